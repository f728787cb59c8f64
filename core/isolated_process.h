#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace wishbone {

/// A child process that works on bytes which nobody has vouched for, so that whatever they do to the library that reads
/// them (crash, endless loop, memory without end) happens to the child: the caller gets an InputError that says so.
///
/// The child is a copy of this process made by fork(); it answers requests until this object goes. Threads: one request at
/// a time, others wait; the library that the child uses must not be in use by another thread when the object is made.
class IsolatedProcess {
 public:
  struct Limits {
    double processor_seconds = 1;                       ///< for each request
    std::size_t memory_bytes = std::size_t{256} << 20;  ///< beyond what this process has now
    int idle_seconds = 60;                              ///< without a piece of an answer
  };

  using Send = std::function<void(std::string_view piece)>;
  /// Runs in the child: sends the pieces of the answer. What it throws is thrown by ask() as InputError.
  using Serve = std::function<void(std::string_view request, const Send& send)>;

  /// `subject` is what the bytes are, mostly a file: the place of the errors. Throws NumericsError when the system gives no
  /// process.
  IsolatedProcess(std::string subject, const Limits& limits, const Serve& serve);
  ~IsolatedProcess();
  IsolatedProcess(const IsolatedProcess&) = delete;
  IsolatedProcess& operator=(const IsolatedProcess&) = delete;

  /// Hands the pieces of the answer to `take` in their order. Throws InputError: what `serve` threw, or how the child ended.
  void ask(std::string_view request, const Send& take);

 private:
  char receive(std::string& piece);
  void receive(char* bytes, std::size_t count);
  void send(std::string_view bytes);
  /// What is wrong, unless the way that the child ended says it.
  [[noreturn]] void fail(std::string what);
  void end();

  std::string subject_;
  Limits limits_;
  std::mutex one_request_;
  int socket_ = -1, child_ = -1;
};

}  // namespace wishbone
