#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "identification/formats/uff/uff_datasets.h"
#include "identification/formats/uff/uff_fields.h"
#include "identification/formats/uff/uff_text.h"

namespace wishbone {
namespace {

/// Columns of 18: x along the second point, y normal to the plane of the third: z = in the plane of x and the
/// third.
Matrix3 axes_through(const UffInput& in, const Vector3& origin, const Vector3& on_x, const Vector3& on_xz) {
  const Vector3 x = on_x - origin, towards_z = on_xz - origin;
  const Vector3 y = towards_z.cross(x);
  if (!(y.norm() > 1e-9 * x.norm() * towards_z.norm()))
    in.fail("the points of a coordinate system must not lie on one line", "",
            "give its origin, a point on its x axis and a point in its xz plane");
  Matrix3 axes;
  axes << x.normalized(), y.normalized(), x.cross(y).normalized();
  return axes;
}

void add(const UffInput& in, UffContents& contents, UffCoordinateSystem system) {
  std::vector<UffCoordinateSystem>& systems = contents.file.coordinate_systems;
  const auto [found, is_new] = contents.system_at.emplace(system.number, systems.size());
  if (is_new) {
    systems.push_back(std::move(system));
    return;
  }
  const UffCoordinateSystem& first = systems[found->second];
  if (!first.axes.isApprox(system.axes, 1e-5) || !first.origin.isApprox(system.origin, 1e-5) ||
      first.type != system.type || first.reference != system.reference)
    in.fail("a coordinate system is defined twice, differently", fmt::format("system {}", system.number),
            "number each system once");
}

/// Programs write nodes twice, in single and in double precision; the same node elsewhere is an error.
void add(const UffInput& in, UffContents& contents, const UffNode& node) {
  if (node.number < 1)
    in.fail_line("a node number must be positive", "number nodes from 1: zero lifts the pen of trace lines");
  const auto [found, is_new] = contents.node_at.emplace(node.number, contents.file.nodes.size());
  if (is_new) {
    contents.file.nodes.push_back(node);
    return;
  }
  const UffNode& first = contents.file.nodes[found->second];
  const bool is_elsewhere =
      first.definition_system == node.definition_system &&
      (first.position - node.position).norm() > 1e-5 * std::max(first.position.norm(), node.position.norm());
  if (first.definition_system != node.definition_system) contents.file.repeated_nodes.push_back(node);
  if (is_elsewhere || first.displacement_system != node.displacement_system)
    in.fail("a node is defined twice, differently", fmt::format("node {}", node.number),
            "number each node once");
}

/// Nodes of two lines each; `take_second` knows what the second field says.
template <class TakeSecond>
void read_long_nodes(UffInput& in, UffContents& contents, TakeSecond take_second) {
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    const std::vector<int> head = integers_of_line(in, 10, 4, "node number, coordinate systems and colour");
    if (head.size() != 4)
      in.fail_line("expected a node: number, two coordinate systems and colour", "complete the record");
    in.require_filled("the coordinates of a node");
    std::vector<double> p;
    append_reals(in, 25, "a coordinate", p);
    if (p.size() != 3)
      in.fail_line(fmt::format("expected the three coordinates of node {}", head[0]), "complete the record");
    UffNode node{head[0], 0, head[2], head[3], {p[0], p[1], p[2]}};
    take_second(node, head[1]);
    add(in, contents, node);
  }
}

constexpr std::string_view kSystemRecord =
    "number, type, reference, colour and method of a coordinate system";

}  // namespace

/// 5I10 / 20A2 / 6E13.5, on two lines: origin, a point on the x axis, a point in the xz plane.
void read_uff_coordinate_systems(UffInput& in, UffContents& contents) {
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    const std::vector<int> head = integers_of_line(in, 10, 5, kSystemRecord);
    UffCoordinateSystem system{head[0], head[1], head[2], head[3], {}, Vector3::Zero(), Matrix3::Identity()};
    system.name = trimmed(in.require("the name of a coordinate system"));
    std::vector<double> p;
    while (p.size() < 9) {
      in.require_filled("the nine coordinates of a coordinate system");
      append_reals(in, 13, "a coordinate", p);
    }
    system.origin = {p[0], p[1], p[2]};
    system.axes = axes_through(in, system.origin, {p[3], p[4], p[5]}, {p[6], p[7], p[8]});
    add(in, contents, std::move(system));
  }
}

/// I10 / 40A2, then for each system 3I10 / 40A2 / 4(3D25.16): rows of the matrix are the axes, the last the
/// origin.
void read_uff_coordinate_matrices(UffInput& in, UffContents& contents) {
  in.require("the part number");
  in.require("the part name");
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    const std::vector<int> head =
        integers_of_line(in, 10, 3, "number, type and colour of a coordinate system");
    UffCoordinateSystem system{head[0], head[1], 0, head[2], {}, Vector3::Zero(), Matrix3::Identity()};
    system.name = trimmed(in.require("the name of a coordinate system"));
    std::vector<double> p;
    while (p.size() < 12) {
      in.require_filled("the twelve numbers of a coordinate system");
      append_reals(in, 25, "a number of the matrix", p);
    }
    for (int axis = 0; axis < 3; ++axis) system.axes.col(axis) = Vector3(p.data() + 3 * axis);
    system.origin = Vector3(p.data() + 9);
    if (!(system.axes.transpose() * system.axes).isIdentity(1e-3) || system.axes.determinant() < 0)
      in.fail("the matrix of a coordinate system must be a rotation", fmt::format("system {}", system.number),
              "write unit vectors that are normal to each other, right-handed");
    add(in, contents, std::move(system));
  }
}

/// 4I10,3E13.5
void read_uff_nodes(UffInput& in, UffContents& contents) {
  while (in.advance_in_dataset()) {
    if (trimmed(in.text()).empty()) continue;
    const auto fields = number_fields(in, {10, 10, 10, 10, 13, 13, 13}, 7);
    if (fields.size() != 7)
      in.fail_line("expected a node: number, two coordinate systems, colour, x, y and z",
                   "complete the record");
    UffNode node{integer_field(in, fields[0], "the node number"),
                 integer_field(in, fields[1], "the definition coordinate system"),
                 integer_field(in, fields[2], "the displacement coordinate system"),
                 integer_field(in, fields[3], "the colour"), Vector3::Zero()};
    for (int i = 0; i < 3; ++i)
      node.position[i] = real_field(in, fields[static_cast<std::size_t>(4 + i)], "a coordinate");
    add(in, contents, node);
  }
}

/// 4I10 / 3D25.16: coordinates in the definition system, the second field.
void read_uff_nodes_in_double(UffInput& in, UffContents& contents) {
  read_long_nodes(in, contents, [](UffNode& node, int second) { node.definition_system = second; });
}

/// 4I10 / 3D25.16: "node coordinates in the part coordinate system", the second field is an export system.
void read_uff_nodes_of_part(UffInput& in, UffContents& contents) {
  read_long_nodes(in, contents, [](UffNode& node, int second) { node.export_system = second; });
}

}  // namespace wishbone
