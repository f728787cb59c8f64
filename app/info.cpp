#include <fmt/core.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "app/command.h"
#include "app/meta_text.h"
#include "app/modal_summary.h"
#include "app/text_table.h"
#include "app/universal_file_summary.h"
#include "core/error.h"
#include "core/hdf5.h"
#include "identification/formats/modal_file.h"
#include "identification/formats/mode_file.h"
#include "identification/formats/uff/uff_reader.h"

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

/// Times of the rows that are good: all, unless the run is under way or was killed.
VectorX good_times(const hdf5::File& file) {
  const hdf5::Dataset time = file.open_dataset("/time");
  const hdf5::Shape shape = time.shape();
  if (shape.size() != 1 || !file.contains("/meta/rows")) return file.read_matrix("/time");
  const MatrixX rows = file.read_matrix("/meta/rows");
  const bool fewer = rows.size() == 1 && rows(0, 0) >= 0 && rows(0, 0) < static_cast<double>(shape[0]);
  const std::vector<double> good = time.read_rows(fewer ? static_cast<std::size_t>(rows(0, 0)) : shape[0]);
  return Eigen::Map<const VectorX>(good.data(), static_cast<Eigen::Index>(good.size()));
}

Facts gather(const hdf5::File& file) {
  Facts facts;
  for (const std::string& path : file.dataset_paths()) {
    const hdf5::Dataset dataset = file.open_dataset(path);
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
  }
  if (file.contains("/meta")) facts.meta = file.open_group("/meta").attributes();
  if (file.contains("/meta/run")) facts.run = file.open_group("/meta/run").attributes();
  if (is_mode_file(file)) facts.modes = read_mode_file(file);
  if (file.contains("/time")) facts.time = good_times(file);
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
  fmt::print("{}\n", out.dump(2));
}

void tell_hdf5(const Options& options) {
  const Facts facts = gather(hdf5::File::open(options.file));
  if (options.json)
    print_json(facts, options);
  else
    print_lines(facts, options);
}

void tell_tables(const Options& options) {
  const ModalData data = read_modal_data(options.file);
  if (options.json) {
    fmt::print("{}\n", nlohmann::ordered_json{{"file", options.file}, {"modal_data", json_of(data)}}.dump(2));
  } else {
    fmt::print("{}\n", options.file);
    print_modal_data(data);
  }
}

void tell_universal_file(const Options& options) {
  const UffFile file = read_uff(options.file);
  if (options.json) {
    nlohmann::ordered_json out = json_of(file);
    out["file"] = options.file;
    fmt::print("{}\n", out.dump(2));
  } else {
    fmt::print("{}\n", options.file);
    print_universal_file(file);
  }
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
