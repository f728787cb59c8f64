#pragma once

#include <string>

namespace wishbone {

/// Writes a text file. Throws NumericsError when it cannot be written.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace wishbone
