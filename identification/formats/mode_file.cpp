#include "identification/formats/mode_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "identification/formats/mode_file_layout.h"

namespace wishbone {
namespace {

using namespace mode_file_layout;

std::string where_is(const hdf5::ObjectReader& object) {
  return object.file_path() + ":" + object.path();
}

/// Lengths that a dataset must have; nothing where any will do.
using WantedShape = std::vector<std::optional<Eigen::Index>>;

std::string text_of(const WantedShape& shape) {
  std::vector<std::string> lengths;
  for (const auto& length : shape) lengths.push_back(length ? fmt::format("{}", *length) : "any");
  return fmt::format("[{}]", fmt::join(lengths, ", "));
}

bool fits(const hdf5::Shape& shape, const WantedShape& wanted) {
  if (shape.size() != wanted.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (wanted[i] && static_cast<std::size_t>(*wanted[i]) != shape[i]) return false;
  return true;
}

/// Rows of a dataset that must have this shape; a vector comes as one column.
MatrixX read(const hdf5::GroupReader& group, const char* path, const WantedShape& wanted) {
  const hdf5::DatasetReader dataset = group.open_dataset(path);
  const hdf5::Shape shape = dataset.shape();
  if (!fits(shape, wanted))
    throw InputError({where_is(dataset), "the dataset has the wrong shape",
                      fmt::format("[{}]", fmt::join(shape, ", ")), text_of(wanted) + " is wanted"});
  return group.read_matrix(path);
}

/// Node ids and the like are stored as doubles.
int integer(const hdf5::GroupReader& group, const char* path, double value) {
  if (std::trunc(value) == value && std::abs(value) <= std::numeric_limits<int>::max())
    return static_cast<int>(value);
  throw InputError({where_is(group.open_dataset(path)), "this must be an integer", fmt::format("{}", value),
                    "node ids and axes are integers"});
}

std::vector<int> read_integers(const hdf5::GroupReader& group, const char* path,
                               std::optional<Eigen::Index> count) {
  const MatrixX values = read(group, path, {count});
  std::vector<int> integers;
  for (Eigen::Index i = 0; i < values.size(); ++i) integers.push_back(integer(group, path, values(i)));
  return integers;
}

/// Rows of a table that is not there when it is empty.
MatrixX read_optional(const hdf5::GroupReader& group, const char* path, Eigen::Index width) {
  return group.contains(path) ? read(group, path, {std::nullopt, width}) : MatrixX(0, width);
}

void read_nodes(const hdf5::GroupReader& group, ModalData& data) {
  data.node_ids = read_integers(group, kNodeId, std::nullopt);
  data.node_position = read(group, kNodePosition, {data.node_count(), 3}).transpose();
  if (group.contains(kNodeMass)) data.node_mass = read(group, kNodeMass, {data.node_count()});
}

void read_modes(const hdf5::GroupReader& group, ModalData& data) {
  data.omega = read(group, kAngularFrequency, {std::nullopt});
  data.damping_ratio = read(group, kDampingRatio, {data.mode_count()});
  data.modal_mass = read(group, kModalMass, {data.mode_count()});
  const std::vector<int> nodes = read_integers(group, kFreedomNode, std::nullopt);
  const auto count = static_cast<Eigen::Index>(nodes.size());
  const std::vector<int> axes = read_integers(group, kFreedomAxis, count);
  for (std::size_t k = 0; k < nodes.size(); ++k) data.freedoms.push_back({nodes[k], axes[k]});
  data.shapes = read(group, kShapes, {count, data.mode_count()});
}

void read_support(const hdf5::GroupReader& group, Support& support) {
  const MatrixX springs = read_optional(group, kSprings, 5);
  for (const auto& row : springs.rowwise())
    support.springs.push_back({integer(group, kSprings, row[0]), row.segment<3>(1), row[4]});
  const MatrixX joints = read_optional(group, kJoints, 4);
  for (const auto& row : joints.rowwise())
    support.joints.push_back({integer(group, kJoints, row[0]), row.segment<3>(1)});
  const MatrixX masses = read_optional(group, kMasses, 2);
  for (const auto& row : masses.rowwise())
    support.masses.push_back({integer(group, kMasses, row[0]), row[1]});
}

void read_lines(const hdf5::GroupReader& group, ModalData& data) {
  const MatrixX lines = read_optional(group, kLines, 2);
  for (const auto& row : lines.rowwise())
    data.lines.push_back({integer(group, kLines, row[0]), integer(group, kLines, row[1])});
}

void read_meta(const hdf5::GroupReader& group, ModalData& data) {
  if (!is_mode_file(group))
    throw InputError({where_is(group), "this is not a mode file", "",
                      fmt::format("/meta of a mode file has the attribute kind = '{}'", kKind)});
  const hdf5::GroupReader meta = group.open_group("meta");
  const hdf5::Value layout = meta.attribute("layout");
  if (const auto* number = std::get_if<double>(&layout); !number || !(*number <= kLayout))
    throw InputError({where_is(meta), "this layout of mode files is not known",
                      number ? fmt::format("layout {}", *number) : "",
                      "read it with a later version of wishbone"});
  data.title = meta.text_attribute("title");
  if (!meta.has_attribute("provenance")) return;
  const hdf5::Value provenance = meta.attribute("provenance");
  if (const auto* texts = std::get_if<std::vector<std::string>>(&provenance)) data.provenance = *texts;
}

}  // namespace

bool is_mode_file(const hdf5::GroupReader& group) {
  return group.contains("meta") && group.open_group("meta").text_attribute("kind") == kKind;
}

ModalData read_mode_file(const hdf5::GroupReader& group) {
  ModalData data;
  read_meta(group, data);
  read_nodes(group, data);
  read_modes(group, data);
  read_support(group, data.support);
  read_lines(group, data);
  try {
    data.validate();
  } catch (const InputError& e) {
    throw InputError({where_is(group), e.diagnostic().what, e.diagnostic().value, e.diagnostic().remedy});
  }
  return data;
}

ModalData read_mode_file(const std::string& path) {
  return read_mode_file(hdf5::FileReader(path));
}

}  // namespace wishbone
