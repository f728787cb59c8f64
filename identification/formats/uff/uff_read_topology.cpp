#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "identification/formats/uff/uff_datasets.h"
#include "identification/formats/uff/uff_elements.h"
#include "identification/formats/uff/uff_fields.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

constexpr int kMostNodesPerElement = 1000;

/// 8I10 on as many lines as `count` needs; what the last line holds beyond must be zero.
std::vector<int> read_nodes(UffInput& in, std::size_t count) {
  std::vector<int> nodes;
  while (nodes.size() < count) {
    in.require_filled("node numbers");
    const std::vector<int> row = integers_of_line(in, 10, 0, "a node number");
    nodes.insert(nodes.end(), row.begin(), row.end());
  }
  const bool is_padded = std::all_of(nodes.begin() + static_cast<std::ptrdiff_t>(count), nodes.end(),
                                     [](int node) { return node == 0; });
  if (!is_padded)
    in.fail_line(fmt::format("more than the announced {} node numbers", count),
                 "correct the count or the list");
  nodes.resize(count);
  return nodes;
}

}  // namespace

/// 3I10 / 80A1 / 8I10 ...
void read_uff_trace_line(UffInput& in, UffContents& contents) {
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    const std::vector<int> head =
        integers_of_line(in, 10, 3, "number, count of nodes and colour of a trace line");
    if (head[1] < 0 || static_cast<std::uintmax_t>(head[1]) > in.bytes_left() / 2)
      in.fail_line(fmt::format("a trace line of {} nodes does not fit into the rest of the file", head[1]),
                   "correct the count");
    UffTraceLine line{head[0], head[2], {}, {}};
    line.name = trimmed(in.require("the name of a trace line"));
    line.nodes = read_nodes(in, static_cast<std::size_t>(head[1]));
    contents.file.trace_lines.push_back(std::move(line));
    while (in.advance_in_dataset()) {  // rows of zeros that fill up
      if (trimmed(in.text()).find_first_not_of("0 ") == std::string_view::npos) continue;
      in.put_back();
      break;
    }
    if (in.at_delimiter()) return;
  }
}

/// 6I10, for beams 3I10, then 8I10 ...
void read_uff_elements(UffInput& in, UffContents& contents) {
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    const std::vector<int> head = integers_of_line(in, 10, 6, "a field of an element");
    if (head.size() != 6)
      in.fail_line("expected an element: number, descriptor, two properties, colour, count of nodes",
                   "complete the record");
    const int count = head[5];
    if (count < 1 || count > kMostNodesPerElement)
      in.fail_line(fmt::format("an element must have 1 to {} nodes", kMostNodesPerElement),
                   "correct the count");
    if (is_uff_beam(head[1])) {
      in.require_filled("orientation node and cross sections of a beam");
      integers_of_line(in, 10, 3, "orientation node or cross section");
    }
    contents.file.elements.push_back(
        {head[0], head[1], head[2], head[3], head[4], read_nodes(in, static_cast<std::size_t>(count))});
  }
}

}  // namespace wishbone
