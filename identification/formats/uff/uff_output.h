#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/partial_file.h"
#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// Writes the records of a Universal File, which has its name once it is whole.
class UffOutput {
 public:
  /// Throws NumericsError when the file cannot be created.
  explicit UffOutput(const std::filesystem::path& path);

  void begin_dataset(std::string_view number);
  void end_dataset();
  /// One line of text without trailing blanks, "NONE" for none: identification lines must not be blank.
  /// Throws InputError if it holds a line break.
  void text(std::string_view line);
  void line(std::string_view formatted);
  /// Rows of `per_line` numbers in "%{width}d".
  void integers(std::span<const int> numbers, int per_line, int width = 10);
  /// Rows of six in E13.5.
  void reals(std::span<const double> numbers);
  void bytes(const char* begin, std::size_t count);
  /// Gives the file its name. Throws NumericsError unless everything reached the disk.
  void close();

 private:
  PartialFile file_;
};

/// E13.5, E20.12; D25.16 as dataset 2411 has it.
std::string e13(double x);
std::string e20(double x);
std::string d25(double x);

/// Dataset 58 or 58b.
void write_uff_function(UffOutput& out, const UffFunction& function);

}  // namespace wishbone
