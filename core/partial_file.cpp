#include "core/partial_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <span>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

constexpr std::size_t kBufferSize = 1 << 16;

// What follows the final name while the file is not whole: this, and so many hexadecimal digits.
constexpr std::string_view kEnding = ".partial-";
constexpr std::size_t kDigits = 6;

/// A name that nobody else has: neither another writer of the same file nor one that was killed.
std::string free_name(const std::string& path) {
  std::random_device random;
  std::string name;
  do {
    name = fmt::format("{}{}{:0{}x}", path, kEnding, random() & 0xffffffU, kDigits);
  } while (::access(name.c_str(), F_OK) == 0);
  return name;
}

}  // namespace

void check_is_file_or_free(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::file_status status = fs::status(path, unknown);
  if (!fs::exists(status) || fs::is_regular_file(status)) return;
  throw NumericsError({path, "a folder, a device or the like has this name: it is not replaced by a file", "",
                       "give the output the name of a file"});
}

bool PartialFile::is_name_of(std::string_view name, std::string_view path) {
  if (name.size() != path.size() + kEnding.size() + kDigits || !name.starts_with(path)) return false;
  const std::string_view ending = name.substr(path.size());
  return ending.starts_with(kEnding) &&
         ending.find_first_not_of("0123456789abcdef", kEnding.size()) == std::string_view::npos;
}

PartialFile::PartialFile(std::string path)
    : path_((check_is_file_or_free(path), std::move(path))),
      descriptor_(Descriptor::make(free_name(path_))) {}

PartialFile::~PartialFile() {
  if (!finished_) ::unlink(name().c_str());
}

void PartialFile::write(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= kBufferSize) flush();
}

void PartialFile::flush() {
  descriptor_.write(std::as_bytes(std::span(buffer_)), size_);
  size_ += buffer_.size();
  buffer_.clear();
}

void PartialFile::finish() {
  flush();
  descriptor_.close();
  check_is_file_or_free(path_);  // it may have been made since
  put_in_place(name(), path_);
  finished_ = true;
}

void write_file(const std::string& path, std::string_view bytes) {
  PartialFile file(path);
  file.write(bytes);
  file.finish();
}

}  // namespace wishbone
