#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "identification/formats/uff/uff_input.h"

namespace wishbone {

/// The number fields of a line, in order; empty ones are blank. `widths` are the columns of the standard's
/// format, repeated as often as the line is long; `expected` is how many numbers the record has, 0 when any
/// number of them may stand there.
///
/// Programs keep the columns of the standard or separate by blanks, some in other columns. So a line counts
/// as separated by blanks when that gives the expected count of numbers; else as in the columns of the
/// standard, where numbers may touch and fields be blank; else numbers come apart where one ends and another
/// begins ("1.0E+00-2.0E+00"). Throws InputError at the first word that is no number.
std::vector<std::string_view> number_fields(const UffInput& in, std::initializer_list<int> widths,
                                            std::size_t expected = 0);

/// The words of a text, separated by blanks.
std::vector<std::string_view> words_of(std::string_view text);
/// The part of a line in columns [begin, begin + width), shorter or empty when the line ends before.
std::string_view columns(std::string_view line, std::size_t begin, std::size_t width);

/// A field of the current line of `in` as a number, blank as zero. Throws InputError, saying that it is
/// `what`.
int integer_field(const UffInput& in, std::string_view field, std::string_view what);
double real_field(const UffInput& in, std::string_view field, std::string_view what);

/// Throws InputError at a field of the current line.
[[noreturn]] void fail_field(const UffInput& in, std::string_view field, std::string what,
                             std::string remedy);

/// All integers of the current line, written in columns of `width`.
std::vector<int> integers_of_line(const UffInput& in, int width, std::size_t expected, std::string_view what);
/// Appends all reals of the current line, written in columns of `width`.
void append_reals(const UffInput& in, int width, std::string_view what, std::vector<double>& reals);

}  // namespace wishbone
