#pragma once

#include <string_view>

/// The UA tire (University of Arizona) as pure functions of slips and load.
///
/// A massless brush on a rectangular patch of length l under parabolic pressure. Slip deforms the tread
/// linearly from the leading edge, camber deforms it parabolically; from the point at which the shear stress
/// reaches mu times the pressure the tread slides. With xi = 0 ... 1 from the leading to the trailing edge,
/// the stresses per unit of xi are
///     pressure  6 Fz xi (1 - xi),
///     adhering  qx = 2 Cs sx xi,   qy = 2 C_alpha sy xi + 6 C_gamma sin(gamma) xi (1 - xi).
/// All forces act on the wheel, in contact axes: x heading, y left, z along the road normal.
///
/// Sources: G. Gim and P. E. Nikravesh, "An analytical model of pneumatic tyres for vehicle dynamic
/// simulations", Int. J. of Vehicle Design 11(6), 589-618 (1990), part 1, and 12(1), 19-39 (1991), part 2.
/// All coefficients here follow from the stresses above by integration; in the moment of the longitudinal
/// stress (UaShear::tz_traction) they may differ from the papers'.
namespace wishbone {

struct UaTireParameters {
  double radius = 0;                ///< R1, unloaded [m]
  double radial_stiffness = 0;      ///< Cz [N/m]
  double radial_damping_ratio = 0;  ///< zeta, of the tire's mass on its radial stiffness
  double mass = 0;                  ///< mt, the mass that zeta refers to [kg]
  double slip_stiffness = 0;        ///< Cs = dFx/dsx at zero slip [N]
  double cornering_stiffness = 0;   ///< C_alpha = dFy/dsy at zero slip [N/rad]
  double camber_stiffness = 0;      ///< C_gamma = dFy/dgamma at zero slip [N/rad]
  double rolling_resistance = 0;    ///< Kr: the moment is Kr Fz [m]
  double friction_max = 0;          ///< U0, at zero slip
  double friction_min = 0;          ///< U1, at slip one and beyond
  double relaxation_x = 0;          ///< sigma_kappa, read only with lag [m]
  double relaxation_y = 0;          ///< sigma_alpha, read only with lag [m]

  /// @throws InputError naming `element` and the parameter that is out of range
  void validate(std::string_view element) const;
};

/// Which evaluation of the model.
enum class UaForm {
  kSmooth,  ///< one signed formula, continuous everywhere: the default
  kClassic  ///< the published three cases; jumps where slip angle and camber stresses balance
};

/// Signed slips: positive sx drives (Fx > 0), positive sy pushes left (Fy > 0), positive gamma leans left.
template <class T>
struct UaSlipT {
  T sx = T(0);     ///< -S = -(vx - v_cir)/vr
  T sy = T(0);     ///< -vy/vr; -tan(slip angle) under braking
  T gamma = T(0);  ///< camber, top of the wheel toward +y [rad]
};
using UaSlip = UaSlipT<double>;

/// Tangential forces and their moment about the patch centre. The moment comes in two parts because only the
/// first changes sides when the wheel rolls backward (the leading edge is then the rear one).
template <class T>
struct UaShearT {
  T fx = T(0);            ///< [N]
  T fy = T(0);            ///< [N]
  T tz_lateral = T(0);    ///< of the lateral stress times its distance from the patch centre [N m]
  T tz_traction = T(0);   ///< of the longitudinal stress times the lateral offset of the tread line [N m]
  T friction = T(0);      ///< mu at this slip
  T sliding_part = T(0);  ///< Sn = 1 - l_n: part of the patch that slides, 0 ... 1
  T tz() const { return tz_lateral + tz_traction; }  ///< rolling forward [N m]
};
using UaShear = UaShearT<double>;

/// Speed below which slips are regularised [m/s].
inline constexpr double kUaSlipSpeedFloor = 0.1;

/// vr = sqrt(max(|vx|, |v_cir|)^2 + v_eps^2) [m/s]: what slip velocities are divided by. One expression for
/// braking (vx rules) and traction (v_cir rules), positive at standstill. Continuous; its slope has a kink at
/// vx = v_cir.
template <class T>
T ua_slip_reference_speed(const T& vx, const T& v_cir);

/// Kinematic slips of a contact point that moves with (vx, vy) while the tread circulates with v_cir [m/s].
template <class T>
UaSlipT<T> ua_slip(const T& vx, const T& vy, const T& v_cir, const T& gamma);
inline UaSlip ua_slip(double vx, double vy, double v_cir, double gamma) {
  return ua_slip<double>(vx, vy, v_cir, gamma);
}

/// Patch length l = sqrt(8 R1 delta) [m] of a penetration delta [m].
template <class T>
T ua_patch_length(const UaTireParameters& tire, const T& delta);

/// Fz = max(0, Cz delta + 2 zeta sqrt(mt Cz) delta' STEP(delta)) for delta > 0, else 0 [N]. STEP is the cubic
/// 3 t^2 - 2 t^3 from 0 to 1 over the first 2 mm, so that damping fades in from zero at touch-down.
template <class T>
T ua_normal_force(const UaTireParameters& tire, const T& delta, const T& delta_rate);
inline double ua_normal_force(const UaTireParameters& tire, double delta, double delta_rate) {
  return ua_normal_force<double>(tire, delta, delta_rate);
}

/// The continuous form. With ax = Cs sx, ay = C_alpha sy, F = mu Fz and ag = C_gamma sin(gamma) held within
/// +-F, sliding starts at xi = l_n = 1 - Sn where |(ax, ay + 3 ag Sn)| = 3 F Sn and keeps the direction u of
/// the stress there:
///     Fx = ax l_n^2 + F ux g,
///     Fy = ay l_n^2 + ag (3 l_n^2 - 2 l_n^3) + F uy g,   g = 1 - 3 l_n^2 + 2 l_n^3.
/// Mirror symmetric: (sy, gamma) -> -(sy, gamma) keeps Fx and turns Fy and Tz. |(Fx, Fy)| <= mu Fz always.
template <class T>
UaShearT<T> ua_shear_smooth(const UaTireParameters& tire, const UaSlipT<T>& slip, const T& patch_length,
                            const T& Fz);

/// The published form: magnitudes in three cases by the signs of slip angle alpha and camber gamma,
/// recombined by signs.
///     I    alpha gamma < 0 or gamma = 0                 stresses add
///     II   alpha gamma >= 0, C_alpha Sa >= C_gamma Sg   they oppose, slip angle rules
///     III  alpha gamma >= 0, C_alpha Sa <  C_gamma Sg   they oppose, camber rules
/// In the sliding zone mu is split in the ratio of the slips. In case III sliding friction acts along
/// sign(gamma), which complete sliding requires there and which makes Fy and Tz jump between II and III.
/// Under braking or traction Tz also jumps at alpha = 0 of a leaning wheel (I and III), for its sign is that
/// of alpha.
template <class T>
UaShearT<T> ua_shear_classic(const UaTireParameters& tire, const UaSlipT<T>& slip, const T& patch_length,
                             const T& Fz);

}  // namespace wishbone
