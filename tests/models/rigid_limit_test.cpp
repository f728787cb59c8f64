// A flexible body that is made stiffer and stiffer moves more and more like the rigid one of the same mass and inertia.
#include <gtest/gtest.h>

#include <string>

#include "compiled_modes.h"
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
      block: {size: [1, 0.1, 0.1], elements: [2, 1, 1], element: mean_dilatation}
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

Scene swing(const std::string& setting) {
  const TextFiles files;
  return load_scene(files.write("scene.yaml", kSwing), {setting});
}

/// The car in the depression of a banked road, critically damped too. Nine modes: the tenth is one of two of equal frequency, and
/// which half of that pair a set of ten takes depends on rounding, so it would change with E.
Scene car(const std::string& chassis, double factor_on_E) {
  Scene scene = load_scene(std::string(WISHBONE_SCENES) + "/sine_depression.yaml",
                           {"chassis=" + chassis, "modes=9", "damping=1"});
  scene.bodies.at(0).flexible->block->young *= factor_on_E;
  scene.analysis.duration = 0.04;
  scene.analysis.rtol = 1e-12;
  scene.analysis.atol = 1e-14;
  return scene;
}

/// Positions of all bodies over time [m].
MatrixX positions(const Scene& scene) {
  const RanScene run(scene);
  MatrixX all(run.file().time().size(), 0);
  for (const Signal& signal : run.file().signals()) {
    if (!signal.path.starts_with("/bodies/") || !signal.path.ends_with("/position")) continue;
    all.conservativeResize(Eigen::NoChange, all.cols() + 3);
    all.rightCols<3>() = run.read(signal.path);
  }
  return all;
}

double distance(const MatrixX& a, const MatrixX& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST(RigidLimit, DistanceFallsWithOneOverE) {
  const MatrixX rigid = positions(swing("modes=none"));
  // 2 kPa times 1e4, 1e6, 1e8
  const double first = distance(positions(swing("E=20 MPa")), rigid),
               second = distance(positions(swing("E=2 GPa")), rigid),
               third = distance(positions(swing("E=200 GPa")), rigid);
  EXPECT_NEAR(first, 1e-4, 1e-5);  // large enough for what is quadratic in it to show
  EXPECT_NEAR(first / second, 100, 5);
  EXPECT_NEAR(second / third, 100, 0.5);
}

TEST(RigidLimit, DistanceOfTheCarFallsWithOneOverE) {
  Scene scene = car("rigid", 1);
  const ModeSet nodes = compiled_modes(compile(car("modal", 1)));
  scene.bodies.at(0).mass = nodes.mass();  // 998.4 kg, where the scene has 998
  scene.bodies.at(0).inertia = nodes.inertia();
  const MatrixX rigid = positions(scene);
  double last = distance(positions(car("modal", 1e2)), rigid);
  EXPECT_GT(last, 1e-6);
  for (const double factor : {1e4, 1e6, 1e8}) {
    const double next = distance(positions(car("modal", factor)), rigid);
    EXPECT_NEAR(last / next, 100, 0.5) << "E times " << factor;
    last = next;
  }
}

}  // namespace
}  // namespace wishbone
