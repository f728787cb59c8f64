// The form of a body is one switch: it does not change where a scene starts, nor how fast.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "models/compile.h"
#include "models/scene_loader.h"
#include "solver/kinematics.h"
#include "text_files.h"

namespace wishbone {
namespace {

struct Moving {
  Pose X_WB;
  Vector6 V;
};

/// Bodies in the order of the scene.
std::vector<Moving> start_of(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const Scene scene = load_scene(file, overrides);
  const CompiledScene compiled = compile(scene);
  State state = compiled.initial;
  Workspace ws(compiled.system);
  assemble(compiled.system, state, ws, compiled.transient.given);
  update_positions<double>(compiled.system, 0, state.q, ws);
  update_velocities<double>(compiled.system, 0, state.q, state.v, ws);
  std::vector<Moving> bodies;
  for (const Scene::Body& body : scene.bodies)
    for (std::size_t i = 0; i < ws.bodies.size(); ++i)
      if (compiled.system.bodies[i].name == body.name) bodies.push_back({ws.bodies[i].X_WB, ws.bodies[i].V});
  EXPECT_EQ(bodies.size(), scene.bodies.size());
  return bodies;
}

void expect_equal_starts(const std::filesystem::path& file, const std::vector<std::string>& rigid,
                         const std::vector<std::string>& others) {
  const std::vector<Moving> wanted = start_of(file, rigid);
  double size = 1e-3;
  for (const Moving& body : wanted) size = std::max(size, body.V.norm());
  for (const std::string& form : others) {
    std::vector<std::string> overrides = rigid;
    overrides.front() = form;
    const std::vector<Moving> found = start_of(file, overrides);
    for (std::size_t b = 0; b < wanted.size(); ++b) {
      EXPECT_LT((found[b].X_WB.p - wanted[b].X_WB.p).norm(), 1e-11) << file << " " << form << " body " << b;
      EXPECT_LT((found[b].X_WB.R - wanted[b].X_WB.R).norm(), 1e-11) << file << " " << form << " body " << b;
      EXPECT_LT((found[b].V - wanted[b].V).norm(), 1e-9 * size) << file << " " << form << " body " << b;
    }
  }
}

const std::filesystem::path kScenes = WISHBONE_SCENES;

TEST(StartInAllForms, OfTheFlexibleArm) {
  expect_equal_starts(kScenes / "examples/flexible_arm.yaml", {"form=rigid"}, {"form=modal"});
}

// In line: with its skew axis only the deflections let it move.
TEST(StartInAllForms, OfTheFlexibleFourBar) {
  expect_equal_starts(kScenes / "benchmarks/flexible_four_bar.yaml", {"form=rigid", "misalignment=0"},
                      {"form=modal"});
}

TEST(StartInAllForms, OfTheCarOnItsManoeuvres) {
  for (const char* scene : {"impulse_steer.yaml", "sine_depression.yaml"})
    expect_equal_starts(kScenes / scene, {"chassis=rigid"},
                        {"chassis=modal", "chassis=nodal", "chassis=nodal_fixed"});
}

/// An arm on a hub and a bob that hangs on its end; what is left open is how they start.
std::string arm(const std::string& axle, const std::string& clamp, const std::string& hook,
                const std::string& motions = "") {
  return R"(wishbone: 1
gravity: [0, 0, 0]
parameters: {form: {default: modal, choices: [modal, nodal, rigid]}}
bodies:
  hub: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [0, 0, 0]}
  arm:
    form: = form
    mass: 1.84
    inertia: [0.0005, 0.1536, 0.1536]
    position: [0.5, 0, 0]
    flexible:
      block: {size: [1 m, 40 mm, 40 mm], elements: [4, 1, 1]}
      material: {young: 2 GPa, poisson: 0.4, density: 1150}
      modes: {select: form, modal: 8, nodal: 54, rigid: 8}
      frames: {near: {nodes: [1, 2, 3, 4]}, far: {nodes: [17, 18, 19, 20]}}
  bob: {mass: 1, inertia: [0.01, 0.01, 0.01], position: [1, 0, -0.3]}
joints:
  axle: {type: revolute, bodies: [ground, hub], at: [0, 0, 0], axis: [0, 0, 1])" +
         axle + R"(}
  clamp: {bodies: [hub, {body: arm, frame: near}], )" +
         clamp + R"(}
  hook: {type: revolute, bodies: [{body: arm, frame: far}, bob], axis: [0, 1, 0])" +
         hook + "}\n" + motions;
}

class ArmOnAHub : public testing::TestWithParam<std::string> {};

TEST_P(ArmOnAHub, StartsAlikeInAllForms) {
  const TextFiles files;
  expect_equal_starts(files.write("arm.yaml", GetParam()), {"form=rigid"}, {"form=modal", "form=nodal"});
}

INSTANTIATE_TEST_SUITE_P(
    Ways, ArmOnAHub,
    testing::Values(arm(", speed: 5 rad/s, position: 30 deg", "type: fixed", ""),
                    arm(", motion: spin", "type: fixed", ", speed: 2 rad/s",
                        "motions: {spin: {expression: 0.3 + 5*t}}\n"),
                    arm(", speed: 5", "type: revolute, axis: [0, 0, 1], position: 20 deg, speed: -1",
                        ", position: 40 deg"),
                    arm(", speed: 5", "type: revolute, axis: [0, 0, 1], motion: fold", "",
                        "motions: {fold: {expression: 0.2 + sin(3*t)}}\n"),
                    arm("", "type: spherical, speed: [0, 1, 2]", ", speed: 3"),
                    arm("", "type: fixed", "")
                        .replace(arm("", "type: fixed", "").find("bob: {"), 6, "bob: {velocity: [0, 2, 0], "),
                    arm(", speed: 5", "type: fixed, cut: false", "")));

// An arm clamped to a hub that spins turns with it: its tip moves with 5 rad/s times its distance.
TEST(StartInAllForms, OfAnArmOnADrivenHubIsThatOfARigidOne) {
  const TextFiles files;
  const auto file = files.write(
      "arm.yaml", arm(", motion: spin", "type: fixed", "", "motions: {spin: {expression: 5*t}}\n"));
  const std::vector<Moving> bodies = start_of(file, {});
  EXPECT_LT((linear(bodies[1].V) - Vector3(0, 2.5, 0)).norm(), 1e-10);
  EXPECT_LT((angular(bodies[1].V) - Vector3(0, 0, 5)).norm(), 1e-10);
  EXPECT_LT((linear(bodies[2].V) - Vector3(0, 5, 0)).norm(), 1e-10);
}

}  // namespace
}  // namespace wishbone
