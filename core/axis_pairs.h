#pragma once

#include <array>

#include "core/spatial.h"

namespace wishbone {

/// The six products of two components of a vector, a <= b, in the order that all arrays over them have:
/// xx, yy, zz, xy, xz, yz.
struct AxisPair {
  int a, b;
};
inline constexpr std::array<AxisPair, 6> kAxisPairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// w_a w_b
template <class T>
Eigen::Matrix<T, 6, 1> products_of_components(const Vector3T<T>& w) {
  return {w.x() * w.x(), w.y() * w.y(), w.z() * w.z(), w.x() * w.y(), w.x() * w.z(), w.y() * w.z()};
}

/// The symmetric matrix A with w^T A w = sum_{a <= b} w_a w_b form_ab.
template <class T>
Matrix3T<T> matrix_of_form(const Eigen::Matrix<T, 6, 1>& form) {
  Matrix3T<T> A;
  const T xy = 0.5 * form[3], xz = 0.5 * form[4], yz = 0.5 * form[5];
  A << form[0], xy, xz, xy, form[1], yz, xz, yz, form[2];
  return A;
}

}  // namespace wishbone
