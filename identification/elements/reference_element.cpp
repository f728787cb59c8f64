#include "identification/elements/reference_element.h"

#include <cmath>

#include "core/dual.h"

namespace wishbone {
namespace {

using Shape = ReferenceElement::Shape;
using Edges = std::vector<std::array<int, 2>>;

const Edges& hexahedron_edges() {
  static const Edges edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                           {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  return edges;
}

const Edges& tetrahedron_edges() {
  static const Edges edges{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  return edges;
}

/// xi, eta, zeta of the corners of the cube.
const Eigen::Matrix<double, 3, 8>& cube_corners() {
  static const Eigen::Matrix<double, 3, 8> corners = [] {
    Eigen::Matrix<double, 3, 8> c;
    c << -1, 1, 1, -1, -1, 1, 1, -1,  //
        -1, -1, 1, 1, -1, -1, 1, 1,   //
        -1, -1, -1, -1, 1, 1, 1, 1;
    return c;
  }();
  return corners;
}

/// N = (1 + xi xi_a)(1 + eta eta_a)(1 + zeta zeta_a) / 8
template <class T>
void trilinear(const Vector3T<T>& xi, T* N) {
  for (int a = 0; a < 8; ++a) {
    const Vector3 at = cube_corners().col(a);
    N[a] = 0.125 * (1 + xi[0] * at[0]) * (1 + xi[1] * at[1]) * (1 + xi[2] * at[2]);
  }
}

/// Serendipity: N = (1 - xi^2)(1 + eta eta_a)(1 + zeta zeta_a) / 4 in the middle of an edge along xi, and of a corner the
/// trilinear function less half of those on its three edges.
template <class T>
void serendipity(const Vector3T<T>& xi, T* N) {
  trilinear(xi, N);
  for (int k = 0; k < 12; ++k) {
    const auto& [a, b] = hexahedron_edges()[static_cast<std::size_t>(k)];
    const Vector3 middle = 0.5 * (cube_corners().col(a) + cube_corners().col(b));
    T product = 0.25;
    for (int axis = 0; axis < 3; ++axis)
      product *= middle[axis] == 0 ? 1 - xi[axis] * xi[axis] : 1 + xi[axis] * middle[axis];
    N[8 + k] = product;
    N[a] -= 0.5 * product;
    N[b] -= 0.5 * product;
  }
}

/// N = L_a (2 L_a - 1) at the corners, 4 L_a L_b in the middle of an edge, L = (1 - xi - eta - zeta, xi, eta, zeta).
template <class T>
void tetrahedral(const Vector3T<T>& xi, T* N) {
  const std::array<T, 4> L{1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};
  for (std::size_t a = 0; a < 4; ++a) N[a] = L[a] * (2 * L[a] - 1);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& [a, b] = tetrahedron_edges()[k];
    N[4 + k] = 4 * L[static_cast<std::size_t>(a)] * L[static_cast<std::size_t>(b)];
  }
}

template <class T>
void shape_functions(Shape shape, const Vector3T<T>& xi, T* N) {
  if (shape == Shape::hexahedron8) return trilinear(xi, N);
  if (shape == Shape::hexahedron20) return serendipity(xi, N);
  tetrahedral(xi, N);
}

/// Gauss points, the corners' order kept where there are two along an axis.
std::vector<QuadraturePoint> cube_rule(int points) {
  std::vector<QuadraturePoint> rule;
  if (points == 2) {
    for (int a = 0; a < 8; ++a) rule.push_back({cube_corners().col(a) / std::sqrt(3.0), 1.0});
    return rule;
  }
  const std::array<double, 3> x{-std::sqrt(0.6), 0, std::sqrt(0.6)}, w{5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) rule.push_back({Vector3(x[i], x[j], x[k]), w[i] * w[j] * w[k]});
  return rule;
}

/// The four points with barycentric coordinates (a, a, a, 1 - 3 a).
void add_four(double a, double weight, std::vector<QuadraturePoint>& rule) {
  rule.push_back({Vector3::Constant(a), weight});
  for (int axis = 0; axis < 3; ++axis)
    rule.push_back({Vector3::Constant(a) + (1 - 4 * a) * Vector3::Unit(axis), weight});
}

/// Degree 2.
std::vector<QuadraturePoint> four_points() {
  std::vector<QuadraturePoint> rule;
  add_four((5 - std::sqrt(5.0)) / 20, 1.0 / 24, rule);
  return rule;
}

/// Degree 5: Stroud's T3:5-1. Source: A. H. Stroud, Approximate Calculation of Multiple Integrals, 1971.
std::vector<QuadraturePoint> fifteen_points() {
  const double root = std::sqrt(15.0), volume = 1.0 / 6;
  std::vector<QuadraturePoint> rule{{Vector3::Constant(0.25), volume * 16 / 135}};
  add_four((7 - root) / 34, volume * (2665 + 14 * root) / 37800, rule);
  add_four((7 + root) / 34, volume * (2665 - 14 * root) / 37800, rule);
  const double a = (5 - root) / 20, b = 0.5 - a;  // (a, a, b, b)
  for (const auto& [first, second] : tetrahedron_edges()) {
    Eigen::Vector4d L = Eigen::Vector4d::Constant(b);
    L[first] = L[second] = a;
    rule.push_back({L.tail<3>(), volume * 10 / 189});
  }
  return rule;
}

}  // namespace

VectorX ReferenceElement::values(const Vector3& xi) const {
  VectorX N(nodes);
  shape_functions(shape, xi, N.data());
  return N;
}

AtElementNodes<3> ReferenceElement::gradients(const Vector3& xi) const {
  Vector3T<Dual> x;
  for (int axis = 0; axis < 3; ++axis) {
    x[axis] = xi[axis];
    x[axis].d[static_cast<std::size_t>(axis)] = 1;
  }
  std::array<Dual, kMostElementNodes> N;
  shape_functions(shape, x, N.data());
  AtElementNodes<3> gradients(3, nodes);
  for (int a = 0; a < nodes; ++a)
    for (int axis = 0; axis < 3; ++axis)
      gradients(axis, a) = N[static_cast<std::size_t>(a)].d[static_cast<std::size_t>(axis)];
  return gradients;
}

const ReferenceElement& reference_element(ElementType type) {
  static const ReferenceElement linear{Shape::hexahedron8, 8, hexahedron_edges(), cube_rule(2), cube_rule(3)};
  static const ReferenceElement quadratic{Shape::hexahedron20, 20, hexahedron_edges(), cube_rule(3),
                                          cube_rule(3)};
  static const ReferenceElement tetrahedron{Shape::tetrahedron10, 10, tetrahedron_edges(), four_points(),
                                            fifteen_points()};
  if (type == ElementType::hexahedron20) return quadratic;
  return type == ElementType::tetrahedron10 ? tetrahedron : linear;
}

}  // namespace wishbone
