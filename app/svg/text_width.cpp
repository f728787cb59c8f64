#include "app/svg/text_width.h"

#include <algorithm>

namespace wishbone {

double text_width(std::string_view text, double font_size) {
  constexpr double kWidthOverSize = 0.58;
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return kWidthOverSize * font_size * static_cast<double>(std::count_if(text.begin(), text.end(), starts_character));
}

double widest(const std::vector<std::string>& texts, double font_size) {
  double width = 0;
  for (const std::string& text : texts) width = std::max(width, text_width(text, font_size));
  return width;
}

}  // namespace wishbone
