#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// One row of a mode shape: the translation of a node along one of the axes of the body.
struct Freedom {
  int node = 0;  ///< id
  int axis = 0;  ///< 0, 1, 2: x, y, z

  bool operator==(const Freedom&) const = default;
};

/// "12 x", for messages and tables.
std::string to_string(const Freedom& freedom);

/// What a structure was held by while its modes were measured, or is to be held by.
struct Support {
  /// Spring from a node to the ground: force -k (u . delta) u on the node.
  struct Spring {
    int node = 0;
    Vector3 direction = Vector3::Zero();  ///< u, unit vector
    double stiffness = 0;                 ///< k > 0 [N/m]
  };
  /// Joint that takes one direction of motion from a node: u . delta = 0.
  struct Joint {
    int node = 0;
    Vector3 direction = Vector3::Zero();  ///< u, unit vector
  };
  /// Mass of the support that moves with a node (of fixtures, of sensors).
  struct Mass {
    int node = 0;
    double mass = 0;  ///< >= 0 [kg]
  };

  std::vector<Spring> springs;
  std::vector<Joint> joints;
  std::vector<Mass> masses;

  bool empty() const { return springs.empty() && joints.empty() && masses.empty(); }
};

/// Modes of a structure as a modal test or a finite-element program gives them: m modes over r freedoms of n
/// nodes. Unlike a ModeSet (bodies/mode_set.h), which is ready to be simulated, it may be supported, may know
/// its nodes in some directions only, and need not know its masses.
///
/// SI units and body axes throughout: whoever reads a file has converted them. Only elastic or supported modes
/// are listed, omega > 0: the rigid-body modes of a free structure follow from its geometry.
struct ModalData {
  std::string title;

  std::vector<int> node_ids;  ///< n, each once, ascending or not
  Matrix3X node_position;     ///< 3 x n, body axes, any origin [m]
  VectorX node_mass;          ///< n, lumped masses of the structure without its support [kg]; empty: unknown

  std::vector<Freedom> freedoms;  ///< r, each once: what the rows of `shapes` are
  VectorX omega;                  ///< m, > 0, ascending, undamped angular frequencies [rad/s]
  VectorX damping_ratio;          ///< m, >= 0 [-]
  VectorX modal_mass;  ///< m, > 0, psi^T M psi of the shapes as scaled here; NaN where nothing is known [kg]
  MatrixX shapes;      ///< r x m, real

  Support support;  ///< empty: a free structure

  std::vector<std::array<int, 2>> lines;  ///< pairs of node ids to draw the structure by; may be empty
  std::vector<std::string> provenance;    ///< where it comes from and what was done to it, oldest first

  int node_count() const { return static_cast<int>(node_ids.size()); }
  int mode_count() const { return static_cast<int>(omega.size()); }
  int freedom_count() const { return static_cast<int>(freedoms.size()); }
  bool has_masses() const { return node_mass.size() > 0; }

  /// Column of `node_position` of a node id; throws InputError when there is no such node.
  int node_index(int node_id) const;
  /// Row of `shapes` of a freedom; nothing when it was not measured.
  std::optional<int> row(const Freedom& freedom) const;
  /// True when every node has its three freedoms, node by node in x, y, z: the layout of a ModeSet.
  bool is_complete() const;

  /// The same structure with the chosen modes only (0-based, ascending). Throws InputError if one is not there.
  ModalData with_modes(const std::vector<int>& modes) const;

  /// Throws InputError, naming the figure that is wrong, unless sizes fit, ids are unique, freedoms and support
  /// refer to nodes that exist, numbers are finite, frequencies positive and ascending, masses and damping not
  /// negative.
  void validate() const;
};

/// The freedoms x, y, z of every node, node by node.
std::vector<Freedom> all_freedoms(const std::vector<int>& node_ids);

/// Displacements of the freedoms under rigid motion (r x 6): three unit translations, three rotations about the
/// mean position of the nodes,
///     delta_i = t + theta x s_i.
/// Columns may be zero or dependent where few directions or nodes are listed.
MatrixX rigid_body_shapes(const std::vector<Freedom>& freedoms, const std::vector<int>& node_ids,
                          const Matrix3X& node_position);

}  // namespace wishbone
