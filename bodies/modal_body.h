#pragma once

#include <span>
#include <vector>

#include "bodies/interface_frame.h"
#include "bodies/mode_set.h"

namespace wishbone {

/// Position, velocity and what follows from them of one ModalBody. Made by ModalBody::make_state(), which
/// sizes every array once. All components are in body axes; b_i = s_i + delta_i and delta_i' are seen from
/// the body frame.
template <class T>
struct ModalBodyStateT {
  // Position stage, written by set_position().
  VectorXT<T> z;                        ///< m, modal coordinates [m sqrt(kg)]
  Matrix3XT<T> interface_b;             ///< 3 x k, p_BoP of each interface [m]
  Matrix3T<T> J = Matrix3T<T>::Zero();  ///< inertia about Bo of the deformed body, -sum m_i b_i~ b_i~ [kg m2]
  Matrix3XT<T> S;                       ///< 3 x m, sum m_i delta_i~ Psi_i [m sqrt(kg)]

  // Velocity stage, written by set_velocity().
  VectorXT<T> zdot;                          ///< m [m sqrt(kg)/s]
  Vector3T<T> w_B = Vector3T<T>::Zero();     ///< angular velocity of the body axes [rad/s]
  Matrix3XT<T> interface_delta_dot;          ///< 3 x k, velocity in the body axes of each interface [m/s]
  Vector3T<T> t_bias = Vector3T<T>::Zero();  ///< w x (J w) + 2 sum m_i b_i x (w x delta_i') [N m]
  VectorXT<T> h_bias;  ///< m, sum m_i Psi_i^T (w x (w x b_i) + 2 w x delta_i') + 2 zeta omega z' + omega^2 z

  /// Of the interfaces that are frames, written in both stages.
  std::vector<FrameTurnT<T>> turns;

  // Mass-weighted points (rows) used by the sums; see ModalBody.
  using Points = Eigen::Matrix<T, Eigen::Dynamic, 3>;
  Points delta;      ///< sqrt(m_i) delta_i
  Points b;          ///< sqrt(m_i) b_i
  Points delta_dot;  ///< sqrt(m_i) delta_i'
  Points bias;       ///< sqrt(m_i) (w x (w x b_i) + 2 w x delta_i')
};
using ModalBodyState = ModalBodyStateT<double>;

/// Flexible body in modal coordinates z, with mean axes B as its frame: Bo is the mass centre.
///
/// Kinetic energy T = 1/2 sum m_i |v_Bo + w x b_i + delta_i'|^2, all in body components, gives for the
/// unknowns (v_Bo', w', z'') with F, N the resultant force and moment about Bo and f_i the nodal forces
///     m (v_Bo' + w x v_Bo)        = F
///     J(z) w' + S(z) z'' + t_bias = N
///     S(z)^T w' + z'' + h_bias    = sum Psi_i^T f_i.
/// Translation couples with nothing and the modal mass is the identity, for the modes of a ModeSet are
/// mass-normalised and orthogonal to rigid motion. Nothing but modal truncation is left out, so a free
/// undamped body conserves energy and both momenta. Damping acts on z alone: it leaves both momenta as they
/// are. Source: docs/theory.md section 3, eqs. [5.47-5.64], where the source keeps the leading terms only;
/// the terms of second order in (z, z') make the equations follow from T.
///
/// The sums are taken over mass points in mass-weighted form, sqrt(m_i) b_i and sqrt(m_i) Psi_i, in which m_i
/// does not appear. The interface nodes are points of their own. All other nodes enter only through second
/// moments sum (m_i [s_i Psi_i]^T [s_i Psi_i]), and where more than 3 (m + 1) of them remain they are
/// exchanged for that number of equivalent points with the same moments, so the cost of an evaluation does
/// not grow with the mesh.
///
/// Joints and forces take hold at interfaces: nodes, which move but do not turn, and frames over several nodes, which
/// do both (bodies/interface_frame.h). Nodes are numbered first, frames after them.
class ModalBody {
 public:
  /// Forces may act at the interface nodes, given by id, and moments too at the frames; their order numbers them from 0.
  /// Throws InputError if the set is not valid (ModeSet::validate), a node is unknown or named twice, or as
  /// frame_shapes does.
  ModalBody(ModeSet modes, const std::vector<int>& interface_node_ids,
            const std::vector<InterfaceFrame>& frames = {});

  int mode_count() const { return modes_.mode_count(); }
  int interface_count() const { return static_cast<int>(interface_shapes_.size()); }
  double mass() const { return mass_; }
  const ModeSet& modes() const { return modes_; }
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

  /// 1/2 m v^2 + 1/2 sum m_i |w x b_i + delta_i'|^2 [J], v_WBo in any axes.
  double kinetic_energy(const Vector3& v_WBo, const ModalBodyState& state) const;
  /// 1/2 sum omega_j^2 z_j^2 [J].
  double elastic_energy(const ModalBodyState& state) const;
  /// Energy 1/2 (z_j'^2 + omega_j^2 z_j^2) of one mode [J], without its coupling to the rotation.
  double mode_energy(int mode, const ModalBodyState& state) const;
  /// Power lost to damping, sum 2 zeta_j omega_j z_j'^2 >= 0 [W].
  template <class T>
  T damping_power(const ModalBodyStateT<T>& state) const;
  /// Angular momentum about Bo, J w + S z', body components [N m s].
  Vector3 angular_momentum(const ModalBodyState& state) const;
  /// delta_i of any node of the body, body components [m]. Throws InputError if the node is unknown.
  Vector3 deflection(int node_id, const ModalBodyState& state) const;

 private:
  template <class T>
  void place_frames(ModalBodyStateT<T>& state) const;
  template <class T>
  void move_frames(ModalBodyStateT<T>& state) const;

  ModeSet modes_;
  double mass_ = 0;
  int node_count_ = 0;  ///< of the interfaces that are nodes
  std::vector<Matrix3X> interface_shapes_, frame_rotations_;
  Matrix3X frame_origins_;       ///< 3 x frames, undeformed [m]
  VectorX inverse_root_mass_;    ///< 1/sqrt(m_i) of the interface nodes
  ModalBodyState::Points s_;     ///< p x 3, sqrt(m_i) s_i: the interface nodes first, then the other points
  MatrixX shapes_;               ///< 3p x m, sqrt(m_i) Psi_i: all x rows, then all y rows, then all z rows
  VectorX damping_, stiffness_;  ///< m, 2 zeta omega and omega^2
};

}  // namespace wishbone
