#include "forces/tire/tire.h"

#include <gmock/gmock.h>

#include <cmath>

#include "forces/support.h"

namespace wishbone {
namespace {

using testing::Applied;
using testing::applied;
using testing::kDegree;
using testing::message_of;
using testing::Random;
using testing::rotation;
using testing::sample_tire;

const Road kSineOnBank(6 * kDegree, {{7.2, 12.0, 0.03}});

// A wheel on the level road, heading along x: 20 mm deflection, upright, the carrier moving with (vx, vy, 0).
MarkerState wheel(double vx, double vy, double spin, double deflection = 0.02) {
  MarkerState w;
  w.p_WM.z() = 0.3008 - deflection;
  w.v_WM = Vector3(vx, vy, 0);
  w.w_WM = Vector3(0, spin, 0);
  return w;
}

double effective_radius(double deflection = 0.02) {
  return 0.3008 - deflection / 3;
}

MarkerState random_wheel(Random& random) {
  MarkerState w;
  const double x = random.uniform(8, 19), y = random.uniform(-2, 2);
  w.p_WM = Vector3(x, y, kSineOnBank.at(x, y, 1).height + random.uniform(0.27, 0.299));
  w.R_WM = rotation(Vector3::UnitZ(), random.uniform(-0.3, 0.3)) *
           rotation(Vector3::UnitX(), random.uniform(0, 10) * kDegree) *
           rotation(Vector3::UnitY(), random.uniform(-3, 3));
  w.v_WM = Vector3(random.uniform(5, 30), random.uniform(-2, 2), random.uniform(-0.2, 0.2));
  w.w_WM = random.vector(1) + random.uniform(0.8, 1.2) * w.v_WM.x() / 0.29 * w.R_WM.col(1);
  return w;
}

TireOutput output(const Tire& tire, const MarkerState& w, const std::vector<double>& states = {},
                  int segment = 0) {
  const std::vector<MarkerState> markers{w};
  return tire.output({0.0, markers, states, segment});
}

double energy(const Tire& tire, const MarkerState& w) {
  const std::vector<MarkerState> markers{w};
  return tire.energy({0.0, markers, {}, 0});
}

TEST(Tire, WrenchAtTheCentreEqualsTheContactForcesAtTheContactPoint) {
  const Tire tire("tire", 0, sample_tire(), kSineOnBank);
  Random random(30);
  for (int i = 0; i < 200; ++i) {
    const MarkerState w = random_wheel(random);
    const Wrench at_C = applied(tire, {w}, {}, 1).wrenches[0];
    const TireOutput out = output(tire, w, {}, 1);
    ASSERT_TRUE(out.contact);
    const WheelContact c = wheel_contact(w, 0.3008, kSineOnBank, 1);
    Matrix3 R_WC;  // contact axes
    R_WC << c.ux, c.uy, c.uz;
    const Vector6 at_P = shift_wrench(spatial(at_C.t, at_C.f), w.p_WM - out.P);
    EXPECT_LT((R_WC.transpose() * linear(at_P) - out.force).norm(), 1e-10);
    EXPECT_LT((R_WC.transpose() * angular(at_P) - out.moment).norm(), 1e-10);
    EXPECT_EQ(out.moment.x(), 0);
  }
}

TEST(Tire, BrakingPushesBackTractionForward) {
  const Tire tire("tire", 0, sample_tire(), Road());
  const double free_rolling = 20 / effective_radius();
  const Applied braking = applied(tire, {wheel(20, 0, 0.95 * free_rolling)});
  const Applied traction = applied(tire, {wheel(20, 0, 1.05 * free_rolling)});
  EXPECT_LT(braking.wrenches[0].f.x(), -1000);
  EXPECT_GT(braking.wrenches[0].t.y(), 0);  // the road spins the wheel up
  EXPECT_GT(traction.wrenches[0].f.x(), 1000);
  EXPECT_LT(traction.wrenches[0].t.y(), 0);
  EXPECT_NEAR(output(tire, wheel(20, 0, 0.95 * free_rolling)).slip_ratio, 0.05, 1e-5);
}

TEST(Tire, FreeRollingLeavesOnlyLoadAndRollingResistance) {
  const Tire tire("tire", 0, sample_tire(), Road());
  const Wrench at_C = applied(tire, {wheel(20, 0, 20 / effective_radius())}).wrenches[0];
  const double Fz = 176400 * 0.02;
  EXPECT_LT((at_C.f - Vector3(0, 0, Fz)).norm(), 1e-9);
  EXPECT_LT((at_C.t - Vector3(0, -0.001 * Fz, 0)).norm(), 1e-9);
}

TEST(Tire, SlippingLeftIsPushedRightAndTurnedIntoTheMotion) {
  const Tire tire("tire", 0, sample_tire(), Road());
  const MarkerState w = wheel(20, 0.5, 20 / effective_radius());
  const Wrench at_C = applied(tire, {w}).wrenches[0];
  EXPECT_LT(at_C.f.y(), -1000);
  EXPECT_GT(at_C.t.z(), 10);
  EXPECT_NEAR(output(tire, w).slip_angle, std::atan(0.5 / 20), 1e-6);
}

TEST(Tire, CamberThrustIsTowardTheLean) {
  const Tire tire("tire", 0, sample_tire(), Road());
  for (const double lean : {4 * kDegree, -4 * kDegree}) {
    MarkerState w = wheel(20, 0, 20 / effective_radius());
    w.R_WM = rotation(Vector3::UnitX(), -lean);  // positive: top of the wheel toward +y
    EXPECT_NEAR(output(tire, w).camber, lean, 1e-15);
    EXPECT_GT(applied(tire, {w}).wrenches[0].f.y() * lean, 0);
  }
}

TEST(Tire, RollingResistanceOpposesTheSpin) {
  const Tire tire("tire", 0, sample_tire(), Road());
  const double spin = 20 / effective_radius();
  EXPECT_LT(output(tire, wheel(20, 0, spin)).moment.y(), 0);
  EXPECT_GT(output(tire, wheel(-20, 0, -spin)).moment.y(), 0);
  EXPECT_EQ(output(tire, wheel(0, 0, 0)).moment.y(), 0);
}

TEST(Tire, FollowsTheLawAtItsSlips) {
  // one state, four ways through the element: both forms, without lag and with lag states set to the
  // kinematic slips
  const UaTireParameters p = sample_tire();
  const MarkerState w = wheel(20, 0.7, 0.97 * 20 / effective_radius());
  const UaSlip slip = ua_slip(20, 0.7, 0.97 * 20, 0);
  const std::vector<double> states{slip.sx * p.relaxation_x, slip.sy * p.relaxation_y};
  for (const UaForm form : {UaForm::kSmooth, UaForm::kClassic}) {
    const auto law = form == UaForm::kSmooth ? ua_shear_smooth<double> : ua_shear_classic<double>;
    const UaShear shear = law(p, slip, std::sqrt(8 * 0.3008 * 0.02), 176400 * 0.02);
    for (const TireOutput& out : {output(Tire("tire", 0, p, Road(), form), w),
                                  output(Tire("tire", 0, p, Road(), form, true), w, states)}) {
      EXPECT_NEAR(out.force.x(), shear.fx, 1e-8);
      EXPECT_NEAR(out.force.y(), shear.fy, 1e-8);
      EXPECT_NEAR(out.moment.z(), shear.tz(), 1e-8);
    }
  }
}

TEST(Tire, HasNeitherFrontNorRear) {
  // The same wheel described by a marker turned half a turn about the vertical: it now rolls backward, leans
  // the other way, and must feel the same forces.
  Random random(31);
  for (const UaForm form : {UaForm::kSmooth, UaForm::kClassic}) {
    const Tire tire("tire", 0, sample_tire(), kSineOnBank, form);
    for (int i = 0; i < 200; ++i) {
      MarkerState w = random_wheel(random);
      const Wrench forward = applied(tire, {w}, {}, 1).wrenches[0];
      w.R_WM.col(0) *= -1;
      w.R_WM.col(1) *= -1;
      const Wrench backward = applied(tire, {w}, {}, 1).wrenches[0];
      EXPECT_LT((forward.f - backward.f).norm(), 1e-9);
      EXPECT_LT((forward.t - backward.t).norm(), 1e-9);
    }
  }
}

TEST(Tire, LeftAndRightAreMirrorImages) {
  const Matrix3 mirror = Vector3(1, -1, 1).asDiagonal();
  const Tire tire("tire", 0, sample_tire(), Road(0, {{7.2, 12.0, 0.03}}));
  Random random(32);
  for (int i = 0; i < 200; ++i) {
    MarkerState w = random_wheel(random);
    w.p_WM.z() = tire.road().at(w.p_WM.x(), 0, 1).height + 0.29;
    MarkerState m = w;
    m.p_WM = mirror * w.p_WM;
    m.v_WM = mirror * w.v_WM;
    m.w_WM = -(mirror * w.w_WM);  // axial
    m.R_WM = mirror * w.R_WM * mirror;
    const Wrench a = applied(tire, {w}, {}, 1).wrenches[0];
    const Wrench b = applied(tire, {m}, {}, 1).wrenches[0];
    EXPECT_LT((mirror * a.f - b.f).norm(), 1e-9);
    EXPECT_LT((-(mirror * a.t) - b.t).norm(), 1e-9);
  }
}

TEST(Tire, AddsItsWrenchAndGivesNothingInTheAir) {
  const Tire tire("tire", 1, sample_tire(), Road());
  std::vector<MarkerState> markers{MarkerState{}, wheel(20, 1, 50, -1e-6)};
  std::vector<Wrench> wrenches(2);
  wrenches[1].f = Vector3(1, 2, 3);
  ForceOutput out{wrenches, {}, 99.0};
  tire.apply({0.0, markers, {}, 0}, out);
  EXPECT_EQ(wrenches[1].f, Vector3(1, 2, 3));
  EXPECT_EQ(wrenches[1].t, Vector3::Zero());
  EXPECT_EQ(out.power, 0.0);
  EXPECT_FALSE(tire.output({0.0, markers, {}, 0}).contact);

  markers[1] = wheel(20, 0, 20 / effective_radius());
  tire.apply({0.0, markers, {}, 0}, out);
  EXPECT_NEAR(wrenches[1].f.z(), 3 + 3528, 1e-9);
  EXPECT_EQ(wrenches[0].f, Vector3::Zero());
}

TEST(Tire, TouchesDownWithoutABlow) {
  const Tire tire("tire", 0, sample_tire(), Road());
  MarkerState w = wheel(20, 1, 50, 1e-9);
  w.v_WM.z() = -3;
  EXPECT_LT(applied(tire, {w}).wrenches[0].f.norm(), 1e-3);
}

TEST(Tire, EnergyIsTheElasticWorkOfTheLoad) {
  UaTireParameters p = sample_tire();
  p.radial_damping_ratio = 0;
  const Tire tire("tire", 0, p, Road());
  MarkerState w = wheel(0, 0, 0);
  w.v_WM.z() = -0.3;
  const auto energy_at = [&](double t) { return energy(tire, wheel(0, 0, 0, 0.02 + 0.3 * t)); };
  EXPECT_NEAR(applied(tire, {w}).power, -(energy_at(1e-4) - energy_at(-1e-4)) / 2e-4, 1e-7);
  EXPECT_EQ(energy(tire, wheel(0, 0, 0, -0.01)), 0);
}

TEST(Tire, PowerIsThatOfTheContactForceAndTheSpin) {
  const Tire tire("tire", 0, sample_tire(), Road());
  const MarkerState w = wheel(20, 0.5, 60);
  const TireOutput out = output(tire, w);
  // at the contact point the carrier moves with (vx, vy, 0); the spin sees Fx at the loaded radius, and Ty
  const double expected =
      out.force.x() * 20 + out.force.y() * 0.5 + (out.moment.y() - 0.2808 * out.force.x()) * 60;
  EXPECT_NEAR(applied(tire, {w}).power, expected, 1e-9);
}

TEST(Tire, UsesTheGivenSegmentWhateverItsPosition) {
  const Tire tire("tire", 0, sample_tire(), Road(0, {{0.0, 12.0, 0.03}}));
  MarkerState w = wheel(20, 0, 70);
  w.p_WM.x() = -0.5;  // on the flat; segment 1 continues as a bump here
  EXPECT_GT(output(tire, w, {}, 1).deflection, output(tire, w, {}, 0).deflection + 1e-3);
}

// Lag
// -----------------------------------------------------------------------------------------------------------------

std::vector<double> travel(const Tire& tire, const MarkerState& w, std::vector<double> states,
                           double duration) {
  constexpr int kSteps = 4000;
  const double h = duration / kSteps;
  const auto rates = [&](const std::vector<double>& s) { return applied(tire, {w}, s).rates; };
  const auto moved = [](const std::vector<double>& s, double t, const std::vector<double>& r) {
    return std::vector<double>{s[0] + t * r[0], s[1] + t * r[1]};
  };
  for (int i = 0; i < kSteps; ++i) {  // midpoint rule
    states = moved(states, h, rates(moved(states, h / 2, rates(states))));
  }
  return states;
}

TEST(TireLag, SlipsApproachTheKinematicOnesOverTheRelaxationLengths) {
  const UaTireParameters p = sample_tire();
  const Tire tire("tire", 0, p, Road(), UaForm::kSmooth, true);
  ASSERT_EQ(tire.state_count(), 2);
  const MarkerState w = wheel(10, 0.3, 0.95 * 10 / effective_radius());  // braking: vr = vx
  const UaSlip steady = ua_slip(10, 0.3, 9.5, 0);
  for (const double distance : {0.1, 0.3, 0.5, 5.0}) {
    const std::vector<double> states = travel(tire, w, {0, 0}, distance / 10);
    EXPECT_NEAR(states[0] / 0.3, steady.sx * (1 - std::exp(-distance / 0.3)), 1e-5);
    EXPECT_NEAR(states[1] / 0.5, steady.sy * (1 - std::exp(-distance / 0.5)), 1e-5);
  }
}

TEST(TireLag, StandingWheelIsASpringAgainstItsDisplacement) {
  const Tire tire("tire", 0, sample_tire(), Road(), UaForm::kSmooth, true);
  const std::vector<double> still = travel(tire, wheel(0, 0, 0), {0, 0}, 1.0);
  EXPECT_EQ(still[0], 0);
  EXPECT_EQ(still[1], 0);
  // pushed 1 mm to the left within 1 ms: v = -1 mm, and a force C_alpha/sigma times it less the onset of
  // sliding
  const std::vector<double> pushed = travel(tire, wheel(0, 1.0, 0), {0, 0}, 1e-3);
  EXPECT_NEAR(pushed[1], -1e-3, 1e-6);
  EXPECT_NEAR(output(tire, wheel(0, 0, 0), pushed).force.y(), -73600 / 0.5 * 1e-3, 3);
}

TEST(TireLag, DeflectionOfAStandingWheelPushedSidewaysDoesNotWindUp) {
  const Tire tire("tire", 0, sample_tire(), Road(), UaForm::kSmooth, true);
  std::vector<double> states = travel(tire, wheel(0, 5.0, 0), {0, 0}, 10);
  EXPECT_LT(std::abs(states[1]), 2 * 0.5);
  EXPECT_LT(output(tire, wheel(0, 5, 0), states).force.y(), -2800);
  states = travel(tire, wheel(0, -5.0, 0), states, 2 * 0.5 / 5.0);  // back by twice the relaxation length
  EXPECT_GT(output(tire, wheel(0, -5, 0), states).force.y(), 2500);
}

TEST(TireLag, RelaxesInTheAir) {
  const Tire tire("tire", 0, sample_tire(), Road(), UaForm::kSmooth, true);
  const MarkerState w = wheel(20, 3, 40, -0.05);
  const std::vector<double> states = travel(tire, w, {0.1, -0.2}, 0.5 / 20);
  EXPECT_NEAR(states[0], 0.1 * std::exp(-0.5 / 0.3), 1e-5);
  EXPECT_NEAR(states[1], -0.2 * std::exp(-1), 1e-5);
  EXPECT_EQ(applied(tire, {w}, states).wrenches[0].f, Vector3::Zero());
}

// Errors
// --------------------------------------------------------------------------------------------------------------

TEST(Tire, TellsWhenTheWheelLiesFlatOrUnderTheRoad) {
  using ::testing::HasSubstr;
  const Tire tire("left tire", 0, sample_tire(), Road());
  MarkerState flat = wheel(0, 0, 0);
  flat.R_WM = rotation(Vector3::UnitX(), 90 * kDegree);
  EXPECT_THAT(message_of<NumericsError>([&] { applied(tire, {flat}); }),
              HasSubstr("left tire at t = 0 s: error: the wheel lies flat"));
  const MarkerState sunk = wheel(0, 0, 0, 0.4);
  EXPECT_THAT(message_of<NumericsError>([&] { applied(tire, {sunk}); }),
              HasSubstr("centre is not above the road"));
}

TEST(Tire, LagNeedsRelaxationLengths) {
  UaTireParameters p = sample_tire();
  p.relaxation_y = 0;
  EXPECT_NO_THROW(Tire("tire", 0, p, Road()));
  EXPECT_THAT(message_of<InputError>([&] { Tire("tire", 0, p, Road(), UaForm::kSmooth, true); }),
              ::testing::HasSubstr("relaxation_y"));
}

}  // namespace
}  // namespace wishbone
