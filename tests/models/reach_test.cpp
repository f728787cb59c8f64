// A motion that leads beyond what the mechanism can reach ends the run there, by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "solver/failure_cause.h"
#include "solver/progress_guard.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

Scene read(const std::string& text) {
  return load_scene(TextFiles().write("scene.yaml", text));
}

TransientSummary run(const std::string& text) {
  const TextFiles files;
  const Scene scene = load_scene(files.write("scene.yaml", text));
  return run_scene(scene, compile(scene), {"scene.yaml", files / "out.h5", {}, {}}).summary;
}

/// A crank of 0.2 m and a coupler of sqrt(0.52) m; the rocker of 0.4 m stands upright and is driven.
std::string crank_rocker(const std::string& rocker, const std::string& rest) {
  return R"(wishbone: 1
bodies:
  crank: {mass: 1, inertia: [0.01, 0.02, 0.02], position: [0.1, 0, 0]}
  coupler: {mass: 2, inertia: [0.02, 0.1, 0.1], position: [0.5, 0.2, 0]}
  rocker: {mass: 1.5, inertia: [0.05, 0.01, 0.05], position: [0.8, 0.2, 0]}
joints:
  A: {type: revolute, bodies: [ground, crank], at: [0, 0, 0], axis: [0, 0, 1]}
  B: {type: revolute, bodies: [crank, coupler], at: [0.2, 0, 0], axis: [0, 0, 1]}
  C: {type: spherical, bodies: [coupler, rocker], at: [0.8, 0.4, 0]}
  D: {type: revolute, bodies: [ground, rocker], at: [0.8, 0, 0], axis: [0, 0, 1])" +
         rocker + "}\n" + rest + "analysis: {duration: 3 s}\n";
}

// |AC|^2 = 0.8 - 0.64 sin(angle) has shrunk to (coupler - crank)^2.
const double kReach = std::asin((0.8 - std::pow(std::sqrt(0.52) - 0.2, 2)) / 0.64);

TEST(MotionBeyondReach, OfARockerIsToldByJointAndTime) {
  const TransientSummary s = run(crank_rocker(", motion: swing", "motions: {swing: {expression: 1*t}}\n"));
  EXPECT_EQ(s.status, TransientSummary::Status::failed);
  EXPECT_THAT(s.message, HasSubstr("joint 'D': error: the mechanism cannot follow the prescribed motion"));
  EXPECT_NEAR(s.t_end, kReach, 1e-5);
  EXPECT_TRUE(s.singular_passages.empty());
}

TEST(MotionBeyondReach, OfACutJointIsToldByItsRow) {
  const TransientSummary s =
      run(crank_rocker(", motion: swing, cut: true", "motions: {swing: {expression: 1*t}}\n"));
  EXPECT_EQ(s.status, TransientSummary::Status::failed);
  EXPECT_THAT(s.message, HasSubstr("'D_drive': error: the mechanism cannot follow the prescribed motion"));
  EXPECT_NEAR(s.t_end, kReach, 1e-5);
}

TEST(MotionBeyondReach, OfAnActuatorIsToldByItsName) {
  const TransientSummary s =
      run(crank_rocker("",
                       "motions: {pull: {expression: sqrt(0.8) - 0.2*t}}\n"
                       "closures: {actuator: {type: distance, from: {ground: [0, 0, 0]}, "
                       "to: {body: rocker, at: [0.8, 0.4, 0]}, motion: pull}}\n"));
  EXPECT_EQ(s.status, TransientSummary::Status::failed);
  EXPECT_THAT(s.message, HasSubstr("'actuator': error: the mechanism cannot follow the prescribed motion"));
  EXPECT_NEAR(s.t_end, (std::sqrt(0.8) - (std::sqrt(0.52) - 0.2)) / 0.2, 1e-3);
}

TEST(MotionBeyondReach, IsToldWhateverTheFormAndTheIntegrator) {
  const Scene scene = read(crank_rocker(", motion: swing", "motions: {swing: {expression: 1*t}}\n"));
  for (const auto& [form, method] : {std::pair(Form::index1, Method::erk),
                                     {Form::index1, Method::bdf},
                                     {Form::index1, Method::adams},
                                     {Form::partition, Method::erk},
                                     {Form::partition, Method::bdf},
                                     {Form::ggl, Method::bdf}}) {
    SCOPED_TRACE(std::string(to_string(form)) + " " + std::string(to_string(method)));
    CompiledScene compiled = compile(scene);
    compiled.transient.integrator.form = form;
    compiled.transient.integrator.method = method;
    Workspace ws(compiled.system);
    const TransientSummary s = run_transient(compiled.system, compiled.initial, compiled.transient, ws,
                                             [](const State&, const Work&) {});
    EXPECT_EQ(s.status, TransientSummary::Status::failed);
    EXPECT_THAT(s.message, HasSubstr("the mechanism cannot follow the prescribed motion"));
    EXPECT_NEAR(s.t_end, kReach, 1e-3);
  }
}

TEST(MotionBeyondReach, IsNoCauseOfOtherErrorsThere) {
  const Scene scene = read(crank_rocker(", motion: swing", "motions: {swing: {expression: 1*t}}\n"));
  const CompiledScene compiled = compile(scene);
  Workspace ws(compiled.system);
  run_transient(compiled.system, compiled.initial, compiled.transient, ws, [](const State&, const Work&) {});
  const Diagnostic other{"out.h5", "no space left on device", "", ""};
  const auto told = [&](const NumericsError& error) {
    return std::string(explained(error, compiled.system, kReach, VectorX(), ws).what());
  };
  EXPECT_EQ(told(NumericsError(other)), NumericsError(other).what());
  EXPECT_THAT(told(StepsFailed(other)), HasSubstr("the mechanism cannot follow the prescribed motion"));
}

}  // namespace
}  // namespace wishbone
