#include "identification/methods/shape_scatter.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "identification/methods/rigid_modes.h"

namespace wishbone {
namespace {

using Eigen::Index;

VectorX root_mean_squares(const MatrixX& shapes) {
  return shapes.colwise().norm().transpose() / std::sqrt(static_cast<double>(shapes.rows()));
}

/// psi_i^T M_t psi_j over its deviation.
void add_orthogonality(const MatrixX& shapes, const VectorX& r, const SparseMatrix& M_t,
                       std::vector<double>& samples) {
  const MatrixX M_shapes = M_t * shapes;
  const MatrixX products = shapes.transpose() * M_shapes;
  const VectorX size = M_shapes.colwise().norm();
  for (Index j = 0; j < shapes.cols(); ++j)
    for (Index i = 0; i < j; ++i)
      samples.push_back(std::abs(products(i, j)) / std::hypot(r[j] * size[i], r[i] * size[j]));
}

/// w^T (lambda_j M_t - K_s) psi_j over its deviation.
void add_equilibrium(const Modes& modes, const VectorX& r, const SparseMatrix& M_t, const SparseMatrix& K_s,
                     const MatrixX& w, std::vector<double>& samples) {
  const MatrixX M_w = M_t * w, K_w = K_s * w;
  for (Index j = 0; j < modes.count(); ++j) {
    const MatrixX forces = modes.lambda[j] * M_w - K_w;
    for (Index k = 0; k < w.cols(); ++k)
      samples.push_back(std::abs(forces.col(k).dot(modes.shapes.col(j))) / (r[j] * forces.col(k).norm()));
  }
}

/// Rigid motions that the joints leave free, D w = 0.
MatrixX motions_without_reactions(const SparseMatrix& D, const MatrixX& rigid) {
  if (D.rows() == 0) return rigid;
  Eigen::FullPivLU<MatrixX> reactions(D * rigid);
  reactions.setThreshold(1e-9);
  if (reactions.dimensionOfKernel() == 0) return MatrixX(rigid.rows(), 0);
  return rigid * reactions.kernel();
}

double median(std::vector<double>& samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  if (samples.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(samples.begin(), middle)) / 2;
}

double root_mean_square(const std::vector<double>& samples) {
  double sum = 0;
  for (const double x : samples) sum += x * x;
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

/// A number as d.ddd...e+xx with 13 digits, the last of which may be spoilt by a change of unit.
struct Decimal {
  int exponent = 0;  ///< of the first digit
  int digits = 0;    ///< that are not trailing zeros

  explicit Decimal(double value) {
    const std::string text = fmt::format("{:.12e}", std::abs(value));
    exponent = std::stoi(text.substr(15));
    digits = 13;
    for (std::size_t k = 13; k > 1 && text[k] == '0'; --k) --digits;
  }
};

}  // namespace

ShapeScatter shape_scatter(const Modes& measured, const SparseMatrix& M, const SupportMatrices& support,
                           const MatrixX& rigid, int fitted) {
  const SparseMatrix M_t = M + support.M_s;
  const VectorX r = root_mean_squares(measured.shapes);
  std::vector<double> samples;
  add_orthogonality(measured.shapes, r, M_t, samples);
  add_equilibrium(measured, r, M_t, support.K_s, motions_without_reactions(support.D, rigid), samples);
  const int products = static_cast<int>(samples.size()) - fitted;
  if (products < 1) return {};
  constexpr double kMedianOfNormal = 0.67448975019608171;
  const double freedom = std::sqrt(static_cast<double>(samples.size()) / products);
  const double typical = median(samples) / kMedianOfNormal;
  const double shown = std::min(root_mean_square(samples), written_scatter(measured.shapes));
  return {freedom * std::max(typical, shown), products};
}

double written_scatter(const MatrixX& shapes) {
  constexpr int kFull = 12;
  int digits = 0, decimals = -400;
  for (const double x : shapes.reshaped()) {
    if (x == 0) continue;
    const Decimal written(x);
    digits = std::max(digits, written.digits);
    decimals = std::max(decimals, written.digits - 1 - written.exponent);
  }
  if (digits > kFull) return 0;
  const auto unit = [&](double x) {
    if (x == 0) return 0.0;  // may be a held freedom
    return std::pow(10.0, std::max(Decimal(x).exponent + 1 - digits, -decimals));
  };
  const MatrixX units = shapes.unaryExpr(unit);
  return (units.colwise().norm().array() / shapes.colwise().norm().array()).maxCoeff() / std::sqrt(12.0);
}

}  // namespace wishbone
