// What a run records beyond the motion of bodies: points, signals, drives, counts of work.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "models/ran_scene.h"

namespace wishbone {
namespace {

TEST(PointOutput, OfAFreeBodyThatSpinsAboutAnAxisMovesOnItsScrew) {
  const RanScene run(R"(
wishbone: 1
gravity: [0, 0, 0]
bodies:
  top: {mass: 1, inertia: [1, 1, 2], position: [1, 0, 0], velocity: [0, 0, 0.5], angular_velocity: [0, 0, 3]}
analysis: {duration: 1 s, rtol: 1e-11, atol: 1e-12}
output: {interval: 0.1 s, points: {tip: {body: top, at: [1.2, 0, 0.1]}}}
)");
  const MatrixX p = run.read("/points/tip/position"), v = run.read("/points/tip/velocity"),
                a = run.read("/points/tip/acceleration");
  for (Eigen::Index i = 0; i < p.rows(); ++i) {
    const double t = run.file().time()[i], c = 0.2 * std::cos(3 * t), s = 0.2 * std::sin(3 * t);
    EXPECT_LT((p.row(i).transpose() - Vector3(1 + c, s, 0.1 + 0.5 * t)).norm(), 1e-9) << t;
    EXPECT_LT((v.row(i).transpose() - Vector3(-3 * s, 3 * c, 0.5)).norm(), 1e-9) << t;
    EXPECT_LT((a.row(i).transpose() - Vector3(-9 * c, -9 * s, 0)).norm(), 1e-9) << t;
  }
}

TEST(PointOutput, OfAClosedLoopFallsAsItsJointsLetIt) {
  // Bricard's mechanism has a redundant row: accelerations must outlive the search for least-norm reactions
  Scene scene = load_scene(std::string(WISHBONE_SCENES) + "/benchmarks/bricard.yaml");
  scene.output.interval = 0.001;
  scene.output.points = {{"P3", {2, 0, {1, -1, 1}}}};
  ASSERT_EQ(scene.bodies[2].name, "bar_3");
  const RanScene run(std::move(scene));
  const MatrixX p = run.read("/points/P3/position"), v = run.read("/points/P3/velocity"),
                a = run.read("/points/P3/acceleration");
  for (Eigen::Index i = 100; i + 1 < p.rows(); i += 500) {
    // central differences over 1 ms: errors h^2/6 times the next derivative but one
    EXPECT_LT((v.row(i) - (p.row(i + 1) - p.row(i - 1)) / 0.002).norm(), 1e-4) << i;
    EXPECT_LT((a.row(i) - (v.row(i + 1) - v.row(i - 1)) / 0.002).norm(), 1e-3) << i;
    EXPECT_GT(a.row(i).norm(), 0.1) << i;
  }
}

/// Whether velocity and acceleration of the point "end" are the derivatives of its position, of a beam that bends.
void expect_consistent_motion_of_the_end(const std::string& end) {
  const RanScene run(R"(
wishbone: 1
gravity: [0, 0, 0]
bodies:
  beam:
    form: modal
    position: [0, 0, 0]
    angular_velocity: [0, 2, 5]
    flexible: {block: {size: [1, 0.05, 0.05], elements: [4, 1, 1]}, material: {young: 1e8, poisson: 0.3, density: 1000}, modes: 6, frames: {face: {nodes: [1, 2, 3, 4]}}}
loads:
  pluck: {body: beam, node: 1, force: [0, {expression: 20*sin(60*t)}, 30]}
analysis: {duration: 0.1 s, rtol: 1e-9, atol: 1e-11}
output: {interval: 0.00005 s, nodes: {beam: [1]}, points: {end: )" +
                     end + "}}\n");
  const MatrixX p = run.read("/points/end/position"), v = run.read("/points/end/velocity"),
                a = run.read("/points/end/acceleration");
  ASSERT_GT(run.read("/flexible/beam/deflection").cwiseAbs().maxCoeff(), 1e-4) << "it bends [m]";
  for (Eigen::Index i = 50; i + 1 < p.rows(); i += 100) {
    const double v_scale = v.row(i).norm(), a_scale = a.row(i).norm();
    EXPECT_LT((v.row(i) - (p.row(i + 1) - p.row(i - 1)) / 0.0001).norm(), 1e-4 * v_scale) << i;
    EXPECT_LT((a.row(i) - (v.row(i + 1) - v.row(i - 1)) / 0.0001).norm(), 1e-3 * a_scale) << i;
  }
}

TEST(PointOutput, OfAFlexibleBodyFollowsItsNode) {
  expect_consistent_motion_of_the_end("{body: beam, node: 1}");
}

TEST(PointOutput, OfAFrameTurnsWithIt) {
  expect_consistent_motion_of_the_end("{body: beam, frame: face, at: [-0.8, 0.1, 0.2]}");
}

TEST(PointOutput, OfAFrameIsWhereAJointOnItHoldsIt) {
  const RanScene run(R"(
wishbone: 1
bodies:
  beam:
    form: modal
    position: [0, 0, 0]
    flexible: {block: {size: [1, 0.05, 0.05], elements: [4, 1, 1]}, material: {young: 5e6, poisson: 0.3, density: 1000}, modes: 6, frames: {face: {nodes: [1, 2, 3, 4]}}}
joints:
  pin: {type: revolute, bodies: [ground, {body: beam, frame: face}], at: [-0.6, 0.1, 0.2], axis: [0, 1, 0]}
analysis: {duration: 0.3 s, rtol: 1e-9, atol: 1e-11}
output: {interval: 0.1 s, nodes: {beam: [20]}, points: {pin: {body: beam, frame: face, at: [-0.6, 0.1, 0.2]}}}
)");
  ASSERT_GT(run.read("/flexible/beam/deflection").cwiseAbs().maxCoeff(), 1e-3) << "it bends [m]";
  const MatrixX p = run.read("/points/pin/position");
  for (Eigen::Index i = 0; i < p.rows(); ++i)
    EXPECT_LT((p.row(i).transpose() - Vector3(-0.6, 0.1, 0.2)).norm(), 1e-8) << i;
}

constexpr const char* kDrivenArm = R"(
wishbone: 1
gravity: [0, 0, 0]
bodies:
  arm: {mass: 2, inertia: [0.2, 0.2, 0.3], position: [0, 0, 0]}
joints:
  axle: {type: cylindrical, bodies: [ground, arm], at: [0, 0, 0], axis: [0, 0, 1], CONTROL}
signals:
  turn: {joint: axle, coordinate: angle}
  spin: {joint: axle, coordinate: angle, quantity: speed}
  height: {body: arm, component: z}
loads:
  lift: {joint: axle, coordinate: travel, force: {expression: "6 - 4*height"}}
motions:
  sweep: {expression: "0.5*7*t^2"}
analysis: {duration: 1 s, rtol: 1e-10, atol: 1e-11}
output: {interval: 0.1 s}
)";

std::string driven_arm(const std::string& control) {
  std::string text = kDrivenArm;
  return text.replace(text.find("CONTROL"), 7, control);
}

TEST(DriveOutput, OfADrivenCoordinateIsInertiaTimesItsAcceleration) {
  const RanScene run(driven_arm("motion: {angle: sweep}"));
  const MatrixX torque = run.read("/joints/axle_angle_drive/driving_force");
  for (Eigen::Index i = 0; i < torque.rows(); ++i) EXPECT_NEAR(torque(i, 0), 0.3 * 7, 1e-9);
}

TEST(DriveOutput, OfALoadAlongAJointIsItsFunction) {
  // 2 h'' = 6 - 4 h from rest: h = 1.5 (1 - cos(sqrt(2) t))
  const RanScene run(driven_arm("motion: {angle: sweep}"));
  const MatrixX force = run.read("/forces/lift/force"), height = run.read("/forces/lift/value");
  for (Eigen::Index i = 0; i < force.rows(); ++i) {
    const double h = 1.5 * (1 - std::cos(std::numbers::sqrt2 * run.file().time()[i]));
    EXPECT_NEAR(height(i, 0), h, 1e-8);
    EXPECT_NEAR(force(i, 0), 6 - 4 * h, 1e-7);
  }
}

TEST(SignalOutput, IsRecordedByNameWithItsUnit) {
  const RanScene run(driven_arm("motion: {angle: sweep}"));
  const MatrixX turn = run.read("/signals/turn"), spin = run.read("/signals/spin"),
                height = run.read("/signals/height"), p = run.read("/bodies/arm/position");
  for (Eigen::Index i = 0; i < turn.rows(); ++i) {
    const double t = run.file().time()[i];
    EXPECT_NEAR(turn(i, 0), 3.5 * t * t, 1e-9);
    EXPECT_NEAR(spin(i, 0), 7 * t, 1e-8);
    EXPECT_EQ(height(i, 0), p(i, 2));
  }
  EXPECT_EQ(run.file().find("/signals/turn")->units, "rad");
  EXPECT_EQ(run.file().find("/signals/spin")->units, "rad/s");
  EXPECT_EQ(run.file().find("/signals/height")->units, "m");
}

TEST(LoadOutput, IsTheForceAndTheMomentInInertialAxes) {
  // the top turns about z with 3 rad/s, and the follower with it
  const RanScene run(R"(
wishbone: 1
gravity: [0, 0, 0]
bodies:
  top: {mass: 1, inertia: [1, 1, 2], position: [0, 0, 0], angular_velocity: [0, 0, 3]}
loads:
  dead: {body: top, at: [0, 0, 1], force: [0, 0, {expression: 2*t}]}
  follower: {body: top, axes: body, moment: [0, 0, 5 N m]}
  push: {body: top, axes: body, force: [4 N, 0, 0]}
analysis: {duration: 1 s, rtol: 1e-11, atol: 1e-12}
output: {interval: 0.1 s}
)");
  const MatrixX dead = run.read("/loads/dead/force"), moment = run.read("/loads/follower/moment"),
                push = run.read("/loads/push/force");
  for (Eigen::Index i = 0; i < dead.rows(); ++i) {
    const double t = run.file().time()[i], angle = 3 * t + 0.5 * 5.0 / 2 * t * t;
    EXPECT_LT((dead.row(i).transpose() - Vector3(0, 0, 2 * t)).norm(), 1e-15) << t;
    EXPECT_LT((moment.row(i).transpose() - Vector3(0, 0, 5)).norm(), 1e-12) << t;
    EXPECT_LT((push.row(i).transpose() - 4 * Vector3(std::cos(angle), std::sin(angle), 0)).norm(), 1e-8) << t;
  }
  for (const char* load : {"dead", "follower", "push"}) {
    const Signal* force = run.file().find(std::string("/loads/") + load + "/force");
    const Signal* torque = run.file().find(std::string("/loads/") + load + "/moment");
    ASSERT_TRUE(force && torque) << load;
    EXPECT_EQ(force->units, "N");
    EXPECT_EQ(torque->units, "N m");
    EXPECT_EQ(force->frame, "world");
    EXPECT_EQ(torque->frame, "world");
  }
}

TEST(LoadOutput, OfALoadThatIsNamedLikeASpringStandsBesideIt) {
  const RanScene run(R"(
wishbone: 1
gravity: [0, 0, 0]
bodies: {block: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0]}}
springs: {pull: {from: {ground: [0, 0, 0]}, to: {body: block}, stiffness: 2, free_length: 1}}
loads: {pull: {body: block, force: [3, 0, 0]}}
analysis: {duration: 0.1 s}
)");
  EXPECT_EQ(run.read("/loads/pull/force")(0, 0), 3);
  EXPECT_EQ(run.read("/forces/pull/force")(0, 0), 0);
}

TEST(JointForceOutput, OfFrictionAndLimitsAreTheirLaws) {
  const RanScene run(driven_arm(
      "motion: {angle: sweep}, friction: {angle: {coulomb: 2, smoothing: 0.1, viscous: 0.5}}, limits: "
      "{travel: {upper: 0.5, stiffness: 1000, exponent: 2}}"));
  const MatrixX friction = run.read("/forces/axle_angle_friction/force");
  const MatrixX stop = run.read("/forces/axle_travel_limit/force"),
                travel = run.read("/forces/axle_travel_limit/value");
  double deepest = 0;
  for (Eigen::Index i = 0; i < friction.rows(); ++i) {
    const double rate = 7 * run.file().time()[i], depth = std::max(0.0, travel(i, 0) - 0.5);
    EXPECT_NEAR(friction(i, 0), -(2 * std::tanh(rate / 0.1) + 0.5 * rate), 1e-7);
    EXPECT_NEAR(stop(i, 0), -1000 * depth * depth, 1e-9);
    deepest = std::max(deepest, depth);
  }
  EXPECT_GT(deepest, 0.01) << "the stop is reached [m]";
}

TEST(WorkCounters, StayAtZeroForWhatASceneDoesNotHave) {
  const RanScene pendulum(R"(
wishbone: 1
bodies: {rod: {mass: 2, inertia: [0.1, 0.1, 0.01], position: [0.4, 0, 0]}}
joints: {pin: {type: revolute, bodies: [ground, rod], at: [0, 0, 0], axis: [0, 1, 0]}}
analysis: {duration: 0.5 s}
)");
  const WorkCounters& w = pendulum.work();
  EXPECT_GT(w.forces, 0);
  EXPECT_GT(w.solves, 0);
  for (const long count :
       {w.signals, w.drives, w.inverse_dynamics, w.tangents, w.closure_factorizations,
        w.orthogonal_factorizations, w.projections, w.rank_searches, w.rank_revisions, w.partitions})
    EXPECT_EQ(count, 0);
}

TEST(WorkCounters, CountWhatASceneHas) {
  const std::string text = driven_arm("motion: {angle: sweep}");

  const RanScene explicit_run(text);
  EXPECT_EQ(explicit_run.work().signals, 3 * explicit_run.work().forces);
  EXPECT_EQ(explicit_run.work().drives, explicit_run.work().forces);
  EXPECT_EQ(explicit_run.work().tangents, 0) << "an explicit method needs no Jacobian";
  EXPECT_GT(explicit_run.work().projections, 0);
  EXPECT_GT(explicit_run.work().rank_searches, 0);
  EXPECT_EQ(explicit_run.work().partitions, 0);
  EXPECT_EQ(explicit_run.meta("work_signal_evaluations"), double(explicit_run.work().signals));

  std::string implicit = text;
  implicit.replace(implicit.find("analysis: {"), 11, "analysis: {integrator: bdf, form: partition, ");
  const RanScene partitioned(implicit);
  EXPECT_GT(partitioned.work().tangents, 0);
  EXPECT_EQ(double(partitioned.work().tangents), partitioned.meta("solver_jacobian_evaluations"));
  EXPECT_GT(partitioned.work().partitions, 0);
}

const char* const kTwoFallingBodies = R"(
wishbone: 1
bodies:
  stone: {mass: 1, inertia: [1, 1, 1], position: [0, 0, 0]}
  feather: {mass: 0.01, inertia: [1, 1, 1], position: [1, 0, 0]}
analysis: {duration: 0.1 s}
)";

TEST(Record, ChoosesSignalsAndLeavesTheirValuesAsTheyAre) {
  const RanScene all(kTwoFallingBodies);
  const RanScene run(std::string(kTwoFallingBodies) + "output: {record: [/bodies/stone/*, '*/kinetic']}\n");
  std::vector<std::string> paths;
  for (const Signal& signal : run.file().signals()) {
    paths.push_back(signal.path);
    EXPECT_EQ(run.read(signal.path), all.read(signal.path));
  }
  EXPECT_EQ(paths, (std::vector<std::string>{"/bodies/stone/angular_velocity", "/bodies/stone/orientation",
                                             "/bodies/stone/position", "/bodies/stone/velocity",
                                             "/energy/kinetic"}));
}

TEST(Record, PatternThatMatchesNothingIsToldAndNoSignalAtAllIsRefused) {
  const TextFiles files;
  const auto run = [&](const std::string& patterns) {
    const Scene scene = load_scene(
        files.write("s.yaml", std::string(kTwoFallingBodies) + "output: {record: " + patterns + "}\n"));
    return run_scene(scene, compile(scene), {"s.yaml", files / "out.h5", {}, {}});
  };
  const RunResult result = run("[/bodies/stone/*, /bodies/stnoe/*]");
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].value, "/bodies/stnoe/*");
  EXPECT_THROW(run("[/bodies/stnoe/*]"), InputError);
  EXPECT_THROW(run("[bodies/stone/*]"), InputError);
  EXPECT_THROW(run("[]"), InputError);
}

}  // namespace
}  // namespace wishbone
