#include "identification/formats/text_writer.h"

namespace wishbone {

void TextWriter::flush() {
  file_.write({buffer_.data(), buffer_.size()});
  buffer_.clear();
}

void TextWriter::close() {
  flush();
  file_.finish();
}

}  // namespace wishbone
