#include "core/output_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <span>
#include <utility>

#include "core/error.h"
#include "core/partial_file.h"

namespace wishbone {
namespace {

/// False when the name has been given to another file since `file` was opened: its owner removed it on leaving.
bool still_has_its_name(const Descriptor& file) {
  struct stat opened, named;
  return fstat(file.get(), &opened) == 0 && lstat(file.path().c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::string owner_of(const Descriptor& file) {
  char text[24] = {};
  const bool known = ::pread(file.get(), text, sizeof text - 1, 0) > 0;
  return known ? fmt::format("process {}", std::atoi(text)) : "another process";
}

[[noreturn]] void refuse(const std::string& path, const Descriptor& file, int error_number) {
  if (error_number != EWOULDBLOCK)
    throw NumericsError({path, "the file cannot be locked: " + system_reason(error_number), file.path(),
                         "write to a folder whose file system locks files"});
  throw InputError({path, "another run is writing to this file", owner_of(file),
                    "give this run an output of its own, or wait until the other one has ended"});
}

/// Of the processes that find the file at once, the one that locks it while it has its name is the owner.
Descriptor lock(const std::string& path) {
  check_is_file_or_free(path);
  for (;;) {
    Descriptor file = Descriptor::open_or_make(path + ".lock");
    if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) refuse(path, file, errno);
    if (!still_has_its_name(file)) continue;
    const std::string owner = fmt::format("{}\n", getpid());
    if (ftruncate(file.get(), 0) != 0) refuse(path, file, errno);
    file.write(std::as_bytes(std::span(owner)), 0);
    return file;
  }
}

}  // namespace

OutputLock::OutputLock(std::string path) : path_(std::move(path)), file_(lock(path_)) {}

OutputLock::~OutputLock() {
  if (file_.get() >= 0) ::unlink(file_.path().c_str());
}

}  // namespace wishbone
