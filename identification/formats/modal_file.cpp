#include "identification/formats/modal_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "core/error.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/formats/mode_file.h"
#include "identification/formats/uff/uff_modal_data.h"

namespace wishbone {
namespace {

using Path = std::filesystem::path;

/// Parts of ModalData that a format has no place for.
struct Lost {
  bool digits = false, title = false, masses = false, support = false, lines = false, provenance = false;
};

struct Format {
  std::string_view extension;
  ModalFormat format;
  ModalData (*read)(const Path&);
  void (*write)(const Path&, const ModalData&);
  std::vector<Path> (*files)(const Path&);
  Lost lost;
};

std::vector<Path> itself(const Path& path) {
  return {path};
}

ModalData read_hdf5(const Path& path) {
  return read_mode_file(path.string());
}
void write_hdf5(const Path& path, const ModalData& data) {
  write_mode_file(path.string(), data);
}

ModalData read_uff_file(const Path& path) {
  return read_uff_modal_data(path);
}

ModalData read_csv(const Path& path) {
  return read_csv_modal_data(csv_modal_files(path));
}
void write_csv(const Path& path, const ModalData& data) {
  write_csv_modal_data(csv_modal_files(path), data);
}
std::vector<Path> csv_files(const Path& path) {
  const CsvModalFiles files = csv_modal_files(path);
  return {files.nodes, files.frequencies, files.shapes};
}

constexpr Lost kNothing;
constexpr Lost kLostInUff{.digits = true, .masses = true, .support = true, .provenance = true};
constexpr Lost kLostInTables{.title = true, .support = true, .lines = true, .provenance = true};
constexpr std::array kFormats{
    Format{".h5", ModalFormat::kModeFile, read_hdf5, write_hdf5, itself, kNothing},
    Format{".hdf5", ModalFormat::kModeFile, read_hdf5, write_hdf5, itself, kNothing},
    Format{".unv", ModalFormat::kUniversalFile, read_uff_file, write_uff_modal_data, itself, kLostInUff},
    Format{".uff", ModalFormat::kUniversalFile, read_uff_file, write_uff_modal_data, itself, kLostInUff},
    Format{".csv", ModalFormat::kCsvTables, read_csv, write_csv, csv_files, kLostInTables}};

/// Null when no format has this extension.
const Format* find_format(const Path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const Format& format) { return format.extension == extension; });
  return found == kFormats.end() ? nullptr : &*found;
}

const Format& format_of(const Path& path) {
  if (const Format* format = find_format(path)) return *format;
  std::vector<std::string_view> extensions;
  for (const Format& format : kFormats) extensions.push_back(format.extension);
  throw InputError({path.string(), "no format of modal data has this extension", path.extension().string(),
                    fmt::format("the extensions are {}", fmt::join(extensions, ", "))});
}

}  // namespace

ModalData read_modal_data(const Path& path) {
  return format_of(path).read(path);
}

void write_modal_data(const Path& path, const ModalData& data) {
  format_of(path).write(path, data);
}

std::vector<Path> modal_data_files(const Path& path) {
  return format_of(path).files(path);
}

std::vector<std::string> lost_in_modal_data(const Path& path, const ModalData& data) {
  const Lost& lost = format_of(path).lost;
  std::vector<std::string> parts;
  if (lost.digits && data.mode_count() > 0) parts.push_back("digits of the modes beyond the sixth");
  if (lost.title && !data.title.empty()) parts.push_back("title");
  if (lost.masses && data.has_masses()) parts.push_back("nodal masses");
  if (lost.support && !data.support.empty())
    parts.push_back(fmt::format("support ({})", describe_support(data.support)));
  if (lost.lines && !data.lines.empty()) parts.push_back("lines");
  if (lost.provenance && !data.provenance.empty()) parts.push_back("provenance");
  return parts;
}

std::optional<ModalFormat> modal_format(const Path& path) {
  const Format* format = find_format(path);
  return format ? std::optional(format->format) : std::nullopt;
}

}  // namespace wishbone
