#pragma once

#include <vector>

#include "bodies/modal_body_state.h"
#include "bodies/shape_set.h"

namespace wishbone {

/// Inertia of a deformed body from matrices that do not depend on its state (inertia shape integrals). With
/// y = [1; z] and the position of a node along axis a, b_a = P_a y, P_a = [s_a Psi_a], all of them follow from
///     N_ab = sum m_i P_ia^T P_ib     (m + 1) x (m + 1):
///     G_aa = N_aa,  G_ab = N_ab + N_ba,      D_x = N_zy - N_yz,  D_y = N_xz - N_zx,  D_z = N_yx - N_xy
///     B_aa = y^T G_aa y,  B_ab = 1/2 y^T G_ab y,  J = tr(B) 1 - B
///     S_a = D_a y                                       (a row of S, without the element of the constant)
///     h   = sum_{a <= b} (w~ w~)_ab G_ab y + 2 sum_a w_a D_a z'.
/// Products of nine matrices with y and of three with z', whatever the number of nodes. Source: docs/theory.md; Shabana,
/// Dynamics of Multibody Systems, ch. 5.
class InertiaInvariants {
 public:
  /// @param interface_nodes columns of set.node_position: interfaces 0, 1, ... of the states
  InertiaInvariants(const ShapeSet& set, const std::vector<int>& interface_nodes);

  /// Multiplications of one evaluation: 12 m^2, and 6 m for every interface node.
  static double operations(const ShapeSet& set, std::size_t interface_nodes);

  // As those of NodeSums.
  template <class T>
  void make_arrays(ModalBodyStateT<T>& state) const;
  template <class T>
  void set_position(bool coupled, ModalBodyStateT<T>& state) const;
  template <class T>
  void set_velocity(ModalBodyStateT<T>& state) const;
  double energy_about_origin(const ModalBodyState& state) const;
  Vector3 momentum_of_deflection(const ModalBodyState& state) const;

 private:
  Eigen::Index m_;
  Matrix3X s_;         ///< 3 x k, interface nodes
  MatrixX interface_;  ///< 3k x m, Psi of the interface nodes
  MatrixX symmetric_;  ///< 6 (m + 1) x (m + 1), G_xx G_yy G_zz G_xy G_xz G_yz one above the other
  MatrixX skew_;       ///< 3 m x (m + 1), D_x D_y D_z likewise, without their first rows
};

}  // namespace wishbone
