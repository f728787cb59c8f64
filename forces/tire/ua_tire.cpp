#include "forces/tire/ua_tire.h"

#include <fmt/format.h>

#include <cmath>

#include "core/dual.h"
#include "core/require.h"

namespace wishbone {

namespace {

constexpr double kDampingRamp = 0.002;  // delta_0 [m]

template <class T>
T clamped(const T& x, const T& limit) {
  return x > limit ? limit : (x < -limit ? T(-limit) : x);
}
template <class T>
T square(const T& x) {
  return x * x;
}
template <class T>
T cube(const T& x) {
  return x * x * x;
}
template <class T>
double sign(const T& x) {
  return x > 0 ? 1.0 : (x < 0 ? -1.0 : 0.0);
}

// U0 at zero slip, falling linearly to U1 at slip one
template <class T>
T friction(const UaTireParameters& tire, const T& comprehensive_slip) {
  return tire.friction_max - (tire.friction_max - tire.friction_min) * at_most(comprehensive_slip, 1.0);
}

// Integrals over the sliding zone xi = l_n ... 1
template <class T>
T sliding_pressure(const T& ln) {
  return 1.0 - 3.0 * square(ln) + 2.0 * cube(ln);
}  // g: of 6 xi (1 - xi)
template <class T>
T sliding_pressure_squared(const T& ln) {  // h: of 30 xi^2 (1 - xi)^2
  return 1.0 - cube(ln) * (10.0 - 15.0 * ln + 6.0 * square(ln));
}

// Sn of B1 Sn^2 + 2 B2 Sn + B3 = 0, B3 <= 0. The positive root exceeds 1 unless the quadratic is positive
// there. Of the two ways to write it each branch takes the one without cancellation or division by a
// vanishing B1.
template <class T>
T sliding_part(const T& B1, const T& B2, const T& B3) {
  using std::sqrt;
  if (B1 + 2.0 * B2 + B3 <= 0) return T(1);
  const T root = sqrt(square(B2) - B1 * B3);
  return B2 > 0 ? T(-B3 / (B2 + root)) : T((root - B2) / B1);
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

template <class T>
T ua_slip_reference_speed(const T& vx, const T& v_cir) {
  using std::abs;
  using std::sqrt;
  const T v = abs(vx) < abs(v_cir) ? v_cir : vx;
  return sqrt(v * v + square(kUaSlipSpeedFloor));
}

template <class T>
UaSlipT<T> ua_slip(const T& vx, const T& vy, const T& v_cir, const T& gamma) {
  const T vr = ua_slip_reference_speed(vx, v_cir);
  return {(v_cir - vx) / vr, -vy / vr, gamma};
}

template <class T>
T ua_patch_length(const UaTireParameters& tire, const T& delta) {
  using std::sqrt;
  return sqrt(8 * tire.radius * at_least(delta, 0.0));
}

template <class T>
T ua_normal_force(const UaTireParameters& tire, const T& delta, const T& delta_rate) {
  if (delta <= 0) return T(0);
  const T t = at_most(T(delta / kDampingRamp), 1.0);
  const T step = square(t) * (3.0 - 2.0 * t);
  const double damping = 2 * tire.radial_damping_ratio * std::sqrt(tire.mass * tire.radial_stiffness);
  return at_least(T(tire.radial_stiffness * delta + damping * delta_rate * step), 0.0);
}

template <class T>
UaShearT<T> ua_shear_smooth(const UaTireParameters& tire, const UaSlipT<T>& slip, const T& patch_length,
                            const T& Fz) {
  using std::abs;
  using std::hypot;
  using std::sin;
  const T l = patch_length;
  const T sin_gamma = sin(slip.gamma);

  const T mu = friction(tire, hypot(slip.sx, slip.sy + l * sin_gamma / (2 * tire.radius)));
  const T F = mu * Fz;

  const T ax = tire.slip_stiffness * slip.sx;
  const T ay = tire.cornering_stiffness * slip.sy;
  // Camber stress has the shape of the pressure: beyond F the whole patch would slide at once, and the force
  // jump.
  const T ag = clamped(tire.camber_stiffness * sin_gamma, F);

  // breakaway: ax^2 + (ay + 3 ag Sn)^2 = (3 F Sn)^2
  const T Sn = sliding_part(9 * (square(F) - square(ag)), -3 * ay * ag, -(square(ax) + square(ay)));
  const T ln = 1 - Sn;

  // u = (ax, ay + 3 ag Sn)/|.|: direction of the stress at breakaway, kept while sliding
  const T stress = hypot(ax, ay + 3 * ag * Sn);
  const T ux = stress > 0 ? ax / stress : 0.0;
  const T uy = stress > 0 ? (ay + 3 * ag * Sn) / stress : 0.0;

  const T g = sliding_pressure(ln);
  const T h = sliding_pressure_squared(ln);
  const T ln2 = square(ln);
  const T ln3 = cube(ln);

  UaShearT<T> shear;
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

template <class T>
UaShearT<T> ua_shear_classic(const UaTireParameters& tire, const UaSlipT<T>& slip, const T& patch_length,
                             const T& Fz) {
  using std::abs;
  using std::hypot;
  using std::sin;
  const T l = patch_length;
  const T sin_gamma = sin(slip.gamma);
  const T tan_alpha = -slip.sy;  // (1 - Ss) tan(alpha) under traction

  // slip magnitudes and the stresses a, b, c they would cause on an adhering patch
  const T Ss = abs(slip.sx);
  const T Sa = abs(slip.sy);
  const T Sg = abs(sin_gamma);
  const T Sag = abs(tan_alpha - l * sin_gamma / (2 * tire.radius));
  const T Ssag = hypot(Ss, Sag);
  const T a = tire.slip_stiffness * Ss;
  const T b = tire.cornering_stiffness * Sa;
  const T c = tire.camber_stiffness * Sg;

  // friction circle
  const T mu = friction(tire, Ssag);
  const T F = mu * Fz;
  const T Fx_slide = Ssag > 0 ? F * Ss / Ssag : 0.0;
  const T Fy_slide = Ssag > 0 ? F * Sag / Ssag : 0.0;

  // the case, as signs: of the camber stress against the slip-angle stress, and of the axes of Fy
  const bool opposed = tan_alpha * sin_gamma >= 0 && Sg > 0;
  const bool camber_rules = opposed && b < c;  // case III
  const double epsilon = opposed ? -1.0 : 1.0;
  const double sign_S = -sign(slip.sx);
  const double sign_gamma = sign(sin_gamma);
  const double sign_alpha =
      camber_rules ? sign_gamma : sign(tan_alpha);  // the same, but defined at alpha = 0

  // B1 Sn^2 + 2 B2 Sn + B3 = 0
  const T B1 = 9 * (square(F) - square(c));
  const T Sn = B1 > 0 ? sliding_part(B1, -3 * epsilon * b * c, -(square(a) + square(b))) : T(1);
  const T ln = 1 - Sn;
  const T ln2 = square(ln);
  const T ln3 = cube(ln);
  const T g = sliding_pressure(ln);
  const T h = sliding_pressure_squared(ln);

  // F_eta toward -sign(alpha) y (I, II) or +sign(gamma) y (III); slip-angle, camber and sliding friction
  // stress along it
  const double along_b = camber_rules ? -1.0 : 1.0;
  const double along_c = camber_rules ? 1.0 : epsilon;
  const T F_xi = a * ln2 + Fx_slide * g;
  const T F_eta = along_b * b * ln2 + along_c * c * (3 * ln2 - 2 * ln3) + Fy_slide * g;

  const T Tz_alpha =
      l * ln2 * (b * (-0.5 + 2 * ln / 3) + along_b * 1.5 * (Fy_slide - along_c * c) * square(Sn));
  const T Tz_s_alpha =
      l * (2.0 / 3 * a * Sa * ln3 + 0.6 * Fx_slide * Fy_slide / tire.cornering_stiffness * h);
  const T Tz_s_gamma = square(l) * Sg / tire.radius * (a * (ln3 / 3 - square(ln2) / 4) + 0.1 * Fx_slide * h);

  UaShearT<T> shear;
  shear.friction = mu;
  shear.sliding_part = Sn;
  shear.fx = -sign_S * F_xi;
  shear.fy = camber_rules ? sign_gamma * F_eta : -sign_alpha * F_eta;
  shear.tz_lateral = sign_alpha * Tz_alpha;
  shear.tz_traction = sign_S * (-sign_alpha * Tz_s_alpha + sign_gamma * Tz_s_gamma);
  return shear;
}

template double ua_slip_reference_speed(const double&, const double&);
template Dual ua_slip_reference_speed(const Dual&, const Dual&);
template UaSlipT<double> ua_slip(const double&, const double&, const double&, const double&);
template UaSlipT<Dual> ua_slip(const Dual&, const Dual&, const Dual&, const Dual&);
template double ua_patch_length(const UaTireParameters&, const double&);
template Dual ua_patch_length(const UaTireParameters&, const Dual&);
template double ua_normal_force(const UaTireParameters&, const double&, const double&);
template Dual ua_normal_force(const UaTireParameters&, const Dual&, const Dual&);
template UaShearT<double> ua_shear_smooth(const UaTireParameters&, const UaSlipT<double>&, const double&,
                                          const double&);
template UaShearT<Dual> ua_shear_smooth(const UaTireParameters&, const UaSlipT<Dual>&, const Dual&,
                                        const Dual&);
template UaShearT<double> ua_shear_classic(const UaTireParameters&, const UaSlipT<double>&, const double&,
                                           const double&);
template UaShearT<Dual> ua_shear_classic(const UaTireParameters&, const UaSlipT<Dual>&, const Dual&,
                                         const Dual&);

}  // namespace wishbone
