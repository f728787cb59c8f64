#include "identification/formats/text_writer.h"

#include "core/error.h"

namespace wishbone {
namespace {

[[noreturn]] void fail(const std::string& path) {
  throw NumericsError(
      {path, "cannot write the file", "", "check that the folder exists, has room and may be written to"});
}

}  // namespace

TextWriter::TextWriter(const std::filesystem::path& path)
    : file_(path.string()), stream_(file_.name(), std::ios::binary) {
  if (!stream_) fail(file_.path());
}

void TextWriter::flush() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void TextWriter::close() {
  flush();
  stream_.close();
  if (!stream_) fail(file_.path());
  file_.finish();
}

}  // namespace wishbone
