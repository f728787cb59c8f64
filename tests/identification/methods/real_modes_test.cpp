#include "identification/methods/real_modes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <random>

#include "core/error.h"
#include "identification/methods/modes.h"

namespace wishbone {
namespace {

using Complex = std::complex<double>;

/// Three masses in a row, fixed at both ends by unequal springs.
const MatrixX kMass = Eigen::Vector3d(2, 1, 3).asDiagonal();
const MatrixX kStiffness = (Matrix3() << 700, -300, 0, -300, 500, -200, 0, -200, 900).finished();

/// Modes with Im s > 0 of M x'' + C x' + K x = 0, by the companion matrix of first order.
void solve_damped(const MatrixX& C, Eigen::VectorXcd& s, Eigen::MatrixXcd& psi) {
  MatrixX A = MatrixX::Zero(6, 6);
  A.topRightCorner(3, 3).setIdentity();
  A.bottomLeftCorner(3, 3) = -kMass.inverse() * kStiffness;
  A.bottomRightCorner(3, 3) = -kMass.inverse() * C;
  const Eigen::EigenSolver<MatrixX> eigen(A);
  s.resize(3);
  psi.resize(3, 3);
  Eigen::Index found = 0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (eigen.eigenvalues()[k].imag() <= 0) continue;
    s[found] = eigen.eigenvalues()[k];
    psi.col(found++) = eigen.eigenvectors().col(k).head(3);
  }
}

TEST(RealModes, OfAProportionallyDampedSystemAreThoseOfTheUndampedOne) {
  const double alpha = 0.4, beta = 0.002;
  Eigen::VectorXcd s;
  Eigen::MatrixXcd psi;
  solve_damped(alpha * kMass + beta * kStiffness, s, psi);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-3.1, 3.1), size(0.1, 50);
  for (auto mode : psi.colwise()) mode *= std::polar(size(random), angle(random));

  const RealModes modes = real_modes(s, psi);
  const Modes undamped = solve_eigenproblem(kStiffness, kMass);
  for (Eigen::Index j = 0; j < 3; ++j) {
    Eigen::Index same = 0;
    (undamped.lambda.cwiseSqrt().array() - modes.omega[j]).abs().minCoeff(&same);
    const double omega = std::sqrt(undamped.lambda[same]);
    EXPECT_NEAR(modes.omega[j], omega, 1e-12 * omega);
    EXPECT_NEAR(modes.damping_ratio[j], alpha / (2 * omega) + beta * omega / 2, 1e-13);
    const VectorX expected = undamped.shapes.col(same).normalized();
    EXPECT_LT((modes.shapes.col(j).normalized() - expected).norm(), 1e-12);
    EXPECT_NEAR(modes.shapes.col(j).norm(), psi.col(j).norm(), 1e-12 * psi.col(j).norm());
    EXPECT_NEAR(modes.phase_collinearity[j], 1, 1e-12);
    EXPECT_LT(modes.imaginary_share[j], 1e-12);
  }
}

TEST(RealModes, LeaveTheLeastImaginaryPartOfAllPhases) {
  Eigen::VectorXcd s;
  Eigen::MatrixXcd psi;
  solve_damped(Eigen::Vector3d(40, 0, 1).asDiagonal(), s, psi);  // far from proportional
  const RealModes modes = real_modes(s, psi);
  for (Eigen::Index j = 0; j < 3; ++j) {
    double least = 1;
    for (int k = 0; k < 2000; ++k) {
      const Eigen::VectorXcd turned = std::polar(1.0, M_PI * k / 2000) * psi.col(j).normalized();
      least = std::min(least, turned.imag().norm());
    }
    EXPECT_NEAR(modes.imaginary_share[j], least, 1e-5);
    EXPECT_GT(least, 1e-3);
    // MPC by its definition from the variances of real and imaginary parts
    const VectorX re = psi.col(j).real(), im = psi.col(j).imag();
    const double xx = re.dot(re), yy = im.dot(im), xy = re.dot(im);
    const double mpc = (std::pow(xx - yy, 2) + 4 * xy * xy) / std::pow(xx + yy, 2);
    EXPECT_NEAR(modes.phase_collinearity[j], mpc, 1e-12);
  }
}

TEST(RealModes, OfATravellingWaveHaveNoCollinearity) {
  Eigen::MatrixXcd psi(2, 1);
  psi << Complex(1, 0), Complex(0, 1);
  const RealModes modes = real_modes(Eigen::VectorXcd::Constant(1, Complex(-1, 10)), psi);
  EXPECT_NEAR(modes.phase_collinearity[0], 0, 1e-15);
  EXPECT_NEAR(modes.imaginary_share[0], std::sqrt(0.5), 1e-15);
}

TEST(RealModes, RefuseWhatIsNoMode) {
  const Eigen::MatrixXcd psi = Eigen::MatrixXcd::Ones(3, 2);
  const Eigen::VectorXcd s = Eigen::VectorXcd::Constant(2, Complex(-1, 10));
  Eigen::MatrixXcd bad = psi;
  bad.col(1).setZero();
  EXPECT_THROW(real_modes(s.head(1), psi), InputError);
  EXPECT_THROW(real_modes(Eigen::Vector2cd(Complex(0, 1), Complex(0, 0)), psi), InputError);
  EXPECT_THROW(real_modes(s, bad), InputError);
  bad(0, 0) = Complex(std::nan(""), 0);
  EXPECT_THROW(real_modes(s, bad), InputError);
}

}  // namespace
}  // namespace wishbone
