#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "identification/modal_data.h"

namespace wishbone {

/// Modal data with something of everything, and numbers that take all their 17 digits.
inline ModalData modal_data_example() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  ModalData data;
  data.title = "Frame, \"as built\"; µm";
  data.node_ids = {17, 3, 2000000000};
  data.node_position = Matrix3X::NullaryExpr(3, 3, [&] { return number(random) / 3; });
  data.node_position(1, 1) = -0.0;
  data.node_mass = Vector3(0.1, 0, 1.0 / 3);
  data.freedoms = {{3, 2}, {17, 0}, {2000000000, 1}, {17, 1}};
  data.omega = Eigen::Vector2d(2 * std::numbers::pi * 1.177, 1e5 / 3);
  data.damping_ratio = Eigen::Vector2d(0, 0.017);
  data.modal_mass = Eigen::Vector2d(std::numeric_limits<double>::quiet_NaN(), 1.0 / 7);
  data.shapes = MatrixX::NullaryExpr(4, 2, [&] { return number(random); });
  data.shapes(0, 1) = 5e-324;  // the smallest double
  data.shapes(1, 0) = -std::numeric_limits<double>::max();
  const Vector3 oblique = Vector3(1, 2, 3).normalized();
  data.support.springs = {{17, Vector3::UnitX(), 47e3}, {3, oblique, 1e5 / 3}};
  data.support.joints = {{3, -oblique}};
  data.support.masses = {{17, 0.05}, {3, 0}};
  data.lines = {{17, 3}, {3, 2000000000}};
  data.provenance = {"measured", "", "turned, scaled"};
  return data;
}

/// Bit patterns: equality of doubles would take -0 for 0, and no NaN for itself.
template <class Matrix>
std::vector<std::uint64_t> bits(const Matrix& matrix) {
  std::vector<std::uint64_t> patterns{static_cast<std::uint64_t>(matrix.rows()),
                                      static_cast<std::uint64_t>(matrix.cols())};
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      patterns.push_back(std::isnan(matrix(i, j)) ? ~std::uint64_t{0}
                                                  : std::bit_cast<std::uint64_t>(matrix(i, j)));
  return patterns;
}

inline void expect_same_tables(const ModalData& a, const ModalData& b) {
  EXPECT_EQ(a.node_ids, b.node_ids);
  EXPECT_EQ(bits(a.node_position), bits(b.node_position));
  EXPECT_EQ(bits(a.node_mass), bits(b.node_mass));
  EXPECT_EQ(a.freedoms, b.freedoms);
  EXPECT_EQ(bits(a.omega), bits(b.omega));
  EXPECT_EQ(bits(a.damping_ratio), bits(b.damping_ratio));
  EXPECT_EQ(bits(a.modal_mass), bits(b.modal_mass));
  EXPECT_EQ(bits(a.shapes), bits(b.shapes));
}

inline void expect_same_support(const Support& a, const Support& b) {
  ASSERT_EQ(a.springs.size(), b.springs.size());
  for (std::size_t i = 0; i < a.springs.size(); ++i) {
    EXPECT_EQ(a.springs[i].node, b.springs[i].node);
    EXPECT_EQ(bits(a.springs[i].direction), bits(b.springs[i].direction));
    EXPECT_EQ(a.springs[i].stiffness, b.springs[i].stiffness);
  }
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_EQ(a.joints[i].node, b.joints[i].node);
    EXPECT_EQ(bits(a.joints[i].direction), bits(b.joints[i].direction));
  }
  ASSERT_EQ(a.masses.size(), b.masses.size());
  for (std::size_t i = 0; i < a.masses.size(); ++i) {
    EXPECT_EQ(a.masses[i].node, b.masses[i].node);
    EXPECT_EQ(a.masses[i].mass, b.masses[i].mass);
  }
}

inline void expect_same(const ModalData& a, const ModalData& b) {
  expect_same_tables(a, b);
  expect_same_support(a.support, b.support);
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.lines, b.lines);
  EXPECT_EQ(a.provenance, b.provenance);
}

}  // namespace wishbone
