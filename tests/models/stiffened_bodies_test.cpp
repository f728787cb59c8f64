// Geometric stiffening as a scene asks for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/error.h"
#include "identification/free_free_modes.h"
#include "identification/spin_stiffening.h"
#include "models/plan.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "solver/result_file.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::Contains;
using testing::HasSubstr;

// A soft blade, 16 rad/s at rest, on a hub that is spun up to 12 rad/s.
constexpr std::string_view kBlade = R"(wishbone: 1
gravity: [0, 0, -9.81]
bodies:
  blade:
    form: modal
    position: [0.6, 0, 0]
    flexible:
      block: {size: [1, 0.1, 0.05], elements: [3, 1, 1]}
      material: {young: 100 MPa, poisson: 0.3, density: 1000}
      modes: all
      frames: {root: {nodes: [1, 2, 3, 4]}}
      stiffening: {held: [1, 2, 3, 4], centre: [0, 0, 0]}
joints:
  hub: {type: revolute, bodies: [ground, {body: blade, frame: root}], at: [0, 0, 0], axis: [0, 0, 1], motion: turn}
motions:
  turn: {expression: 15*t^2}
analysis: {duration: 0.4 s, rtol: 1e-9}
output: {interval: 20 ms, points: {tip: {body: blade, node: 15}}}
)";

class StiffenedBodies : public testing::Test {
 protected:
  Scene load(std::string_view replacement = "", std::string_view old = "") const {
    std::string text(kBlade);
    if (!old.empty()) text.replace(text.find(old), old.size(), replacement);
    return load_scene(files_.write("scene.yaml", text));
  }
  VectorX path_of_tip(const Scene& scene) const {
    const auto file = files_ / "out.h5";
    const TransientSummary summary = run_scene(scene, compile(scene), {"scene.yaml", file, {}, {}}).summary;
    EXPECT_EQ(summary.status, TransientSummary::Status::complete) << summary.message;
    return ResultFile(file.string()).read("/points/tip/position").reshaped();
  }
  TextFiles files_;
};

TEST_F(StiffenedBodies, AreStiffenedAboutThePointThatTheSceneNames) {
  const CompiledScene compiled = compile(load());
  const HexahedralMesh mesh = make_block({1, 0.1, 0.05}, {3, 1, 1});
  const IsotropicMaterial material{100e6, 0.3, 1000};
  const MatrixX expected =
      spin_stiffening(mesh, material, free_free_modes(mesh, material), {{1, 2, 3, 4}, Vector3(-0.6, 0, 0)});
  const MatrixX& stiffening = compiled.system.flexible[0].modal.set().stiffening;
  ASSERT_EQ(stiffening.cols(), expected.cols());
  EXPECT_LT((stiffening - expected).norm(), 1e-10 * expected.norm());
}

// Nodes and all modes are the same body, stiffened too.
TEST_F(StiffenedBodies, MoveAlikeInNodalAndModalForm) {
  const VectorX modal = path_of_tip(load()), nodal = path_of_tip(load("form: nodal", "form: modal"));
  EXPECT_LT((modal - nodal).norm(), 1e-7 * modal.norm());
  const VectorX soft = path_of_tip(load("", "      stiffening: {held: [1, 2, 3, 4], centre: [0, 0, 0]}\n"));
  EXPECT_GT((modal - soft).norm(), 1e-3 * modal.norm());
}

/// Tip deflection of a clamped beam under a uniform load, in units of that at rest, while it spins with gamma = Omega sqrt(rho A
/// L^4 / EI) on a hub of radius r L: w_xxxx - gamma^2 ((r (1 - x) + (1 - x^2) / 2) w_x)_x = q, by Ritz's method.
double sag(double gamma, double r) {
  constexpr int n = 9;
  MatrixX K(n, n);
  VectorX q(n);
  const auto integral = [](double power) { return 1 / (power + 1); };
  for (int i = 0; i < n; ++i) {
    const double a = i + 2;
    q[i] = integral(a);
    for (int j = 0; j < n; ++j) {
      const double b = j + 2, p = a + b - 2;
      K(i, j) =
          a * (a - 1) * b * (b - 1) * integral(p - 2) +
          gamma * gamma * a * b * (r * (integral(p) - integral(p + 1)) + (integral(p) - integral(p + 2)) / 2);
    }
  }
  return 8 * K.ldlt().solve(q).sum();
}

// A blade sags less while it spins. What its solid elements bend too little is taken from the sag at rest.
TEST_F(StiffenedBodies, SagLessWhileTheySpin) {
  constexpr const char* kHanging = R"(wishbone: 1
gravity: [0, 0, -9.81]
bodies:
  blade:
    form: modal
    position: [0.6, 0, 0]
    velocity: [0, SPEED, 0]
    angular_velocity: [0, 0, SPIN]
    flexible:
      block: {size: [1, 0.1, 0.05], elements: [10, 1, 1]}
      material: {young: 400 MPa, poisson: 0, density: 1000}
      modes: 16
      damping: 50 %
      frames: {root: {nodes: [1, 2, 3, 4]}}
      stiffening: {held: [1, 2, 3, 4], centre: [0, 0, 0]}
joints:
  hub: {type: revolute, bodies: [ground, {body: blade, frame: root}], at: [0, 0, 0], axis: [0, 0, 1], motion: turn}
motions:
  turn: {expression: SPIN*t}
analysis: {duration: 1.5 s, rtol: 1e-7, integrator: bdf}
output: {interval: 0.5 s, points: {tip: {body: blade, node: 41}}}
)";
  constexpr double kSpin = 25, kLength = 1, kHub = 0.1;
  const auto height = [&](double spin) {
    std::string text(kHanging);
    const auto put = [&](std::string_view name, double value) {
      for (auto at = text.find(name); at != std::string::npos; at = text.find(name))
        text.replace(at, name.size(), std::to_string(value));
    };
    put("SPEED", 0.6 * spin);
    put("SPIN", spin);
    const VectorX path = path_of_tip(load_scene(files_.write("scene.yaml", text)));
    return path[path.size() - 1];  // columns x, y, z one after the other
  };
  const double tip = -0.025, rest = tip - height(0), spinning = tip - height(kSpin);
  const double gamma = kSpin * std::sqrt(8 * rest / (9.81 * kLength));  // w = rho A g L^4 / (8 EI)
  ASSERT_GT(gamma, 2);
  EXPECT_NEAR(spinning / rest, sag(gamma, kHub / kLength), 0.01);
  EXPECT_LT(spinning / rest, 0.7);
}

TEST_F(StiffenedBodies, AreNamedInThePlan) {
  const Scene scene = load(), plain = load("", "      stiffening: {held: [1, 2, 3, 4], centre: [0, 0, 0]}\n");
  EXPECT_THAT(make_plan(scene, compile(scene)).kept, Contains("geometric stiffening of blade"));
  const Plan plan = make_plan(plain, compile(plain));
  EXPECT_THAT(plan.left_out, Contains("geometric stiffening: no body asks for it"));
  // 42 modes of 16 nodes: 15 x 16 x 42 against 12 x 42^2
  EXPECT_THAT(plan.kept, Contains("inertia of blade by node sums: 10080 multiplications an evaluation "
                                  "(invariants 21168)"));
}

TEST_F(StiffenedBodies, AreRefusedWithoutNodesOrElements) {
  const auto message = [&](std::string_view replacement, std::string_view old) {
    return files_.relative(message_of<InputError>([&] { load(replacement, old); }));
  };
  EXPECT_EQ(message("held: [1, 99]", "held: [1, 2, 3, 4]"),
            "scene.yaml:12:30: bodies.blade.flexible.stiffening.held[2]: error: the body has no such node "
            "(got '99')\n"
            "  its nodes are 1 to 16");
  EXPECT_THAT(message("held: []", "held: [1, 2, 3, 4]"), HasSubstr("there are no nodes in the list"));
  EXPECT_THAT(message("stiffening: yes", "stiffening: {held: [1, 2, 3, 4], centre: [0, 0, 0]}"),
              HasSubstr("scene.yaml:12:19: bodies.blade.flexible.stiffening"));
}

}  // namespace
}  // namespace wishbone
