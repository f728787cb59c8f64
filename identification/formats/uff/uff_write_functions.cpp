#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "identification/formats/uff/uff_output.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

std::size_t ordinates_per_point(const UffFunction& f) {
  return f.is_complex ? 2 : 1;
}

void check(const UffFunction& f) {
  const auto refuse = [](std::string what, std::size_t value, std::string remedy) {
    throw InputError({"Universal File", std::move(what), fmt::format("{}", value), std::move(remedy)});
  };
  if (f.value_count() % ordinates_per_point(f) != 0)
    refuse("complex values need real and imaginary parts", f.value_count(), "give both parts of each");
  if (f.point_count() > 2147483647u) refuse("a function has too many points", f.point_count(), "split it");
  if (f.abscissa.size() != (f.is_even ? 0 : f.point_count()))
    refuse(fmt::format("a function of {} points must list {} abscissae", f.point_count(),
                       f.is_even ? 0 : f.point_count()),
           f.abscissa.size(), "list them when spacing is uneven, and only then");
}

/// A name of at most `width` bytes, "NONE" for none.
std::string name(std::string_view text, std::size_t width) {
  text = trimmed(text);
  if (text.size() > width || text.find_first_of("\r\n") != std::string_view::npos)
    throw InputError({"Universal File", fmt::format("a name must be one line of at most {} bytes", width),
                      shown(text), "shorten it"});
  return fmt::format("{:<{}}", text.empty() ? "NONE" : text, width);
}

void write_axis(UffOutput& out, const UffAxis& axis) {
  out.line(fmt::format("{:10}{:5}{:5}{:5} {} {}", axis.quantity, axis.length_exponent, axis.force_exponent,
                       axis.temperature_exponent, name(axis.label, 20), name(axis.unit, 20)));
}

void write_heading(UffOutput& out, const UffFunction& f) {
  for (const std::string& id : f.ids) out.text(id);
  out.line(fmt::format("{:5}{:10}{:5}{:10} {}{:10}{:4} {}{:10}{:4}", f.type, f.number, f.version, f.load_case,
                       name(f.response.entity, 10), f.response.node, f.response.direction,
                       name(f.reference.entity, 10), f.reference.node, f.reference.direction));
  const int type = (f.is_double() ? 4 : 2) + (f.is_complex ? (f.is_double() ? 2 : 3) : 0);
  out.line(fmt::format("{:10}{:10}{:10}", type, f.point_count(), f.is_even ? 1 : 0) + e13(f.abscissa_start) +
           e13(f.abscissa_step) + e13(f.z_value));
  for (const UffAxis* axis : {&f.abscissa_axis, &f.ordinate_axis, &f.denominator_axis, &f.z_axis})
    write_axis(out, *axis);
}

/// How many numbers stand on a line of text: 6E13.5, 4E20.12, 2(E13.5,E20.12), E13.5,2E20.12.
std::size_t numbers_per_line(const UffFunction& f) {
  if (!f.is_double()) return 6;
  return f.is_even || !f.is_complex ? 4 : 3;
}

template <class T>
void write_text_values(UffOutput& out, const UffFunction& f, const std::vector<T>& values) {
  const std::size_t per_point = ordinates_per_point(f), per_line = numbers_per_line(f);
  std::string row;
  std::size_t on_line = 0;
  const auto put = [&](std::string number) {
    row += number;
    if (++on_line < per_line) return;
    out.line(row);
    row.clear();
    on_line = 0;
  };
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!f.is_even && k % per_point == 0) put(e13(f.abscissa[k / per_point]));
    put(sizeof(T) == 4 ? e13(values[k]) : e20(values[k]));
  }
  if (on_line > 0) out.line(row);
}

template <class T>
void put_binary(UffOutput& out, T number, bool reversed) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &number, sizeof(T));
  if (reversed) std::reverse(bytes.begin(), bytes.end());
  out.bytes(bytes.data(), bytes.size());
}

/// Abscissae in the precision of the values.
template <class T>
void write_binary_values(UffOutput& out, const UffFunction& f, const std::vector<T>& values) {
  const bool reversed = f.is_big_endian != (std::endian::native == std::endian::big);
  const std::size_t per_point = ordinates_per_point(f);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!f.is_even && k % per_point == 0)
      put_binary(out, static_cast<T>(f.abscissa[k / per_point]), reversed);
    put_binary(out, values[k], reversed);
  }
}

}  // namespace

void write_uff_function(UffOutput& out, const UffFunction& f) {
  check(f);
  const std::size_t bytes = (f.value_count() + f.abscissa.size()) * (f.is_double() ? 8 : 4);
  if (f.is_binary)
    out.begin_dataset(fmt::format("    58b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", f.is_big_endian ? 2 : 1, 2,
                                  11, bytes, 0, 0, 0, 0));
  else
    out.begin_dataset("58");
  write_heading(out, f);
  std::visit(
      [&](const auto& values) {
        f.is_binary ? write_binary_values(out, f, values) : write_text_values(out, f, values);
      },
      f.values);
  out.end_dataset();
}

}  // namespace wishbone
