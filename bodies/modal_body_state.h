#pragma once

#include <vector>

#include "bodies/interface_frame.h"

namespace wishbone {

/// Mass-weighted points of a body in a state, p x 3; see NodeSums.
template <class T>
struct NodePointsT {
  using Points = Eigen::Matrix<T, Eigen::Dynamic, 3>;
  Points delta;      ///< sqrt(m_i) delta_i
  Points b;          ///< sqrt(m_i) b_i
  Points delta_dot;  ///< sqrt(m_i) delta_i'
  Points bias;       ///< sqrt(m_i) (w x (w x b_i) + 2 w x delta_i')
};

/// Products of a body's inertia invariants with its state; see InertiaInvariants.
template <class T>
struct InvariantProductsT {
  VectorXT<T> y;               ///< m + 1, [1; z]
  VectorXT<T> symmetric;       ///< 6 (m + 1), G_ab y for ab = xx, yy, zz, xy, xz, yz
  VectorXT<T> skew, skew_dot;  ///< 3 m, D_a y and D_a z' for a = x, y, z
  Matrix3T<T> J = Matrix3T<T>::Zero();
};

/// Position, velocity and what follows from them of one ModalBody. Made by ModalBody::make_state(), which
/// sizes every array once. All components are in body axes; b_i = s_i + delta_i and delta_i' are seen from
/// the body frame.
template <class T>
struct ModalBodyStateT {
  // Position stage, written by set_position().
  VectorXT<T> z;             ///< m, modal coordinates [m sqrt(kg)]
  Matrix3XT<T> interface_b;  ///< 3 x k, p_BoP of each interface [m]
  Matrix3T<T> J =
      Matrix3T<T>::Zero();  ///< inertia about Bo of the deformed body, -sum m_i b_i~ b_i~ - Gamma [kg m2]
  Matrix3XT<T> S;           ///< 3 x m, sum m_i b_i~ Psi_i [m sqrt(kg)]
  Vector3T<T> c = Vector3T<T>::Zero();  ///< sum m_i b_i; zero with mean axes [kg m]

  // Velocity stage, written by set_velocity().
  VectorXT<T> zdot;                          ///< m [m sqrt(kg)/s]
  Vector3T<T> w_B = Vector3T<T>::Zero();     ///< angular velocity of the body axes [rad/s]
  Matrix3XT<T> interface_delta_dot;          ///< 3 x k, velocity in the body axes of each interface [m/s]
  Vector3T<T> t_bias = Vector3T<T>::Zero();  ///< w x (J w) + 2 sum m_i b_i x (w x delta_i') - Gamma' w [N m]
  Vector3T<T> f_bias = Vector3T<T>::Zero();  ///< w x (w x c) + 2 w x c'; zero with mean axes [N]
  VectorXT<T> h_bias;  ///< m, sum m_i Psi_i^T (w x (w x b_i) + 2 w x delta_i') + C z' + (K + K_g(w)) z

  /// Of the interfaces that are frames, written in both stages.
  std::vector<FrameTurnT<T>> turns;

  // Geometric stiffening (ShapeSet::stiffening).
  Eigen::Matrix<T, Eigen::Dynamic, 6> stiffening_z;  ///< K_ab z for ab = xx, yy, zz, xy, xz, yz
  Matrix3T<T> shortening =
      Matrix3T<T>::Zero();  ///< Gamma(z), by which J is less than that of the points [kg m2]

  // Whichever of the two the body uses.
  NodePointsT<T> points;
  InvariantProductsT<T> products;
};
using ModalBodyState = ModalBodyStateT<double>;

}  // namespace wishbone
