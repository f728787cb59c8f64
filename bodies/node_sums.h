#pragma once

#include <vector>

#include "bodies/modal_body_state.h"
#include "bodies/shape_set.h"

namespace wishbone {

/// Inertia of a deformed body as sums over mass points, in mass-weighted form, sqrt(m_i) b_i and sqrt(m_i) Psi_i, in which
/// m_i does not appear:
///     J = -sum b_i~ b_i~,  S = sum b_i~ Psi_i,  t = sum b_i x bias_i,  h = sum Psi_i^T bias_i,
///     bias_i = w x (w x b_i) + 2 w x delta_i'.
/// The interface nodes are points of their own. All other nodes enter only through second moments
/// sum (m_i [s_i Psi_i]^T [s_i Psi_i]), and where more than 3 (m + 1) of them remain they are exchanged for that number of
/// equivalent points with the same moments, so the cost of an evaluation does not grow with the mesh.
class NodeSums {
 public:
  /// @param interface_nodes columns of set.node_position, each once: interfaces 0, 1, ... of the states
  NodeSums(const ShapeSet& set, const std::vector<int>& interface_nodes);

  /// Multiplications of one evaluation: 15 p m with p points, of which 6 for S and 3 each for delta, delta' and h.
  static double operations(const ShapeSet& set, std::size_t interface_nodes);

  template <class T>
  void make_arrays(ModalBodyStateT<T>& state) const;
  /// From state.z: interface_b of the nodes, J and, if `coupled`, S.
  template <class T>
  void set_position(bool coupled, ModalBodyStateT<T>& state) const;
  /// From state.zdot and state.w_B: interface_delta_dot of the nodes, t_bias and h_bias of inertia.
  template <class T>
  void set_velocity(ModalBodyStateT<T>& state) const;

  /// 1/2 sum m_i |w x b_i + delta_i'|^2 [J].
  double energy_about_origin(const ModalBodyState& state) const;
  /// sum m_i b_i x delta_i' [N m s].
  Vector3 momentum_of_deflection(const ModalBodyState& state) const;

 private:
  Eigen::Index node_count_;  ///< interface nodes
  bool mean_axes_;
  VectorX inverse_root_mass_;      ///< 1/sqrt(m_i) of the interface nodes
  NodePointsT<double>::Points s_;  ///< p x 3, sqrt(m_i) s_i: the interface nodes first, then the other points
  MatrixX shapes_;                 ///< 3p x m, sqrt(m_i) Psi_i: all x rows, then all y rows, then all z rows
};

}  // namespace wishbone
