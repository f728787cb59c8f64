#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace wishbone {

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);
/// Without blanks at the end.
std::string_view without_trailing_blanks(std::string_view text);

/// For messages: in quotes, valid UTF-8, control characters replaced, cut to a readable length; nothing for
/// nothing.
std::string shown(std::string_view found);

/// A whole number in I format: digits with a sign, or a real without a fraction such as "3.0".
std::optional<int> integer_in(std::string_view field);

/// A number as Fortran writes it: 1.0, 1E5, 1.0D-03, 0.00000E+000, 1.0-101 (three digits without a letter).
/// Numbers too small for a double are zero; nothing when it is no number, too large, infinite or not a
/// number.
std::optional<double> real_in(std::string_view field);

/// Length of the number at the start of `text`; 0 when there is none. Tells where numbers that run together,
/// as in "1.0E+00-2.0E+00", come apart.
std::size_t number_length(std::string_view text);

}  // namespace wishbone
