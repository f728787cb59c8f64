// Damping of the flexible bodies of a scene in proportion to mass and stiffness.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiled_modes.h"
#include "models/plan.h"
#include "models/ran_scene.h"

namespace wishbone {
namespace {

constexpr double kAlpha = 3, kBeta = 4e-4;

/// A beam that swings on a ball at node 1 and is pulled at node 12.
std::string scene(std::string_view form, std::string_view modes, std::string_view damping) {
  return fmt::format(R"(wishbone: 1
bodies:
  beam:
    form: {}
    position: [0.5, 0.05, 0.05]
    flexible:
      block: {{size: [1, 0.1, 0.1], elements: [2, 1, 1]}}
      material: {{young: 2 MPa, poisson: 0.3, density: 2600}}
      modes: {}
      damping: {}
joints:
  hold: {{type: spherical, bodies: [ground, {{body: beam, node: 1}}]}}
loads:
  push: {{body: beam, node: 12, force: [0, 30 N, 10 N]}}
analysis: {{duration: 200 ms, rtol: 1e-9}}
output: {{interval: 20 ms, nodes: {{beam: [12]}}, points: {{tip: {{body: beam, node: 12}}}}}}
)",
                     form, modes, damping);
}
constexpr std::string_view kDamping = "{mass: 3 1/s, stiffness: 0.4 ms}";

CompiledScene compiled(const std::string& text) {
  const TextFiles files;
  return compile(load_scene(files.write("scene.yaml", text)));
}

TEST(FlexibleDamping, GivesEachModeItsRatioStaticShapesToo) {
  for (const auto modes : {"all", "5\n      attachment: [1, 12]", "2\n      constraint: [1, 4, 12]"}) {
    const ModeSet set = compiled_modes(compiled(scene("modal", modes, kDamping)));
    for (int j = 0; j < set.mode_count(); ++j) {
      const double c = kAlpha + kBeta * set.omega[j] * set.omega[j];  // of unit modal mass: 2 zeta omega
      EXPECT_NEAR(2 * set.damping_ratio[j] * set.omega[j], c, 1e-12 * c);
    }
  }
}

TEST(FlexibleDamping, OfOneOfTheTwoLeavesTheOtherOut) {
  const ModeSet mass = compiled_modes(compiled(scene("modal", "4", "{mass: 3}")));
  const ModeSet stiffness = compiled_modes(compiled(scene("modal", "4", "{stiffness: 0.4 ms}")));
  for (int j = 0; j < 4; ++j) {
    EXPECT_NEAR(mass.damping_ratio[j], kAlpha / (2 * mass.omega[j]), 1e-15);
    EXPECT_NEAR(stiffness.damping_ratio[j], kBeta * mass.omega[j] / 2, 1e-15);
  }
}

TEST(FlexibleDamping, MovesTheBodyAlikeInModalAndNodalForm) {
  const RanScene modal(scene("modal", "all", kDamping)), nodal(scene("nodal", "all", kDamping));
  const RanScene undamped(scene("modal", "all", "0"));
  for (const char* path : {"/points/tip/position", "/flexible/beam/deflection"}) {
    const MatrixX a = modal.read(path), b = nodal.read(path), c = undamped.read(path);
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-7) << path;
    EXPECT_GT((a - c).cwiseAbs().maxCoeff(), 1e-4) << path;
  }
}

TEST(FlexibleDamping, IsShownModeByModeInThePlan) {
  const TextFiles files;
  const Scene loaded = load_scene(files.write("scene.yaml", scene("modal", "3", kDamping)));
  const CompiledScene compiled = compile(loaded);
  const Plan plan = make_plan(loaded, compiled);
  for (std::size_t j = 0; j < 3; ++j)
    EXPECT_EQ(plan.modes.at(0).modes.at(j).damping_ratio,
              compiled_modes(compiled).damping_ratio[static_cast<Eigen::Index>(j)]);
  EXPECT_THAT(plan.kept, testing::Contains("structural damping"));
}

}  // namespace
}  // namespace wishbone
