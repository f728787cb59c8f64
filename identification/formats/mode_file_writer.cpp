#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/partial_file.h"
#include "core/version.h"
#include "identification/formats/mode_file.h"
#include "identification/formats/mode_file_layout.h"

namespace wishbone {
namespace {

using namespace mode_file_layout;

struct Description {
  std::string units, about, frame;
};

void describe(hdf5::Dataset dataset, const Description& description) {
  dataset.set_attribute("units", description.units);
  dataset.set_attribute("about", description.about);
  if (!description.frame.empty()) dataset.set_attribute("frame", description.frame);
}

/// One number of every item.
template <class Item, class Number>
void write_list(hdf5::Group& group, const char* path, const std::vector<Item>& items, Number number,
                const Description& description) {
  std::vector<double> values;
  for (const Item& item : items) values.push_back(number(item));
  describe(group.write(path, {values.size()}, values), description);
}

void write_vector(hdf5::Group& group, const char* path, const VectorX& values,
                  const Description& description) {
  const auto size = static_cast<std::size_t>(values.size());
  describe(group.write(path, {size}, std::span(values.data(), size)), description);
}

/// A row of `width` numbers for every item; nothing when there are no items.
template <int width, class Item, class Row>
void write_rows(hdf5::Group& group, const char* path, const std::vector<Item>& items, Row row,
                const Description& description) {
  if (items.empty()) return;
  MatrixX rows(static_cast<Eigen::Index>(items.size()), width);
  for (std::size_t i = 0; i < items.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = row(items[i]);
  describe(group.write(path, rows), description);
}

void write_nodes(hdf5::Group& group, const ModalData& data) {
  write_list(group, kNodeId, data.node_ids, [](int id) { return id; }, {"1", "node ids, each once", ""});
  describe(group.write(kNodePosition, data.node_position.transpose()),
           {"m", "undeformed positions of the nodes: x, y, z", "body"});
  if (data.has_masses())
    write_vector(group, kNodeMass, data.node_mass,
                 {"kg", "lumped masses of the nodes, of the structure without its support", ""});
}

void write_modes(hdf5::Group& group, const ModalData& data) {
  write_vector(group, kFrequency, data.omega / (2 * std::numbers::pi),
               {"Hz", "undamped natural frequencies, ascending; angular_frequency is what is read back", ""});
  write_vector(group, kAngularFrequency, data.omega,
               {"rad/s", "undamped natural angular frequencies, ascending", ""});
  write_vector(group, kDampingRatio, data.damping_ratio, {"1", "damping ratios", ""});
  write_vector(group, kModalMass, data.modal_mass,
               {"kg", "modal masses of the shapes as scaled here; NaN where not known", ""});
  describe(group.write(kShapes, data.shapes),
           {"1", "mode shapes: a row for every freedom, a column for every mode", "body"});
  write_list(group, kFreedomNode, data.freedoms, [](const Freedom& f) { return f.node; },
             {"1", "node id of every row of the shapes", ""});
  write_list(group, kFreedomAxis, data.freedoms, [](const Freedom& f) { return f.axis; },
             {"1", "body axis of every row of the shapes: 0 x, 1 y, 2 z", ""});
}

void write_support(hdf5::Group& group, const Support& support) {
  const auto row_of_spring = [](const Support::Spring& spring) {
    return (Eigen::RowVector<double, 5>() << spring.node, spring.direction.transpose(), spring.stiffness)
        .finished();
  };
  const auto row_of_joint = [](const Support::Joint& joint) {
    return (Eigen::RowVector4d() << joint.node, joint.direction.transpose()).finished();
  };
  const auto row_of_mass = [](const Support::Mass& mass) { return Eigen::RowVector2d(mass.node, mass.mass); };
  write_rows<5>(
      group, kSprings, support.springs, row_of_spring,
      {"1, 1, 1, 1, N/m", "springs to the ground: node id, unit direction x, y, z, stiffness", "body"});
  write_rows<4>(group, kJoints, support.joints, row_of_joint,
                {"1", "directions held fixed: node id, unit direction x, y, z", "body"});
  write_rows<2>(group, kMasses, support.masses, row_of_mass,
                {"1, kg", "masses of the support that move with nodes: node id, mass", ""});
}

void write_meta(hdf5::Group& group, const ModalData& data) {
  hdf5::Group meta = group.create_group("meta");
  meta.set_attribute("kind", std::string(kKind));
  meta.set_attribute("layout", kLayout);
  meta.set_attribute("title", data.title);
  meta.set_attribute("provenance", data.provenance);
  meta.set_attribute("support", describe_support(data.support));
  meta.set_attribute("version", std::string(kVersion));
}

}  // namespace

std::string describe_support(const Support& support) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, std::string_view one, std::string_view many) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
  };
  add(support.springs.size(), "spring", "springs");
  add(support.joints.size(), "joint", "joints");
  add(support.masses.size(), "mass", "masses");
  return parts.empty() ? "free" : fmt::format("{}", fmt::join(parts, ", "));
}

void write_mode_file(hdf5::Group& group, const ModalData& data) {
  data.validate();
  write_nodes(group, data);
  write_modes(group, data);
  write_support(group, data.support);
  write_rows<2>(group, kLines, data.lines,
                [](const auto& line) { return Eigen::RowVector2d(line[0], line[1]); },
                {"1", "pairs of node ids to draw the structure by", ""});
  write_meta(group, data);
}

void write_mode_file(const std::string& path, const ModalData& data) {
  data.validate();
  PartialFile partial(path);
  hdf5::File file = hdf5::File::create(partial.name());
  write_mode_file(file, data);
  file.close();
  partial.finish();
}

}  // namespace wishbone
