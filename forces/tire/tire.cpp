#include "forces/tire/tire.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dual.h"
#include "core/require.h"

namespace wishbone {

namespace {

constexpr double kTrailSpin = 1.0;      // Omega_0 [rad/s]: the patch has a leading edge above it
constexpr double kLeastUpright = 1e-3;  // cos(camber) below which the wheel counts as lying flat

// u' = -w - vr s - |w| (|s| - 1)+ sign(s), s = u/sigma, w the slip velocity. Up to slip 1 the deflection
// tends to the kinematic slip -w/vr; the last term bounds it by 2 sigma however small vr is.
template <class T>
T lag_rate(const T& deflection, double sigma, const T& slip_velocity, const T& vr) {
  using std::abs;
  const T s = deflection / sigma;
  const T excess = abs(s) > 1 ? T(s - (s > 0 ? 1.0 : -1.0)) : T(0);
  return -slip_velocity - vr * s - abs(slip_velocity) * excess;
}

}  // namespace

Tire::Tire(std::string name, MarkerIndex wheel, UaTireParameters parameters, Road road, UaForm form, bool lag)
    : name_(std::move(name)),
      wheel_(wheel),
      parameters_(parameters),
      road_(std::move(road)),
      form_(form),
      lag_(lag) {
  parameters_.validate(name_);
  if (!lag_) return;
  require(parameters_.relaxation_x > 0, name_, "lag needs a positive `relaxation_x`",
          parameters_.relaxation_x, "give the longitudinal relaxation length, or switch `lag` off");
  require(parameters_.relaxation_y > 0, name_, "lag needs a positive `relaxation_y`",
          parameters_.relaxation_y, "give the lateral relaxation length, or switch `lag` off");
}

template <class T>
WheelContactT<T> Tire::checked_contact(const ForceInputT<T>& input) const {
  const WheelContactT<T> contact =
      wheel_contact(input.markers[wheel_], parameters_.radius, road_, input.segment);
  const auto fail = [&](const char* what, double value) {
    throw NumericsError({fmt::format("{} at t = {} s", name_, input.time), what, fmt::format("{:g}", value),
                         "check the initial pose and whether the vehicle rolled over"});
  };
  if (!(contact.upright > kLeastUpright))
    fail("the wheel lies flat on the road: cosine of its camber", value_of(contact.upright));
  if (!(contact.loaded_radius > 0))
    fail("the wheel centre is not above the road: loaded radius [m]", value_of(contact.loaded_radius));
  return contact;
}

template <class T>
UaSlipT<T> Tire::slip(const WheelContactT<T>& c, const ForceInputT<T>& input) const {
  if (!lag_) return ua_slip(c.vx, c.vy, c.v_cir, c.camber);
  return {input.states[0] / parameters_.relaxation_x, input.states[1] / parameters_.relaxation_y, c.camber};
}

template <class T>
Tire::Evaluation<T> Tire::evaluate(const ForceInputT<T>& input) const {
  using std::tanh;
  Evaluation<T> e;
  e.contact = checked_contact(input);
  const WheelContactT<T>& c = e.contact;
  if (c.deflection <= 0) return e;

  e.Fz = ua_normal_force(parameters_, c.deflection, c.deflection_rate);
  const T l = ua_patch_length(parameters_, c.deflection);
  const UaSlipT<T> s = slip(c, input);
  e.shear = form_ == UaForm::kSmooth ? ua_shear_smooth(parameters_, s, l, e.Fz)
                                     : ua_shear_classic(parameters_, s, l, e.Fz);
  // Ty = -Kr Fz tanh(v_cir/v_0)
  e.Ty = -parameters_.rolling_resistance * e.Fz * tanh(c.v_cir / kRollingSpeedFloor);
  e.Tz = tanh(c.spin / kTrailSpin) * e.shear.tz_lateral + e.shear.tz_traction;
  return e;
}

template <class T>
void Tire::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  const MarkerStateT<T>& wheel = input.markers[wheel_];
  const Evaluation<T> e = evaluate(input);
  const WheelContactT<T>& c = e.contact;

  if (lag_) set_lag_rates(c, input, output);
  output.power = T(0);
  if (c.deflection <= 0) return;

  // M_C = M_P + (P - C) x F
  const Vector3T<T> f = e.shear.fx * c.ux + e.shear.fy * c.uy + e.Fz * c.uz;
  const Vector3T<T> t = e.Ty * c.uy + e.Tz * c.uz + (c.P - wheel.p_WM).cross(f);
  output.wrenches[wheel_].f += f;
  output.wrenches[wheel_].t += t;
  output.power = f.dot(wheel.v_WM) + t.dot(wheel.w_WM);
}

template <class T>
void Tire::set_lag_rates(const WheelContactT<T>& c, const ForceInputT<T>& input,
                         ForceOutputT<T>& output) const {
  const double touching = c.deflection > 0 ? 1.0 : 0.0;
  const T vr = ua_slip_reference_speed(c.vx, c.v_cir);
  output.state_rates[0] =
      lag_rate(input.states[0], parameters_.relaxation_x, T(touching * (c.vx - c.v_cir)), vr);
  output.state_rates[1] = lag_rate(input.states[1], parameters_.relaxation_y, T(touching * c.vy), vr);
}

double Tire::energy(const ForceInput& input) const {
  const double delta = std::max(0.0, checked_contact(input).deflection);
  return 0.5 * parameters_.radial_stiffness * delta * delta;
}

TireOutput Tire::output(const ForceInput& input) const {
  const Evaluation<double> e = evaluate(input);
  const WheelContact& c = e.contact;
  TireOutput out;
  out.contact = c.deflection > 0;
  out.P0 = c.P0;
  out.P = c.P;
  out.deflection = c.deflection;
  out.camber = c.camber;
  if (!out.contact) return out;
  out.slip_ratio = -ua_slip(c.vx, c.vy, c.v_cir, c.camber).sx;
  out.slip_angle = std::atan(c.vy / ua_slip_reference_speed(c.vx, 0.0));  // |vx|, regularised at standstill
  out.force = Vector3(e.shear.fx, e.shear.fy, e.Fz);
  out.moment = Vector3(0.0, e.Ty, e.Tz);
  return out;
}

template void Tire::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void Tire::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
