// Rolling resistance against closed forms: a wheel that carries a load and coasts to rest, forward and in reverse, on the level
// and on slopes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "models/ran_scene.h"

namespace wishbone {
namespace {

constexpr double kMass = 331, kCarried = 330;  // the guide along x carries 1 kg of the mass
constexpr double kInertia = 2, kRadius = 0.315, kStiffness = 2e5, kResistance = 3e-3, kGravity = 9.81;
constexpr double kDeflection = kCarried * kGravity / kStiffness;
constexpr double kLoaded = kRadius - kDeflection, kRolling = kRadius - kDeflection / 3;
/// Of v' (m + J/(r r_e)) = -Kr N/r, r the loaded radius and r_e that of rolling.
constexpr double kDeceleration = kResistance * kCarried * kGravity / (kMass * kLoaded + kInertia / kRolling);

std::string wheel(const std::string& form, bool lag, double v, double gx, double duration) {
  const auto number = [](double x) { return std::to_string(x); };
  std::string text = R"(wishbone: 1
parameters: {v: V, R: 0.315 m, d: = 330*9.81/2e5}
gravity: [GX, 0, -9.81]
bodies:
  slide: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, 0, 1]}
  carriage: {mass: 300, inertia: [10, 10, 10], position: [0, 0, 1]}
  wheel: {mass: 30, inertia: [1, 2, 1], position: [0, 0, = R - d]}
joints:
  along: {type: prismatic, bodies: [ground, slide], at: [0, 0, 1], axis: [1, 0, 0], speed: = v}
  up: {type: prismatic, bodies: [slide, carriage], at: [0, 0, 1], axis: [0, 0, 1]}
  hub: {type: revolute, bodies: [carriage, wheel], at: [0, 0, = R - d], axis: [0, 1, 0], speed: = v/(R - d/3)}
tire_models:
  ua: {form: FORM, radius: = R, vertical_stiffness: 200 kN/m, damping_ratio: 0.02, mass: 10 kg, slip_stiffness: 80 kN,
       cornering_stiffness: 73.6 kN/rad, camber_stiffness: 8.094 kN/rad, rolling_resistance: 3 mm, friction_max: 1.0,
       friction_min: 0.8, lag: LAG, relaxation_longitudinal: 0.3 m, relaxation_lateral: 0.5 m}
tires: {tire: {wheel: wheel, model: ua}}
road: {}
analysis: {duration: DURATION, integrator: bdf, rtol: 1e-7, atol: 1e-8}
output: {interval: 0.1}
)";
  const auto put = [&](const std::string& name, const std::string& value) {
    text.replace(text.find(name), name.size(), value);
  };
  put("V,", number(v) + ",");
  put("GX", number(gx));
  put("FORM", form);
  put("LAG", lag ? "true" : "false");
  put("DURATION", number(duration));
  return text;
}

TEST(CoastingWheel, ComesToRestAfterTheWayAndTimeOfAConstantResistance) {
  const double way = 0.25 / (2 * kDeceleration), time = 0.5 / kDeceleration;
  EXPECT_NEAR(way, 1.35, 0.01);
  EXPECT_NEAR(time, 5.4, 0.05);
  for (const char* form : {"smooth", "classic"})
    for (const double v : {0.5, -0.5}) {
      const RanScene run(wheel(form, false, v, 0, 7));
      const MatrixX x = run.read("/joints/along/coordinates"), rate = run.read("/joints/along/speeds");
      const Eigen::Index at_half = std::lround(time / 2 / 0.1);
      EXPECT_NEAR(std::abs(rate(at_half, 0)), 0.5 - kDeceleration * 0.1 * static_cast<double>(at_half), 1e-3);
      EXPECT_NEAR(x(x.rows() - 1, 0) / std::copysign(1.0, v), way, 2e-3) << form << ", " << v;
      EXPECT_LT(std::abs(rate(std::lround((time + 0.1) / 0.1), 0)), 1e-3) << form << ", " << v;
      EXPECT_LT(std::abs(rate(rate.rows() - 1, 0)), 1e-6) << form << ", " << v;
    }
}

TEST(CoastingWheel, IsHeldBackByKrNOverRAtEverySpeed) {
  for (const double v : {0.03, 0.1, 1.0, 10.0, -0.03, -10.0}) {
    const RanScene run(wheel("smooth", false, v, 0, 0.2));  // at first the slip builds up
    const MatrixX rate = run.read("/joints/along/speeds");
    EXPECT_NEAR((rate(1, 0) - rate(2, 0)) / 0.1, std::copysign(kDeceleration, v), 0.005 * kDeceleration) << v;
  }
}

TEST(CoastingWheel, ParkedOnASlopeThatItCanHoldCreepsBelowAMillimetreASecond) {
  // m gx r = f Kr N, N = kCarried g: the wheel turns at v_0 atanh(f)
  const double f = 0.5, gx = f * kResistance * kCarried * kGravity / (kMass * kLoaded);
  const RanScene run(wheel("smooth", false, 0, gx, 2));
  const MatrixX spin = run.read("/joints/hub/speeds");
  EXPECT_NEAR(spin(spin.rows() - 1, 0) * kRolling, kRollingSpeedFloor * std::atanh(f), 2e-5);
}

TEST(CoastingWheel, RollsDownASlopeThatIsTooSteep) {
  const double f = 3, gx = f * kResistance * kCarried * kGravity / (kMass * kLoaded);
  const RanScene run(wheel("smooth", false, 0, gx, 2));
  const MatrixX rate = run.read("/joints/along/speeds");
  EXPECT_NEAR(rate(rate.rows() - 1, 0), (f - 1) * kDeceleration * 2, 0.02 * (f - 1) * kDeceleration * 2);
}

}  // namespace
}  // namespace wishbone
