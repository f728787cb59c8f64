#include "identification/elements/element_geometry.h"

#include <fmt/format.h>

#include "core/error.h"

namespace wishbone {

ElementGeometry::ElementGeometry(ElementType type, const Matrix3X& nodes, int id)
    : reference_(&reference_element(type)), nodes_(nodes) {
  if (reference_->is_quadratic()) check_middle_nodes(id);
  const auto& rule = reference_->stiffness_rule;
  for (std::size_t point = 0; point < rule.size(); ++point) {
    const double determinant = jacobian(rule[point].xi).determinant();
    if (!(determinant > 0))
      throw InputError(
          {fmt::format("element {}", id), "the Jacobian determinant must be positive at every Gauss point",
           fmt::format("{:g} m3 {}", determinant,
                       reference_->is_quadratic() ? fmt::format("at point {}", point + 1)
                                                  : fmt::format("near corner {}", point + 1)),
           reference_->corners() == 4
               ? "list corners 1-3 counterclockwise seen from corner 4"
               : "list corners 1-4 counterclockwise seen from corners 5-8, and keep the element convex"});
    volume_ += rule[point].weight * determinant;
  }
}

void ElementGeometry::check_middle_nodes(int id) const {
  constexpr double kNear = 0.2;  // of the edge; at a quarter the mapping folds
  for (std::size_t k = 0; k < reference_->edges.size(); ++k) {
    const auto& [a, b] = reference_->edges[k];
    const int middle = reference_->corners() + static_cast<int>(k);
    const double length = (nodes_.col(b) - nodes_.col(a)).norm();
    // along the edge: an arc may bulge
    const double off =
        std::abs(
            (nodes_.col(middle) - 0.5 * (nodes_.col(a) + nodes_.col(b))).dot(nodes_.col(b) - nodes_.col(a))) /
        length;
    const double aside = (nodes_.col(middle) - 0.5 * (nodes_.col(a) + nodes_.col(b))).norm();
    if (off <= kNear * length && aside <= 0.5 * length) continue;
    throw InputError(
        {fmt::format("element {}", id),
         fmt::format("its node {} must lie near the middle between its nodes {} and {}", middle + 1, a + 1,
                     b + 1),
         fmt::format("{:.3g} m from it, the edge has {:.3g} m", aside, length),
         fmt::format("list the nodes in the order of {}", reference_->corners() == 4 ? "C3D10" : "C3D20")});
  }
}

Matrix3 ElementGeometry::jacobian(const Vector3& xi) const {
  return nodes_ * reference_->gradients(xi).transpose();
}

AtElementNodes<3> ElementGeometry::gradients(const Vector3& xi, double* determinant) const {
  const AtElementNodes<3> dN_dxi = reference_->gradients(xi);
  const Matrix3 dx_dxi = nodes_ * dN_dxi.transpose();
  *determinant = dx_dxi.determinant();
  // dN/dx = (dx/dxi)^-T dN/dxi
  return dx_dxi.inverse().transpose() * dN_dxi;
}

MatrixX ElementGeometry::products() const {
  MatrixX products = MatrixX::Zero(node_count(), node_count());
  for (const QuadraturePoint& point : reference_->mass_rule) {
    const VectorX N = reference_->values(point.xi);
    products.noalias() += point.weight * jacobian(point.xi).determinant() * N * N.transpose();
  }
  return products;
}

VectorX ElementGeometry::mass_shares() const {
  if (!reference_->is_quadratic()) return VectorX::Constant(node_count(), 1.0 / node_count());
  const VectorX diagonal = products().diagonal();
  return diagonal / diagonal.sum();
}

}  // namespace wishbone
