// The scenes that a newcomer tries first.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

const std::filesystem::path kExamples = std::filesystem::path(WISHBONE_SCENES) / "examples";

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ExampleScenes, LoadWithoutComplaint) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kExamples)) {
    EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(ExampleScenes, RunWithoutAWarning) {
  const TemporaryFolder folder;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(WISHBONE_SCENES)) {
    if (entry.path().extension() != ".yaml" || entry.path().filename() == "car.yaml")
      continue;  // car: included
    const Scene scene = load_scene(entry.path());
    CompiledScene compiled = compile(scene);
    compiled.transient.duration = std::min(compiled.transient.duration, 1.0);
    compiled.transient.interval = std::min(compiled.transient.interval, 0.01);
    const RunResult result = run_scene(scene, compiled, {entry.path(), folder / "out.h5", {}, {}});
    EXPECT_EQ(result.summary.status, TransientSummary::Status::complete) << entry.path();
    for (const Diagnostic& warning : result.warnings)
      ADD_FAILURE() << entry.path() << ": " << warning.warning();
  }
}

TEST(ExampleScenes, PendulumIsTheOneThatTheReadmeShows) {
  const std::string readme = text_of(kExamples / "../../../README.md");
  EXPECT_THAT(readme, testing::HasSubstr("```yaml\n" + text_of(kExamples / "pendulum.yaml") + "```"));
}

TEST(ExampleScenes, PendulumIsAUniformRodHungByItsEnd) {
  const Scene scene = load_scene(kExamples / "pendulum.yaml");
  ASSERT_EQ(scene.bodies.size(), 1u);
  ASSERT_EQ(scene.joints.size(), 1u);
  const Scene::Body& rod = scene.bodies[0];
  const Vector3 p_PinBo = rod.X_DB.p - scene.joints[0].second.p_DP;
  const double length = 2 * p_PinBo.norm();
  EXPECT_NEAR(rod.inertia(1, 1), rod.mass * length * length / 12, 1e-12);  // m L^2 / 12 about the middle
  EXPECT_NEAR(scene.joints[0].position.front().value(), 1.0471975511965976, 1e-12);  // pi/3
}

}  // namespace
}  // namespace wishbone
