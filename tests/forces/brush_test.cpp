// The closed forms of the UA tire against quadrature of the brush's stress field.
//
// The patch is walked from the leading edge (xi = 0) to the trailing edge (xi = 1): the adhering stress grows
// until it reaches the friction limit, from there on the tread slides. Forces and moments are sums over
// points of the tread line; nothing here uses the closed forms' polynomials in l_n.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "forces/support.h"
#include "forces/tire/ua_tire.h"

namespace wishbone {
namespace {

using testing::Random;
using testing::sample_tire;

// One point of the tread line: shear stress per unit xi, and lateral offset from the wheel plane.
struct Tread {
  double qx, qy;
  double offset;
};
using Field = std::function<Tread(double xi)>;

double pressure(double xi) {
  return 6 * xi * (1 - xi);
}

// First xi at which the adhering stress reaches the limit; the ratio of both to xi is free of the common zero
// there.
double breakaway(const std::function<double(double)>& excess) {
  if (excess(0.0) >= 0) return 0.0;
  double low = 0, high = 1;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return low;
}

// Composite Gauss-Legendre rule with three points.
void integrate(const Field& field, double from, double to, double length, UaShear& sum) {
  constexpr int kPanels = 8;
  const std::array<double, 3> node{-std::sqrt(0.6), 0.0, std::sqrt(0.6)};
  const std::array<double, 3> weight{5.0 / 9, 8.0 / 9, 5.0 / 9};
  const double half = 0.5 * (to - from) / kPanels;
  for (int panel = 0; panel < kPanels; ++panel) {
    for (int k = 0; k < 3; ++k) {
      const double xi = from + half * (2 * panel + 1 + node[k]);
      const Tread tread = field(xi);
      const double w = half * weight[k];
      sum.fx += w * tread.qx;
      sum.fy += w * tread.qy;
      sum.tz_lateral += w * length * (0.5 - xi) * tread.qy;
      sum.tz_traction -= w * tread.offset * tread.qx;
    }
  }
}

UaShear integrate_patch(const Field& adhering, const Field& sliding, double xi_breakaway, double length) {
  UaShear sum;
  integrate(adhering, 0, xi_breakaway, length, sum);
  integrate(sliding, xi_breakaway, 1, length, sum);
  sum.sliding_part = 1 - xi_breakaway;
  return sum;
}

double comprehensive_friction(const UaTireParameters& t, const UaSlip& s, double l) {
  const double lateral = s.sy + l * std::sin(s.gamma) / (2 * t.radius);
  return t.friction_max - (t.friction_max - t.friction_min) * std::min(1.0, std::hypot(s.sx, lateral));
}

UaShear smooth_brush(const UaTireParameters& t, const UaSlip& s, double l, double Fz) {
  const double F = comprehensive_friction(t, s, l) * Fz;
  const double ax = t.slip_stiffness * s.sx, ay = t.cornering_stiffness * s.sy;
  const double ag = std::max(-F, std::min(F, t.camber_stiffness * std::sin(s.gamma)));
  const auto stress_by_xi = [&](double xi) { return Eigen::Vector2d(2 * ax, 2 * ay + 6 * ag * (1 - xi)); };
  const auto camber_line = [&](double xi) {
    return l * l * xi * (1 - xi) * std::sin(s.gamma) / (2 * t.radius);
  };

  const double xi_b = breakaway([&](double xi) { return stress_by_xi(xi).norm() - 6 * F * (1 - xi); });
  const Eigen::Vector2d u = stress_by_xi(xi_b).stableNormalized();
  const Field adhering = [&](double xi) -> Tread {
    const Eigen::Vector2d q = xi * stress_by_xi(xi);
    return {q.x(), q.y(), l * s.sy * xi + camber_line(xi)};
  };
  const Field sliding = [&](double xi) -> Tread {
    const Eigen::Vector2d q = F * pressure(xi) * u;
    return {q.x(), q.y(),
            l * q.y() / (2 * t.cornering_stiffness) + camber_line(xi)};  // stress over tread stiffness
  };
  return integrate_patch(adhering, sliding, xi_b, l);
}

// The three published cases as stress fields: in III friction acts along the lean, and the tread's slip
// deflection is on the side of the slip angle in all three.
UaShear classic_brush(const UaTireParameters& t, const UaSlip& s, double l, double Fz) {
  const double S = -s.sx, tan_alpha = -s.sy, sg = std::sin(s.gamma);
  const double lateral = tan_alpha - l * sg / (2 * t.radius);
  const double slip = std::hypot(S, lateral);
  const double F = comprehensive_friction(t, s, l) * Fz;
  const double Fxs = slip > 0 ? F * std::abs(S) / slip : 0, Fys = slip > 0 ? F * std::abs(lateral) / slip : 0;
  const double c = t.camber_stiffness * std::abs(sg);
  const bool case_iii = tan_alpha * sg > 0 && t.cornering_stiffness * std::abs(tan_alpha) < c;

  const double ax = t.slip_stiffness * s.sx, ay = t.cornering_stiffness * s.sy, ag = t.camber_stiffness * sg;
  const auto stress_by_xi = [&](double xi) { return Eigen::Vector2d(2 * ax, 2 * ay + 6 * ag * (1 - xi)); };
  const double xi_b =
      c >= F ? 0.0 : breakaway([&](double xi) { return stress_by_xi(xi).norm() - 6 * F * (1 - xi); });

  const double side = case_iii ? std::copysign(1.0, sg) : -std::copysign(1.0, tan_alpha);
  const auto camber_line = [&](double xi) { return l * l * xi * (1 - xi) * sg / (2 * t.radius); };
  const Field adhering = [&](double xi) -> Tread {
    const Eigen::Vector2d q = xi * stress_by_xi(xi);
    return {q.x(), q.y(), -l * tan_alpha * xi + camber_line(xi)};
  };
  const Field sliding = [&](double xi) -> Tread {
    const double deflection = l * Fys * pressure(xi) / (2 * t.cornering_stiffness);
    return {-std::copysign(Fxs, S) * pressure(xi), side * Fys * pressure(xi),
            -std::copysign(deflection, tan_alpha) + camber_line(xi)};
  };
  return integrate_patch(adhering, sliding, xi_b, l);
}

template <class Law, class Brush>
void expect_closed_form_equals_brush(Law law, Brush brush, unsigned seed) {
  const UaTireParameters t = sample_tire();
  Random random(seed);
  int elastic = 0;
  for (int i = 0; i < 3000; ++i) {
    const double delta = random.uniform(1e-3, 0.05);
    const double Fz = t.radial_stiffness * delta * random.uniform(0.5, 1.5);
    const double l = ua_patch_length(t, delta);
    const UaSlip slip{random.signed_decades(1e-5, 1.2), random.signed_decades(1e-5, 1.5),
                      random.uniform(-0.2, 0.2)};
    const UaShear closed = law(t, slip, l, Fz);
    const UaShear field = brush(t, slip, l, Fz);
    SCOPED_TRACE(::testing::Message() << "case " << i << ": sx " << slip.sx << " sy " << slip.sy << " gamma "
                                      << slip.gamma << " Fz " << Fz);
    ASSERT_NEAR(closed.fx, field.fx, 1e-11 * Fz);
    ASSERT_NEAR(closed.fy, field.fy, 1e-11 * Fz);
    ASSERT_NEAR(closed.tz_lateral, field.tz_lateral, 1e-11 * Fz * l);
    ASSERT_NEAR(closed.tz_traction, field.tz_traction, 1e-11 * Fz * l);
    ASSERT_NEAR(closed.sliding_part, field.sliding_part, 1e-11);
    if (field.sliding_part < 1) ++elastic;
  }
  EXPECT_GT(elastic, 1000);  // both regimes have been visited
  EXPECT_LT(elastic, 2500);
}

TEST(Brush, SmoothFormIsTheIntegralOfItsStresses) {
  expect_closed_form_equals_brush(ua_shear_smooth<double>, smooth_brush, 20);
}

TEST(Brush, ClassicFormIsTheIntegralOfItsStresses) {
  expect_closed_form_equals_brush(ua_shear_classic<double>, classic_brush, 21);
}

}  // namespace
}  // namespace wishbone
