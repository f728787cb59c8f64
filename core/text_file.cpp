#include "core/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "core/error.h"
#include "core/input_file.h"
#include "core/utf8.h"

namespace wishbone {
namespace {

std::string read_bytes(const std::filesystem::path& path, std::size_t max_bytes, const Source& asked_from) {
  const std::string name = fmt::format("'{}'", path.string());
  const auto refuse = [&](const std::string& what, const std::string& remedy) {
    throw InputError({asked_from.text(), what, name, remedy});
  };
  std::error_code error;
  if (const auto fault = input_fault(path)) {
    refuse(fault->what, std::filesystem::exists(path, error)
                            ? fault->remedy
                            : "check the name; an included file is looked for relative to the including one");
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse("the file cannot be opened", "check its permissions");
  std::string bytes(max_bytes + 1, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) refuse("the file cannot be read", "check the disk and the permissions");
  if (bytes.size() > max_bytes) {
    refuse(fmt::format("the file is larger than {} bytes", max_bytes),
           "split it into several files and include them");
  }
  return bytes;
}

Source place_at(const std::filesystem::path& path, std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line_start = before.rfind('\n') + 1;  // npos + 1 == 0: the first line
  return {std::make_shared<const std::string>(path.string()),
          1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(offset - line_start), ""};
}

void check_text(const std::filesystem::path& path, std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if ((c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F) {
      throw InputError({place_at(path, text, i).text(), "the file is not text",
                        fmt::format("byte 0x{:02x}", c), "name a YAML text file"});
    }
    const std::size_t n = utf8_length(text.substr(i));
    if (n == 0) {
      throw InputError({place_at(path, text, i).text(), "the file is not UTF-8 text",
                        fmt::format("byte 0x{:02x}", c), "save it in the encoding UTF-8"});
    }
    i += n;
  }
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, std::size_t max_bytes,
                           const Source& asked_from) {
  std::string text = read_bytes(path, max_bytes, asked_from);
  if (text.empty()) throw InputError({path.string(), "the file is empty", "", "write a document into it"});
  check_text(path, text);
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

}  // namespace wishbone
