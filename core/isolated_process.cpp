#include "core/isolated_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>
#include <utility>

#include "core/descriptor.h"
#include "core/error.h"
#include "core/packed_bytes.h"

namespace wishbone {
namespace {

// A message is one of these letters, the length of what follows, and that.
constexpr char kRequest = 'r', kPiece = 'p', kDone = 'd', kRefused = 'x';
constexpr std::size_t kHeader = 1 + sizeof(std::uint64_t);

std::string header(char kind, std::uint64_t length) {
  std::string bytes(kHeader, kind);
  std::memcpy(bytes.data() + 1, &length, sizeof length);
  return bytes;
}

std::uint64_t length_in(const char* header) {
  std::uint64_t length;
  std::memcpy(&length, header + 1, sizeof length);
  return length;
}

/// False when the other side is gone.
bool send_all(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

// --- the child ---------------------------------------------------------------------------------------------------------

constexpr int kChannel = 3;  // its only descriptor besides the three standard ones

/// Leaves what belongs to the parent alone: its descriptors (and the locks on them), handlers of signals, terminal.
void let_go_of_the_parent(int socket) {
  const int nowhere = open("/dev/null", O_RDWR);
  const int channel = fcntl(socket, F_DUPFD, kChannel + 1);
  for (const int standard : {0, 1, 2}) dup2(nowhere, standard);
  dup2(channel, kChannel);
  close_range(kChannel + 1, ~0U, 0);
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  // The parent decides what an interruption means; the child goes when the channel closes.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) ::signal(signal, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Address space in use [bytes].
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // takes terabytes of address space
#else
constexpr bool kSanitized = false;
#endif

void limit_memory(std::size_t bytes) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const rlimit limit{address_space() + bytes, RLIM_INFINITY};
  if (!kSanitized) setrlimit(RLIMIT_AS, &limit);
}

/// SIGPROF ends the process once it has used this much processor time from now on; zero: no more limit.
void limit_time(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_PROF, &timer, nullptr);
}

std::optional<std::string> next_request() {
  const auto receive = [](char* bytes, std::size_t count) {
    while (count > 0) {
      const ssize_t n = recv(kChannel, bytes, count, 0);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      bytes += n;
      count -= static_cast<std::size_t>(n);
    }
    return true;
  };
  char head[kHeader];
  if (!receive(head, kHeader)) return {};
  std::string request(length_in(head), '\0');
  if (!receive(request.data(), request.size())) return {};
  return request;
}

void reply(char kind, std::string_view bytes) {
  if (!send_all(kChannel, header(kind, bytes.size())) || !send_all(kChannel, bytes)) _exit(0);
}

std::string packed(const Diagnostic& diagnostic) {
  PackedBytes bytes;
  bytes.put(diagnostic.where);
  bytes.put(diagnostic.what);
  bytes.put(diagnostic.value);
  bytes.put(diagnostic.remedy);
  return bytes.text();
}

void answer(std::string_view request, const std::string& subject, const IsolatedProcess::Limits& limits,
            const IsolatedProcess::Serve& serve) {
  try {
    serve(request, [](std::string_view piece) { reply(kPiece, piece); });
    reply(kDone, {});
  } catch (const Error& e) {
    reply(kRefused, packed(e.diagnostic()));
  } catch (const std::bad_alloc&) {
    reply(kRefused, packed({subject, "the file is broken: it claims more memory than its size explains",
                            fmt::format("more than {} MB", limits.memory_bytes >> 20),
                            "take an intact copy, or write it again"}));
  } catch (const std::exception& e) {
    reply(kRefused, packed({subject, std::string("the file is broken: ") + e.what(), "",
                            "take an intact copy, or write it again"}));
  }
}

[[noreturn]] void live(const std::string& subject, const IsolatedProcess::Limits& limits,
                       const IsolatedProcess::Serve& serve) {
  limit_memory(limits.memory_bytes);
  while (const auto request = next_request()) {
    limit_time(limits.processor_seconds);
    answer(*request, subject, limits, serve);
    limit_time(0);
  }
  _exit(0);
}

}  // namespace

// --- the parent --------------------------------------------------------------------------------------------------------

namespace {

constexpr const char* kGone = "the process that reads it ended";

/// How the child ended. One that goes on (the channel closes a moment before the process is gone, hence the patience) is killed;
/// of that, and of one that somebody else has waited for, there is nothing to tell.
std::optional<int> ending_of(pid_t child) {
  if (child <= 0) return {};
  int status = 0;
  for (int tries = 0; tries < 100; ++tries) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return {};
    usleep(1000);
  }
  kill(child, SIGKILL);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) continue;
  return {};
}

}  // namespace

IsolatedProcess::IsolatedProcess(std::string subject, const Limits& limits, const Serve& serve)
    : subject_(std::move(subject)), limits_(limits) {
  const auto refuse = [&](const char* what) {
    throw NumericsError(
        {subject_, fmt::format("{}: {}", what, std::strerror(errno)), "",
         "the file is read in a process of its own; allow this one more processes and open files"});
  };
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) refuse("cannot make a channel");
  child_ = fork();
  if (child_ == 0) {
    let_go_of_the_parent(ends[1]);
    live(subject_, limits_, serve);
  }
  close(ends[1]);
  socket_ = ends[0];
  if (child_ < 0) {
    end();
    refuse("cannot start a process");
  }
}

IsolatedProcess::~IsolatedProcess() {
  end();
}

void IsolatedProcess::ask(std::string_view request, const Send& take) {
  const std::lock_guard lock(one_request_);
  send(header(kRequest, request.size()));
  send(request);
  std::string piece;
  for (char kind = receive(piece); kind != kDone; kind = receive(piece)) {
    if (kind == kRefused) {
      PackedReader bytes(piece);
      Diagnostic diagnostic;
      for (std::string* part : {&diagnostic.where, &diagnostic.what, &diagnostic.value, &diagnostic.remedy})
        *part = bytes.text();
      throw InputError(std::move(diagnostic));
    }
    try {
      take(piece);
    } catch (...) {
      end();  // what is left of this answer would be taken for the next one's
      throw;
    }
  }
}

char IsolatedProcess::receive(std::string& piece) {
  char head[kHeader];
  receive(head, kHeader);
  const std::uint64_t length = length_in(head);
  if (length > limits_.memory_bytes) fail("the process that reads it answers with more than it may hold");
  piece.resize(length);
  receive(piece.data(), piece.size());
  return head[0];
}

void IsolatedProcess::receive(char* bytes, std::size_t count) {
  int idle_seconds = 0;
  while (count > 0) {
    pollfd wait{socket_, POLLIN, 0};
    const int ready = poll(&wait, 1, 1000);
    if (ready < 0 && errno != EINTR) {
      const std::string reason = system_reason(errno);
      end();  // what is left of this answer would be taken for the next one's
      throw NumericsError({subject_, "the process that reads it cannot be waited for: " + reason, "",
                           "free memory, or allow this process more open files"});
    }
    if (ready == 0 && ++idle_seconds > limits_.idle_seconds)
      fail(fmt::format("reading it does not end within {} s", limits_.idle_seconds));
    if (ready <= 0) continue;
    const ssize_t n = recv(socket_, bytes, count, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(kGone);
    idle_seconds = 0;
    bytes += n;
    count -= static_cast<std::size_t>(n);
  }
}

void IsolatedProcess::send(std::string_view bytes) {
  if (!send_all(socket_, bytes)) fail(kGone);
}

void IsolatedProcess::fail(std::string what) {
  std::string value;
  const std::optional<int> status = ending_of(std::exchange(child_, -1));
  if (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGPROF) {
    what =
        fmt::format("reading it does not end within {:.2g} s of processor time", limits_.processor_seconds);
  } else if (status && WIFSIGNALED(*status)) {
    what = "the library that reads it crashed on it";
    value = strsignal(WTERMSIG(*status));
  }
  throw InputError(
      {subject_, "the file is broken: " + what, value, "take an intact copy, or write it again"});
}

void IsolatedProcess::end() {
  if (socket_ >= 0) {
    shutdown(socket_, SHUT_RDWR);  // reaches the child even if another one holds a copy of this end
    close(std::exchange(socket_, -1));
  }
  if (child_ > 0) waitpid(std::exchange(child_, -1), nullptr, 0);
}

}  // namespace wishbone
