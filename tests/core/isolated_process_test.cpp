#include "core/isolated_process.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "core/error.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string answer(IsolatedProcess& process, std::string_view request) {
  std::string text;
  process.ask(request, [&](std::string_view piece) { text += piece; });
  return text;
}

void echo(std::string_view request, const IsolatedProcess::Send& send) {
  if (request == "refuse") throw InputError({"a.h5:/x", "it is broken", "7", "mend it"});
  if (request == "crash") raise(SIGSEGV);
  if (request == "abort") abort();
  if (request == "leave") _exit(0);
  if (request == "loop")
    for (volatile bool on = true; on;) continue;
  if (request == "sleep") pause();
  if (request == "allocate") std::vector<char>(std::size_t{1} << 40);
  send(request);
  send("!");
}

class Isolated : public testing::Test {
 protected:
  std::string error_of(const std::string& request) {
    return message_of<InputError>([&] { answer(process_, request); });
  }
  IsolatedProcess process_{"a.h5", {.processor_seconds = 0.3, .idle_seconds = 1}, echo};
};

TEST_F(Isolated, AnswersEachRequest) {
  EXPECT_EQ(answer(process_, "one"), "one!");
  EXPECT_EQ(answer(process_, ""), "!");
  const std::string large(5'000'000, 'x');
  EXPECT_EQ(answer(process_, large), large + "!");
}

TEST_F(Isolated, HandsErrorsOnAndGoesOn) {
  EXPECT_EQ(error_of("refuse"), "a.h5:/x: error: it is broken (got 7)\n  mend it");
  EXPECT_EQ(answer(process_, "one"), "one!");
}

TEST_F(Isolated, CrashIsAnErrorOfTheInput) {
  for (const char* how : {"crash", "abort"}) {
    IsolatedProcess process("a.h5", {}, echo);
    EXPECT_THAT(message_of<InputError>([&] { answer(process, how); }),
                AllOf(HasSubstr("a.h5: error: "), HasSubstr("broken")));
    EXPECT_THROW(answer(process, "one"), InputError) << "and stays one";
  }
}

TEST_F(Isolated, ProcessThatLeavesIsAnErrorOfTheInput) {
  EXPECT_THAT(error_of("leave"),
              HasSubstr("a.h5: error: the file is broken: the process that reads it ended"));
}

TEST_F(Isolated, ProcessOfWhichNobodyKnowsTheEndIsNotSaidToGoOn) {
  const auto handler = signal(SIGCHLD, SIG_IGN);  // the system forgets children that have ended
  for (const char* again : {"", ", and stays so"})
    EXPECT_THAT(error_of("crash"), HasSubstr("broken: the process that reads it ended")) << again;
  signal(SIGCHLD, handler);
}

TEST_F(Isolated, AnswerLargerThanItsMemoryIsNotWaitedFor) {
  const std::string large(std::size_t{4} << 20, 'x');
  IsolatedProcess process("a.h5", {.memory_bytes = std::size_t{1} << 20},
                          [&](std::string_view, const IsolatedProcess::Send& send) { send(large); });
  EXPECT_THAT(message_of<InputError>([&] { answer(process, ""); }), HasSubstr("more than it may hold"));
}

TEST_F(Isolated, EndlessLoopIsStoppedByItsProcessorTime) {
  EXPECT_THAT(error_of("loop"), HasSubstr("reading it does not end within 0.3 s of processor time"));
}

TEST_F(Isolated, SilenceIsStoppedByTheClock) {
  EXPECT_THAT(error_of("sleep"), HasSubstr("reading it does not end within 1 s"));
}

TEST_F(Isolated, ProcessorTimeCountsForEachRequestAnew) {
  const auto work = [](std::string_view, const IsolatedProcess::Send&) {
    const clock_t start = clock();
    while (clock() - start < CLOCKS_PER_SEC / 8) continue;
  };
  IsolatedProcess process("a.h5", {.processor_seconds = 0.3}, work);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(answer(process, ""), "");
}

TEST_F(Isolated, TooMuchMemoryIsAnErrorOfTheInput) {
  EXPECT_THAT(error_of("allocate"), HasSubstr("a.h5: error: the file is broken"));
}

TEST(IsolatedProcess, LeavesNoProcessBehind) {
  { IsolatedProcess process("a.h5", {}, echo); }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

TEST_F(Isolated, HoldsNoFileOfTheCaller) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  IsolatedProcess other("b.h5", {}, echo);
  answer(other, "it has begun");
  close(ends[1]);
  char byte;
  EXPECT_EQ(read(ends[0], &byte, 1), 0) << "the other process keeps the end for writing open";
  close(ends[0]);
}

TEST_F(Isolated, ServesSeveralThreadsOneAfterTheOther) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      const std::string text(1000 + static_cast<std::size_t>(i), static_cast<char>('a' + i));
      for (int n = 0; n < 200; ++n) EXPECT_EQ(answer(process_, text), text + "!");
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace wishbone
