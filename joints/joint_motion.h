#pragma once

#include "core/spatial.h"

namespace wishbone {

/// Motion of the outboard joint frame M relative to the inboard one F, in F components:
///   V_FM = H v + V_drift,   (d/dt in F) V_FM = H v' + A_drift,
/// with V = (w_FM, v_FMo). V_drift is that of a prescribed motion; A_drift has its acceleration and, for the joints whose
/// hinge matrix changes as seen from F, H' v.
template <int nv, class T = double>
struct AcrossJoint {
  PoseT<T> X_FM;
  Eigen::Matrix<T, 6, nv> H = Eigen::Matrix<T, 6, nv>::Zero();  ///< hinge matrix, F components
};

/// The contract of a tree joint (a concept; the recursions visit concrete types). T is the scalar, double or Dual:
///
///     static constexpr const char* kKind;                       "revolute", ...
///     static constexpr int kNq, kNv;                            numbers of coordinates and speeds
///     static constexpr bool kRotates, kTranslates;              whether M ever turns against F; whether its origin leaves
///                                                               that of F. What never happens is left out
///     static constexpr bool kHasDrift;                          whether calc_drift gives anything but zero
///     void calc_across(double t, const T* q, AcrossJoint<kNv, T>&) const;
///     void calc_drift(double t, const T* q, const T* v, Vector6T<T>& V_drift, Vector6T<T>& A_drift) const;
///     void calc_q_rate(const T* q, const T* v, T* q_rate) const;                   q' = N(q) v
///     void retract(const double* d, double* q) const;           moves q along the displacement d (size kNv), to
///                                                               first order q + N(q) d, staying on the manifold
///     void calc_displacement(const double* q0, const double* q, double* d) const;  the inverse: q = q0 retracted by d
///     void set_neutral(double* q) const;                        the coordinates of X_FM = identity
///     Joint reversed() const;                                   optional: the inverse motion in the same coordinates, where
///                                                               that is the same type (else joints/reversed_joint.h)
///
/// calc_across writes what differs from the default AcrossJoint that it is given; calc_drift sets both arguments.

}  // namespace wishbone
