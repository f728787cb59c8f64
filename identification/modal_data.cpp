#include "identification/modal_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

void check_sizes(const ModalData& data) {
  const Eigen::Index n = data.node_count(), m = data.mode_count(), r = data.freedom_count();
  const bool fits = data.node_position.cols() == n && (!data.has_masses() || data.node_mass.size() == n) &&
                    data.shapes.rows() == r && data.shapes.cols() == m && data.damping_ratio.size() == m &&
                    data.modal_mass.size() == m;
  if (!fits)
    throw InputError(
        {"modal data",
         fmt::format("{} nodes, {} freedoms and {} modes need as many positions, rows and columns", n, r, m),
         fmt::format("{} positions, {} masses, {} x {} shapes, {} damping ratios, {} modal masses",
                     data.node_position.cols(), data.node_mass.size(), data.shapes.rows(), data.shapes.cols(),
                     data.damping_ratio.size(), data.modal_mass.size()),
         "give every node, freedom and mode its share"});
}

void check_names(const ModalData& data) {
  const std::set<int> known(data.node_ids.begin(), data.node_ids.end());
  if (known.size() != data.node_ids.size())
    throw InputError(
        {"modal data", "node ids must differ from each other", "a repeated id", "number each node once"});
  const auto check_node = [&](int node, std::string_view where) {
    if (!known.contains(node))
      throw InputError({"modal data", fmt::format("{} names a node that has no position", where),
                        fmt::format("node {}", node), "give the coordinates of every node that is named"});
  };
  std::set<std::pair<int, int>> rows;
  for (const Freedom& freedom : data.freedoms) {
    check_node(freedom.node, "a freedom");
    if (freedom.axis < 0 || freedom.axis > 2)
      throw InputError({"modal data", "the axis of a freedom must be 0, 1 or 2",
                        fmt::format("{}", freedom.axis), "give x, y or z"});
    if (!rows.emplace(freedom.node, freedom.axis).second)
      throw InputError(
          {"modal data", "a freedom must be listed once", to_string(freedom), "remove the second one"});
  }
  for (const auto& spring : data.support.springs) check_node(spring.node, "a support spring");
  for (const auto& joint : data.support.joints) check_node(joint.node, "a support joint");
  for (const auto& mass : data.support.masses) check_node(mass.node, "a support mass");
  for (const auto& [a, b] : data.lines) {
    check_node(a, "a line");
    check_node(b, "a line");
  }
}

void check_support(const Support& support) {
  const auto check_direction = [](const Vector3& u, std::string_view what, int node) {
    if (!(std::abs(u.norm() - 1) <= 1e-9))
      throw InputError({"modal data",
                        fmt::format("the direction of a support {} must be a unit vector", what),
                        fmt::format("length {:g} at node {}", u.norm(), node), "divide it by its length"});
  };
  for (const auto& spring : support.springs) {
    check_direction(spring.direction, "spring", spring.node);
    if (!(spring.stiffness > 0 && std::isfinite(spring.stiffness)))
      throw InputError({"modal data", "the stiffness of a support spring must be positive",
                        fmt::format("{:g} N/m at node {}", spring.stiffness, spring.node),
                        "leave the spring out"});
  }
  for (const auto& joint : support.joints) check_direction(joint.direction, "joint", joint.node);
  for (const auto& mass : support.masses)
    if (!(mass.mass >= 0 && std::isfinite(mass.mass)))
      throw InputError({"modal data", "a support mass must not be negative",
                        fmt::format("{:g} kg at node {}", mass.mass, mass.node),
                        "give what moves with the node"});
}

void check_values(const ModalData& data) {
  if (!data.node_position.allFinite() || !data.shapes.allFinite())
    throw InputError({"modal data", "positions and shapes must be finite numbers",
                      "an infinity or not a number", "check how they were read"});
  for (int i = 0; i < data.node_mass.size(); ++i)
    if (!(data.node_mass[i] >= 0 && std::isfinite(data.node_mass[i])))
      throw InputError({"modal data",
                        fmt::format("the mass of node {} must not be negative", data.node_ids[i]),
                        fmt::format("{:g} kg", data.node_mass[i]), "give its lumped mass"});
  for (int j = 0; j < data.mode_count(); ++j) {
    if (!(data.omega[j] > 0 && std::isfinite(data.omega[j])))
      throw InputError({"modal data", fmt::format("the frequency of mode {} must be positive", j + 1),
                        fmt::format("{:g} rad/s", data.omega[j]),
                        "leave rigid-body modes of a free structure out: they follow from its geometry"});
    if (j > 0 && data.omega[j] < data.omega[j - 1])
      throw InputError({"modal data", "frequencies must ascend",
                        fmt::format("mode {} at {:g} rad/s", j + 1, data.omega[j]), "sort the modes"});
    if (!(data.damping_ratio[j] >= 0 && std::isfinite(data.damping_ratio[j])))
      throw InputError({"modal data", fmt::format("the damping ratio of mode {} must not be negative", j + 1),
                        fmt::format("{:g}", data.damping_ratio[j]), "give zero for an undamped mode"});
    if (!(std::isnan(data.modal_mass[j]) || (data.modal_mass[j] > 0 && std::isfinite(data.modal_mass[j]))))
      throw InputError({"modal data", fmt::format("the modal mass of mode {} must be positive", j + 1),
                        fmt::format("{:g}", data.modal_mass[j]), "leave it out when it is not known"});
  }
}

}  // namespace

std::string to_string(const Freedom& freedom) {
  return fmt::format("{} {}", freedom.node, "xyz"[freedom.axis]);
}

int ModalData::node_index(int node_id) const {
  const auto found = std::find(node_ids.begin(), node_ids.end(), node_id);
  if (found == node_ids.end())
    throw InputError({"modal data", "there is no such node", fmt::format("node {}", node_id),
                      fmt::format("name one of the {} nodes", node_count())});
  return static_cast<int>(found - node_ids.begin());
}

std::optional<int> ModalData::row(const Freedom& freedom) const {
  const auto found = std::find(freedoms.begin(), freedoms.end(), freedom);
  if (found == freedoms.end()) return std::nullopt;
  return static_cast<int>(found - freedoms.begin());
}

bool ModalData::is_complete() const {
  return freedoms == all_freedoms(node_ids);
}

ModalData ModalData::with_modes(const std::vector<int>& modes) const {
  for (const int j : modes)
    if (j < 0 || j >= mode_count())
      throw InputError({"modal data", fmt::format("there are {} modes", mode_count()),
                        fmt::format("mode {}", j + 1), "choose among them"});
  ModalData chosen = *this;
  chosen.omega = omega(modes);
  chosen.damping_ratio = damping_ratio(modes);
  chosen.modal_mass = modal_mass(modes);
  chosen.shapes = shapes(Eigen::all, modes);
  return chosen;
}

void ModalData::validate() const {
  check_sizes(*this);
  check_names(*this);
  check_support(support);
  check_values(*this);
}

std::vector<Freedom> all_freedoms(const std::vector<int>& node_ids) {
  std::vector<Freedom> freedoms;
  freedoms.reserve(3 * node_ids.size());
  for (const int node : node_ids)
    for (int axis = 0; axis < 3; ++axis) freedoms.push_back({node, axis});
  return freedoms;
}

MatrixX rigid_body_shapes(const std::vector<Freedom>& freedoms, const std::vector<int>& node_ids,
                          const Matrix3X& node_position) {
  std::unordered_map<int, Eigen::Index> column;
  for (std::size_t i = 0; i < node_ids.size(); ++i) column[node_ids[i]] = static_cast<Eigen::Index>(i);
  const Vector3 middle = node_position.rowwise().mean();
  MatrixX shapes(static_cast<Eigen::Index>(freedoms.size()), 6);
  for (std::size_t k = 0; k < freedoms.size(); ++k) {
    const Vector3 s = node_position.col(column.at(freedoms[k].node)) - middle;
    // delta = t - s~ theta
    Eigen::Matrix<double, 3, 6> rows;
    rows << Matrix3::Identity(), -skew(s);
    shapes.row(static_cast<Eigen::Index>(k)) = rows.row(freedoms[k].axis);
  }
  return shapes;
}

}  // namespace wishbone
