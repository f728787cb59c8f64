#include "core/partial_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <random>
#include <span>
#include <utility>

namespace wishbone {
namespace {

constexpr std::size_t kBufferSize = 1 << 16;

/// A name that nobody else has: neither another writer of the same file nor one that was killed.
std::string free_name(const std::string& path) {
  std::random_device random;
  std::string name;
  do {
    name = fmt::format("{}.partial-{:06x}", path, random() & 0xffffffU);
  } while (::access(name.c_str(), F_OK) == 0);
  return name;
}

}  // namespace

PartialFile::PartialFile(std::string path)
    : path_(std::move(path)), descriptor_(Descriptor::make(free_name(path_))) {}

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
  put_in_place(name(), path_);
  finished_ = true;
}

void write_file(const std::string& path, std::string_view bytes) {
  PartialFile file(path);
  file.write(bytes);
  file.finish();
}

}  // namespace wishbone
