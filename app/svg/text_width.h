#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wishbone {

/// Estimate of the width of a text (UTF-8) in a sans-serif font of that size, on the safe side [px].
double text_width(std::string_view text, double font_size);
/// The text, cut and ended by "…" where it is wider than that.
std::string fitted(const std::string& text, double font_size, double width);

double widest(const std::vector<std::string>& texts, double font_size);

}  // namespace wishbone
