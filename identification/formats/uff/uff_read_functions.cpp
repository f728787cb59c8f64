#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "identification/formats/uff/uff_datasets.h"
#include "identification/formats/uff/uff_fields.h"
#include "identification/formats/uff/uff_function_layout.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

/// Takes the numbers of record 12 one after another: abscissa when uneven, then the ordinate.
template <class T>
class ValueSink {
 public:
  ValueSink(const UffLayout& layout, UffFunction& f) : layout_(layout), abscissa_(f.abscissa) {
    values_.reserve(layout.points * layout.ordinates_per_point());
    if (!layout.is_even) abscissa_.reserve(layout.points);
  }
  /// False when the number does not fit T.
  bool put(double number) {
    if (!layout_.is_even && count_ % layout_.numbers_per_point() == 0)
      abscissa_.push_back(number);
    else
      values_.push_back(static_cast<T>(number));
    ++count_;
    return std::isfinite(static_cast<T>(number));
  }
  std::size_t count() const { return count_; }
  std::vector<T> take() { return std::move(values_); }

 private:
  UffLayout layout_;
  std::vector<double>& abscissa_;
  std::vector<T> values_;
  std::size_t count_ = 0;
};

/// 6E13.5; 4E20.12; 2(E13.5,E20.12); E13.5,2E20.12
std::initializer_list<int> value_columns(const UffLayout& layout) {
  static constexpr std::initializer_list<int> kSingle = {13}, kDouble = {20}, kPairs = {13, 20},
                                              kTriples = {13, 20, 20};
  if (!layout.is_double) return kSingle;
  if (layout.is_even) return kDouble;
  return layout.is_complex ? kTriples : kPairs;
}

template <class T>
std::vector<T> read_text_values(UffInput& in, const UffLayout& layout, UffFunction& f) {
  const std::size_t wanted = layout.points * layout.numbers_per_point();
  if (wanted > in.bytes_left() / 2 + 1)
    in.fail(fmt::format("{} values do not fit into the rest of the file", wanted),
            fmt::format("{} bytes", in.bytes_left()), "correct the count of points, or get the whole file");
  ValueSink<T> sink(layout, f);
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    for (const std::string_view field : number_fields(in, value_columns(layout)))
      if (!sink.put(real_field(in, field, "a value")))
        fail_field(in, field, "the value does not fit single precision", "write it in double precision");
    if (sink.count() > wanted)
      in.fail_line(fmt::format("expected {} values, found more", wanted), "correct the count of points");
  }
  if (sink.count() < wanted)
    in.fail(fmt::format("expected {} values, found {}", wanted, sink.count()), "the delimiter",
            "correct the count of points, or get the whole file");
  return sink.take();
}

template <class T>
void reverse_bytes(T& number) {
  std::array<unsigned char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &number, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  std::memcpy(&number, bytes.data(), sizeof(T));
}

constexpr bool kNativeIsBig = std::endian::native == std::endian::big;

/// Fills `numbers` from the file, the byte order of the machine.
template <class T>
void read_numbers(UffInput& in, bool is_big_endian, std::vector<T>& numbers) {
  in.read_binary(reinterpret_cast<char*>(numbers.data()), numbers.size() * sizeof(T));
  if (is_big_endian != kNativeIsBig)
    for (T& number : numbers) reverse_bytes(number);
  const auto bad = std::find_if(numbers.begin(), numbers.end(), [](T x) { return !std::isfinite(x); });
  if (bad != numbers.end())
    in.fail("the values must be finite numbers",
            fmt::format("{} as number {} of the binary block", *bad, bad - numbers.begin() + 1),
            "check byte order and format in the first line of the dataset");
}

/// Uneven: point after point, through a small buffer. A is the type of the abscissa.
template <class A, class T>
std::vector<T> read_uneven_values(UffInput& in, const UffLayout& layout, UffFunction& f) {
  ValueSink<T> sink(layout, f);
  std::vector<A> abscissa(1);
  std::vector<T> ordinates(layout.ordinates_per_point());
  for (std::size_t k = 0; k < layout.points; ++k) {
    read_numbers(in, f.is_big_endian, abscissa);
    read_numbers(in, f.is_big_endian, ordinates);
    sink.put(static_cast<double>(abscissa[0]));
    for (const T ordinate : ordinates) sink.put(static_cast<double>(ordinate));
  }
  return sink.take();
}

/// The length of the binary block: the announced one if the delimiter follows there, else one that the count
/// of points gives: programs announce the bytes of real values for complex ones, or count line ends.
struct BlockLength {
  std::uintmax_t bytes = 0;
  bool has_single_abscissa = false;
};

BlockLength find_block_length(UffInput& in, const UffLayout& layout, std::uintmax_t announced) {
  const std::size_t size = layout.is_double ? 8 : 4;
  const std::uintmax_t equal = std::uintmax_t{layout.points} * layout.numbers_per_point() * size;
  std::vector<BlockLength> candidates = {{equal, !layout.is_double}};
  if (layout.is_double && !layout.is_even)
    candidates.push_back({equal - std::uintmax_t{layout.points} * 4, true});
  std::stable_sort(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
    return (a.bytes == announced) > (b.bytes == announced);
  });
  for (const BlockLength& candidate : candidates)
    if (in.delimiter_follows(candidate.bytes)) return candidate;
  in.fail(fmt::format("expected {} bytes for {} points of {} {}-byte numbers and then the delimiter", equal,
                      layout.points, layout.numbers_per_point(), size),
          fmt::format("{} bytes announced, {} left in the file", announced, in.bytes_left()),
          "correct the count of points or the byte count, or get the whole file");
}

template <class T>
std::vector<T> read_binary_values(UffInput& in, const UffLayout& layout, std::uintmax_t announced,
                                  UffFunction& f) {
  const BlockLength block = find_block_length(in, layout, announced);
  if (!layout.is_even && block.has_single_abscissa) return read_uneven_values<float, T>(in, layout, f);
  if (!layout.is_even) return read_uneven_values<double, T>(in, layout, f);
  std::vector<T> values(layout.points * layout.ordinates_per_point());
  read_numbers(in, f.is_big_endian, values);
  return values;
}

/// Byte order, format, lines of the heading, bytes: words, or in columns where they touch.
std::array<std::string_view, 4> binary_form_fields(std::string_view line) {
  const std::string_view rest = line.substr(std::min(line.find_first_of("bB") + 1, line.size()));
  const std::vector<std::string_view> words = words_of(rest);
  if (words.size() >= 4 && std::all_of(words.begin(), words.begin() + 4, real_in))
    return {words[0], words[1], words[2], words[3]};
  return {columns(rest, 0, 6), columns(rest, 6, 6), columns(rest, 12, 12), columns(rest, 24, 12)};
}

}  // namespace

void read_uff_function(UffInput& in, UffContents& contents) {
  UffFunction f;
  const UffLayout layout = read_uff_function_heading(in, f);
  if (layout.is_double)
    f.values = read_text_values<double>(in, layout, f);
  else
    f.values = read_text_values<float>(in, layout, f);
  contents.file.functions.push_back(std::move(f));
}

/// I6,1A1,I6,I6,I12,I12,...: 58, b, byte order (1 little, 2 big endian), format (1 VAX, 2 IEEE 754, 3 IBM
/// 370), lines of the heading, bytes of the block.
void read_uff_binary_function(UffInput& in, UffContents& contents) {
  UffFunction f;
  f.is_binary = true;
  const std::array<std::string_view, 4> fields = binary_form_fields(in.text());
  const int order = integer_field(in, fields[0], "the byte order");
  const int format = integer_field(in, fields[1], "the floating-point format");
  const double bytes = real_field(in, fields[3], "the count of bytes");
  if (order != 1 && order != 2)
    fail_field(in, fields[0], "the byte order must be 1 or 2", "write 1 for little, 2 for big endian");
  if (format != 2)
    fail_field(in, fields[1], "the floating-point format must be 2", "write the values as IEEE 754 numbers");
  f.is_big_endian = order == 2;

  const UffLayout layout = read_uff_function_heading(in, f);
  const auto announced = bytes > 0 && bytes < 1e18 ? static_cast<std::uintmax_t>(bytes) : 0;
  if (layout.is_double)
    f.values = read_binary_values<double>(in, layout, announced, f);
  else
    f.values = read_binary_values<float>(in, layout, announced, f);
  in.end_dataset();
  contents.file.functions.push_back(std::move(f));
}

}  // namespace wishbone
