#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/yaml.h"
#include "identification/identify.h"

/// Readers of the parts of an identification, for its loader only.
namespace wishbone::identification_sections {

/// Names of files as the document gives them, and those that were read.
class Files {
 public:
  /// The path of a file named by a value: relative to the document that the value stands in.
  std::filesystem::path note(const Value& name);
  void add(const std::filesystem::path& path) { read_.push_back(path.string()); }
  const std::vector<std::string>& read() const { return read_; }

 private:
  std::vector<std::string> read_;
};

/// `node: N` or `nodes: [N, ...]` of a mapping that has one of the two.
std::vector<int> read_nodes(const Mapping& keys);

/// A MatrixMarket file with a symmetric matrix.
SparseMatrix read_structure_matrix(const Value& name, Files& files);

Support read_support(const Value& value);
/// Positions are those of the structure that is changed: springs between nodes act along their connection.
StructureChange read_change(const Value& value, const ModalData& structure, Files& files);
AnalyticalModel read_model(const Value& value, Files& files);
MeasurementNoise read_noise(const Value& value);
RigidBodyData read_rigid_body(const Value& value);

/// `all`, a number of lowest modes, a list of mode numbers (from 1), or a range of frequencies {above, below}.
ModalData choose_modes(const Value& value, const ModalData& modes);

/// A block of hexahedra and its material as a model; shared with the flexible bodies of scenes.
AnalyticalModel block_model(const Vector3& size, const Eigen::Vector3i& elements, double young,
                            double poisson, double density);

}  // namespace wishbone::identification_sections
