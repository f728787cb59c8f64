// Speeds that a scene gives are those that it starts with, or the scene is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "solver/kinematics.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

/// A scene at its start.
struct Start {
  CompiledScene compiled;
  State state;
  AssemblyReport report;
  Workspace ws;

  explicit Start(CompiledScene scene)
      : compiled(std::move(scene)), state(compiled.initial), ws(compiled.system) {
    report = assemble(compiled.system, state, ws, compiled.transient.given);
    update_positions<double>(compiled.system, state.t, state.q, ws);
    update_velocities<double>(compiled.system, state.t, state.q, state.v, ws);
  }
  const BodyMotion& body(const std::string& name) const {
    for (std::size_t i = 0; i < ws.bodies.size(); ++i)
      if (compiled.system.bodies[i].name == name) return ws.bodies[i];
    throw std::out_of_range(name);
  }
  Vector3 v(const std::string& name) const { return linear(body(name).V); }
  Vector3 w(const std::string& name) const { return angular(body(name).V); }
  double kinetic_energy() const {
    double energy = 0;
    for (std::size_t i = 0; i < ws.bodies.size(); ++i) {
      const TreeBody& b = compiled.system.bodies[i];
      const Vector3 w_B = ws.bodies[i].X_WB.R.transpose() * angular(ws.bodies[i].V);
      energy += 0.5 * (b.mass * linear(ws.bodies[i].V).squaredNorm() + w_B.dot(b.J_B * w_B));
    }
    return energy;
  }
};

class InitialSpeeds : public testing::Test {
 protected:
  Start start(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return Start(compile(load_scene(files_.write("scene.yaml", text), overrides)));
  }
  std::string refusal(const std::string& text) const {
    return files_.relative(message_of<InputError>([&] { start(text); }));
  }

 private:
  TextFiles files_;
};

/// Two equal wheels in mesh; what their joints say is left open.
std::string gears(const std::string& a, const std::string& b) {
  return R"(wishbone: 1
gravity: [0, 0, 0]
bodies:
  a: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, 0, 0]}
  b: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [1, 0, 0]}
joints:
  A: {type: revolute, bodies: [ground, a], at: [0, 0, 0], axis: [0, 0, 1])" +
         a + R"(}
  B: {type: revolute, bodies: [ground, b], at: [1, 0, 0], axis: [0, 0, 1])" +
         b + R"(}
closures:
  mesh: {type: gear, driver: {joint: A, coordinate: angle}, driven: {joint: B, coordinate: angle}, ratio: -1}
)";
}

TEST_F(InitialSpeeds, OfAGearPairAreThoseOfTheDriver) {
  const Start s = start(gears(", speed: 10 rad/s", ""));
  EXPECT_NEAR(s.w("a").z(), 10, 1e-12);
  EXPECT_NEAR(s.w("b").z(), -10, 1e-12);
  EXPECT_NEAR(s.kinetic_energy(), 10, 1e-11);  // 2 (1/2 0.1 10^2)
  ASSERT_EQ(s.report.speeds.size(), 1u);       // and it is told what followed
  EXPECT_EQ(s.report.speeds[0].given, 0);
  EXPECT_NEAR(s.report.speeds[0].assembled, -10, 1e-12);
}

TEST_F(InitialSpeeds, ThatAgreeAreTaken) {
  const Start s = start(gears(", speed: 10 rad/s", ", speed: -10 rad/s"));
  EXPECT_NEAR(s.w("b").z(), -10, 1e-12);
  EXPECT_TRUE(s.report.speeds.empty());
  EXPECT_TRUE(s.report.warnings.empty());
}

TEST_F(InitialSpeeds, ThatContradictEachOtherAreRefusedByName) {
  const std::string message = refusal(gears(", speed: 10 rad/s", ", speed: 0 rad/s"));
  EXPECT_THAT(message, HasSubstr("scene.yaml:8:3: joints.B: error: initial speeds contradict each other"));
  EXPECT_THAT(message, HasSubstr("joint 'B' is given 0 rad/s, joint 'A' (10 rad/s) leave it -10 rad/s"));
}

TEST_F(InitialSpeeds, OfFewDigitsMayDifferInTheLastAndAreTold) {
  const Start s = start(gears(", speed: 3.3333 rad/s", ", speed: -3.333 rad/s"));
  EXPECT_NEAR(s.w("b").z(), -3.3333, 1e-12);
  ASSERT_EQ(s.report.warnings.size(), 1u);
  EXPECT_THAT(s.report.warnings[0].warning(), HasSubstr("joint 'B' is given -3.333 rad/s"));
}

/// Crank 0.2 m, rod, block on a line: at crank angle phi the block moves with the velocity of the slider-crank.
std::string slider_crank(const std::string& crank, const std::string& slide,
                         const std::string& rod_end = "") {
  return R"(wishbone: 1
gravity: [0, 0, 0]
bodies:
  crank: {mass: 1, inertia: [0.01, 0.02, 0.02], position: [0, 0.1, 0]}
  rod: {mass: 2, inertia: [0.02, 0.1, 0.1], position: [0.25, 0.1, 0]}
  block: {mass: 3, inertia: [0.01, 0.01, 0.01], position: [0.5, 0, 0]}
joints:
  A: {type: revolute, bodies: [ground, crank], at: [0, 0, 0], axis: [0, 0, 1])" +
         crank + R"(}
  B: {type: revolute, bodies: [crank, rod], at: [0, 0.2, 0], axis: [0, 0, 1]}
  C: {type: spherical, bodies: [rod, block], at: [0.5, 0, 0])" +
         rod_end + R"(}
  D: {type: prismatic, bodies: [ground, block], at: [0.5, 0, 0], axis: [1, 0, 0])" +
         slide + R"(}
)";
}

// Crank upright, pin at (0, 0.2) moving with (-0.2 w, 0); the rod pulls the block along x with the same speed.
TEST_F(InitialSpeeds, OfACutJointCountLikeThoseOfTheTree) {
  for (const std::string cut : {"", ", cut: true", ", cut: false"}) {
    const Start s = start(slider_crank("", ", speed: 1.5 m/s" + cut));
    EXPECT_NEAR(s.v("block").x(), 1.5, 1e-12) << cut;
    EXPECT_NEAR(s.w("crank").z(), -7.5, 1e-10) << cut;
    EXPECT_NEAR(s.w("rod").norm(), 0, 1e-10) << cut;
  }
}

TEST_F(InitialSpeeds, OfALockedJointAreRefused) {
  const std::string message = refusal(slider_crank(", speed: 1 rad/s", ", cut: true") +
                                      "  lock: {type: fixed, bodies: [ground, block], at: [0.5, 0, 0]}\n");
  EXPECT_THAT(message, HasSubstr("joints.A: error: the joints do not allow this initial speed"));
  EXPECT_THAT(message, HasSubstr("joint 'A' is given 1 rad/s, the joints leave it"));
}

TEST_F(InitialSpeeds, AgainstAMotionAreRefused) {
  const std::string message =
      refusal(slider_crank(", motion: turn", ", speed: 1 m/s") + "motions: {turn: {expression: 2*t}}\n");
  EXPECT_THAT(message, HasSubstr("joint 'D' is given 1 m/s"));
  EXPECT_THAT(message, HasSubstr("-0.4 m/s"));  // -0.2 m x 2 rad/s
}

// Where the block is given, the crank follows.
TEST_F(InitialSpeeds, PositionsOfCutJointsAreThoseOfTheTree) {
  for (const std::string cut : {", cut: true", ", cut: false"}) {
    const Start s = start(slider_crank("", ", position: 50 mm, assembly_weight: 1e9" + cut));
    EXPECT_NEAR(s.body("block").X_WB.p.x(), 0.55, 1e-8) << cut;
  }
  const Start tree = start(slider_crank("", ", position: 50 mm"));
  const Start loop = start(slider_crank("", ", position: 50 mm, cut: true"));
  EXPECT_LT((tree.body("block").X_WB.p - loop.body("block").X_WB.p).norm(), 1e-9);
}

/// A rod that turns about a ball joint at the origin.
std::string ball(const std::string& body, const std::string& joint) {
  return R"(wishbone: 1
gravity: [0, 0, 0]
bodies:
  top: {mass: 2, inertia: [0.1, 0.1, 0.2], position: [0, 0, 0.5])" +
         body + R"(}
joints:
  tip: {type: spherical, bodies: [ground, top], at: [0, 0, 0])" +
         joint + R"(}
)";
}

TEST_F(InitialSpeeds, OfSphericalJointsAreAngularVelocities) {
  const Vector3 w(1, 2, 30), v = w.cross(Vector3(0, 0, 0.5));
  for (const std::string cut : {"", ", cut: true"}) {
    for (const Start& s :
         {start(ball("", ", speed: [1, 2, 30]" + cut)), start(ball(", angular_velocity: [1, 2, 30]", cut))}) {
      EXPECT_LT((s.w("top") - w).norm(), 1e-11) << cut;
      EXPECT_LT((s.v("top") - v).norm(), 1e-11) << cut;
    }
  }
}

TEST_F(InitialSpeeds, OfABodyOnASphericalJointMustFitIt) {
  EXPECT_LT((start(ball(", velocity: [1, 0, 0]", "")).v("top") - Vector3(1, 0, 0)).norm(), 1e-12);
  EXPECT_THAT(refusal(ball(", velocity: [0, 0, 1]", "")),
              HasSubstr("body 'top' (velocity z) is given 1 m/s, the joints leave it"));
  EXPECT_THAT(refusal(ball(", angular_velocity: [1, 2, 31]", ", speed: [1, 2, 30]")),
              HasSubstr("joint 'tip' (z) is given 30 rad/s"));
}

// A free joint has speeds against its first body; what is given of a body is against the ground.
TEST_F(InitialSpeeds, OfABodyFreeOnAnotherAreThoseAgainstTheGround) {
  const Start s = start(R"(wishbone: 1
bodies:
  ship: {mass: 1, inertia: [1, 1, 1], position: [0, 0, 0], velocity: [10, 0, 0], angular_velocity: [0, 0, 2]}
  boat: {mass: 1, inertia: [1, 1, 1], position: [0, 1, 0], velocity: [10, 0, 0], angular_velocity: [1, 0, 0]}
joints:
  tow: {type: free, bodies: [ship, boat]}
)");
  EXPECT_LT((s.v("boat") - Vector3(10, 0, 0)).norm(), 1e-12);
  EXPECT_LT((s.w("boat") - Vector3(1, 0, 0)).norm(), 1e-12);
}

// What is not given moves least: of two masses on a rod without mass the kinetic energy is least.
TEST_F(InitialSpeeds, LeaveTheOthersTheLeastChange) {
  const Start s = start(R"(wishbone: 1
gravity: [0, 0, 0]
bodies:
  a: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, 0, 0], velocity: [2, 0, 0]}
  b: {mass: 3, inertia: [0.1, 0.1, 0.1], position: [1, 0, 0]}
closures:
  rod: {type: distance, from: {body: a, at: [0, 0, 0]}, to: {body: b, at: [1, 0, 0]}}
)");
  EXPECT_LT((s.v("a") - Vector3(2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((s.v("b") - Vector3(2, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace wishbone
