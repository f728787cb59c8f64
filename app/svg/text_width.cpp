#include "app/svg/text_width.h"

#include <algorithm>

namespace wishbone {
namespace {

bool starts_character(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
}

}  // namespace

double text_width(std::string_view text, double font_size) {
  constexpr double kWidthOverSize = 0.58;
  return kWidthOverSize * font_size *
         static_cast<double>(std::count_if(text.begin(), text.end(), starts_character));
}

std::string fitted(const std::string& text, double font_size, double width) {
  if (text_width(text, font_size) <= width) return text;
  std::string kept = text;
  while (!kept.empty() && text_width(kept + "…", font_size) > width) {
    while (!starts_character(kept.back())) kept.pop_back();
    kept.pop_back();
  }
  return kept + "…";
}

double widest(const std::vector<std::string>& texts, double font_size) {
  double width = 0;
  for (const std::string& text : texts) width = std::max(width, text_width(text, font_size));
  return width;
}

}  // namespace wishbone
