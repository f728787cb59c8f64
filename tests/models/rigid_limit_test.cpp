// A flexible body that is made stiffer and stiffer moves more and more like the rigid one of the same mass and inertia.
#include <gtest/gtest.h>

#include <string>

#include "models/scene_loader.h"
#include "ran_scene.h"

namespace wishbone {
namespace {

/// A soft beam that swings down from a pin at one corner, with a weight hung on the opposite one. Critical damping of every
/// mode ends at once what the start makes ring; from then on deflections are those of statics and go with 1/E.
constexpr std::string_view kSwing = R"(wishbone: 1
parameters: {E: 2 kPa, modes: {default: few, choices: [few, none]}}
bodies:
  beam:
    form: modal
    position: [0.5, 0.05, 0.05]
    flexible:
      block: {size: [1, 0.1, 0.1], elements: [2, 1, 1]}
      material: {young: = E, poisson: 0.3, density: 1000}
      modes: {select: modes, few: 9, none: none}
      damping: 1
  weight: {mass: 2, inertia: [0.02, 0.03, 0.025], position: [1.1, 0.3, -0.1]}
joints:
  pin: {type: spherical, bodies: [ground, {body: beam, node: 1}]}
  hook: {type: spherical, bodies: [{body: beam, node: 12}, weight]}
analysis: {duration: 0.1 s, integrator: erk, rtol: 1e-10, atol: 1e-12}
output: {interval: 5 ms}
)";

/// Positions of beam and weight over time [m].
MatrixX positions(const std::string& setting) {
  const TextFiles files;
  const RanScene run(load_scene(files.write("scene.yaml", kSwing), {setting}));
  MatrixX all(run.file().time().size(), 6);
  all << run.read("/bodies/beam/position"), run.read("/bodies/weight/position");
  return all;
}

TEST(RigidLimit, DistanceFallsWithOneOverE) {
  const MatrixX rigid = positions("modes=none");
  const auto distance = [&](const std::string& young) {
    return (positions("E=" + young) - rigid).cwiseAbs().maxCoeff();
  };
  // 2 kPa times 1e4, 1e6, 1e8
  const double first = distance("20 MPa"), second = distance("2 GPa"), third = distance("200 GPa");
  EXPECT_NEAR(first, 1e-4, 1e-5);  // large enough for what is quadratic in it to show
  EXPECT_NEAR(first / second, 100, 5);
  EXPECT_NEAR(second / third, 100, 0.5);
}

}  // namespace
}  // namespace wishbone
