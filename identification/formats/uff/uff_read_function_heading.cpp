#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "identification/formats/uff/uff_fields.h"
#include "identification/formats/uff/uff_function_layout.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

/// I5,I10,I5,I10,1X,A10,I10,I4,1X,A10,I10,I4 in the columns of the standard; false when they do not hold
/// that, or, if `exactly`, do not hold a number at the right end of each. A name that is too long shifts what
/// follows.
bool read_freedoms_in_columns(std::string_view line, bool exactly, UffFunction& f) {
  const std::array<std::pair<std::size_t, std::size_t>, 8> places = {
      {{0, 5}, {5, 10}, {15, 5}, {20, 10}, {41, 10}, {51, 4}, {66, 10}, {76, 4}}};
  const std::array<int*, 8> targets = {&f.type,           &f.number,
                                       &f.version,        &f.load_case,
                                       &f.response.node,  &f.response.direction,
                                       &f.reference.node, &f.reference.direction};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::string_view field = columns(line, places[k].first, places[k].second);
    const auto value = trimmed(field).empty() ? std::optional(0) : integer_in(field);
    if (!value || (exactly && (field.empty() || field.back() == ' '))) return false;
    *targets[k] = *value;
  }
  f.response.entity = trimmed(columns(line, 31, 10));
  f.reference.entity = trimmed(columns(line, 56, 10));
  return true;
}

/// The same ten fields separated by blanks, names without blanks.
bool read_freedoms_as_words(std::string_view line, UffFunction& f) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() != 10) return false;
  const std::array<std::pair<std::size_t, int*>, 8> targets = {{{0, &f.type},
                                                                {1, &f.number},
                                                                {2, &f.version},
                                                                {3, &f.load_case},
                                                                {5, &f.response.node},
                                                                {6, &f.response.direction},
                                                                {8, &f.reference.node},
                                                                {9, &f.reference.direction}}};
  for (const auto& [k, target] : targets) {
    const auto value = integer_in(words[k]);
    if (!value) return false;
    *target = *value;
  }
  f.response.entity = words[4];
  f.reference.entity = words[7];
  return true;
}

void read_freedoms(UffInput& in, UffFunction& f) {
  const std::string_view line = in.require("function type, response and reference");
  if (!read_freedoms_in_columns(line, true, f) && !read_freedoms_as_words(line, f) &&
      !read_freedoms_in_columns(line, false, f))
    in.fail_line(
        "expected function type, number, version, load case, then entity, node and direction of response and "
        "of reference",
        "write the record in its columns: 2(I5,I10),2(1X,A10,I10,I4)");
}

/// 3I10,3E13.5: ordinate type, count of points, spacing, abscissa begin and step, z.
UffLayout read_form(UffInput& in, UffFunction& f) {
  in.require_filled("the data form");
  auto fields = number_fields(in, {10, 10, 10, 13, 13, 13}, 6);
  fields.resize(std::max<std::size_t>(fields.size(), 6));
  const int type = integer_field(in, fields[0], "the ordinate type");
  const int points = integer_field(in, fields[1], "the count of points");
  const int spacing = integer_field(in, fields[2], "the abscissa spacing");
  if (type != 2 && type != 4 && type != 5 && type != 6)
    fail_field(in, fields[0], "the ordinate type must be 2, 4, 5 or 6",
               "write real or complex values in single or double precision");
  if (points < 0) fail_field(in, fields[1], "the count of points must not be negative", "correct the count");
  if (spacing != 0 && spacing != 1)
    fail_field(in, fields[2], "the abscissa spacing must be 0 or 1",
               "write 1 for even, 0 for uneven spacing");
  f.abscissa_start = real_field(in, fields[3], "the first abscissa");
  f.abscissa_step = real_field(in, fields[4], "the abscissa step");
  f.z_value = real_field(in, fields[5], "the z value");
  f.is_even = spacing == 1;
  f.is_complex = type >= 5;
  return {static_cast<std::size_t>(points), f.is_even, f.is_complex, type == 4 || type == 6};
}

/// I10,3I5,1X,20A1,1X,20A1; else six words.
UffAxis axis_from(const UffInput& in) {
  const std::string_view line = in.text();
  std::array<std::string_view, 4> fields = {columns(line, 0, 10), columns(line, 10, 5), columns(line, 15, 5),
                                            columns(line, 20, 5)};
  std::string_view label = columns(line, 26, 20), unit = columns(line, 47, 20);
  const auto is_integer = [](std::string_view field) { return trimmed(field).empty() || integer_in(field); };
  const std::vector<std::string_view> words = words_of(line);
  if (!std::all_of(fields.begin(), fields.end(), is_integer) && words.size() == 6) {
    std::copy_n(words.begin(), 4, fields.begin());
    label = words[4];
    unit = words[5];
  }
  UffAxis axis;
  axis.quantity = integer_field(in, fields[0], "the quantity of an axis");
  axis.length_exponent = integer_field(in, fields[1], "a unit exponent");
  axis.force_exponent = integer_field(in, fields[2], "a unit exponent");
  axis.temperature_exponent = integer_field(in, fields[3], "a unit exponent");
  axis.label = trimmed(label);
  axis.unit = trimmed(unit);
  return axis;
}

}  // namespace

UffLayout read_uff_function_heading(UffInput& in, UffFunction& f) {
  for (std::string& id : f.ids) id = without_trailing_blanks(in.require("an identification line"));
  read_freedoms(in, f);
  const UffLayout layout = read_form(in, f);
  for (UffAxis* axis : {&f.abscissa_axis, &f.ordinate_axis, &f.denominator_axis}) {
    in.require("the description of an axis");
    *axis = axis_from(in);
  }
  in.require_before_binary("the description of the z axis");
  f.z_axis = axis_from(in);
  return layout;
}

}  // namespace wishbone
