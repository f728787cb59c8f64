#pragma once

#include <vector>

#include "joints/cut_joint.h"
#include "joints/support.h"

namespace wishbone::testing {

/// Markers with their motion, the participants of one closure in order.
struct Scene {
  std::vector<MarkerState> markers;
  std::vector<MarkerAcceleration> accelerations;
  std::vector<double> near;
  double t = 0.7;
};

inline MarkerState random_marker(Random& random) {
  return {random.rotation(), random.vector(2), random.vector(3), random.vector(4)};
}
inline MarkerAcceleration random_acceleration(Random& random) {
  return {random.vector(5), random.vector(6)};
}
/// Markers anywhere in any motion.
inline Scene random_scene(const CutJoint& joint, Random& random) {
  Scene scene;
  for (int i = 0; i < participant_count(joint); ++i) {
    scene.markers.push_back(random_marker(random));
    scene.accelerations.push_back(random_acceleration(random));
  }
  scene.near.assign(gauge_count(joint), 0.0);
  return scene;
}

/// The same markers as they move: x + x' e.
inline std::vector<MarkerStateT<Dual>> moving(const Scene& scene) {
  std::vector<MarkerStateT<Dual>> result;
  for (std::size_t i = 0; i < scene.markers.size(); ++i) {
    const MarkerState& s = scene.markers[i];
    const MarkerAcceleration& a = scene.accelerations[i];
    result.push_back({dual(s.R_WM, skew(s.w_WM) * s.R_WM), dual(s.p_WM, s.v_WM), dual(s.w_WM, a.alpha),
                      dual(s.v_WM, a.a)});
  }
  return result;
}

inline std::vector<MarkerIndex> all_of(std::size_t count) {
  std::vector<MarkerIndex> indices(count);
  for (std::size_t i = 0; i < count; ++i) indices[i] = static_cast<MarkerIndex>(i);
  return indices;
}

template <class T>
VectorXT<T> residual(const CutJoint& joint, double t, const std::vector<MarkerStateT<T>>& markers,
                     const std::vector<double>& near) {
  VectorXT<T> Phi(row_count(joint));
  const std::vector<MarkerIndex> indices = all_of(markers.size());
  std::visit([&](const auto& j) { j.residual(t, Sides<T>(markers, indices), near.data(), Phi.data()); },
             joint);
  return Phi;
}

template <class T>
Matrix6XT<T> wrenches(const CutJoint& joint, const std::vector<MarkerStateT<T>>& markers) {
  Matrix6XT<T> W(6, row_count(joint) * participant_count(joint));
  const std::vector<MarkerIndex> indices = all_of(markers.size());
  std::visit([&](const auto& j) { j.wrenches(Sides<T>(markers, indices), W.data()); }, joint);
  return W;
}

/// D v = sum W_p^T V_p.
template <class T>
VectorXT<T> velocity_rows(const CutJoint& joint, const std::vector<MarkerStateT<T>>& markers) {
  const Matrix6XT<T> W = wrenches(joint, markers);
  const int rows = row_count(joint);
  VectorXT<T> Dv = VectorXT<T>::Zero(rows);
  for (std::size_t p = 0; p < markers.size(); ++p) {
    const Vector6T<T> V = spatial(markers[p].w_WM, markers[p].v_WM);
    Dv += W.middleCols(static_cast<Eigen::Index>(p) * rows, rows).transpose() * V;
  }
  return Dv;
}

inline VectorX time_rate(const CutJoint& joint, double t) {
  VectorX Phi_t(row_count(joint));
  std::visit([&](const auto& j) { j.time_rate(t, Phi_t.data()); }, joint);
  return Phi_t;
}

inline VectorX acceleration(const CutJoint& joint, const Scene& scene) {
  VectorX Phi_dd(row_count(joint));
  const std::vector<MarkerIndex> indices = all_of(scene.markers.size());
  std::visit(
      [&](const auto& j) {
        j.acceleration(scene.t, Sides<double>(scene.markers, indices),
                       MarkerAccelerations<double>(scene.accelerations, indices), Phi_dd.data());
      },
      joint);
  return Phi_dd;
}

/// Puts B where the tree joint with the coordinates q takes it from A, moving with its speeds v and rates v'.
template <class Joint>
void carry(const Joint& joint, const VectorX& q, const VectorX& v, const VectorX& v_rate, Scene& scene) {
  const auto m = across(joint, scene.t, q);
  const Drift d = drift(joint, scene.t, q, v);
  const MarkerState& A = scene.markers[0];
  const MarkerAcceleration& a_A = scene.accelerations[0];
  const Vector6 V_F = m.H * v + d.V, A_F = m.H * v_rate + d.A;
  const Vector3 w = A.R_WM * V_F.head<3>(), rate = A.R_WM * V_F.tail<3>(), p = A.R_WM * m.X_FM.p;
  scene.markers[1] = {A.R_WM * m.X_FM.R, A.p_WM + p, A.w_WM + w, A.v_WM + A.w_WM.cross(p) + rate};
  scene.accelerations[1] = {a_A.alpha + A.R_WM * A_F.head<3>() + A.w_WM.cross(w),
                            a_A.a + a_A.alpha.cross(p) + A.w_WM.cross(A.w_WM.cross(p)) +
                                2 * A.w_WM.cross(rate) + A.R_WM * A_F.tail<3>()};
}

inline int rank(const MatrixX& M) {
  Eigen::JacobiSVD<MatrixX> svd(M);
  return static_cast<int>((svd.singularValues().array() > 1e-9).count());
}

}  // namespace wishbone::testing
