#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/yaml.h"
#include "identification/identify.h"
#include "models/scene.h"

/// Readers of the parts of an identification, for its loader only.
namespace wishbone::identification_sections {

/// Names of files as the document gives them, and those that were read.
class Files {
 public:
  /// The path of a file named by a value, relative to the document that the value stands in. Throws InputError there
  /// when there is no such file.
  std::filesystem::path note(const Value& name);
  /// The same for a name that stands for files of these extensions.
  std::filesystem::path note(const Value& name, std::initializer_list<const char*> extensions);
  /// The same for modal data, whose name may stand for several tables.
  std::filesystem::path note_modal_data(const Value& name);
  const std::vector<std::string>& read() const { return read_; }

 private:
  void add(const std::filesystem::path& path, const Value& name);

  std::vector<std::string> read_;
};

/// `node: N` or `nodes: [N, ...]` of a mapping that has one of the two.
std::vector<int> read_nodes(const Mapping& keys);

/// "its nodes are 1 to 20".
std::string nodes_text(const std::vector<int>& ids);

Support read_support(const Value& value);
/// Refuses, where it stands, the first node of a support or a design change that is not among `ids`.
void check_nodes(const Value& section, const std::vector<int>& ids);
/// Springs between nodes act along their connection; `ids` and `position` (3 x n) are those of the structure.
StructureChange read_change(const Value& value, const std::vector<int>& ids, const Matrix3X& position,
                            Files& files);
/// A block, matrices, a listed mesh, or what CalculiX stored.
AnalyticalModel read_model(const Value& value, Files& files);
/// A square symmetric matrix from a file.
SparseMatrix read_symmetric(const Value& name, Files& files);
MeasurementNoise read_noise(const Value& value);
RigidBodyData read_rigid_body(const Value& value);

/// `all`, a number of lowest modes, a list of mode numbers (from 1), or a range of frequencies {above, below}.
ModalData choose_modes(const Value& value, const ModalData& modes);

/// A block of hexahedra and its material; shared with the flexible bodies of scenes.
MeshedBody block_body(const Scene::Block& block);
AnalyticalModel mesh_model(const MeshedBody& body);
/// {nodes, elements, element, material}: a listed mesh.
AnalyticalModel read_mesh(const Value& value, Files& files);

}  // namespace wishbone::identification_sections
