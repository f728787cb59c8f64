#pragma once

#include <bitset>
#include <string>
#include <unordered_map>
#include <vector>

#include "identification/formats/uff/uff_file.h"
#include "identification/formats/uff/uff_mode_sets.h"
#include "identification/formats/uff/uff_modes.h"
#include "identification/formats/uff/uff_systems.h"

namespace wishbone {

/// Translations of nodes in one mode, 3 x n, components in the axes of the nodes.
using UffMotions = Eigen::Matrix3Xcd;

/// The nodes that all modes of a file know, in the order of the file.
class UffKnownNodes {
 public:
  struct Node {
    int number = 0;
    Matrix3 axes = Matrix3::Identity();  ///< columns: axes of the components in global ones
    std::bitset<3> measured;             ///< components that some mode moves
  };
  /// A row of the modes: a node and a global axis.
  struct Row {
    std::size_t node;
    int axis;
  };

  /// Throws InputError (place: `where`) when nodes of the modes have no position, or when it is not clear
  /// what axes they have.
  UffKnownNodes(const UffFile& file, const std::vector<UffModeSet>& modes, UffShapeAxes axes,
                const std::string& where);

  UffMotions motions(const UffModeSet& mode) const;
  /// The global axes that measured components have a part in.
  std::vector<Row> rows() const;
  const Node& operator[](std::size_t i) const { return nodes_[i]; }

  /// What was assumed and left out on the way.
  void say(std::vector<std::string>& provenance) const;

 private:
  std::vector<Node> nodes_;
  std::unordered_map<int, Eigen::Index> column_of_;
  bool in_systems_ = false;           ///< shapes are in displacement systems
  std::size_t in_some_modes_ = 0;     ///< nodes that at least one mode knows
  std::ptrdiff_t in_local_axes_ = 0;  ///< nodes of the file with a displacement system that is not global
  std::size_t without_shape_ = 0;     ///< nodes of the file that no mode knows
};

}  // namespace wishbone
