// A force or motion without a finite value ends the run with its name, whatever the form and the method.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

/// What undoes a force at about t = 0.05 s.
constexpr const char* kFaults[] = {"sqrt(0.05 - t)", "ln(0.05 - t)",    "t < 0.05 ? 1 : exp(2e4*t)",
                                   "asin(20*t)",     "1/(0.05 - t)",    "t < 0.05 ? 1 : 10^(6150*t)",
                                   "0*t/(t < 0.05)", "sqrt(0.5 - turn)"};
/// Who suffers it; %s is the fault.
constexpr const char* kVictims[] = {
    "loads: {culprit: {body: arm, force: [0, {expression: '%s'}, 0]}}",
    "loads: {culprit: {body: arm, moment: [0, 0, {expression: '%s'}], axes: body}}",
    "loads: {culprit: {joint: pin, moment: {expression: '%s'}}}",
};
constexpr const char* kSolvers[] = {
    "form: ode, integrator: erk",       "form: ode, integrator: adams",  "form: ode, integrator: bdf",
    "form: index1, integrator: erk",    "form: index1, integrator: bdf", "form: index1, integrator: adams",
    "form: partition, integrator: bdf", "form: ggl, integrator: bdf",
};

std::string scene_of(const std::string& fault, std::string victim, const std::string& solver) {
  victim.replace(victim.find("%s"), 2, fault);
  const bool closed = solver.find("ode") == std::string::npos;
  return "wishbone: 1\ngravity: [0, -9.81, 0]\nbodies:\n"
         "  arm: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [1, 0, 0]}\n"
         "  cog: {mass: 1, inertia: [0.1, 0.1, 0.1], position: [3, 0, 0]}\n"
         "joints:\n"
         "  pin: {type: revolute, bodies: [ground, arm], at: [0, 0, 0], axis: [0, 0, 1], speed: 10}\n"
         "  shaft: {type: revolute, bodies: [ground, cog], at: [3, 0, 0], axis: [0, 0, 1], speed: -10}\n" +
         std::string(
             closed
                 ? "closures: {mesh: {type: gear, driver: {joint: pin}, driven: {joint: shaft}, ratio: -1}}\n"
                 : "") +
         "signals: {turn: {joint: pin}}\n" + victim + "\nanalysis: {duration: 0.2, rtol: 1e-6, atol: 1e-8, " +
         solver + "}\noutput: {interval: 0.01}\n";
}

/// How the run ends: its message when it fails, "complete" otherwise.
std::string end_of(const std::string& scene_text) {
  const TextFiles files;
  const auto file = files.write("scene.yaml", scene_text);
  try {
    const Scene scene = load_scene(file);
    const RunResult result = run_scene(scene, compile(scene), {file, files / "out.h5", {}, {}});
    const bool failed = result.summary.status == TransientSummary::Status::failed;
    return failed ? result.summary.message : "complete";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(NamedFaults, OfForcesByExpressionInEveryFormAndMethod) {
  int count = 0;
  for (const char* fault : kFaults)
    for (const char* victim : kVictims)
      for (const char* solver : kSolvers) {
        const std::string message = end_of(scene_of(fault, victim, solver));
        EXPECT_THAT(message, HasSubstr("culprit")) << fault << ", " << victim << ", " << solver;
        ++count;
      }
  EXPECT_EQ(count, 192);
}

TEST(NamedFaults, TellTheExpressionAndItsInputs) {
  const std::string message = end_of(scene_of("sqrt(0.5 - turn)", kVictims[2], "form: ode, integrator: erk"));
  EXPECT_THAT(message,
              testing::AllOf(HasSubstr("nan of 'sqrt(0.5 - turn)' with turn = 0.5"), HasSubstr("t = 0.0")));
}

TEST(NamedFaults, OfMotionsInEveryFormAndMethod) {
  for (const char* solver : kSolvers)
    for (const char* fault : {"sqrt(0.05 - t)", "ln(0.05 - t)", "asin(20*t)", "1/(0.05 - t)"}) {
      std::string text = scene_of("0*t", kVictims[0], solver);
      text.replace(text.find("speed: 10}"), 10, "motion: drive}");
      const std::string given = ", speed: -10";  // the motion says how fast the gears turn
      text.erase(text.find(given), given.size());
      text += "motions: {drive: {expression: '" + std::string(fault) + "'}}\n";
      EXPECT_THAT(end_of(text), testing::AnyOf(HasSubstr("drive"), HasSubstr("pin")))
          << fault << ", " << solver;
    }
}

TEST(NamedFaults, OfATableThatIsNotOfNumbersIsAnInputErrorWithItsPlace) {
  for (const char* value : {".nan", "nan", ".inf", "-inf", "1e999"}) {
    const std::string table =
        std::string("loads: {culprit: {joint: pin, moment: {table: {points: [[0, 1], [1, ") + value +
        "]]}}}}";
    std::string text = scene_of("0*t", "loads: {x: {joint: pin, moment: {expression: '%s'}}}", kSolvers[0]);
    text.replace(text.find("loads:"), text.find("\nanalysis") - text.find("loads:"), table);
    EXPECT_THAT(end_of(text), HasSubstr("loads.culprit.moment.table.points[2][2]: error:")) << value;
  }
}

}  // namespace
}  // namespace wishbone
