#include "forces/tire/ua_tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace wishbone {

namespace {

constexpr double kDampingRamp = 0.002;  // delta_0 [m]

double square(double x) {
  return x * x;
}
double cube(double x) {
  return x * x * x;
}
double sign(double x) {
  return x > 0 ? 1.0 : (x < 0 ? -1.0 : 0.0);
}

// U0 at zero slip, falling linearly to U1 at slip one
double friction(const UaTireParameters& tire, double comprehensive_slip) {
  return tire.friction_max - (tire.friction_max - tire.friction_min) * std::min(1.0, comprehensive_slip);
}

// Integrals over the sliding zone xi = l_n ... 1
double sliding_pressure(double ln) {
  return 1 - 3 * square(ln) + 2 * cube(ln);
}  // g: of 6 xi (1 - xi)
double sliding_pressure_squared(double ln) {  // h: of 30 xi^2 (1 - xi)^2
  return 1 - cube(ln) * (10 - 15 * ln + 6 * square(ln));
}

// Sn of B1 Sn^2 + 2 B2 Sn + B3 = 0, B3 <= 0. The positive root exceeds 1 unless the quadratic is positive
// there. Of the two ways to write it each branch takes the one without cancellation or division by a
// vanishing B1.
double sliding_part(double B1, double B2, double B3) {
  if (B1 + 2 * B2 + B3 <= 0) return 1.0;
  const double root = std::sqrt(square(B2) - B1 * B3);
  return B2 > 0 ? -B3 / (B2 + root) : (root - B2) / B1;
}

}  // namespace

void UaTireParameters::validate(std::string_view element) const {
  const auto check = [&](bool ok, std::string_view name, double value, std::string_view rule) {
    require(ok, element, fmt::format("`{}` must be {}", name, rule), value, "correct the tire's data");
  };
  check(radius > 0, "radius", radius, "positive");
  check(radial_stiffness > 0, "radial_stiffness", radial_stiffness, "positive");
  check(radial_damping_ratio >= 0, "radial_damping_ratio", radial_damping_ratio, "zero or positive");
  check(mass >= 0, "mass", mass, "zero or positive");
  check(slip_stiffness > 0, "slip_stiffness", slip_stiffness, "positive");
  check(cornering_stiffness > 0, "cornering_stiffness", cornering_stiffness, "positive");
  check(camber_stiffness >= 0, "camber_stiffness", camber_stiffness, "zero or positive");
  check(rolling_resistance >= 0, "rolling_resistance", rolling_resistance, "zero or positive");
  check(friction_min >= 0, "friction_min", friction_min, "zero or positive");
  check(friction_max >= friction_min, "friction_max", friction_max, "at least `friction_min`");
  check(relaxation_x >= 0, "relaxation_x", relaxation_x, "zero or positive");
  check(relaxation_y >= 0, "relaxation_y", relaxation_y, "zero or positive");
}

double ua_slip_reference_speed(double vx, double v_cir) {
  return std::sqrt(square(std::max(std::abs(vx), std::abs(v_cir))) + square(kUaSlipSpeedFloor));
}

UaSlip ua_slip(double vx, double vy, double v_cir, double gamma) {
  const double vr = ua_slip_reference_speed(vx, v_cir);
  return {(v_cir - vx) / vr, -vy / vr, gamma};
}

double ua_patch_length(const UaTireParameters& tire, double delta) {
  return std::sqrt(8 * tire.radius * std::max(0.0, delta));
}

double ua_normal_force(const UaTireParameters& tire, double delta, double delta_rate) {
  if (delta <= 0) return 0.0;
  const double t = std::min(1.0, delta / kDampingRamp);
  const double step = square(t) * (3 - 2 * t);
  const double damping = 2 * tire.radial_damping_ratio * std::sqrt(tire.mass * tire.radial_stiffness);
  return std::max(0.0, tire.radial_stiffness * delta + damping * delta_rate * step);
}

UaShear ua_shear_smooth(const UaTireParameters& tire, const UaSlip& slip, double patch_length, double Fz) {
  const double l = patch_length;
  const double sin_gamma = std::sin(slip.gamma);

  const double mu = friction(tire, std::hypot(slip.sx, slip.sy + l * sin_gamma / (2 * tire.radius)));
  const double F = mu * Fz;

  const double ax = tire.slip_stiffness * slip.sx;
  const double ay = tire.cornering_stiffness * slip.sy;
  // Camber stress has the shape of the pressure: beyond F the whole patch would slide at once, and the force
  // jump.
  const double ag = std::clamp(tire.camber_stiffness * sin_gamma, -F, F);

  // breakaway: ax^2 + (ay + 3 ag Sn)^2 = (3 F Sn)^2
  const double Sn = sliding_part(9 * (square(F) - square(ag)), -3 * ay * ag, -(square(ax) + square(ay)));
  const double ln = 1 - Sn;

  // u = (ax, ay + 3 ag Sn)/|.|: direction of the stress at breakaway, kept while sliding
  const double stress = std::hypot(ax, ay + 3 * ag * Sn);
  const double ux = stress > 0 ? ax / stress : 0.0;
  const double uy = stress > 0 ? (ay + 3 * ag * Sn) / stress : 0.0;

  const double g = sliding_pressure(ln);
  const double h = sliding_pressure_squared(ln);
  const double ln2 = square(ln);
  const double ln3 = cube(ln);

  UaShear shear;
  shear.friction = mu;
  shear.sliding_part = Sn;
  shear.fx = ax * ln2 + F * ux * g;
  shear.fy = ay * ln2 + ag * (3 * ln2 - 2 * ln3) + F * uy * g;
  // Int l (1/2 - xi) qy
  shear.tz_lateral = l * ln2 * (ay * (0.5 - 2 * ln / 3) + 1.5 * (ag - F * uy) * square(Sn));
  // -Int (slip deflection + camber line) qx
  shear.tz_traction =
      -l * (2.0 / 3 * ax * slip.sy * ln3 + 0.6 * square(F) * ux * uy * h / tire.cornering_stiffness) -
      square(l) * sin_gamma / tire.radius * (ax * (ln3 / 3 - square(ln2) / 4) + 0.1 * F * ux * h);
  return shear;
}

UaShear ua_shear_classic(const UaTireParameters& tire, const UaSlip& slip, double patch_length, double Fz) {
  const double l = patch_length;
  const double sin_gamma = std::sin(slip.gamma);
  const double tan_alpha = -slip.sy;  // (1 - Ss) tan(alpha) under traction

  // slip magnitudes and the stresses a, b, c they would cause on an adhering patch
  const double Ss = std::abs(slip.sx);
  const double Sa = std::abs(slip.sy);
  const double Sg = std::abs(sin_gamma);
  const double Sag = std::abs(tan_alpha - l * sin_gamma / (2 * tire.radius));
  const double Ssag = std::hypot(Ss, Sag);
  const double a = tire.slip_stiffness * Ss;
  const double b = tire.cornering_stiffness * Sa;
  const double c = tire.camber_stiffness * Sg;

  // friction circle
  const double mu = friction(tire, Ssag);
  const double F = mu * Fz;
  const double Fx_slide = Ssag > 0 ? F * Ss / Ssag : 0.0;
  const double Fy_slide = Ssag > 0 ? F * Sag / Ssag : 0.0;

  // the case, as signs: of the camber stress against the slip-angle stress, and of the axes of Fy
  const bool opposed = tan_alpha * sin_gamma >= 0 && Sg > 0;
  const bool camber_rules = opposed && b < c;  // case III
  const double epsilon = opposed ? -1.0 : 1.0;
  const double sign_S = -sign(slip.sx);
  const double sign_gamma = sign(sin_gamma);
  const double sign_alpha =
      camber_rules ? sign_gamma : sign(tan_alpha);  // the same, but defined at alpha = 0

  // B1 Sn^2 + 2 B2 Sn + B3 = 0
  const double B1 = 9 * (square(F) - square(c));
  const double Sn = B1 > 0 ? sliding_part(B1, -3 * epsilon * b * c, -(square(a) + square(b))) : 1.0;
  const double ln = 1 - Sn;
  const double ln2 = square(ln);
  const double ln3 = cube(ln);
  const double g = sliding_pressure(ln);
  const double h = sliding_pressure_squared(ln);

  // F_eta toward -sign(alpha) y (I, II) or +sign(gamma) y (III); slip-angle, camber and sliding friction
  // stress along it
  const double along_b = camber_rules ? -1.0 : 1.0;
  const double along_c = camber_rules ? 1.0 : epsilon;
  const double F_xi = a * ln2 + Fx_slide * g;
  const double F_eta = along_b * b * ln2 + along_c * c * (3 * ln2 - 2 * ln3) + Fy_slide * g;

  const double Tz_alpha =
      l * ln2 * (b * (-0.5 + 2 * ln / 3) + along_b * 1.5 * (Fy_slide - along_c * c) * square(Sn));
  const double Tz_s_alpha =
      l * (2.0 / 3 * a * Sa * ln3 + 0.6 * Fx_slide * Fy_slide / tire.cornering_stiffness * h);
  const double Tz_s_gamma =
      square(l) * Sg / tire.radius * (a * (ln3 / 3 - square(ln2) / 4) + 0.1 * Fx_slide * h);

  UaShear shear;
  shear.friction = mu;
  shear.sliding_part = Sn;
  shear.fx = -sign_S * F_xi;
  shear.fy = camber_rules ? sign_gamma * F_eta : -sign_alpha * F_eta;
  shear.tz_lateral = sign_alpha * Tz_alpha;
  shear.tz_traction = sign_S * (-sign_alpha * Tz_s_alpha + sign_gamma * Tz_s_gamma);
  return shear;
}

}  // namespace wishbone
