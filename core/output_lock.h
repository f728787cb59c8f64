#pragma once

#include <string>

#include "core/descriptor.h"

namespace wishbone {

/// Keeps the results of one run to one run: while it lives nobody else can take the lock of the same path. It is a lock of the
/// operating system on PATH.lock, which holds the process number of the owner; a process that dies gives it up, so that a lock
/// file left behind is in nobody's way.
class OutputLock {
 public:
  /// @throws InputError when another process, or another part of this one, writes there: names its process number;
  ///   NumericsError when the lock file cannot be made, or what has the name is no file (a device, a folder)
  OutputLock(std::string path);  // NOLINT(google-explicit-constructor): a path to write to is a lock to take
  /// Removes the lock file.
  ~OutputLock();
  OutputLock(OutputLock&&) noexcept = default;
  OutputLock& operator=(OutputLock&&) = delete;

  /// What is locked.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  Descriptor file_;
};

}  // namespace wishbone
