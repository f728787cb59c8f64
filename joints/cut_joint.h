#pragma once

#include <array>
#include <variant>

#include "bodies/marker.h"

namespace wishbone {

/// Acceleration of a marker, world components.
struct MarkerAcceleration {
  Vector3 alpha = Vector3::Zero();  ///< angular [rad/s^2]
  Vector3 a = Vector3::Zero();      ///< of Mo [m/s^2]
};

/// A cut joint closes a loop between a marker A and a marker B by rows Phi = 0. Its contract (a concept):
///
///     static constexpr int kRows;
///     static constexpr int kAngles;                                  the last rows that are angles
///     static constexpr std::array<const char*, kRows> kDirections;   names of the rows, for messages
///     void residual(A, B, Phi)                      Phi
///     void wrenches(A, B, W_A, W_B)                 column i: the (moment, force) that a unit multiplier of row i puts
///                                                   on A and on B, about the markers' origins; by virtual power
///                                                   D v = W_A^T V_A + W_B^T V_B
///     void acceleration(A, B, a_A, a_B, Phi_dd)     second derivative of Phi for the given marker accelerations
///
/// Rows are written in the axes of A: a direction that is redundant in one pose of the vehicle is then redundant in
/// all of them.
template <int rows>
using ClosureVector = Eigen::Matrix<double, rows, 1>;
template <int rows>
using ClosureWrenches = Eigen::Matrix<double, 6, rows>;

/// Mo of B stays on Mo of A: Phi = R_AW (p_WB - p_WA), 3 rows [m].
struct SphericalClosure {
  static constexpr int kRows = 3;
  static constexpr int kAngles = 0;
  static constexpr std::array<const char*, 3> kDirections{"x", "y", "z"};

  void residual(const MarkerState& A, const MarkerState& B, Eigen::Ref<ClosureVector<3>> Phi) const;
  void wrenches(const MarkerState& A, const MarkerState& B, Eigen::Ref<ClosureWrenches<3>> W_A,
                Eigen::Ref<ClosureWrenches<3>> W_B) const;
  void acceleration(const MarkerState& A, const MarkerState& B, const MarkerAcceleration& a_A,
                    const MarkerAcceleration& a_B, Eigen::Ref<ClosureVector<3>> Phi_dd) const;
};

/// As spherical, and the z axes of both markers stay parallel:
/// Phi = (R_AW (p_WB - p_WA), z_A . x_B, z_A . y_B), 3 rows [m] and 2 rows [rad].
struct RevoluteClosure {
  static constexpr int kRows = 5;
  static constexpr int kAngles = 2;
  static constexpr std::array<const char*, 5> kDirections{"x", "y", "z", "tilt about y", "tilt about x"};

  void residual(const MarkerState& A, const MarkerState& B, Eigen::Ref<ClosureVector<5>> Phi) const;
  void wrenches(const MarkerState& A, const MarkerState& B, Eigen::Ref<ClosureWrenches<5>> W_A,
                Eigen::Ref<ClosureWrenches<5>> W_B) const;
  void acceleration(const MarkerState& A, const MarkerState& B, const MarkerAcceleration& a_A,
                    const MarkerAcceleration& a_B, Eigen::Ref<ClosureVector<5>> Phi_dd) const;
};

/// Every cut joint. A new one is one entry here.
using CutJoint = std::variant<SphericalClosure, RevoluteClosure>;

inline int row_count(const CutJoint& joint) {
  return std::visit([](const auto& j) { return j.kRows; }, joint);
}
/// Whether a row is an angle [rad] rather than a length [m]; a joint's angles come last.
inline bool row_is_angle(const CutJoint& joint, int row) {
  return std::visit([row](const auto& j) { return row >= j.kRows - j.kAngles; }, joint);
}
inline const char* row_direction(const CutJoint& joint, int row) {
  return std::visit([row](const auto& j) { return j.kDirections[row]; }, joint);
}

}  // namespace wishbone
