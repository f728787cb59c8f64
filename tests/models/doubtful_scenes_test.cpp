// Scenes that can be read but were most likely not meant: each is told with its place, value and likely meaning.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "models/broken_text.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr std::string_view kGoodScene = R"(wishbone: 1
gravity: [0, 0, -9.81]
bodies:
  slide: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, 0, 1]}
  carriage: {mass: 300, inertia: [10, 10, 10], position: [0, 0, 1]}
  wheel: {mass: 30, inertia: [1, 2, 1], position: [0, 0, 0.2988]}
  beam:
    form: modal
    position: [0.5, 5.05, 0.05]
    flexible:
      block: {size: [1, 0.1, 0.1], elements: [8, 1, 1]}
      material: {young: 210 GPa, poisson: 0.3, density: 7850}
      modes: all
      damping: 2 %
  rod: {mass: 2, inertia: [0.1, 0.1, 0.1], position: [1, 2, 0], orientation: {axis: [0, 0, 1], angle: 30 deg}}
  cog: {mass: 2, inertia: [0.1, 0.1, 0.1], position: [2, 2, 0]}
joints:
  along: {type: prismatic, bodies: [ground, slide], at: [0, 0, 1], axis: [1, 0, 0], speed: 20 m/s}
  up: {type: prismatic, bodies: [slide, carriage], at: [0, 0, 1], axis: [0, 0, 1], position: 0}
  hub: {type: revolute, bodies: [carriage, wheel], at: [0, 0, 0.2988], axis: [0, 1, 0], speed: 64.7}
  pin: {type: revolute, bodies: [ground, rod], at: [0, 2, 0], axis: [0, 0, 1], position: 0 deg}
  shaft: {type: revolute, bodies: [ground, cog], at: [2, 2.1, 0], axis: [0, 0, 1]}
closures:
  mesh: {type: gear, driver: {joint: pin}, driven: {joint: shaft}, ratio: -2}
springs:
  coil: {from: {ground: [1, 3, 0]}, to: {body: rod}, stiffness: 2 kN/m, damping: 5, free_length: 1 m}
loads:
  push: {body: rod, force: [0, 1 N, 0]}
tire_models:
  ua: {radius: 0.315, vertical_stiffness: 200 kN/m, damping_ratio: 0.02, mass: 10 kg, slip_stiffness: 80 kN,
       cornering_stiffness: 73.6 kN/rad, camber_stiffness: 8 kN/rad, rolling_resistance: 3 mm, friction_max: 1, friction_min: 0.8}
tires:
  tire: {wheel: wheel, model: ua}
road: {}
analysis: {duration: 1 ms, rtol: 1e-5}
output: {interval: 1 ms}
)";

std::string with(const Broken& doubtful) {
  std::string scene(kGoodScene);
  const auto at = scene.find(doubtful.text);
  EXPECT_NE(at, std::string::npos);
  return scene.replace(at, doubtful.text.size(), doubtful.replacement);
}

/// All that is told of a scene when it is read, compiled and run.
std::string told_of(const std::string& scene_text) {
  const TextFiles files;
  const auto file = files.write("scene.yaml", scene_text);
  const Scene scene = load_scene(file);
  const RunResult result = run_scene(scene, compile(scene), {file, files / "out.h5", {}, {}});
  std::string all;
  for (const Diagnostic& warning : result.warnings) all += warning.warning() + "\n";
  return files.relative(all);
}

TEST(DoubtfulScenes, AreNotTheOrdinaryOnes) {
  EXPECT_EQ(told_of(std::string(kGoodScene)), "");
}

// What is computed or has a unit is meant, and what differs is no twin.
TEST(DoubtfulScenes, AreNotThoseOfWhatIsMeant) {
  const std::string bar =
      "  bar: {type: distance, from: {ground: [1, 3, 0]}, to: {body: rod}, length: 1 m}\n"
      "  rail: {type: distance, from: {ground: [1, 3, 0]}, to: {body: rod}, length: 2 m}\nsprings:";
  const std::string couplings =
      "  one: {type: coupling, terms: [{joint: pin, factor: 2}, {joint: shaft, factor: 1}], constant: 1}\n"
      "  two: {type: coupling, terms: [{joint: pin, factor: 2}, {joint: shaft, factor: 1}], constant: 2}\n"
      "springs:";
  for (const Broken& meant :
       {Broken{"", "angle: 30 deg", "angle: = 2*pi*9/8", ""},
        Broken{"", "angle: 30 deg", "angle: 30 rad", ""},
        Broken{"", "position: 0 deg}", "position: = 3*15}", ""},
        Broken{"", "position: 0 deg}", "position: 45 rad}", ""}, Broken{"", "springs:", bar.c_str(), ""},
        Broken{"", "springs:", couplings.c_str(), ""}}) {
    const TextFiles files;
    EXPECT_THAT(load_scene(files.write("scene.yaml", with(meant))).warnings, testing::IsEmpty())
        << meant.replacement;
  }
}

class DoubtfulScenes : public testing::TestWithParam<Broken> {};

TEST_P(DoubtfulScenes, AreToldWithPlaceValueAndLikelyMeaning) {
  EXPECT_THAT(told_of(with(GetParam())), testing::HasSubstr(GetParam().message));
}

constexpr Broken kDoubtful[] = {
    Broken{"ModulusInGPa", "young: 210 GPa", "young: 210",
           "scene.yaml:7:3: bodies.beam: warning: no solid is as soft for its density (got young 210 Pa, "
           "density "
           "7850 kg/m3, where sound runs 0.164 m/s)\n"
           "  is the modulus in GPa? write '210 GPa' then"},
    Broken{"ModulusInMPa", "young: 210 GPa", "young: 210000",
           "is the modulus in MPa (N/mm2)? write '210000 MPa'"},
    Broken{"DensityInGramsPerCubicCentimetre", "density: 7850", "density: 7.85",
           "is the density in g/cm3? write '7.85 g/cm3' then"},
    Broken{"DensityInTonnesPerCubicMillimetre", "density: 7850", "density: 7.85e-9",
           "is the density in t/mm3? write '7.85e-09 t/mm3' then"},
    Broken{"DampingInPerCent", "damping: 2 %", "damping: 2",
           "scene.yaml:14:16: bodies.beam.flexible.damping: warning: modes are damped beyond critically (got "
           "a damping "
           "ratio of 2)\n  is it in per cent? write '2 %' then, or '200 %' if not"},
    Broken{"DampingOfOneModeInPerCent", "modes: all\n      damping: 2 %",
           "modes: 4\n      damping: [0, 0, 0, 3]",
           "flexible.damping[4]: warning: modes are damped beyond critically"},
    Broken{"TireDampingInPerCent", "damping_ratio: 0.02", "damping_ratio: 2",
           "warning: the tire is damped beyond critically (got a damping ratio of 2)"},
    Broken{"GravityUpwards", "[0, 0, -9.81]", "[0, 0, 9.81]",
           "gravity: warning: gravity points away from the road (got [0, 0, 9.81] m/s2)"},
    Broken{"GravityInMillimetres", "[0, 0, -9.81]", "[0, 0, -9810]",
           "is it in mm/s2? write '9810 mm/s2' then"},
    Broken{"OrientationInDegrees", "angle: 30 deg", "angle: 30",
           "warning: the angle is more than a turn (got 30 rad)\n  is it in degrees? write '30 deg' then"},
    Broken{"JointPositionInDegrees", "position: 0 deg}", "position: 45}",
           "joints.pin.position: warning: the joint starts turns away from its design pose (got 45 rad"},
    Broken{"SpringTwice", "loads:",
           "  twin: {from: {body: rod}, to: {ground: [1, 3, 0]}, stiffness: 2 kN/m, damping: 5, free_length: "
           "1 m}\nloads:",
           "warning: this spring is the same as 'coil' (got 'twin')"},
    Broken{"LoadTwice", "tire_models:", "  shove: {body: rod, force: [0, 1 N, 0]}\ntire_models:",
           "warning: this load is the same as 'push' (got 'shove')"},
    Broken{"JointTwice", "closures:",
           "  peg: {type: revolute, bodies: [ground, rod], at: [0, 2, 0], axis: [0, 0, -1]}\nclosures:",
           "warning: this joint is the same as 'pin' (got 'peg')"},
    Broken{"GearTwice", "springs:",
           "  again: {type: gear, driver: {joint: pin}, driven: {joint: shaft}, ratio: -2}\nsprings:",
           "warning: this closure is the same as 'mesh' (got 'again')"},
    Broken{"TireStiffnessPerMillimetre", "vertical_stiffness: 200 kN/m", "vertical_stiffness: 200",
           "warning: the tires cannot carry the bodies"},
    Broken{"WheelInertiaInSquareMillimetres", "inertia: [1, 2, 1]", "inertia: [1e6, 2e6, 1e6]",
           "warning: the inertia about the spin axis does not suit the wheel's mass and radius"},
    Broken{"InertiaInSquareMillimetres", "{mass: 2, inertia: [0.1, 0.1, 0.1], position: [2, 2, 0]}",
           "{mass: 2, inertia: [1e5, 1e5, 1e5], position: [2, 2, 0]}",
           "warning: the body has the inertia of one much larger than itself (got a radius of gyration of "
           "224 m"},
    Broken{
        "TireInTheAir", "axis: [0, 0, 1], position: 0}", "axis: [0, 0, 1], position: 0.3}",
        "tire 'tire' at t = 0 s: warning: the tire is in the air at the start (got 0.2838 m above the road)"},
    Broken{"WheelAxisTurnedAway", "position: [0, 0, 0.2988]}",
           "position: [0, 0, 0.2988], orientation: {axis: [0, 0, 1], angle: 90 deg}}",
           "warning: the joint 'hub' does not turn the wheel about its spin axis"},
    Broken{"WheelAcrossItsWay", "position: [0, 0, 0.2988]}",
           "position: [0, 0, 0.2988], orientation: {axis: [0, 0, 1], angle: 90 deg}}",
           "warning: the wheel starts across the way that it goes"},
    Broken{"SpeedInKilometresPerHour", "speed: 20 m/s", "speed: 120",
           "warning: no tire is as fast (got 120 m/s, which are 432 km/h)\n"
           "  is the speed in km/h? write '120 km/h' then"},
};
INSTANTIATE_TEST_SUITE_P(All, DoubtfulScenes, testing::ValuesIn(kDoubtful),
                         [](const auto& each) { return each.param.name; });

template <class Load>
std::string refusal_of(const std::string& scene_text, Load load) {
  const TextFiles files;
  const auto file = files.write("scene.yaml", scene_text);
  try {
    load(file, files / "out.h5");
  } catch (const InputError& error) {
    return files.relative(error.what());
  }
  return "no error";
}

/// What cannot be meant at all is refused, with its place.
class RefusedDoubts : public testing::TestWithParam<Broken> {};

TEST_P(RefusedDoubts, TellTheirPlace) {
  const std::string message = refusal_of(with(GetParam()), [](const auto& file, const auto& out) {
    const Scene scene = load_scene(file);
    run_scene(scene, compile(scene), {file, out, {}, {}});
  });
  EXPECT_THAT(message, testing::HasSubstr(GetParam().message));
}

constexpr Broken kRefused[] = {
    Broken{"GearOfAJointWithItself", "driven: {joint: shaft}", "driven: {joint: pin}",
           "scene.yaml:24:44: closures.mesh.driven: error: the coordinate is driven by itself"},
    Broken{"CoordinateTwiceInACoupling",
           "{type: gear, driver: {joint: pin}, driven: {joint: shaft}, ratio: -2}",
           "{type: coupling, terms: [{joint: pin, factor: 1}, {joint: pin, factor: 2}]}",
           "scene.yaml:24:59: closures.mesh.terms[2]: error: the coordinate is in the coupling already"},
    Broken{"PoissonInPerCent", "poisson: 0.3", "poisson: 30", "error:"},
    Broken{"InertiaOfNoBody", "inertia: [1, 2, 1]", "inertia: [1, 4, 1]", "no body can have this inertia"},
    Broken{"FormWithoutClosures", "rtol: 1e-5", "rtol: 1e-5, form: ode",
           "scene.yaml:35:1: analysis: analysis.form: error: form ode"},
    Broken{"IntegratorOfAnotherForm", "rtol: 1e-5", "rtol: 1e-5, form: ggl, integrator: erk",
           "scene.yaml:35:1: analysis: analysis.integrator: error: form ggl"},
    Broken{"ResultsOfOneName", "  mesh: {type", "  pin: {type",
           "scene.yaml:24:3: closures.pin: error: 'pin' is the name of"},
    Broken{"DriveNamedAsASpring", "  push: {body: rod, force: [0, 1 N, 0]}",
           "  coil: {joint: pin, moment: 1}", "loads.coil: error: 'coil' is the name of"},
};
INSTANTIATE_TEST_SUITE_P(All, RefusedDoubts, testing::ValuesIn(kRefused),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace wishbone
