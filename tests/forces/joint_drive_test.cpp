#include "forces/joint_drive.h"

#include <gmock/gmock.h>

#include <limits>

#include "forces/support.h"

namespace wishbone {
namespace {

using testing::hinge;

Function expression_of(const std::string& text) {
  return Function(Expression(text, {"t", "rate"}));
}

TEST(JointDrive, PositiveTorqueTurnsTheSecondForwardAndTheFirstBack) {
  const JointDrive motor("motor", 0, 1, {Gauge::Kind::rotation}, expression_of("3*t - 2*rate"));
  const std::vector<MarkerState> markers = hinge(0.4, 1);
  const std::vector<double> variables{2, 0.5};
  std::vector<Wrench> wrenches(2);
  ForceOutput output{wrenches, {}};
  const ForceInput input{2, markers, {}, 0, 0, variables};
  motor.apply(input, output);
  EXPECT_NEAR(markers[0].R_WM.col(2).dot(wrenches[1].t), 5, 1e-13);
  EXPECT_LT((wrenches[0].t + wrenches[1].t).norm(), 1e-13);
  EXPECT_DOUBLE_EQ(motor.output(input).force, 5);
  EXPECT_THAT(motor.variables(), ::testing::ElementsAre(0, 1));
}

TEST(JointDrive, ItsPowerIsThatOfItsWrenches) {
  for (const auto kind : {Gauge::Kind::rotation, Gauge::Kind::translation, Gauge::Kind::distance}) {
    const JointDrive drive("drive", 0, 1, {kind, 1}, 7.0);
    for (unsigned seed = 1; seed < 20; ++seed) {
      const std::vector<MarkerState> markers = hinge(1.1, seed);
      const testing::Applied a = testing::applied(drive, markers);
      double power = 0;
      for (std::size_t i = 0; i < 2; ++i)
        power += a.wrenches[i].f.dot(markers[i].v_WM) + a.wrenches[i].t.dot(markers[i].w_WM);
      EXPECT_NEAR(a.power, power, 1e-11);
    }
  }
}

TEST(JointDrive, RejectsWhatIsNoForce) {
  EXPECT_THROW(JointDrive("motor", 0, 1, {}, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(JointDrive("motor", 1, 1, {}, 1.0), InputError);
}

}  // namespace
}  // namespace wishbone
