#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Motion of the outboard joint frame M relative to the inboard one F, in F components:
///   V_FM = H v + V_drift,   (d/dt in F) V_FM = H v' + A_drift,
/// with V = (w_FM, v_FMo). All joints here use speeds in which H' v vanishes (the rate of change seen from F), so
/// the drift terms are those of a prescribed motion alone.
template <int nv>
struct AcrossJoint {
  Pose X_FM;
  Eigen::Matrix<double, 6, nv> H = Eigen::Matrix<double, 6, nv>::Zero();  ///< hinge matrix, F components
  Vector6 V_drift = Vector6::Zero();
  Vector6 A_drift = Vector6::Zero();
};

/// The contract of a tree joint (a concept; the recursions visit concrete types):
///
///     static constexpr int kNq, kNv;                            numbers of coordinates and speeds
///     void calc_across(double t, const double* q, AcrossJoint<kNv>&) const;
///     void calc_q_rate(const double* q, const double* v, double* q_rate) const;    q' = N(q) v
///     void retract(const double* d, double* q) const;           moves q along the displacement d (size kNv), to
///                                                               first order q + N(q) d, staying on the manifold
///     void set_neutral(double* q) const;                        the coordinates of X_FM = identity

}  // namespace wishbone
