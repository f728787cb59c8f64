// Flexible bodies of linear shapes say when they are deflected further than these reach.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/ran_scene.h"

namespace wishbone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// A bar of steel, 1 m x 30 x 30 mm, is pushed at its end with the force that deflects it by `share` of its length.
std::string cantilever(double share, std::string_view modes = "automatic\n      below: 2 kHz",
                       std::string_view form = "modal") {
  const double force = 3 * 210e9 * std::pow(0.03, 4) / 12 * share;
  return fmt::format(R"(wishbone: 1
gravity: [0, 0, 0]
bodies:
  beam:
    form: {}
    position: [0.5, 0, 0]
    flexible:
      block: {{size: [1 m, 30 mm, 30 mm], elements: [6, 1, 1]}}
      material: {{young: 210 GPa, poisson: 0.3, density: 7850}}
      modes: {}
      damping: 100 %
      frames: {{root: {{nodes: [1, 2, 3, 4]}}, tip: {{nodes: [25, 26, 27, 28]}}}}
joints:
  clamp: {{type: fixed, bodies: [ground, {{body: beam, frame: root}}]}}
loads:
  tip: {{body: beam, frame: tip, force: [0, 0, {}]}}
analysis: {{duration: 0.1 s, integrator: bdf, rtol: 1e-4}}
output: {{interval: 5 ms}}
)",
                     form, modes, -force);
}

Warnings warnings_of_run(const std::string& scene) {
  return RanScene(scene).warnings();
}

TEST(LinearRange, ALargeDeflectionIsTold) {
  const Warnings warnings = warnings_of_run(cantilever(0.54));
  ASSERT_THAT(warnings, SizeIs(1));
  EXPECT_THAT(warnings[0].where, HasSubstr("beam, t = "));
  EXPECT_THAT(warnings[0].what, HasSubstr("beyond the range of linear elasticity"));
  EXPECT_THAT(warnings[0].what, HasSubstr("0.15"));
  EXPECT_THAT(warnings[0].remedy, HasSubstr("divide the body"));
  // slopes of w (3 x^2 - x^3)/2 against the mean axes, 1.05 w at the root; put on at once, the load deflects up to twice as far
  EXPECT_GT(std::stod(warnings[0].value), 1.05 * 0.54);
  EXPECT_LT(std::stod(warnings[0].value), 2 * 1.05 * 0.54);
}

TEST(LinearRange, SmallDeflectionsAreNot) {
  EXPECT_THAT(warnings_of_run(cantilever(0.0024)), IsEmpty());
  EXPECT_THAT(warnings_of_run(cantilever(0.08)), IsEmpty());
}

// Neither the form nor where the modes come from matters: nodes are all that is looked at.
TEST(LinearRange, IsThatOfNodesWhateverTheFormOfTheBody) {
  for (const auto& scene : {cantilever(0.4, "all", "nodal"), cantilever(0.4, "{measured: {from: model}}")}) {
    EXPECT_THAT(warnings_of_run(scene), SizeIs(1));
  }
  EXPECT_THAT(warnings_of_run(cantilever(0.05, "{measured: {from: model}}")), IsEmpty());
}

// Turning as it stands is no deflection, however far.
TEST(LinearRange, ABodyThatTurnsIsWithinIt) {
  EXPECT_THAT(warnings_of_run(R"(wishbone: 1
gravity: [0, 0, 0]
bodies:
  beam:
    form: modal
    position: [0, 0, 0]
    angular_velocity: [0, 0, 20]
    flexible:
      block: {size: [1 m, 30 mm, 30 mm], elements: [6, 1, 1]}
      material: {young: 210 GPa, poisson: 0.3, density: 7850}
      modes: 6
analysis: {duration: 1 s}
output: {interval: 20 ms}
)"),
              IsEmpty());
}

}  // namespace
}  // namespace wishbone
