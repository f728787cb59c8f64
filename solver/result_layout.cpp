#include "solver/result_layout.h"

#include <fmt/format.h>

#include <numeric>
#include <utility>
#include <vector>

namespace wishbone {
namespace {

void set_attributes(hdf5::Dataset& dataset, const std::string& units, const std::string& frame,
                    const std::string& about) {
  dataset.set_attribute("units", units);
  dataset.set_attribute("frame", frame);
  dataset.set_attribute("about", about);
}

}  // namespace

ResultLayout::ResultLayout(hdf5::File& file, hdf5::Dataset time)
    : file_(file), time_(std::move(time), "time") {
  set_attributes(time_.dataset(), "s", "", "time of each row");
}

bool ResultLayout::is_reserved(const std::string& path) {
  return path == "/time" || path == "/meta" || path.starts_with("/meta/") ||
         path.starts_with("/component_") || path.starts_with("/vector_");
}

hdf5::Scale* ResultLayout::axis(const std::string& kind, int length) {
  const std::string name = fmt::format("{}_{}", kind, length);
  if (const auto made = axes_.find(name); made != axes_.end()) return &made->second;
  std::vector<double> numbers(static_cast<std::size_t>(length));
  std::iota(numbers.begin(), numbers.end(), 1.0);
  hdf5::Dataset dataset = file_.write("/" + name, {numbers.size()}, numbers);
  set_attributes(dataset, "1", "", fmt::format("number of the {}", kind));
  return &axes_.emplace(name, hdf5::Scale(std::move(dataset), name)).first->second;
}

void ResultLayout::describe(hdf5::Dataset& dataset, const Signal& signal) {
  set_attributes(dataset, signal.units, signal.frame, signal.about);
  for (const auto& [name, texts] : signal.lists) dataset.set_attribute(name, texts);
  std::vector<hdf5::Scale*> scales{&time_};
  for (std::size_t i = 0; i < signal.shape.size(); ++i)
    scales.push_back(axis(i + 1 == signal.shape.size() ? "component" : "vector", signal.shape[i]));
  dataset.attach_scales(scales);
}

void ResultLayout::finish() {
  time_.finish();
  for (auto& [name, scale] : axes_) scale.finish();
}

hdf5::Dataset create_row_count(hdf5::File& file, std::size_t rows) {
  const double count = static_cast<double>(rows);
  hdf5::Dataset dataset = file.write("/meta/rows", {}, {&count, 1});
  set_attributes(dataset, "1", "", "number of rows that are good; what lies beyond is to be ignored");
  return dataset;
}

}  // namespace wishbone
