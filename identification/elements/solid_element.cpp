#include "identification/elements/solid_element.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace wishbone {
namespace {

/// Strains (xx, yy, zz, xy, yz, zx) of a displacement along x, y, z with the gradient g.
Eigen::Matrix<double, 6, 3> symmetric_gradient(const Vector3& g) {
  Eigen::Matrix<double, 6, 3> B;
  B << g[0], 0, 0,    // xx
      0, g[1], 0,     // yy
      0, 0, g[2],     // zz
      g[1], g[0], 0,  // xy
      0, g[2], g[1],  // yz
      g[2], 0, g[0];  // zx
  return B;
}

Matrix3 stress_tensor(const Vector6& s) {
  Matrix3 sigma;
  sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return sigma;
}

}  // namespace

SolidElement::SolidElement(ElementType type, const Matrix3X& nodes, const Matrix6& elasticity, int id)
    : type_(type), geometry_(type, nodes, id), elasticity_(elasticity) {
  if (type_ == ElementType::mean_dilatation) find_mean_gradients();
  if (type_ == ElementType::incompatible_modes) find_inner_motion();
}

void SolidElement::find_mean_gradients() {
  mean_gradients_.setZero(3, geometry_.node_count());
  for (const QuadraturePoint& point : geometry_.reference().stiffness_rule) {
    double determinant = 0;
    const AtElementNodes<3> gradients = geometry_.gradients(point.xi, &determinant);
    mean_gradients_ += point.weight * determinant * gradients;
  }
  mean_gradients_ /= geometry_.volume();
}

/// alpha = -(int G^T D G dV)^-1 int G^T D B dV u
void SolidElement::find_inner_motion() {
  Eigen::Matrix<double, 9, 9> GDG = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 24> GDB = Eigen::Matrix<double, 9, 24>::Zero();
  for (const QuadraturePoint& point : geometry_.reference().stiffness_rule) {
    double determinant = 0;
    const StrainOperator B = compatible_operator(geometry_.gradients(point.xi, &determinant));
    const InnerOperator G = inner_operator(point.xi, determinant);
    const Eigen::Matrix<double, 9, 6> GD = point.weight * determinant * G.transpose() * elasticity_;
    GDG.noalias() += GD * G;
    GDB.noalias() += GD * B;
  }
  inner_motion_ = -GDG.llt().solve(GDB);
}

SolidElement::StrainOperator SolidElement::compatible_operator(const AtElementNodes<3>& gradients) const {
  StrainOperator B(6, 3 * gradients.cols());
  for (Eigen::Index a = 0; a < gradients.cols(); ++a)
    B.middleCols<3>(3 * a) = symmetric_gradient(gradients.col(a));
  return B;
}

/// grad P_k = (det J_0 / det J) J_0^-T dP_k/dxi,   dP_k/dxi = -2 xi_k e_k
SolidElement::InnerOperator SolidElement::inner_operator(const Vector3& xi, double determinant) const {
  const Matrix3 J_0 = geometry_.jacobian(Vector3::Zero());
  const Matrix3 to_x = J_0.determinant() / determinant * J_0.inverse().transpose();
  InnerOperator G;
  for (int k = 0; k < 3; ++k) G.middleCols<3>(3 * k) = symmetric_gradient(to_x.col(k) * (-2 * xi[k]));
  return G;
}

SolidElement::StrainOperator SolidElement::strain_operator(const Vector3& xi) const {
  double determinant = 0;
  const AtElementNodes<3> g = geometry_.gradients(xi, &determinant);
  StrainOperator B = compatible_operator(g);
  if (type_ == ElementType::incompatible_modes) B += inner_operator(xi, determinant) * inner_motion_;
  // the dilatation (trace) of a node's columns is its gradient: exchange it for the mean gradient
  if (type_ == ElementType::mean_dilatation)
    for (Eigen::Index a = 0; a < g.cols(); ++a)
      B.middleCols<3>(3 * a).topRows<3>().rowwise() += (mean_gradients_.col(a) - g.col(a)).transpose() / 3;
  return B;
}

MatrixX SolidElement::stiffness() const {
  const Eigen::Index n = 3 * geometry_.node_count();
  MatrixX K = MatrixX::Zero(n, n);
  for (const QuadraturePoint& point : geometry_.reference().stiffness_rule) {
    const double dV = point.weight * geometry_.jacobian(point.xi).determinant();
    const StrainOperator B = strain_operator(point.xi);
    const StrainOperator stress = dV * elasticity_ * B;
    K.noalias() += B.transpose() * stress;
  }
  return K;
}

MatrixX SolidElement::displacement_products() const {
  const Eigen::Index n = geometry_.node_count();
  MatrixX products = MatrixX::Zero(3 * n, 3 * n);
  for (const QuadraturePoint& point : geometry_.reference().mass_rule) {
    const VectorX N = geometry_.reference().values(point.xi);
    MatrixX u = MatrixX::Zero(3, 3 * n);
    for (Eigen::Index a = 0; a < n; ++a) u.middleCols<3>(3 * a) = N[a] * Matrix3::Identity();
    if (type_ == ElementType::incompatible_modes)
      for (int k = 0; k < 3; ++k) u += (1 - point.xi[k] * point.xi[k]) * inner_motion_.middleRows<3>(3 * k);
    products.noalias() += point.weight * geometry_.jacobian(point.xi).determinant() * u.transpose() * u;
  }
  return products;
}

MatrixX SolidElement::stress_stiffness(const VectorX& u) const {
  MatrixX K = MatrixX::Zero(geometry_.node_count(), geometry_.node_count());
  for (const QuadraturePoint& point : geometry_.reference().stiffness_rule) {
    double determinant = 0;
    const AtElementNodes<3> g = geometry_.gradients(point.xi, &determinant);
    const Matrix3 sigma = stress_tensor(elasticity_ * (strain_operator(point.xi) * u));
    const AtElementNodes<3> pulled = point.weight * determinant * sigma * g;
    K.noalias() += g.transpose() * pulled;
  }
  return K;
}

}  // namespace wishbone
