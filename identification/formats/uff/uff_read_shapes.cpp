#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "identification/formats/uff/uff_datasets.h"
#include "identification/formats/uff/uff_fields.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

constexpr int kMostValuesPerNode = 1000;
constexpr int kMostRecordNumbers = 100;

bool is_complex_mode(int analysis) {
  return analysis == kUffComplexModeFirstOrder || analysis == kUffComplexModeSecondOrder;
}

void read_ids(UffInput& in, UffShape& shape) {
  for (std::string& id : shape.ids) id = without_trailing_blanks(in.require("an identification line"));
}

/// 6I10: model, analysis, characteristic, quantity, data type, values a node. False when the data type is
/// none that is read.
bool read_definition(UffInput& in, UffShape& shape) {
  in.require_filled("the data definition parameters");
  const std::vector<int> fields = integers_of_line(in, 10, 6, "a data definition parameter");
  shape.model = fields[0];
  shape.analysis = fields[1];
  shape.characteristic = fields[2];
  shape.quantity = fields[3];
  shape.is_complex = fields[4] == 5 || fields[4] == 6;
  shape.values_per_node = fields[5];
  if (shape.values_per_node < 1 || shape.values_per_node > kMostValuesPerNode)
    in.fail_line(fmt::format("the count of values per node must be 1 to {}", kMostValuesPerNode),
                 "correct field 6 of the record");
  return shape.is_complex || fields[4] == 2 || fields[4] == 4;
}

/// Values of node after node: I10 / 6E13.5 ...
void read_nodal_values(UffInput& in, UffShape& shape) {
  const std::size_t count = static_cast<std::size_t>(shape.values_per_node) * (shape.is_complex ? 2 : 1);
  std::unordered_set<int> known;
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    const std::vector<int> node = integers_of_line(in, 10, 1, "a node number");
    if (node.size() != 1 || node[0] < 1)
      in.fail_line("expected a node number", fmt::format("write {} values for each node", count));
    if (!known.insert(node[0]).second)
      in.fail_line("a node occurs twice in one dataset", "write the values of each node once");
    shape.nodes.push_back(node[0]);
    const std::size_t wanted = shape.values.size() + count;
    while (shape.values.size() < wanted) {
      in.require_filled(fmt::format("{} values of node {}", count, node[0]));
      append_reals(in, 13, "a value", shape.values);
    }
    if (shape.values.size() > wanted)
      in.fail_line(fmt::format("expected {} values of node {}, found more", count, node[0]),
                   "correct the count of values per node");
  }
}

std::vector<double> reals_of_record(UffInput& in, std::size_t count, std::string_view what) {
  std::vector<double> reals;
  for (std::size_t lines = std::max<std::size_t>(1, (count + 5) / 6); lines > 0; --lines) {
    in.require(what);
    append_reals(in, 13, what, reals);
  }
  reals.resize(std::max<std::size_t>(reals.size(), 6));
  return reals;
}

void store_numbers(UffShape& shape, const std::vector<int>& integers, const std::vector<double>& reals) {
  const auto integer = [&](std::size_t k) { return k < integers.size() ? integers[k] : 0; };
  shape.load_case = integer(0);
  shape.number = integer(1);
  if (shape.analysis == kUffNormalMode) {
    shape.frequency = reals[0];
    shape.modal_mass = reals[1];
    shape.viscous_damping = reals[2];
    shape.hysteretic_damping = reals[3];
  } else if (is_complex_mode(shape.analysis)) {
    shape.eigenvalue = {reals[0], reals[1]};
    shape.modal_a = {reals[2], reals[3]};
    shape.modal_b = {reals[4], reals[5]};
  } else if (shape.analysis == kUffTransient) {
    shape.time = reals[0];
  } else if (shape.analysis == kUffFrequencyResponse) {
    shape.frequency = reals[0];
  } else if (shape.analysis == kUffBuckling) {
    shape.eigenvalue = reals[0];
  }
}

void skip_unused(UffInput& in, UffContents& contents, const UffShape& shape, std::string why) {
  in.skip_dataset();
  contents.file.unused.push_back({shape.dataset, shape.line, std::move(why)});
}

}  // namespace

/// 5(80A1) / 6I10 / 8I10 / 6E13.5 / nodal values.
void read_uff_data_at_nodes(UffInput& in, UffContents& contents) {
  UffShape shape;
  shape.line = in.line();
  read_ids(in, shape);
  if (!read_definition(in, shape))
    return skip_unused(in, contents, shape, "its values are neither real nor complex");

  in.require_filled("the counts and integers of the analysis");
  const std::vector<int> record = integers_of_line(in, 10, 2, "a count or integer of the analysis");
  if (record[0] < 0 || record[0] > kMostRecordNumbers || record[1] < 0 || record[1] > kMostRecordNumbers)
    in.fail_line(fmt::format("the counts of integers and reals must be 0 to {}", kMostRecordNumbers),
                 "correct fields 1 and 2 of record 7");
  store_numbers(shape, {record.begin() + 2, record.end()},
                reals_of_record(in, static_cast<std::size_t>(record[1]), "a number of the analysis"));
  read_nodal_values(in, shape);
  contents.file.shapes.push_back(std::move(shape));
}

/// I10 / 40A2 / I10 / 5(40A2) / 6I10 / 8I10 / 8I10 / 6E13.5 / 6E13.5 / nodal values.
void read_uff_analysis_data(UffInput& in, UffContents& contents) {
  UffShape shape;
  shape.dataset = 2414;
  shape.line = in.line();
  in.require("the dataset label");
  shape.label = integers_of_line(in, 10, 1, "the dataset label")[0];
  shape.name = without_trailing_blanks(in.require("the dataset name"));
  in.require("the dataset location");
  const int location = integers_of_line(in, 10, 1, "the dataset location")[0];
  if (location != 1) return skip_unused(in, contents, shape, "its values are not at nodes");
  read_ids(in, shape);
  if (!read_definition(in, shape))
    return skip_unused(in, contents, shape, "its values are neither real nor complex");

  in.require_filled("the integers of the analysis");
  const std::vector<int> integers = integers_of_line(in, 10, 8, "an integer of the analysis");
  in.require("the creation option");
  const std::vector<double> first = reals_of_record(in, 6, "a number of the analysis");
  const std::vector<double> second = reals_of_record(in, 6, "a number of the analysis");
  const bool in_time = shape.analysis == kUffTransient,
             in_frequency = shape.analysis == kUffFrequencyResponse;
  shape.load_case = integers[4];
  shape.number = integers[in_time ? 6 : in_frequency ? 7 : 5];
  shape.time = first[0];
  shape.frequency = first[1];
  shape.eigenvalue = is_complex_mode(shape.analysis) ? std::complex(second[0], second[1]) : first[2];
  shape.modal_mass = first[3];
  shape.viscous_damping = first[4];
  shape.hysteretic_damping = first[5];
  shape.modal_a = {second[2], second[3]};
  shape.modal_b = {second[4], second[5]};
  read_nodal_values(in, shape);
  contents.file.shapes.push_back(std::move(shape));
}

}  // namespace wishbone
