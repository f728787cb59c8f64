#pragma once

#include <string>
#include <vector>

#include "forces/force_element.h"
#include "forces/road/road.h"
#include "forces/tire/contact.h"
#include "forces/tire/ua_tire.h"

namespace wishbone {

/// What a tire reports; forces act on the wheel.
struct TireOutput {
  bool contact = false;
  Vector3 P0 = Vector3::Zero();  ///< road point below the wheel centre; its x decides the road segment [m]
  Vector3 P = Vector3::Zero();   ///< contact point, world [m]
  double deflection = 0;         ///< delta [m]; negative in the air
  double camber = 0;             ///< gamma [rad], positive when the top leans to the left (+uy)
  double slip_ratio = 0;         ///< kinematic S = (vx - v_cir)/vr, positive when braking; 0 in the air
  double slip_angle = 0;  ///< kinematic alpha = atan(vy/|vx|) [rad], positive to the left; 0 in the air
  Vector3 force = Vector3::Zero();   ///< (Fx, Fy, Fz) in the contact axes ux, uy, uz, at P [N]
  Vector3 moment = Vector3::Zero();  ///< (0, Ty, Tz) about P in the contact axes [N m]
};

/// Speed of rolling below which rolling resistance fades out, so that it has no jump at rest [m/s].
inline constexpr double kRollingSpeedFloor = 1e-3;

/// A tire on a road: the UA tire law at the one-point contact, as a force element of one marker.
///
///     F = Fx ux + Fy uy + Fz uz at P,   M_P = Ty uy + Tz uz,
///     Ty = -Kr Fz tanh(v_cir/v_0),   v_0 = kRollingSpeedFloor = 1 mm/s,
/// given to the wheel at its centre C as (M_P + (P - C) x F, F). Nothing acts in the air (delta <= 0).
/// Rolling resistance opposes the rolling, forward and in reverse, with its full moment from some mm/s on: a wheel that coasts
/// is held back by Kr Fz/rho. Below v_0 it is viscous: a wheel at rest creeps where a slope or a torque pulls with a
/// fraction f < 1 of Kr Fz, at v_0 atanh(f); a locked wheel, which slides, has none.
/// The lateral stress's part of Tz carries the factor tanh(Omega/Omega_0), Omega_0 = 1 rad/s: rolling backward exchanges
/// the leading and the trailing edge, and with them the side of the pneumatic trail; a wheel at rest has neither.
///
/// With `lag` the element has two states, the longitudinal and lateral deflections u and v [m] of the carcass
/// at the contact,
///     u' = -(vx - v_cir) - vr u/sigma_kappa,   sx = u/sigma_kappa,
///     v' = -vy           - vr v/sigma_alpha,   sy = v/sigma_alpha,
/// and the shear follows these slips. They tend to the kinematic slips over the travelled lengths sigma; at
/// standstill vr = v_eps > 0 leaves a spring of rate Cs/sigma that creeps slowly, and nothing divides by a
/// speed. Beyond slip 1 the tread slides, and a deflection relaxes with the sliding as well (see lag_rate),
/// lest it wind up in a standing wheel that is pushed sideways. In the air both relax to zero.
///
/// Energy: Cz delta^2/2 in contact. The element's discrete state is its road segment (ForceInput::segment).
/// @throws NumericsError from apply, energy and output naming the tire, the time and the value when the wheel
///   lies flat on the road or its centre is not above it.
class Tire {
 public:
  /// @param wheel marker at the wheel centre, fixed to the wheel, y axis = spin axis, pointing left
  /// @throws InputError naming the tire when a parameter is out of range
  Tire(std::string name, MarkerIndex wheel, UaTireParameters parameters, Road road,
       UaForm form = UaForm::kSmooth, bool lag = false);

  const std::string& name() const { return name_; }
  MarkerIndex wheel() const { return wheel_; }
  const UaTireParameters& parameters() const { return parameters_; }
  const Road& road() const { return road_; }

  // the edges of the road, and where on it the wheel's centre is: its x [m]
  bool has_segments() const { return road_.segment_count() > 1; }
  double position(const ForceInput& input) const { return input.markers[wheel_].p_WM.x(); }
  int segment_at(double x) const { return road_.segment_at(x); }
  Edges edges(int segment) const { return {road_.lower_edge(segment), road_.upper_edge(segment)}; }

  std::vector<MarkerIndex> markers() const { return {wheel_}; }
  int state_count() const { return lag_ ? 2 : 0; }
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput& input) const;
  TireOutput output(const ForceInput& input) const;

 private:
  // Everything one evaluation needs of the contact: forces and moments in contact axes, about P.
  template <class T>
  struct Evaluation {
    WheelContactT<T> contact;
    T Fz = T(0);
    UaShearT<T> shear;
    T Ty = T(0);
    T Tz = T(0);
  };
  template <class T>
  WheelContactT<T> checked_contact(const ForceInputT<T>& input) const;
  template <class T>
  UaSlipT<T> slip(const WheelContactT<T>& contact, const ForceInputT<T>& input) const;
  template <class T>
  Evaluation<T> evaluate(const ForceInputT<T>& input) const;
  template <class T>
  void set_lag_rates(const WheelContactT<T>& contact, const ForceInputT<T>& input,
                     ForceOutputT<T>& output) const;

  std::string name_;
  MarkerIndex wheel_;
  UaTireParameters parameters_;
  Road road_;
  UaForm form_;
  bool lag_;
};

}  // namespace wishbone
