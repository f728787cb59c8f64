#pragma once

#include <array>
#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// The solid elements. Nodes are numbered as in CalculiX and Abaqus (C3D8, C3D20, C3D10): corners 1-4 of a hexahedron run
/// round one face, counterclockwise seen from the opposite one, corners 5-8 lie over them; corners 1-3 of a tetrahedron run
/// counterclockwise seen from corner 4. Middle nodes follow the corners in the order of ReferenceElement::edges.
enum class ElementType {
  incompatible_modes,  ///< 8-node hexahedron that bends (C3D8I): the default
  mean_dilatation,     ///< 8-node hexahedron of the source: locks or yields in bending
  hexahedron20,        ///< quadratic (C3D20), integrated fully
  tetrahedron10        ///< quadratic (C3D10)
};

/// Most nodes that an element has.
inline constexpr int kMostElementNodes = 20;
/// Components of something at every node of an element; never on the heap.
template <int Rows>
using AtElementNodes = Eigen::Matrix<double, Rows, Eigen::Dynamic, 0, Rows, kMostElementNodes>;

struct QuadraturePoint {
  Vector3 xi = Vector3::Zero();
  double weight = 0;
};

/// Shape functions N_a (value 1 at node a, 0 at the others) over the parent element: the cube -1 <= xi, eta, zeta <= 1, or
/// the tetrahedron xi, eta, zeta >= 0, xi + eta + zeta <= 1. Source: O. C. Zienkiewicz, R. L. Taylor, The Finite Element
/// Method, 5th ed., vol. 1, 2000, chapter 8.
struct ReferenceElement {
  enum class Shape { hexahedron8, hexahedron20, tetrahedron10 };

  Shape shape = Shape::hexahedron8;
  int nodes = 8;
  std::vector<std::array<int, 2>> edges;  ///< pairs of corners, from 0; middle node k lies on edge k

  /// For the stiffness. 2 x 2 x 2 Gauss points of a hexahedron with 8 nodes, 3 x 3 x 3 of one with 20: with 2 x 2 x 2 a lone one
  /// would have six motions that cost nothing, and a body must have none but its rigid ones. Four points of a tetrahedron, exact
  /// with straight edges.
  std::vector<QuadraturePoint> stiffness_rule;
  /// For products of two shape functions: exact where the edges are straight and opposite faces of a hexahedron parallel.
  std::vector<QuadraturePoint> mass_rule;

  VectorX values(const Vector3& xi) const;
  AtElementNodes<3> gradients(const Vector3& xi) const;  ///< dN/dxi

  int corners() const { return shape == Shape::tetrahedron10 ? 4 : 8; }
  bool is_quadratic() const { return shape != Shape::hexahedron8; }
};

const ReferenceElement& reference_element(ElementType type);

}  // namespace wishbone
