#include "core/descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

/// Makes a new name in a folder survive a power cut; file systems that cannot do it say so, and it is no fault of the file.
void sync_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

std::string system_reason(int error_number) {
  std::string reason = std::generic_category().message(error_number);
  if (!reason.empty()) reason[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(reason[0])));
  return reason;
}

Descriptor::Descriptor(std::string path, int flags, const char* failure)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), flags | O_NOFOLLOW | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail(failure, errno);
}

Descriptor Descriptor::make(const std::string& path) {
  return {path, O_RDWR | O_CREAT | O_EXCL, "the file cannot be made"};
}

Descriptor Descriptor::open(const std::string& path) {
  return {path, O_RDWR, "the file cannot be opened"};
}

Descriptor Descriptor::open_or_make(const std::string& path) {
  return {path, O_RDWR | O_CREAT, "the file can be neither opened nor made"};
}

Descriptor::Descriptor(Descriptor&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Descriptor::fail(const char* what, int error_number) const {
  throw NumericsError({path_, std::string(what) + ": " + system_reason(error_number), "",
                       error_number == ENOSPC || error_number == EDQUOT
                           ? "make room on the disk, or write to another one"
                           : "check the folder and its permissions"});
}

void Descriptor::write(std::span<const std::byte> bytes, std::size_t offset) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail("cannot write", count < 0 ? errno : ENOSPC);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::size_t>(count);
  }
}

void Descriptor::read(std::span<std::byte> bytes, std::size_t offset) const {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail("cannot read back what was written", count < 0 ? errno : EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += static_cast<std::size_t>(count);
  }
}

void Descriptor::sync() {
  if (::fdatasync(descriptor_) != 0) fail("cannot put the file on the disk", errno);
}

void Descriptor::close() {
  if (descriptor_ >= 0 && ::close(std::exchange(descriptor_, -1)) != 0) fail("cannot write", errno);
}

void put_in_place(const std::string& from, const std::string& to) {
  Descriptor::open(from).sync();
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error)
    throw NumericsError({to, "the file cannot be given its final name: " + system_reason(error.value()), "",
                         "check the folder and its permissions"});
  sync_folder_of(to);
}

}  // namespace wishbone
