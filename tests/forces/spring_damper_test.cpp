#include "forces/spring_damper.h"

#include <gmock/gmock.h>

#include "forces/support.h"

namespace wishbone {
namespace {

using testing::Applied;
using testing::applied;
using testing::message_of;
using testing::Random;

std::vector<MarkerState> random_ends(Random& random) {
  std::vector<MarkerState> markers(2);
  for (MarkerState& m : markers) {
    m.p_WM = random.vector(1);
    m.v_WM = random.vector(3);
    m.w_WM = random.vector(5);
  }
  return markers;
}

TEST(SpringDamper, StretchedSpringPullsItsEndsTogether) {
  const SpringDamper spring("spring", 0, 1, 100, 10, 1);
  std::vector<MarkerState> markers(2);
  markers[1].p_WM = Vector3(0, 3, 4);
  markers[1].v_WM = Vector3(7, 0, 5);  // 4 m/s along the line
  const SpringDamperOutput out = spring.output({0.0, markers, {}, 0});
  EXPECT_DOUBLE_EQ(out.length, 5);
  EXPECT_DOUBLE_EQ(out.rate, 4);
  EXPECT_DOUBLE_EQ(out.force, 100 * 4 + 10 * 4);
  EXPECT_LT((applied(spring, markers).wrenches[0].f - Vector3(0, 264, 352)).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(spring.energy({0.0, markers, {}, 0}), 800);
}

TEST(SpringDamper, ActionEqualsReactionWithoutMoments) {
  Random random(40);
  const SpringDamper spring("spring", 0, 1, 47000, 4000, 0.5683);
  for (int i = 0; i < 100; ++i) {
    const Applied a = applied(spring, random_ends(random));
    EXPECT_EQ(a.wrenches[0].f, -a.wrenches[1].f);
    EXPECT_EQ(a.wrenches[0].t, Vector3::Zero());
    EXPECT_EQ(a.wrenches[1].t, Vector3::Zero());
  }
}

TEST(SpringDamper, ElasticForceIsMinusTheGradientOfTheEnergy) {
  Random random(41);
  const SpringDamper spring("spring", 0, 1, 470, 0, 0.6);
  const double h = 1e-5;
  for (int i = 0; i < 50; ++i) {
    const std::vector<MarkerState> markers = random_ends(random);
    const Applied a = applied(spring, markers);
    for (int end : {0, 1}) {
      for (int axis : {0, 1, 2}) {
        const auto energy = [&](double step) {
          std::vector<MarkerState> moved = markers;
          moved[end].p_WM[axis] += step;
          return spring.energy({0.0, moved, {}, 0});
        };
        EXPECT_NEAR(a.wrenches[end].f[axis], -(energy(h) - energy(-h)) / (2 * h), 1e-6);
      }
    }
  }
}

TEST(SpringDamper, PowerIsWhatTheEnergyLosesLessDissipation) {
  Random random(42);
  const double c = 40;
  const SpringDamper spring("spring", 0, 1, 470, c, 0.6);
  const double h = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const std::vector<MarkerState> markers = random_ends(random);
    const auto energy = [&](double t) {
      std::vector<MarkerState> moved = markers;
      for (MarkerState& m : moved) m.p_WM += t * m.v_WM;
      return spring.energy({0.0, moved, {}, 0});
    };
    const Applied a = applied(spring, markers);
    const double rate = spring.output({0.0, markers, {}, 0}).rate;
    EXPECT_NEAR(a.power, -(energy(h) - energy(-h)) / (2 * h) - c * rate * rate, 1e-5);
    EXPECT_NEAR(a.power, a.wrenches[0].f.dot(markers[0].v_WM) + a.wrenches[1].f.dot(markers[1].v_WM), 1e-10);
  }
}

TEST(SpringDamper, NamesItselfWhenItsEndsMeet) {
  const SpringDamper spring("front spring", 0, 1, 1, 1, 1);
  EXPECT_THAT(
      message_of<NumericsError>([&] { applied(spring, std::vector<MarkerState>(2)); }),
      ::testing::StartsWith("front spring at t = 0 s: error: the ends of the spring must not coincide"));
}

TEST(SpringDamper, OfNoFreeLengthPullsByTheOffsetAndTheRateWhereItsEndsMeet) {
  const SpringDamper spring("spring", 0, 1, 50, 4, 0);
  std::vector<MarkerState> markers(2);
  markers[1].v_WM = Vector3(1, 2, -2);
  const Applied at_zero = applied(spring, markers);
  EXPECT_LT((at_zero.wrenches[0].f - 4 * markers[1].v_WM).norm(), 1e-14);
  EXPECT_NEAR(at_zero.power, -4 * 9, 1e-12);  // -c |v|^2
  markers[1].p_WM = 1e-12 * markers[1].v_WM;  // a moment later
  EXPECT_LT((applied(spring, markers).wrenches[0].f - at_zero.wrenches[0].f).norm(), 1e-9);
}

TEST(SpringDamper, RejectsNegativeDataByName) {
  using ::testing::HasSubstr;
  EXPECT_THAT(message_of<InputError>([] { SpringDamper("s1", 0, 1, -1, 0, 0); }),
              HasSubstr("s1: error: the stiffness"));
  EXPECT_THAT(message_of<InputError>([] { SpringDamper("s1", 0, 1, 1, -2, 0); }), HasSubstr("(got -2)"));
  EXPECT_THAT(message_of<InputError>([] { SpringDamper("s1", 3, 3, 1, 0, 0); }),
              HasSubstr("different markers"));
}

}  // namespace
}  // namespace wishbone
