#include "identification/formats/uff/uff_reader.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/input_file.h"
#include "identification/formats/uff/uff_datasets.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

using Read = void (*)(UffInput&, UffContents&);

constexpr std::array<std::pair<std::string_view, Read>, 13> kReaders = {{
    {"15", read_uff_nodes},
    {"18", read_uff_coordinate_systems},
    {"55", read_uff_data_at_nodes},
    {"58", read_uff_function},
    {"58b", read_uff_binary_function},
    {"82", read_uff_trace_line},
    {"151", read_uff_header},
    {"164", read_uff_units},
    {"781", read_uff_nodes_in_double},
    {"2411", read_uff_nodes_of_part},
    {"2412", read_uff_elements},
    {"2414", read_uff_analysis_data},
    {"2420", read_uff_coordinate_matrices},
}};

/// "58" or "58b" at the begin of a line; empty when there is no number.
std::string dataset_of(std::string_view line) {
  line = trimmed(line);
  const std::size_t digits = std::min(line.find_first_not_of("0123456789"), line.size());
  if (digits == 0 || digits > 6) return "";
  std::string name(line.substr(0, digits));
  if (digits < line.size() && (line[digits] == 'b' || line[digits] == 'B')) name += 'b';
  return name;
}

/// From the line of the dataset's number to its delimiter.
void read_dataset(UffInput& in, UffContents& contents) {
  const std::string name = dataset_of(in.text());
  if (name.empty()) in.fail_line("expected the number of a dataset", "name a Universal File (.uff, .unv)");
  in.set_dataset(name);
  for (const auto& [known, read] : kReaders)
    if (name == known) return read(in, contents);
  contents.file.unused.push_back({std::stoi(name), in.line(), "datasets of this kind are not read"});
  in.skip_dataset();
}

/// Some programs write a line of text between two datasets; a number there tells that a delimiter is missing.
void pass_over_text(const UffInput& in, bool is_first, UffFile& file) {
  if (is_first)
    in.fail_line("expected the delimiter '    -1' in front of a dataset",
                 "name a Universal File (.uff, .unv)");
  const std::string_view text = trimmed(in.text());
  if (number_length(text) > 0)
    in.fail_line("expected the delimiter '    -1' in front of a dataset",
                 "close the dataset before it by '    -1'");
  file.unused.push_back({0, in.line(), "text between datasets"});
}

}  // namespace

UffFile read_uff(const std::filesystem::path& path) {
  if (const auto fault = input_fault(path)) throw InputError({path.string(), fault->what, "", fault->remedy});
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError({path.string(), "the file cannot be opened", "", "check its permissions"});
  return read_uff(file, path.string());
}

UffFile read_uff(std::istream& stream, const std::string& name) {
  UffInput in(stream, name);
  UffContents contents;
  bool is_empty = true;
  while (in.advance()) {
    if (trimmed(in.text()).empty()) continue;
    in.set_dataset("");
    if (!in.at_opening()) {
      pass_over_text(in, is_empty, contents.file);
      continue;
    }
    if (!in.advance()) in.fail("the file ends where a dataset begins", "", "remove the last delimiter");
    is_empty = false;
    if (!in.at_delimiter()) read_dataset(in, contents);
  }
  if (is_empty) in.fail("the file holds no dataset", "", "name a Universal File (.uff, .unv)");
  return std::move(contents.file);
}

}  // namespace wishbone
