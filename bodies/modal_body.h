#pragma once

#include <variant>
#include <vector>

#include "bodies/inertia_invariants.h"
#include "bodies/mode_set.h"
#include "bodies/node_sums.h"

namespace wishbone {

/// Which inertial coupling between deformation and rotation a flexible body has.
enum class InertiaTerms {
  consistent,  ///< all that follow from the kinetic energy
  source  ///< S(z) = 0 in both places, as in [5.63, 5.64]: neither energy nor angular momentum is conserved
};

/// What the inertia of a deformed body is computed from: the same numbers up to rounding, at different cost.
enum class InertiaMethod { cheaper, node_sums, invariants };

/// Flexible body whose deflections are made of shapes (ShapeSet): normal modes (modal form) or the mass-weighted
/// displacements of its nodes (nodal form).
///
/// Kinetic energy T = 1/2 sum m_i |v_Bo + w x b_i + delta_i'|^2, all in body components, gives for the
/// unknowns a = v_Bo' + w x v_Bo, w' and z'' with F, N the resultant force and moment about Bo and f_i the nodal forces
///     m a + w' x c + P z'' + f_bias                 = F
///     c x a + J(z) w' + S(z) z'' + t_bias           = N
///     P^T a + S(z)^T w' + z'' + h_bias              = sum Psi_i^T f_i,
/// c = sum m_i b_i, P = sum m_i Psi_i. With mean axes c and P vanish: Bo is the mass centre and translation couples with
/// nothing. The modal mass is the identity, for the shapes are mass-orthonormal. Nothing but truncation is left out, so a
/// free undamped body conserves energy and both momenta. Elastic and damping forces depend on z alone and have no share in
/// F and N: they leave both momenta as they are, of the deformed body too. Source: docs/theory.md section 3, eqs.
/// [5.41-5.64], where the source keeps the leading terms only (InertiaTerms::source).
///
/// With geometric stiffening (ShapeSet::stiffening) T is less by 1/2 w^T Gamma(z) w, by which the body is shorter when it
/// bends: J - Gamma stands for J, - Gamma' w - w x (Gamma w) enters t_bias, and K_g(w) z enters h_bias. Nothing is
/// conserved less for it.
///
/// J, S and the biases come from sums over nodes or from inertia invariants, whichever takes fewer operations.
///
/// Joints and forces take hold at interfaces: nodes, which move but do not turn, and frames over several nodes, which
/// do both (bodies/interface_frame.h). Nodes are numbered first, frames after them.
class ModalBody {
 public:
  /// Forces may act at the interface nodes, given by id, and moments too at the frames; their order numbers them from 0.
  /// Throws InputError if the set is not valid (ShapeSet::validate), a node is unknown or named twice, or as
  /// frame_shapes does.
  ModalBody(ShapeSet set, const std::vector<int>& interface_node_ids,
            const std::vector<InterfaceFrame>& frames = {}, InertiaTerms terms = InertiaTerms::consistent,
            InertiaMethod method = InertiaMethod::cheaper);
  /// @throws InputError as the other, and if the modes are not valid (ModeSet::validate)
  ModalBody(const ModeSet& modes, const std::vector<int>& interface_node_ids,
            const std::vector<InterfaceFrame>& frames = {}, InertiaTerms terms = InertiaTerms::consistent,
            InertiaMethod method = InertiaMethod::cheaper);

  int mode_count() const { return set_.shape_count(); }
  int interface_count() const { return static_cast<int>(interface_shapes_.size()); }
  double mass() const { return mass_; }
  const ShapeSet& set() const { return set_; }
  /// What J, S and the biases are computed from, and the multiplications that either takes in an evaluation.
  InertiaMethod inertia_method() const;
  double operations(InertiaMethod method) const;
  /// Whether c, P and f_bias vanish.
  bool mean_axes() const { return set_.mean_axes; }
  /// P = sum m_i Psi_i (3 x m), what z'' adds to the linear momentum's rate; empty with mean axes [sqrt(kg)].
  const Matrix3X& momentum_shape() const { return P_; }
  /// Psi_i (3 x m) of an interface, a node or the origin of a frame: the modal load of a force there is Psi_i^T f.
  const Matrix3X& interface_shape(int interface) const { return interface_shapes_[interface]; }
  /// Whether an interface is a frame.
  bool interface_turns(int interface) const { return interface >= node_count_; }
  /// Rotation shapes (3 x m) of a frame: phi = rotation z.
  const Matrix3X& interface_rotation(int interface) const {
    return frame_rotations_[interface - node_count_];
  }
  /// Turn of a frame in a state.
  template <class T>
  const FrameTurnT<T>& interface_turn(int interface, const ModalBodyStateT<T>& state) const {
    return state.turns[interface - node_count_];
  }

  /// Arrays of the right size, at rest and undeformed.
  template <class T = double>
  ModalBodyStateT<T> make_state() const;

  /// Deflections, interface positions, J(z) and S(z). Allocates nothing.
  template <class T>
  void set_position(const T* z, ModalBodyStateT<T>& state) const;

  /// Interface velocities, t_bias and h_bias at the position set before. Allocates nothing.
  template <class T>
  void set_velocity(const Vector3T<T>& w_B, const T* zdot, ModalBodyStateT<T>& state) const;

  /// 1/2 sum m_i |v_Bo + w x b_i + delta_i'|^2 - 1/2 w^T Gamma w [J], body components of v_WBo.
  double kinetic_energy(const Vector3& v_WBo_B, const ModalBodyState& state) const;
  /// 1/2 z^T K z [J].
  double elastic_energy(const ModalBodyState& state) const;
  /// Energy 1/2 (z_j'^2 + omega_j^2 z_j^2) of one mode [J], without its coupling to the rotation. K must be diagonal.
  double mode_energy(int mode, const ModalBodyState& state) const;
  /// Power lost to damping, z'^T C z' >= 0 [W].
  template <class T>
  T damping_power(const ModalBodyStateT<T>& state) const;
  /// Momentum sum m_i v_i and angular momentum about Bo, sum m_i b_i x v_i - Gamma w, body components [N s, N m s].
  Vector3 linear_momentum(const Vector3& v_WBo_B, const ModalBodyState& state) const;
  Vector3 angular_momentum(const Vector3& v_WBo_B, const ModalBodyState& state) const;
  /// delta_i of any node of the body, body components [m]. Throws InputError if the node is unknown.
  Vector3 deflection(int node_id, const ModalBodyState& state) const;

 private:
  template <class T>
  void place_frames(ModalBodyStateT<T>& state) const;
  template <class T>
  void move_frames(ModalBodyStateT<T>& state) const;
  template <class T>
  void shorten(ModalBodyStateT<T>& state) const;
  template <class T>
  void add_stiffening(ModalBodyStateT<T>& state) const;

  ShapeSet set_;
  InertiaTerms terms_;
  double mass_ = 0;
  Matrix3X P_;
  int node_count_ = 0;  ///< of the interfaces that are nodes
  std::vector<Matrix3X> interface_shapes_, frame_rotations_;
  Matrix3X frame_origins_;  ///< 3 x frames, undeformed [m]
  std::variant<NodeSums, InertiaInvariants> inertia_;
};

}  // namespace wishbone
