// Geometric stiffening of spinning bodies: a clamped beam in steady rotation and in spin-up against published digits.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "flexible_forms.h"

namespace wishbone {
namespace {

using namespace flexible_forms;

/// Points and weights of the Gauss rule on [0, 1].
struct GaussRule {
  VectorX x, w;
  explicit GaussRule(int n) {
    // Golub and Welsch: eigenvalues of the Jacobi matrix of the Legendre polynomials
    MatrixX J = MatrixX::Zero(n, n);
    for (int k = 1; k < n; ++k) J(k, k - 1) = J(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
    const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(J);
    x = 0.5 * (eigen.eigenvalues().array() + 1);
    w = eigen.eigenvectors().row(0).cwiseAbs2();
  }
};

/// Euler-Bernoulli beam along x, clamped at x = 0 on a hub of radius r about which it spins, bending along y.
struct Beam {
  double EI = 1.4e4, mass_per_length = 1.2, rotary_inertia = 6e-4, length = 10, hub = 0;

  /// sqrt(EI / rho A L^4)
  double rate() const { return std::sqrt(EI / mass_per_length) / (length * length); }
};

constexpr int kStations = 24, kPolynomials = 10;

/// x^2 P_j(2 x - 1) on [0, 1], with Legendre's polynomials, and its derivatives: what a clamp allows.
struct ClampedPolynomial {
  double value, slope, curvature;
  ClampedPolynomial(int j, double x) {
    const double s = 2 * x - 1;
    double p = 1, p1 = 0, p2 = 0, before = 0, before1 = 0,
           before2 = 0;  // P_k, P_k', P_k'' and those of k - 1
    for (int k = 0; k < j; ++k) {
      const double next = ((2 * k + 1) * s * p - k * before) / (k + 1);
      const double next1 = before1 + (2 * k + 1) * p, next2 = before2 + (2 * k + 1) * p1;
      before = std::exchange(p, next);
      before1 = std::exchange(p1, next1);
      before2 = std::exchange(p2, next2);
    }
    value = x * x * p;
    slope = 2 * x * p + 2 * x * x * p1;
    curvature = 2 * p + 8 * x * p1 + 4 * x * x * p2;
  }
};

/// The lowest clamped modes of a beam as shapes of mass points at Gauss stations, four to a section, which sums exactly to the
/// integrals over the length, rotary inertia included. Their axes are fixed at the clamp, `p_OB` from it to the mass centre.
struct ClampedBeam {
  ShapeSet set;
  Vector3 p_OB;
  VectorX tip;  ///< deflection of the end by each shape

  ClampedBeam(const Beam& beam, int modes, bool stiffened) {
    const double L = beam.length, side = std::sqrt(beam.rotary_inertia / beam.mass_per_length);
    const GaussRule gauss(kStations);
    MatrixX M = MatrixX::Zero(kPolynomials, kPolynomials), K = M, tension = M;
    for (int s = 0; s < kStations; ++s) {
      VectorX u(kPolynomials), u1(kPolynomials), u2(kPolynomials);
      for (int j = 0; j < kPolynomials; ++j) {
        const ClampedPolynomial polynomial(j, gauss.x[s]);
        u[j] = polynomial.value;
        u1[j] = polynomial.slope / L;
        u2[j] = polynomial.curvature / (L * L);
      }
      const double dx = L * gauss.w[s], x = L * gauss.x[s];
      M += dx * (beam.mass_per_length * u * u.transpose() + beam.rotary_inertia * u1 * u1.transpose());
      K += dx * beam.EI * u2 * u2.transpose();
      // T / Omega^2 = rho A (r (L - x) + (L^2 - x^2) / 2)
      const double T = beam.mass_per_length * (beam.hub * (L - x) + (L * L - x * x) / 2);
      tension += dx * T * u1 * u1.transpose();
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(K, M);
    const MatrixX C = eigen.eigenvectors().leftCols(modes);

    const int n = 4 * kStations;
    set.node_position.resize(3, n);
    set.node_mass.resize(n);
    set.shapes = MatrixX::Zero(3 * n, modes);
    p_OB = Vector3(L / 2, 0, 0);
    for (int i = 0; i < n; ++i) {
      const int s = i / 4;
      const double y = (i % 2 == 0 ? 1 : -1) * side, z = (i % 4 < 2 ? 1 : -1) * side;
      set.node_ids.push_back(i + 1);
      set.node_position.col(i) = Vector3(L * gauss.x[s], y, z) - p_OB;
      set.node_mass[i] = 0.25 * beam.mass_per_length * L * gauss.w[s];
      for (int j = 0; j < kPolynomials; ++j) {
        const ClampedPolynomial polynomial(j, gauss.x[s]);
        set.shapes.row(3 * i) += -y * polynomial.slope / L * C.row(j);
        set.shapes.row(3 * i + 1) += polynomial.value * C.row(j);
      }
    }
    set.stiffness = eigen.eigenvalues().head(modes);
    set.damping = VectorX::Zero(modes);
    set.mean_axes = false;
    tip = C.colwise().sum().transpose();  // P_j(1) = 1
    if (!stiffened) return;
    // a spin about any axis across the beam pulls it alike
    set.stiffening = MatrixX::Zero(modes, 6 * modes);
    for (const int pair : {1, 2})
      set.stiffening.middleCols(pair * modes, modes) = C.transpose() * tension * C;
  }
};

/// z'' of the clamped beam while the clamp turns: P^T a + S^T w' + z'' + h_bias = 0.
VectorX elastic_acceleration(const ModalBody& body, ModalBodyState& state, const Vector3& p_OB,
                             const Vector3& w, const Vector3& w_rate, const VectorX& z, const VectorX& zdot) {
  body.set_position(z.data(), state);
  body.set_velocity(w, zdot.data(), state);
  const Vector3 a = w_rate.cross(p_OB) + w.cross(w.cross(p_OB));
  return -(body.momentum_shape().transpose() * a + state.S.transpose() * w_rate + state.h_bias);
}

/// Frequencies in units of sqrt(EI / rho A L^4) of small vibrations in steady rotation about `axis`.
VectorX frequencies(const Beam& beam, int modes, double gamma, const Vector3& axis) {
  const ClampedBeam clamped(beam, modes, true);
  const ModalBody body(clamped.set, {});
  ModalBodyState state = body.make_state();
  const Vector3 w = gamma * beam.rate() * axis, p_CB = clamped.p_OB + Vector3(beam.hub, 0, 0);
  const VectorX rest = VectorX::Zero(modes);
  const VectorX at_rest = elastic_acceleration(body, state, p_CB, w, Vector3::Zero(), rest, rest);
  MatrixX K(modes, modes);
  for (int j = 0; j < modes; ++j) {
    const VectorX z = VectorX::Unit(modes, j);
    K.col(j) = at_rest - elastic_acceleration(body, state, p_CB, w, Vector3::Zero(), z, rest);
  }
  return Eigen::SelfAdjointEigenSolver<MatrixX>(K).eigenvalues().cwiseSqrt() / beam.rate();
}

/// First flapping frequencies of a rotating Euler-Bernoulli cantilever, delta = r / L, from a series and a Ritz method in 60
/// and 140 digits (Wright et al. 1982 and Yoo & Shin 1998 state the problem).
struct Published {
  double delta, gamma, flap;
};
constexpr Published kPublished[] = {{0, 0, 3.516015268500151},  {0, 2, 4.137319573025358},
                                    {0, 4, 5.585001420884815},  {0, 6, 7.360373019310019},
                                    {0, 12, 13.17015048750618}, {1, 2, 4.833688871530717},
                                    {1, 6, 10.44386586945982},  {1, 12, 19.72154193525476}};

TEST(SpinningBeam, HasThePublishedFrequencies) {
  Beam beam;
  beam.rotary_inertia = 1e-6;  // next to none: the published ones neglect it
  for (const Published& p : kPublished) {
    SCOPED_TRACE(testing::Message() << "delta " << p.delta << " gamma " << p.gamma);
    beam.hub = p.delta * beam.length;
    // bending along y: a spin about y lets it flap, a spin about z is in its plane, mu_lag^2 = mu_flap^2 - gamma^2
    const double flap = frequencies(beam, 10, p.gamma, Vector3::UnitY())[0];
    EXPECT_NEAR(flap, p.flap, 1e-6 * p.flap);
    const double lag = frequencies(beam, 10, p.gamma, Vector3::UnitZ())[0];
    EXPECT_NEAR(lag * lag, p.flap * p.flap - p.gamma * p.gamma, 1e-6 * p.flap * p.flap);
    if (p.delta == 0 && p.gamma <= 6) {
      EXPECT_NEAR(frequencies(beam, 3, p.gamma, Vector3::UnitY())[0], p.flap, 1e-3 * p.flap);
    }
  }
}

/// psi'(t) and psi''(t) of the spin-up to 6 rad/s in 15 s.
double spin(double t) {
  constexpr double kT = 15, k2Pi = 2 * std::numbers::pi;
  return t < kT ? 6 / kT * (t - kT / k2Pi * std::sin(k2Pi * t / kT)) : 6;
}
double spin_rate(double t) {
  constexpr double kT = 15, k2Pi = 2 * std::numbers::pi;
  return t < kT ? 6 / kT * (1 - std::cos(k2Pi * t / kT)) : 0;
}

/// Deflection of the end at the times given, by the classical Runge-Kutta rule.
std::vector<double> spin_up(int modes, bool stiffened, const std::vector<double>& times) {
  const ClampedBeam beam(Beam{}, modes, stiffened);
  const ModalBody body(beam.set, {});
  ModalBodyState state = body.make_state();
  const auto rate = [&](double t, const VectorX& y) {
    VectorX out(2 * modes);
    out << y.tail(modes), elastic_acceleration(body, state, beam.p_OB, {0, 0, spin(t)}, {0, 0, spin_rate(t)},
                                               y.head(modes), y.tail(modes));
    return out;
  };
  constexpr double h = 1e-3;
  VectorX y = VectorX::Zero(2 * modes);
  std::vector<double> tip;
  long step = 0;
  for (const double time : times) {
    for (; step < std::lround(time / h); ++step) {
      const double t = h * static_cast<double>(step);
      const VectorX k1 = rate(t, y), k2 = rate(t + h / 2, y + h / 2 * k1),
                    k3 = rate(t + h / 2, y + h / 2 * k2), k4 = rate(t + h, y + h * k3);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    tip.push_back(beam.tip.dot(y.head(modes)));
  }
  return tip;
}

// Spin-up of a cantilever, data of Simo & Vu-Quoc 1986; deflections of a geometrically exact beam by two methods that agree
// to 10 digits. Linear shapes with the stiffness of the tension follow it to 1e-3 m while the tip, 0.574 m aside, draws 19 mm nearer,
// which they do not know of.
TEST(SpinningBeam, FollowsTheSpinUpOfAGeometricallyExactBeam) {
  const std::vector<double> times{1, 2, 3, 4, 5, 6, 6.762, 8, 9, 10, 12, 14, 15, 17, 20};
  const std::vector<double> exact{
      -2.05435319768e-02, -1.02380632191e-01, -2.17267358746e-01, -3.42278647478e-01, -4.68476183441e-01,
      -5.43596400281e-01, -5.73834759187e-01, -5.42841535139e-01, -4.60271115712e-01, -3.62814515637e-01,
      -1.50900697086e-01, -2.02913377682e-02, 1.30362628219e-03,  -2.53351302164e-03, 7.26580818045e-04};
  const std::vector<double> tip = spin_up(3, true, times);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(tip[i], exact[i], 1e-3) << "t = " << times[i] << " s";
}

// Without the stiffness of the tension it diverges (Kane, Ryan & Banerjee 1987): the spin is faster than the first mode.
TEST(SpinningBeam, FliesApartWithoutStiffening) {
  EXPECT_GT(std::abs(spin_up(3, false, {20})[0]), 100);
}

}  // namespace
}  // namespace wishbone
