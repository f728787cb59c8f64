#pragma once

#include <span>
#include <vector>

#include "bodies/interface_frame.h"
#include "bodies/mode_set.h"
#include "bodies/shape_set.h"

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
  Matrix3XT<T> S;                       ///< 3 x m, sum m_i b_i~ Psi_i [m sqrt(kg)]
  Vector3T<T> c = Vector3T<T>::Zero();  ///< sum m_i b_i; zero with mean axes [kg m]

  // Velocity stage, written by set_velocity().
  VectorXT<T> zdot;                          ///< m [m sqrt(kg)/s]
  Vector3T<T> w_B = Vector3T<T>::Zero();     ///< angular velocity of the body axes [rad/s]
  Matrix3XT<T> interface_delta_dot;          ///< 3 x k, velocity in the body axes of each interface [m/s]
  Vector3T<T> t_bias = Vector3T<T>::Zero();  ///< w x (J w) + 2 sum m_i b_i x (w x delta_i') [N m]
  Vector3T<T> f_bias = Vector3T<T>::Zero();  ///< w x (w x c) + 2 w x c'; zero with mean axes [N]
  VectorXT<T> h_bias;  ///< m, sum m_i Psi_i^T (w x (w x b_i) + 2 w x delta_i') + C z' + K z

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

/// Which inertial coupling between deformation and rotation a flexible body has.
enum class InertiaTerms {
  consistent,  ///< all that follow from the kinetic energy
  source  ///< S(z) = 0 in both places, as in [5.63, 5.64]: neither energy nor angular momentum is conserved
};

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
  /// Throws InputError if the set is not valid (ShapeSet::validate), a node is unknown or named twice, or as
  /// frame_shapes does.
  ModalBody(ShapeSet set, const std::vector<int>& interface_node_ids,
            const std::vector<InterfaceFrame>& frames = {}, InertiaTerms terms = InertiaTerms::consistent);
  /// @throws InputError as the other, and if the modes are not valid (ModeSet::validate)
  ModalBody(const ModeSet& modes, const std::vector<int>& interface_node_ids,
            const std::vector<InterfaceFrame>& frames = {}, InertiaTerms terms = InertiaTerms::consistent);

  int mode_count() const { return set_.shape_count(); }
  int interface_count() const { return static_cast<int>(interface_shapes_.size()); }
  double mass() const { return mass_; }
  const ShapeSet& set() const { return set_; }
  InertiaTerms inertia_terms() const { return terms_; }
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

  /// 1/2 sum m_i |v_Bo + w x b_i + delta_i'|^2 [J], body components of v_WBo.
  double kinetic_energy(const Vector3& v_WBo_B, const ModalBodyState& state) const;
  /// 1/2 z^T K z [J].
  double elastic_energy(const ModalBodyState& state) const;
  /// Energy 1/2 (z_j'^2 + omega_j^2 z_j^2) of one mode [J], without its coupling to the rotation. K must be diagonal.
  double mode_energy(int mode, const ModalBodyState& state) const;
  /// Power lost to damping, z'^T C z' >= 0 [W].
  template <class T>
  T damping_power(const ModalBodyStateT<T>& state) const;
  /// Momentum sum m_i v_i and angular momentum about Bo, sum m_i b_i x v_i, body components [N s, N m s].
  Vector3 linear_momentum(const Vector3& v_WBo_B, const ModalBodyState& state) const;
  Vector3 angular_momentum(const Vector3& v_WBo_B, const ModalBodyState& state) const;
  /// delta_i of any node of the body, body components [m]. Throws InputError if the node is unknown.
  Vector3 deflection(int node_id, const ModalBodyState& state) const;

 private:
  /// + K z and + C z', with matrices or their diagonals.
  template <class T>
  void add_product(const MatrixX& matrix, const VectorXT<T>& z, VectorXT<T>& sum) const;
  template <class T>
  void place_frames(ModalBodyStateT<T>& state) const;
  template <class T>
  void move_frames(ModalBodyStateT<T>& state) const;

  ShapeSet set_;
  InertiaTerms terms_;
  double mass_ = 0;
  Matrix3X P_;
  int node_count_ = 0;  ///< of the interfaces that are nodes
  std::vector<Matrix3X> interface_shapes_, frame_rotations_;
  Matrix3X frame_origins_;     ///< 3 x frames, undeformed [m]
  VectorX inverse_root_mass_;  ///< 1/sqrt(m_i) of the interface nodes
  ModalBodyState::Points s_;   ///< p x 3, sqrt(m_i) s_i: the interface nodes first, then the other points
  MatrixX shapes_;             ///< 3p x m, sqrt(m_i) Psi_i: all x rows, then all y rows, then all z rows
};

}  // namespace wishbone
