#include "identification/formats/uff/uff_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

double finite(double x) {
  if (!std::isfinite(x))
    throw InputError({"Universal File", "only finite numbers can be written", fmt::format("{}", x),
                      "leave out what is not known"});
  return x;
}

}  // namespace

UffOutput::UffOutput(const std::filesystem::path& path) : file_(path.string()) {}

void UffOutput::begin_dataset(std::string_view number) {
  line("    -1");
  line(fmt::format("{:>6}", number));
}

void UffOutput::end_dataset() {
  line("    -1");
}

void UffOutput::text(std::string_view text) {
  text = without_trailing_blanks(text);
  if (text.find_first_of("\r\n") != std::string_view::npos || text.size() > 80)
    throw InputError(
        {"Universal File", "a text must be one line of at most 80 bytes", shown(text), "shorten it"});
  line(text.empty() || text == "    -1" ? "NONE" : text);
}

void UffOutput::line(std::string_view formatted) {
  file_.write(formatted);
  file_.write("\n");
}

void UffOutput::integers(std::span<const int> numbers, int per_line, int width) {
  std::string row;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    row += fmt::format("{:{}}", numbers[k], width);
    if ((k + 1) % static_cast<std::size_t>(per_line) != 0 && k + 1 < numbers.size()) continue;
    line(row);
    row.clear();
  }
}

void UffOutput::reals(std::span<const double> numbers) {
  std::string row;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    row += e13(numbers[k]);
    if ((k + 1) % 6 != 0 && k + 1 < numbers.size()) continue;
    line(row);
    row.clear();
  }
}

void UffOutput::bytes(const char* begin, std::size_t count) {
  file_.write({begin, count});
}

void UffOutput::close() {
  file_.finish();
}

std::string e13(double x) {
  return fmt::format("{:13.5E}", finite(x));
}

std::string e20(double x) {
  return fmt::format("{:20.12E}", finite(x));
}

std::string d25(double x) {
  std::string text = fmt::format("{:25.16E}", finite(x));
  std::replace(text.begin(), text.end(), 'E', 'D');
  return text;
}

}  // namespace wishbone
