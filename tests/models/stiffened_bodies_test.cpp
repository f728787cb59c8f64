// Geometric stiffening as a scene asks for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

// A blade on a hub that turns with 15 rad/s, twice as fast as the blade swings at rest; it begins to fall.
constexpr std::string_view kBlade = R"(wishbone: 1
gravity: [0, 0, -1]
bodies:
  blade:
    form: modal
    position: [0.6, 0, 0]
    velocity: [0, 9, 0]
    angular_velocity: [0, 0, 15]
    flexible:
      block: {size: [1, 0.1, 0.05], elements: [3, 1, 1]}
      material: {young: 20 MPa, poisson: 0.3, density: 1000}
      modes: all
      frames: {root: {nodes: [1, 2, 3, 4]}}
      stiffening: {held: [1, 2, 3, 4], centre: [0, 0, 0]}
joints:
  hub: {type: revolute, bodies: [ground, {body: blade, frame: root}], at: [0, 0, 0], axis: [0, 0, 1], motion: turn}
motions:
  turn: {expression: 15*t}
analysis: {duration: 0.2 s, rtol: 1e-9}
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
  const Mesh mesh = make_block({1, 0.1, 0.05}, {3, 1, 1});
  const IsotropicMaterial material{20e6, 0.3, 1000};
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
  EXPECT_GT((modal - soft).norm(), 1e-4 * modal.norm());  // a thousand times that
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
            "scene.yaml:14:30: bodies.blade.flexible.stiffening.held[2]: error: the body has no such node "
            "(got '99')\n"
            "  its nodes are 1 to 16");
  EXPECT_THAT(message("held: []", "held: [1, 2, 3, 4]"), HasSubstr("there are no nodes in the list"));
  EXPECT_THAT(message("stiffening: yes", "stiffening: {held: [1, 2, 3, 4], centre: [0, 0, 0]}"),
              HasSubstr("scene.yaml:14:19: bodies.blade.flexible.stiffening"));
}

}  // namespace
}  // namespace wishbone
