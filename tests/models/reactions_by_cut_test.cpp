// The reaction of a joint is what it holds, on its first-named body about the joint's point there; whether the joint carries a
// body or closes a loop is none of its business.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "models/ran_scene.h"

namespace wishbone {
namespace {

/// An arm that swings about a vertical axis by 3 rad/s^2 carries a block on the joint that is tried.
std::string scene(const std::string& joint, bool first_is_arm, bool cut, const std::string& motions) {
  return R"(wishbone: 1
bodies:
  arm: {mass: 1, inertia: [0.1, 0.2, 0.2], position: [0.5, 0, 0]}
  block: {mass: 2, inertia: [0.03, 0.02, 0.04], position: [1.2, 0.1, -0.3]}
joints:
  axle: {type: revolute, bodies: [ground, arm], at: [0, 0, 0], axis: [0, 0, 1], motion: swing}
  tried: {bodies: )" +
         std::string(first_is_arm ? "[arm, block]" : "[block, arm]") +
         ", at: [1, 0, 0], cut: " + (cut ? "true" : "false") + ", " + joint + R"(}
motions:
  swing: {expression: 0.4*t + 1.5*t^2}
)" + motions +
         R"(analysis: {duration: 0.3 s, rtol: 1e-11, atol: 1e-12}
output: {interval: 0.1 s}
)";
}

struct Tried {
  std::string name, joint, motions;
};

class ReactionByCut : public testing::TestWithParam<Tried> {};

TEST_P(ReactionByCut, IsTheSameInTheTreeAndInTheLoop) {
  for (const bool first_is_arm : {true, false}) {
    const RanScene tree(scene(GetParam().joint, first_is_arm, false, GetParam().motions));
    const RanScene loop(scene(GetParam().joint, first_is_arm, true, GetParam().motions));
    for (const std::string path : {"/joints/tried/force", "/joints/tried/moment"}) {
      const MatrixX wanted = tree.read(path), found = loop.read(path);
      EXPECT_LT((found - wanted).cwiseAbs().maxCoeff(), 1e-6) << path << " first is arm " << first_is_arm;
    }
    if (GetParam().joint.find("motion: drive") == std::string::npos) continue;
    for (const std::string quantity : {"force", "moment", "driving_force"}) {
      const std::string path = "/joints/tried_drive/" + quantity;
      EXPECT_LT((loop.read(path) - tree.read(path)).cwiseAbs().maxCoeff(), 1e-6)
          << path << " first is arm " << first_is_arm;
    }
  }
}

constexpr const char* kDrive = "  drive: {expression: 0.1*t + 0.5*t^2}\n";

INSTANTIATE_TEST_SUITE_P(
    Joints, ReactionByCut,
    testing::Values(
        Tried{"Fixed", "type: fixed", ""}, Tried{"Revolute", "type: revolute, axis: [0, 1, 0.2]", ""},
        Tried{"DrivenRevolute", "type: revolute, axis: [0, 1, 0.2], motion: drive", kDrive},
        Tried{"SprungRevolute", "type: revolute, axis: [0, 1, 0], spring: {stiffness: 9, damping: 1}", ""},
        Tried{"Prismatic", "type: prismatic, axis: [0.3, 0.1, -1]", ""},
        Tried{"DrivenPrismatic", "type: prismatic, axis: [0.3, 0.1, -1], motion: drive", kDrive},
        Tried{"Cylindrical", "type: cylindrical, axis: [0.3, 0.1, -1]", ""},
        Tried{"DrivenCylindrical", "type: cylindrical, axis: [0.3, 0.1, -1], motion: {travel: drive}",
              kDrive},
        Tried{"Screw", "type: screw, axis: [0, 0.1, -1], pitch: 0.02", ""},
        Tried{"Universal", "type: universal, axis: [1, 0, 0], second_axis: [0, 1, 0]", ""},
        Tried{"ConstantVelocity", "type: constant_velocity, axis: [0, 0, 1]", ""},
        Tried{"Spherical", "type: spherical", ""}, Tried{"Planar", "type: planar, axis: [0, 0.6, 0.8]", ""}),
    [](const auto& tried) { return tried.param.name; });

/// A flywheel 0.3 m beside its bearing, driven by 2 N m in three ways.
std::string flywheel(const std::string& axle, const std::string& rest) {
  return R"(wishbone: 1
bodies:
  wheel: {mass: 10, inertia: [0.5, 0.3, 0.3], position: [0.3, 0, 0]}
joints:
  axle: {type: revolute, bodies: [ground, wheel], at: [0, 0, 0], axis: [1, 0, 0])" +
         axle + "}\n" + rest + R"(analysis: {duration: 0.2 s}
output: {interval: 0.1 s}
)";
}

// The motor acts along the coordinate, so that the bearing holds the weight, (0, 0.3 m m g, 0), and nothing about its axis.
TEST(ReactionOfADrivenAxle, IsWithoutTheMotorHoweverItIsDriven) {
  const std::string motion = "motions: {spin: {expression: 2*t^2}}\n";
  const std::string load = "loads: {motor: {joint: axle, moment: 2 N m}}\n";
  for (const auto& text : {flywheel(", motion: spin", motion), flywheel(", motion: spin, cut: true", motion),
                           flywheel("", load), flywheel(", cut: true", load)}) {
    const RanScene run(text);
    const MatrixX force = run.read("/joints/axle/force"), moment = run.read("/joints/axle/moment");
    for (int row = 0; row < force.rows(); ++row) {
      EXPECT_LT((force.row(row) - Eigen::RowVector3d(0, 0, -98.1)).norm(), 1e-6);
      EXPECT_LT((moment.row(row) - Eigen::RowVector3d(0, 0.3 * 98.1, 0)).norm(), 1e-6);
    }
  }
  for (const std::string cut : {"", ", cut: true"}) {
    const RanScene run(flywheel(", motion: spin" + cut, motion));
    EXPECT_NEAR(run.read("/joints/axle_drive/driving_force")(1, 0), 2, 1e-8);  // 0.5 kg m2 x 4 rad/s2
    EXPECT_NEAR(run.read("/joints/axle_drive/moment")(1, 0), -2, 1e-8);        // on the ground
  }
}

}  // namespace
}  // namespace wishbone
