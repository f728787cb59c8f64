#include "forces/tire/ua_tire.h"

#include <gmock/gmock.h>

#include <cmath>

#include "forces/support.h"

namespace wishbone {
namespace {

using testing::kDegree;
using testing::message_of;
using testing::Random;
using testing::sample_tire;

const UaTireParameters kTire = sample_tire();
constexpr double kLoad = 3500;
const double kPatch = ua_patch_length(kTire, kLoad / 176400);

using Law = UaShear (*)(const UaTireParameters&, const UaSlip&, const double&, const double&);

// Slips of a wheel at a slip ratio (positive braking, vr = vx; negative traction, vr = v_cir = vx/(1 +
// kappa)) and angles in degrees; no regularisation.
UaSlip slip_of(double kappa, double alpha, double gamma) {
  const double vx_by_vr = kappa < 0 ? 1 + kappa : 1.0;
  return {-kappa, -vx_by_vr * std::tan(alpha * kDegree), gamma * kDegree};
}

struct Row {
  double kappa, alpha, gamma;
  double mu, Sn, Fx, Fy, Tz;
};

// 205/60 R14 at 3500 N, from integration of the stress field and rounded to the digits shown.
const Row kTable[] = {
    {0.02, 0, 0, 0.99600, 0.057372, -566.235, 0, 0},
    {0.05, 0, 0, 0.99000, 0.144300, -1293.961, 0, 0},
    {0.2, 0, 0, 0.96000, 0.595238, -3137.188, 0, 0},
    {1.0, 0, 0, 0.80000, 1, -2800.000, 0, 0},
    {-0.2, 0, 0, 0.96000, 0.595238, 3137.188, 0, 0},
    {0, 1, 0, 0.99651, 0.122780, 0, -1133.413, 31.5822},
    {0, 3, 0, 0.98952, 0.371245, 0, -2602.446, 34.9169},
    {0, 6, 0, 0.97898, 0.752550, 0, -3374.511, 4.2685},
    {0, 9, 0, 0.96832, 1, 0, -3389.131, 0},
    {0.05, 3, 0, 0.98551, 0.399947, -1378.032, -2267.129, 10.9421},
    {-0.05, 3, 0, 0.98589, 0.382491, 1371.492, -2193.398, 23.1628},
    {0.2, 6, 0, 0.95481, 0.976489, -2956.716, -1556.350, -8.3762},
    {0, 0, 3, 0.99620, 0, 0, 423.607, 0},
    {0, -2, 3, 0.98921, 0.281943, 0, 2337.238, -34.6542},
    {0, 3, 3, 0.99332, 0.329657, 0, -2301.774, 42.3138},
    {0.05, 3, 3, 0.98797, 0.358386, -1460.745, -1851.777, 11.2515},
};

void expect_row(const Row& row, const UaShear& shear) {
  SCOPED_TRACE(::testing::Message() << "kappa " << row.kappa << " alpha " << row.alpha << " gamma "
                                    << row.gamma);
  EXPECT_NEAR(shear.friction, row.mu, 0.51e-5);
  EXPECT_NEAR(shear.sliding_part, row.Sn, 0.51e-6);
  EXPECT_NEAR(shear.fx, row.Fx, 0.51e-3);
  EXPECT_NEAR(shear.fy, row.Fy, 0.51e-3);
  EXPECT_NEAR(shear.tz(), row.Tz, 0.51e-4);
}

TEST(UaTireClassic, ReproducesTheReferenceTable) {
  for (const Row& row : kTable) {
    expect_row(row, ua_shear_classic(kTire, slip_of(row.kappa, row.alpha, row.gamma), kPatch, kLoad));
  }
}

TEST(UaTireSmooth, AgreesWithTheTableForPureSlips) {
  for (const Row& row : kTable) {
    const bool pure = row.kappa == 0 || (row.alpha == 0 && row.gamma == 0);
    if (pure)
      expect_row(row, ua_shear_smooth(kTire, slip_of(row.kappa, row.alpha, row.gamma), kPatch, kLoad));
  }
}

TEST(UaTireSmooth, WeighsCombinedSlipByStiffness) {
  // the documented difference from the classic (-1378, -2267) N
  const UaShear shear = ua_shear_smooth(kTire, slip_of(0.05, 3, 0), kPatch, kLoad);
  EXPECT_NEAR(shear.fx, -980, 0.5);
  EXPECT_NEAR(shear.fy, -2520, 0.5);
}

class UaTireForms : public ::testing::TestWithParam<Law> {
 protected:
  UaShear shear(double sx, double sy, double gamma, double Fz = kLoad) const {
    return GetParam()(kTire, {sx, sy, gamma}, kPatch, Fz);
  }
};
INSTANTIATE_TEST_SUITE_P(, UaTireForms,
                         ::testing::Values(&ua_shear_smooth<double>, &ua_shear_classic<double>),
                         [](const auto& form) { return form.index == 0 ? "Smooth" : "Classic"; });

TEST_P(UaTireForms, SlopesAtZeroSlipAreTheStiffnesses) {
  const double s = 1e-8;
  EXPECT_NEAR((shear(s, 0, 0).fx - shear(-s, 0, 0).fx) / (2 * s), 30000, 30000 * 1e-6);
  EXPECT_NEAR((shear(0, s, 0).fy - shear(0, -s, 0).fy) / (2 * s), 73600, 73600 * 1e-6);
  EXPECT_NEAR((shear(0, 0, s).fy - shear(0, 0, -s).fy) / (2 * s), 8094, 8094 * 1e-6);
}

TEST_P(UaTireForms, PureSlipPeaksAtMuFzWhereThePatchBeginsToSlideWhole) {
  // Cs s = 3 mu(s) Fz with mu = U0 - (U0 - U1) s
  const double s = 3 * kLoad / (30000 + 3 * 0.2 * kLoad);
  const UaShear peak = shear(s, 0, 0);
  EXPECT_NEAR(peak.sliding_part, 1, 1e-12);
  EXPECT_NEAR(peak.fx, (1 - 0.2 * s) * kLoad, 1e-9);
  EXPECT_LT(shear(s + 1e-3, 0, 0).fx, peak.fx);
}

TEST_P(UaTireForms, IsOddInAllSlipsAndMirrorSymmetric) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double sx = random.signed_decades(1e-4, 1.5), sy = random.signed_decades(1e-4, 1.5);
    const double gamma = random.uniform(-0.2, 0.2);
    const UaShear f = shear(sx, sy, gamma);
    const UaShear mirrored = shear(sx, -sy, -gamma);
    ASSERT_EQ(mirrored.fx, f.fx);
    ASSERT_EQ(mirrored.fy, -f.fy);
    ASSERT_EQ(mirrored.tz(), -f.tz());
    const UaShear reversed = shear(-sx, sy, gamma);
    ASSERT_EQ(reversed.fx, -f.fx);
    ASSERT_EQ(reversed.fy, f.fy);
    ASSERT_EQ(reversed.tz_lateral, f.tz_lateral);
    ASSERT_EQ(reversed.tz_traction, -f.tz_traction);
  }
}

TEST_P(UaTireForms, ForceStaysWithinTheFrictionCircle) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double Fz = random.uniform(1, 9000);
    const double gamma = GetParam() == &ua_shear_smooth<double> ? random.uniform(-0.4, 0.4) : 0.0;
    const UaShear f = shear(random.signed_decades(1e-4, 3), random.signed_decades(1e-4, 30), gamma, Fz);
    ASSERT_LE(std::hypot(f.fx, f.fy), f.friction * Fz * (1 + 1e-12));
    ASSERT_GE(f.friction, kTire.friction_min);
  }
}

TEST_P(UaTireForms, OpposesSlipAndLeansWithCamber) {
  EXPECT_LT(shear(-0.05, 0, 0).fx, 0);    // braking
  EXPECT_GT(shear(0.05, 0, 0).fx, 0);     // traction
  EXPECT_LT(shear(0, -0.05, 0).fy, 0);    // slipping left
  EXPECT_GT(shear(0, 0, 0.05).fy, 0);     // leaning left
  EXPECT_GT(shear(0, -0.02, 0).tz(), 0);  // slipping left: turns the heading left, into the motion
}

TEST_P(UaTireForms, AligningMomentChangesSignUnderHeavyBraking) {
  EXPECT_GT(shear(0, -std::tan(6 * kDegree), 0).tz(), 0);
  EXPECT_LT(shear(-0.2, -std::tan(6 * kDegree), 0).tz(), 0);
}

TEST_P(UaTireForms, IsDeadWithoutSlipOrWithoutLoad) {
  for (const UaShear& f : {shear(0, 0, 0), shear(0.1, -0.2, 0.1, 0.0)}) {
    EXPECT_EQ(f.fx, 0);
    EXPECT_EQ(f.fy, 0);
    EXPECT_EQ(f.tz(), 0);
  }
}

TEST_P(UaTireForms, ForcesDoNotDependOnTheUnitOfLength) {
  UaTireParameters in_millimetres = kTire;
  in_millimetres.radius *= 1000;
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const UaSlip slip{random.signed_decades(1e-3, 1), random.signed_decades(1e-3, 1),
                      random.uniform(-0.1, 0.1)};
    const UaShear m = GetParam()(kTire, slip, kPatch, kLoad);
    const UaShear mm = GetParam()(in_millimetres, slip, 1000 * kPatch, kLoad);
    ASSERT_NEAR(mm.fx, m.fx, 1e-9);
    ASSERT_NEAR(mm.fy, m.fy, 1e-9);
    ASSERT_NEAR(mm.tz(), 1000 * m.tz(), 1e-6);
  }
}

// The largest jump of (Fx, Fy, Tz) along the straight line between two slips: the interval of largest change
// is halved until only a discontinuity can be left of it.
double largest_jump(Law law, const UaSlip& from, const UaSlip& to, double Fz = kLoad) {
  const auto at = [&](double t) {
    const auto mix = [t](double a, double b) { return a + t * (b - a); };
    const UaShear f =
        law(kTire, {mix(from.sx, to.sx), mix(from.sy, to.sy), mix(from.gamma, to.gamma)}, kPatch, Fz);
    return Vector3(f.fx, f.fy, f.tz());
  };
  double low = 0, high = 0, most = -1;
  constexpr int kIntervals = 400;
  for (int i = 0; i < kIntervals; ++i) {
    const double a = double(i) / kIntervals, b = double(i + 1) / kIntervals;
    const double change = (at(b) - at(a)).norm();
    if (change > most) most = change, low = a, high = b;
  }
  for (int i = 0; i < 45; ++i) {
    const double middle = 0.5 * (low + high);
    const bool left = (at(middle) - at(low)).norm() > (at(high) - at(middle)).norm();
    (left ? high : low) = middle;
  }
  return (at(high) - at(low)).norm();
}

TEST(UaTireSmooth, HasNoJumpAnywhere) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const auto slip = [&] {
      return UaSlip{random.signed_decades(1e-3, 1.2), random.signed_decades(1e-3, 1.2),
                    random.uniform(-0.3, 0.3)};
    };
    ASSERT_LT(largest_jump(ua_shear_smooth<double>, slip(), slip(), random.uniform(50, 6000)), 1e-7);
  }
}

TEST(UaTireSmooth, HasNoJumpWhereAWeaklyLoadedTireLeans) {
  // without holding the camber stress within friction the force would jump here, at C_gamma sin(gamma) = F
  EXPECT_LT(largest_jump(ua_shear_smooth<double>, {0, 0.01, 0.0}, {0, 0.01, 0.3}, 1000), 1e-7);
}

TEST(UaTireClassic, IsContinuousButForTheDocumentedJumps) {
  EXPECT_LT(largest_jump(ua_shear_classic<double>, {0, 0.004, 0.05}, {0, -0.004, 0.05}),
            1e-7);  // I to III, at alpha = 0
  EXPECT_LT(largest_jump(ua_shear_classic<double>, {0.1, 0.1, 0}, {-0.1, 0.1, 0}),
            1e-7);  // traction to braking
  EXPECT_LT(largest_jump(ua_shear_classic<double>, {0.1, 0.01, 0}, {0.9, 0.3, 0}),
            1e-7);  // elastic to sliding
  EXPECT_LT(largest_jump(ua_shear_classic<double>, {0, -0.05, 0.02}, {0, -0.5, 0.02}),
            1e-7);  // the same in case II
}

TEST(UaTireClassic, JumpsBetweenCasesTwoAndThreeByTheKnownAmounts) {
  struct Jump {
    double gamma, kappa, Fy_iii, Fy_ii;
  };
  for (const Jump& jump : {Jump{2, 0, 19.80, 6.98}, Jump{2, 0.05, 94.34, 25.50}, Jump{4, 0, 69.56, 25.82},
                           Jump{4, 0.05, 188.98, 53.15}}) {
    const double gamma = jump.gamma * kDegree;
    const double boundary =
        kTire.camber_stiffness * std::sin(gamma) / kTire.cornering_stiffness;  // tan(alpha)
    const double e = 1e-12;
    const auto Fy = [&](Law law, double tan_alpha) {
      return law(kTire, {-jump.kappa, -tan_alpha, gamma}, kPatch, kLoad).fy;
    };
    EXPECT_NEAR(Fy(ua_shear_classic<double>, boundary - e), jump.Fy_iii, 0.0051);
    EXPECT_NEAR(Fy(ua_shear_classic<double>, boundary + e), jump.Fy_ii, 0.0051);
    EXPECT_NEAR(Fy(ua_shear_smooth<double>, boundary - e), Fy(ua_shear_smooth<double>, boundary + e), 1e-6);
  }
}

TEST(UaTireClassic, MomentOfALeaningBrakedWheelJumpsWithTheSignOfTheSlipAngle) {
  const auto tz = [](Law law, double sy) { return law(kTire, {-0.05, sy, 4 * kDegree}, kPatch, kLoad).tz(); };
  EXPECT_GT(std::abs(tz(ua_shear_classic<double>, 1e-12) - tz(ua_shear_classic<double>, -1e-12)), 0.1);
  EXPECT_NEAR(tz(ua_shear_smooth<double>, 1e-12), tz(ua_shear_smooth<double>, -1e-12), 1e-6);
}

TEST(UaSlip, BrakingAndTractionMeetContinuously) {
  for (const double v : {33.3, -33.3, 0.0}) {
    const UaSlip braking = ua_slip(v + 1e-12, 1.0, v, 0.0);
    const UaSlip traction = ua_slip(v - 1e-12, 1.0, v, 0.0);
    EXPECT_NEAR(braking.sx, traction.sx, 1e-10);
    EXPECT_NEAR(braking.sy, traction.sy, 1e-10);
  }
}

TEST(UaSlip, KeepsItsSignsRollingBackward) {
  EXPECT_LT(ua_slip(20.0, 0.0, 18.0, 0.0).sx, 0);    // braking forward: pushed back
  EXPECT_GT(ua_slip(-20.0, 0.0, -18.0, 0.0).sx, 0);  // braking backward: pushed forward
  EXPECT_LT(ua_slip(-20.0, 1.0, -20.0, 0.0).sy, 0);  // slipping left: pushed right either way
}

TEST(UaSlip, IsFiniteAtStandstill) {
  const UaSlip slip = ua_slip(0.0, 0.0, 0.0, 0.0);
  EXPECT_EQ(slip.sx, 0);
  EXPECT_EQ(slip.sy, 0);
  EXPECT_NEAR(ua_slip(0, 0.05, 0, 0).sy, -0.5, 1e-15);
}

TEST(UaSlip, RegularisationIsInvisibleAtTravelSpeed) {
  // sqrt(1 + (v_eps/v)^2) - 1 = v_eps^2/(2 v^2)
  EXPECT_NEAR(ua_slip(20.0, 1.0, 20.0, 0.0).sy * 20, -1, 1.3e-5);
}

TEST(UaNormalForce, IsElasticWithDampingThatFadesIn) {
  UaTireParameters t = kTire;
  t.radial_stiffness = 1e5;
  t.mass = 10;
  t.radial_damping_ratio = 0.05;  // 2 zeta sqrt(m C) = 100 N s/m
  EXPECT_DOUBLE_EQ(ua_normal_force(t, 0.01, 0), 1000);
  EXPECT_DOUBLE_EQ(ua_normal_force(t, 0.01, 0.5), 1050);
  EXPECT_DOUBLE_EQ(ua_normal_force(t, 0.001, 0.5), 125);  // half way up the ramp of 2 mm
  EXPECT_EQ(ua_normal_force(t, 0, 0.5), 0);
  EXPECT_EQ(ua_normal_force(t, -0.01, 0.5), 0);
  EXPECT_NEAR(ua_normal_force(t, 1e-9, 10.0), 0, 2e-4);  // no blow at touch-down
}

TEST(UaNormalForce, NeverPulls) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_GE(ua_normal_force(kTire, random.uniform(-0.01, 0.03), random.uniform(-500, 500)), 0);
  }
  EXPECT_EQ(ua_normal_force(kTire, 0.01, -500), 0);
}

TEST(UaTireParameters, NamesTheOffendingParameter) {
  UaTireParameters t = kTire;
  t.friction_min = 1.5;
  const std::string message = message_of<InputError>([&] { t.validate("front left tire"); });
  EXPECT_THAT(message,
              ::testing::HasSubstr("front left tire: error: `friction_max` must be at least `friction_min`"));
}

}  // namespace
}  // namespace wishbone
