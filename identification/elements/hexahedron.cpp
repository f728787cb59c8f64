#include "identification/elements/hexahedron.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.h"

namespace wishbone {
namespace {

/// xi, eta, zeta of the corners.
const Hexahedron::Corners& reference_corners() {
  static const Hexahedron::Corners corners = [] {
    Hexahedron::Corners c;
    c << -1, 1, 1, -1, -1, 1, 1, -1,  //
        -1, -1, 1, 1, -1, -1, 1, 1,   //
        -1, -1, -1, -1, 1, 1, 1, 1;
    return c;
  }();
  return corners;
}

/// Point `index` (0..7) of the 2 x 2 x 2 Gauss rule; all weights are one.
Vector3 gauss_point(int index) {
  return reference_corners().col(index) / std::sqrt(3.0);
}

/// dN/dxi (3 x 8) of the trilinear shape functions N_a = (1 + xi xi_a)(1 + eta eta_a)(1 + zeta zeta_a) / 8.
Hexahedron::Corners reference_gradients(const Vector3& xi) {
  Hexahedron::Corners gradients;
  for (int a = 0; a < 8; ++a) {
    const Vector3 corner = reference_corners().col(a);
    const Vector3 factor = Vector3::Ones() + xi.cwiseProduct(corner);
    gradients.col(a) = 0.125 * corner.cwiseProduct(Vector3(factor.y() * factor.z(), factor.z() * factor.x(),
                                                           factor.x() * factor.y()));
  }
  return gradients;
}

}  // namespace

void IsotropicMaterial::validate() const {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds) throw InputError({"material", what, fmt::format("{:g}", value), "give it in SI units"});
  };
  require(youngs_modulus > 0, "Young's modulus must be positive", youngs_modulus);
  require(poissons_ratio > -1 && poissons_ratio < 0.5, "Poisson's ratio must lie between -1 and 1/2",
          poissons_ratio);
  require(density > 0, "the density must be positive", density);
}

Matrix6 IsotropicMaterial::elasticity() const {
  const double mu = youngs_modulus / (2 * (1 + poissons_ratio));
  const double lambda = 2 * mu * poissons_ratio / (1 - 2 * poissons_ratio);
  Matrix6 D = Matrix6::Zero();
  D.topLeftCorner<3, 3>() = lambda * Matrix3::Ones() + 2 * mu * Matrix3::Identity();
  D.bottomRightCorner<3, 3>() = mu * Matrix3::Identity();
  return D;
}

Hexahedron::Hexahedron(const Corners& corners, int id) : corners_(corners) {
  for (int point = 0; point < 8; ++point) {
    double determinant = 0;
    const Gradients gradients = shape_gradients(gauss_point(point), &determinant);
    if (!(determinant > 0))
      throw InputError(
          {fmt::format("element {}", id), "the Jacobian determinant must be positive at every Gauss point",
           fmt::format("{:g} m3 near corner {}", determinant, point + 1),
           "list corners 1-4 counterclockwise seen from corners 5-8, and keep the element convex"});
    volume_ += determinant;
    mean_gradients_ += determinant * gradients;
  }
  mean_gradients_ /= volume_;
}

Hexahedron::Gradients Hexahedron::shape_gradients(const Vector3& xi, double* jacobian_determinant) const {
  const Corners dN_dxi = reference_gradients(xi);
  const Matrix3 dx_dxi = corners_ * dN_dxi.transpose();  // row: x, column: xi
  *jacobian_determinant = dx_dxi.determinant();
  // dN/dx = (dx/dxi)^-T dN/dxi
  return dx_dxi.inverse().transpose() * dN_dxi;
}

Hexahedron::StrainOperator Hexahedron::strain_operator(const Vector3& xi) const {
  double determinant = 0;
  const Gradients g = shape_gradients(xi, &determinant);
  StrainOperator B;
  for (int a = 0; a < 8; ++a) {
    Eigen::Matrix<double, 6, 3> B_a;
    B_a << g(0, a), 0, 0,     // xx
        0, g(1, a), 0,        // yy
        0, 0, g(2, a),        // zz
        g(1, a), g(0, a), 0,  // xy
        0, g(2, a), g(1, a),  // yz
        g(2, a), 0, g(0, a);  // zx
    // the dilatation (trace) of a corner's columns is its gradient: exchange it for the mean gradient
    B_a.topRows<3>().rowwise() += (mean_gradients_.col(a) - g.col(a)).transpose() / 3;
    B.middleCols<3>(3 * a) = B_a;
  }
  return B;
}

Hexahedron::Stiffness Hexahedron::stiffness(const Matrix6& elasticity) const {
  Stiffness K = Stiffness::Zero();
  for (int point = 0; point < 8; ++point) {
    double determinant = 0;
    shape_gradients(gauss_point(point), &determinant);
    const StrainOperator B = strain_operator(gauss_point(point));
    K.noalias() += B.transpose() * (determinant * elasticity * B);
  }
  return K;
}

Eigen::Matrix<double, 8, 8> Hexahedron::stress_stiffness(const Matrix6& elasticity,
                                                         const Displacement& u) const {
  Eigen::Matrix<double, 8, 8> K = Eigen::Matrix<double, 8, 8>::Zero();
  for (int point = 0; point < 8; ++point) {
    double determinant = 0;
    const Gradients g = shape_gradients(gauss_point(point), &determinant);
    const Eigen::Matrix<double, 6, 1> s = elasticity * (strain_operator(gauss_point(point)) * u);
    Matrix3 sigma;
    sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    K.noalias() += g.transpose() * (determinant * sigma * g);
  }
  return K;
}

}  // namespace wishbone
