#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "app/command.h"
#include "app/meta_text.h"
#include "app/modal_summary.h"
#include "app/text_table.h"
#include "app/universal_file_summary.h"
#include "core/error.h"
#include "core/hdf5_reader.h"
#include "identification/formats/modal_file.h"
#include "identification/formats/mode_file.h"
#include "identification/formats/uff/uff_modal_data.h"
#include "identification/formats/uff/uff_reader.h"
#include "solver/result_file.h"

namespace wishbone {

namespace {

struct Options {
  std::string file;
  bool json = false;
};

struct DatasetFacts {
  std::string path, units, frame, about;
  hdf5::Shape shape;
  std::map<std::string, std::vector<std::string>> lists;  ///< what its numbers belong to: `nodes`, `rows`
};

/// What a person or a program wants to know about any HDF5 file of wishbone, a result or a set of modes.
struct Facts {
  std::vector<DatasetFacts> datasets;
  std::map<std::string, hdf5::Value> meta, run;
  VectorX time;                    ///< empty when the file has none
  std::optional<ModalData> modes;  ///< of a mode file
};

Facts gather(const hdf5::FileReader& file) {
  Facts facts;
  for (const std::string& path : file.dataset_paths()) {
    const hdf5::DatasetReader dataset = file.open_dataset(path);
    DatasetFacts d{path,
                   dataset.text_attribute("units"),
                   dataset.text_attribute("frame"),
                   dataset.text_attribute("about"),
                   dataset.shape(),
                   {}};
    for (const auto& [name, value] : dataset.attributes())
      if (const auto* texts = std::get_if<std::vector<std::string>>(&value);
          texts && (name == "nodes" || name == "rows"))
        d.lists.emplace(name, *texts);
    facts.datasets.push_back(std::move(d));
    if (path != "/time" || dataset.shape().size() != 1 || !dataset.is_numeric()) continue;
    const std::vector<double> times = dataset.read_rows(good_rows(file, dataset.shape()[0]));
    facts.time = Eigen::Map<const VectorX>(times.data(), static_cast<Eigen::Index>(times.size()));
  }
  if (file.contains("/meta")) facts.meta = file.open_group("/meta").attributes();
  if (file.contains("/meta/run")) facts.run = file.open_group("/meta/run").attributes();
  if (is_mode_file(file)) facts.modes = read_mode_file(file);
  return facts;
}

void print_meta(const std::map<std::string, hdf5::Value>& meta) {
  for (const auto& [name, value] : meta) {
    const std::string text = text_of(value);
    const auto lines = std::count(text.begin(), text.end(), '\n');
    fmt::print("  {}: {}\n", name,
               lines == 0 ? text : fmt::format("text of {} lines (--json shows it)", lines));
  }
}

/// What a dataset is about, and of which nodes or rows: the first ones of many.
std::string about_text(const DatasetFacts& d) {
  constexpr std::size_t kMostListed = 12;
  std::string text = d.about;
  for (const auto& [name, texts] : d.lists) {
    const std::span<const std::string> listed(texts.data(), std::min(texts.size(), kMostListed));
    text +=
        fmt::format("; {} {}{}", name, fmt::join(listed, ", "), listed.size() < texts.size() ? ", ..." : "");
  }
  return text;
}

void print_lines(const Facts& facts, const Options& options) {
  fmt::print("{}\n", options.file);
  if (const auto status = facts.meta.find("status"); status != facts.meta.end())
    fmt::print("status: {}\n", text_of(status->second));
  if (facts.time.size() > 0)
    fmt::print("time: {:.6g} s to {:.6g} s, {} rows\n", facts.time[0], facts.time[facts.time.size() - 1],
               facts.time.size());
  if (facts.modes) print_modal_data(*facts.modes);
  fmt::print("\n");
  TextTable table({"dataset", "shape", "unit", "frame", "about"}, 5);
  for (const DatasetFacts& d : facts.datasets)
    table.add_row({d.path, fmt::format("[{}]", fmt::join(d.shape, ", ")), d.units, d.frame, about_text(d)});
  fmt::print("{}", table.text());
  if (!facts.meta.empty() && !facts.modes) {
    fmt::print("\nmeta\n");
    print_meta(facts.meta);
  }
  if (!facts.run.empty()) fmt::print("\nexecution\n");
  print_meta(facts.run);
}

nlohmann::ordered_json json_of_meta(const std::map<std::string, hdf5::Value>& meta) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& [name, value] : meta) out[name] = json_of(value);
  return out;
}

void print_json(const Facts& facts, const Options& options) {
  nlohmann::ordered_json out{{"file", options.file}};
  if (facts.time.size() > 0)
    out["time"] = {
        {"first", facts.time[0]}, {"last", facts.time[facts.time.size() - 1]}, {"rows", facts.time.size()}};
  if (facts.modes) out["modal_data"] = json_of(*facts.modes);
  out["datasets"] = nlohmann::ordered_json::array();
  for (const DatasetFacts& d : facts.datasets) {
    nlohmann::ordered_json dataset{
        {"path", d.path}, {"shape", d.shape}, {"units", d.units}, {"frame", d.frame}, {"about", d.about}};
    for (const auto& [name, texts] : d.lists) dataset[name] = texts;
    out["datasets"].push_back(std::move(dataset));
  }
  out["meta"] = json_of_meta(facts.meta);
  out["run"] = json_of_meta(facts.run);
  fmt::print("{}\n", json_text(out));
}

void tell_hdf5(const Options& options) {
  const Facts facts = gather(hdf5::FileReader(options.file));
  if (options.json)
    print_json(facts, options);
  else
    print_lines(facts, options);
  if (facts.modes) warn_of_units(options.file, *facts.modes);
}

void tell_tables(const Options& options) {
  const ModalData data = read_modal_data(options.file);
  if (options.json) {
    fmt::print("{}\n", json_text({{"file", options.file}, {"modal_data", json_of(data)}}));
  } else {
    fmt::print("{}\n", options.file);
    print_modal_data(data);
  }
  warn_of_units(options.file, data);
}

/// What the file comes to as modal data; nothing when it holds no modes.
std::optional<ModalData> understood(const UffFile& file, const std::string& name) {
  try {
    return uff_modal_data(file, name);
  } catch (const InputError&) {
    return std::nullopt;  // of functions, or of geometry alone
  }
}

void print_understood(const ModalData& data) {
  fmt::print("\nas modal data: {}\n", brief(data));
  print_extent(data);
  for (const std::string& line : data.provenance) fmt::print("  {}\n", line);
}

void tell_universal_file(const Options& options) {
  const UffFile file = read_uff(options.file);
  const std::optional<ModalData> data = understood(file, options.file);
  if (options.json) {
    nlohmann::ordered_json out = json_of(file);
    out["file"] = options.file;
    if (data) out["modal_data"] = json_of(*data);
    fmt::print("{}\n", json_text(out));
  } else {
    fmt::print("{}\n", options.file);
    print_universal_file(file);
    if (data) print_understood(*data);
  }
  if (data) warn_of_units(options.file, *data);
}

ExitCode run(const Options& options) {
  const auto format = modal_format(options.file);
  if (format == ModalFormat::kCsvTables)
    tell_tables(options);
  else if (format == ModalFormat::kUniversalFile)
    tell_universal_file(options);
  else
    tell_hdf5(options);
  return kDone;
}

}  // namespace

void add_info(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "info", "Tell what is in a file: status, time span, datasets with their units; modes");
  command
      ->add_option("FILE", options->file,
                   "HDF5 file written by wishbone (a .partial one too), Universal File (.unv, .uff),\n"
                   "or modal data in CSV tables")
      ->required();
  command->add_flag("--json", options->json, "print JSON");
  command->footer("Example:\n  wishbone info out.h5");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace wishbone
