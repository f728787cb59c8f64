// Frames of a scene whose nodes keep their distances.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiled_modes.h"
#include "core/error.h"
#include "models/interface_nodes.h"
#include "models/plan.h"
#include "models/ran_scene.h"

namespace wishbone {
namespace {

using testing::ElementsAre;

/// An arm that turns on a pin in its rigid root and is twisted at its tip. Sections hold the nodes 1-4 (x = 0) to 13-16.
std::string scene(std::string_view flexible, std::string_view form = "modal") {
  return fmt::format(R"(wishbone: 1
bodies:
  arm:
    form: {}
    position: [0.6, 0, 0]
    flexible:
      block: {{size: [1.2, 0.4, 0.3], elements: [3, 1, 1]}}
      material: {{young: 5 MPa, poisson: 0.3, density: 2000}}
      {}
joints:
  pin: {{type: revolute, bodies: [ground, {{body: arm, frame: root}}], axis: [0, 0, 1]}}
loads:
  twist: {{body: arm, frame: tip, moment: [150 N m, 0, 40 N m]}}
analysis: {{duration: 0.2, rtol: 1e-9}}
output: {{interval: 20 ms, nodes: {{arm: [1, 2, 3, 4, 13, 14, 15, 16]}}}}
)",
                     form, flexible);
}
constexpr std::string_view kFrames = R"(frames:
        root: {nodes: [1, 2, 3, 4], rigid: true}
        tip: {nodes: [13, 14, 15, 16]})";

std::string with_modes(std::string_view modes, std::string_view frames = kFrames) {
  return fmt::format("modes: {}\n      {}", modes, frames);
}

Scene load(const std::string& text) {
  const TextFiles files;
  return load_scene(files.write("scene.yaml", text));
}

/// How far the nodes of a section (first column in a record of deflections) move beyond a rigid motion, at most [m].
double warping(const RanScene& run, int first) {
  Matrix3X places(3, 4);  // of a section, in the order of the nodes of a block
  places << 0, 0, 0, 0, -0.2, 0.2, 0.2, -0.2, -0.15, -0.15, 0.15, 0.15;
  const MatrixX deflections = run.read("/flexible/arm/deflection");
  double largest = 0;
  for (const auto& row : deflections.rowwise()) {
    MatrixX A(12, 6);
    VectorX delta(12);
    for (int i = 0; i < 4; ++i) {
      A.middleRows<3>(3 * i) << Matrix3::Identity(), -skew(places.col(i));
      delta.segment<3>(3 * i) = row.segment(3 * (first + i), 3).transpose();
    }
    const VectorX motion = A.colPivHouseholderQr().solve(delta);
    largest = std::max(largest, (A * motion - delta).norm());
  }
  return largest;
}

TEST(RigidFramesOfScenes, KeepTheirNodesTogetherWhileTheBodyBends) {
  const RanScene run(scene(with_modes("all")));
  EXPECT_LT(warping(run, 0), 1e-12);
  EXPECT_GT(warping(run, 4), 1e-5) << "the tip is free to warp";
}

TEST(RigidFramesOfScenes, AreTheSameInModalAndNodalForm) {
  const RanScene modal(scene(with_modes("all"))), nodal(scene(with_modes("all"), "nodal"));
  const RanScene soft(
      scene(with_modes("all", "frames: {root: {nodes: [1, 2, 3, 4]}, tip: {nodes: [13, 14, 15, 16]}}")));
  const char* angle = "/joints/pin/coordinates";
  EXPECT_LT(
      (modal.read("/flexible/arm/deflection") - nodal.read("/flexible/arm/deflection")).cwiseAbs().maxCoeff(),
      1e-7);
  EXPECT_LT((modal.read(angle) - nodal.read(angle)).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_GT((modal.read(angle) - soft.read(angle)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(RigidFramesOfScenes, CountTheirNodesAsInterfacesWhetherHeldOrNot) {
  EXPECT_THAT(interface_nodes(load(scene(with_modes("all"))), 0), ElementsAre(1, 2, 3, 4, 13, 14, 15, 16));
  const std::string frames =
      "frames: {root: {nodes: [1, 2, 3, 4]}, tip: {nodes: [13, 14, 15, 16]}, rib: {nodes: [5, 6, 7, 8], "
      "rigid: true}}";
  EXPECT_THAT(interface_nodes(load(scene(with_modes("all", frames))), 0),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 13, 14, 15, 16));
}

TEST(RigidFramesOfScenes, AreInTheTableOfModes) {
  const Scene loaded = load(scene(with_modes("all")));
  const CompiledScene compiled = compile(loaded);
  const ModeSet left = compiled_modes(compiled);
  EXPECT_EQ(left.mode_count(), 42 - 6);
  const BodyModes table = make_plan(loaded, compiled).modes.at(0);
  EXPECT_EQ(table.choice, "all normal modes; 1 rigid frame leaves 36 of 42");
  ASSERT_EQ(table.modes.size(), 36u);
  for (std::size_t j = 0; j < 36; ++j) {
    EXPECT_NEAR(table.modes[j].frequency * 2 * M_PI / left.omega[static_cast<Eigen::Index>(j)], 1, 1e-12);
    EXPECT_EQ(table.modes[j].kind, ModeKind::normal);
  }
  // of few modes with the static shapes of the frame's nodes, the lowest stay normal
  const Scene few = load(scene(with_modes("4\n      attachment: interfaces")));
  const BodyModes mixed = compile(few).modes.at(0);
  ASSERT_EQ(mixed.modes.size(), 4u + 24u - 6u);
  EXPECT_EQ(mixed.modes.front().kind, ModeKind::normal);
  EXPECT_EQ(mixed.modes.back().kind, ModeKind::attachment);
}

TEST(RigidFramesOfScenes, KeepTheDampingRatiosMeaningful) {
  const CompiledScene compiled =
      compile(load(scene(with_modes("all\n      damping: {mass: 2, stiffness: 1 ms}"))));
  const ModeSet left = compiled_modes(compiled);
  for (int j = 0; j < left.mode_count(); ++j) {
    const double expected = 2 / (2 * left.omega[j]) + 1e-3 * left.omega[j] / 2;
    EXPECT_NEAR(left.damping_ratio[j], expected, 1e-9 * expected);
    EXPECT_NEAR(compiled.modes.at(0).modes[static_cast<std::size_t>(j)].damping_ratio, expected,
                1e-9 * expected);
  }
}

TEST(RigidFramesOfScenes, OfARigidBodyAreItsOwn) {
  const Scene none = load(scene(with_modes("none")));
  EXPECT_EQ(none.bodies[0].form, Scene::BodyForm::kRigid);
  EXPECT_TRUE(compile(none).system.flexible.empty());
}

TEST(RigidFramesOfScenes, NameTheBodyWhoseModesTheyUseUp) {
  const TextFiles files;
  const Scene few = load_scene(files.write("scene.yaml", scene(with_modes("1"))));
  EXPECT_EQ(files.relative(message_of<InputError>([&] { compile(few); })),
            "scene.yaml:3:3: bodies.arm: frame 'root': error: none of the shapes of the body leaves these "
            "nodes at their distances (got 1 shape)\n"
            "  keep more modes, among them the attachment modes of the nodes of the frame; a body that is "
            "rigid altogether has 'modes: none'");
}

}  // namespace
}  // namespace wishbone
