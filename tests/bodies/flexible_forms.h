#pragma once

// The chassis as a flexible body in every form, a strong motion of it, and the equations of motion solved.

#include <string>
#include <vector>

#include "bodies/modal_body.h"
#include "identification/elements/mesh.h"

namespace wishbone::flexible_forms {

inline constexpr IsotropicMaterial kMaterial{2.1e8, 0.3, 2600};
inline const std::vector<int> kInterface = {1, 5, 2, 6, 17, 13, 18, 14, 3, 4, 19, 20};

Mesh chassis_mesh();
const ModeSet& chassis();
ModeSet damped(ModeSet set, double zeta);

/// A reproducible vector of numbers in [-1, 1].
VectorX some_numbers(Eigen::Index count, unsigned seed);

/// A matrix that may be given by its diagonal.
MatrixX full(const MatrixX& matrix);

/// The chassis in every form with all its freedoms.
struct NamedShapes {
  std::string form;
  ShapeSet set;
};
std::vector<NamedShapes> complete_forms(double zeta = 0);

/// Spinning and vibrating strongly: deflections of some centimetres, on a body of 2.4 m that turns with 3
/// rad/s.
struct Motion {
  Vector3 w_B{1.5, -0.8, 2.5};
  Vector3 v_WBo{3, 1, -2};
  VectorX z, zdot;

  explicit Motion(const ModalBody& body);
};
ModalBodyState state_of(const ModalBody& body, const Motion& motion);

/// b_i and delta_i' of every node from the mode set alone.
struct NodeMotion {
  Matrix3X delta, b, delta_dot;
  NodeMotion(const ShapeSet& set, const Motion& motion)
      : delta((set.shapes * motion.z).reshaped(3, set.node_count())),
        b(set.node_position + delta),
        delta_dot((set.shapes * motion.zdot).reshaped(3, set.node_count())) {}
};

/// Gamma with w.(Gamma w) = sum_{a <= b} w_a w_b z^T K_ab z, from what ShapeSet::stiffening holds.
Matrix3 shortening(const MatrixX& stiffening, const VectorX& z);

/// M_z = 1 - P^T P / m - S^T J^-1 S of the undeformed body, S and J about the mass centre: the mass that is left to the shapes when
/// force and moment on the body vanish, whatever its axes.
MatrixX mass_of_free_motion(const ShapeSet& set);

/// The three equations of motion solved for v_Bo' + w x v_Bo (body axes), w' and z''.
struct Accelerations {
  Vector3 a, alpha;
  VectorX zddot;

  Accelerations(const ModalBody& body, const ModalBodyState& state, const Vector3& force,
                const Vector3& moment, const VectorX& modal_load);
};

}  // namespace wishbone::flexible_forms
