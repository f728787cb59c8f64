#include "solver/result_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"

namespace wishbone {

namespace {

Signal describe(const hdf5::DatasetReader& dataset) {
  constexpr double kLongestRow = 1e9;
  const hdf5::Shape& shape = dataset.shape();
  Signal signal;
  signal.path = dataset.path();
  double size = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) size *= static_cast<double>(shape[i]);
  if (size > kLongestRow || size < 1)
    throw InputError({dataset.file_path() + ":" + dataset.path(), "a row has no such number of elements",
                      fmt::format("{:g}", size), "the file is broken: take an intact copy"});
  for (std::size_t i = 1; i < shape.size(); ++i) signal.shape.push_back(static_cast<int>(shape[i]));
  signal.units = dataset.text_attribute("units");
  signal.frame = dataset.text_attribute("frame");
  signal.about = dataset.text_attribute("about");
  for (auto& [name, value] : dataset.attributes())
    if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) signal.lists.emplace(name, *texts);
  return signal;
}

std::vector<std::string> names_of_axis(int length, bool has_frame) {
  if (has_frame && length == 3) return {"x", "y", "z"};
  if (has_frame && length == 4) return {"w", "x", "y", "z"};
  std::vector<std::string> names;
  for (int i = 1; i <= length; ++i) names.push_back(std::to_string(i));
  return names;
}

/// A list of a signal that has one entry for each of `length` things; nullptr when there is none.
const std::vector<std::string>* list_of_length(const Signal& signal, const std::string& name, int length) {
  const auto list = signal.lists.find(name);
  return list != signal.lists.end() && static_cast<int>(list->second.size()) == length ? &list->second
                                                                                       : nullptr;
}

}  // namespace

std::size_t good_rows(const hdf5::GroupReader& file, std::size_t rows) {
  if (!file.contains("/meta/rows")) return rows;
  const MatrixX good = file.read_matrix("/meta/rows");
  if (good.size() != 1 || !(good(0) >= 0))
    throw InputError({file.file_path() + ":/meta/rows", "this must be the number of good rows",
                      good.size() == 1 ? fmt::format("{}", good(0)) : "", "take an intact copy"});
  return good(0) < static_cast<double>(rows) ? static_cast<std::size_t>(good(0)) : rows;
}

ResultFile::ResultFile(const std::string& path) : path_(path), file_(path) {
  if (!file_.contains("/time"))
    throw InputError({path, "this file has no /time: it is not the result of a run", "",
                      "`wishbone info` shows what is in it"});
  const hdf5::DatasetReader time = file_.open_dataset("/time");
  if (time.shape().size() != 1 || !time.is_numeric())
    throw InputError({path + ":/time", "the times of a result are one number for each row",
                      fmt::format("[{}]", fmt::join(time.shape(), ", ")),
                      "`wishbone info` shows what is in it"});
  std::size_t rows = good_rows(file_, time.shape()[0]);
  for (const std::string& dataset_path : file_.dataset_paths()) {
    const hdf5::DatasetReader dataset = file_.open_dataset(dataset_path);
    // A signal over time has the dimension scale attached; matrices of other meaning have not.
    if (dataset_path == "/time" || dataset.shape().empty() || !dataset.has_attribute("DIMENSION_LIST"))
      continue;
    rows = std::min(rows, dataset.shape()[0]);
    signals_.push_back(describe(dataset));
  }
  const std::vector<double> times = time.read_rows(rows);
  time_ = Eigen::Map<const VectorX>(times.data(), static_cast<Eigen::Index>(rows));
}

const Signal* ResultFile::find(const std::string& path) const {
  const auto found =
      std::lower_bound(signals_.begin(), signals_.end(), path,
                       [](const Signal& signal, const std::string& p) { return signal.path < p; });
  return found != signals_.end() && found->path == path ? &*found : nullptr;
}

MatrixX ResultFile::read(const std::string& path) const {
  const hdf5::DatasetReader dataset = file_.open_dataset(path);
  const Signal* signal = find(path);
  if (!signal) throw InputError({path_ + ":" + path, "this dataset is not a signal over time", "", ""});
  const std::vector<double> values = dataset.read_rows(static_cast<std::size_t>(time_.size()));
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(values.data(), time_.size(), signal->size());
}

std::map<std::string, hdf5::Value> ResultFile::meta() const {
  if (!file_.contains("/meta")) return {};
  return file_.open_group("/meta").attributes();
}

std::map<std::string, hdf5::Value> ResultFile::run_meta() const {
  if (!file_.contains("/meta/run")) return {};
  return file_.open_group("/meta/run").attributes();
}

std::string ResultFile::status() const {
  if (!file_.contains("/meta")) return {};
  return file_.open_group("/meta").text_attribute("status");
}

std::vector<std::string> component_names(const Signal& signal) {
  if (signal.shape.empty()) return {""};
  const std::vector<std::string> components = names_of_axis(signal.shape.back(), !signal.frame.empty());
  const int vectors = signal.size() / signal.shape.back();
  if (signal.shape.size() == 1) {
    const auto* rows = list_of_length(signal, "rows", signal.size());
    return rows ? *rows : components;
  }
  const auto* nodes = list_of_length(signal, "nodes", vectors);
  std::vector<std::string> names;
  for (int i = 0; i < vectors; ++i) {
    const std::string vector =
        nodes ? "node " + (*nodes)[static_cast<std::size_t>(i)] : fmt::format("{}", i + 1);
    for (const std::string& component : components) names.push_back(vector + " " + component);
  }
  return names;
}

}  // namespace wishbone
