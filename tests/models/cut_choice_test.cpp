// The spanning tree: which joints are cut decides what a run costs, never what the mechanism does.
#include "models/spanning_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "models/compile.h"
#include "models/joint_choices.h"
#include "models/plan.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A spatial four-bar: a crank turns about z, a coupler hangs on ball joints, a rocker swings about x. The coupler may spin
/// about itself; friction damps the crank. Nothing is redundant, so that reactions are unique.
constexpr const char* kSpatialFourBar = R"(
wishbone: 1
bodies:
  crank: {mass: 1, inertia: [0.02, 0.03, 0.04], position: [0.05, 0.1, 0]}
  coupler: {mass: 2, inertia: [0.2, 0.1, 0.2], position: [0.3, 0.3, 0.2], orientation: {axis: [1, 2, 3], angle: 0.4}}
  rocker: {mass: 1.5, inertia: [0.1, 0.05, 0.1], position: [0.6, 0.3, 0.2]}
joints:
  motor: {type: revolute, bodies: [ground, crank], at: [0, 0, 0], axis: [0, 0, 1], friction: {coulomb: 0.1, smoothing: 0.5}, MOTOR}
  near: {type: spherical, bodies: [crank, coupler], at: [0.1, 0.2, 0], NEAR}
  far: {type: spherical, bodies: [rocker, coupler], at: [0.6, 0.4, 0.4], FAR}
  hinge: {type: revolute, bodies: [ground, rocker], at: [0.6, 0.2, 0], axis: [1, 0, 0], HINGE}
loads:
  push: {body: crank, moment: [0, 0, 2]}
analysis: {duration: 1 s}
)";

std::string replaced(std::string text, const std::map<std::string, std::string>& with) {
  for (const auto& [word, by] : with)
    for (auto at = text.find(", " + word + "}"); at != std::string::npos; at = text.find(", " + word + "}"))
      text.replace(at, word.size() + 3, by.empty() ? "}" : ", " + by + "}");
  return text;
}

/// The scene with one joint pinned as cut, or with none.
Scene scene_cut_at(const std::string& joint) {
  const TextFiles files;
  std::map<std::string, std::string> with{{"MOTOR", ""}, {"NEAR", ""}, {"FAR", ""}, {"HINGE", ""}};
  if (!joint.empty()) with[joint] = "cut: true";
  return load_scene(files.write("scene.yaml", replaced(kSpatialFourBar, with)));
}

using Signals = std::map<std::string, std::vector<std::vector<double>>>;  // by path, a row for each output

Signals run(const Scene& scene) {
  const CompiledScene compiled = compile(scene);
  TransientOptions options;
  options.duration = 1;
  options.interval = 0.1;
  options.integrator.rtol = options.integrator.atol = 1e-11;
  Workspace ws(compiled.system);
  Observer observer(compiled.system, compiled.observer);
  Signals signals;
  const TransientSummary summary = run_transient(
      compiled.system, compiled.initial, options, ws, [&](const State& state, const Work& work) {
        const double* row = observer.sample(state, work, ws).data();
        for (const Signal& signal : observer.signals()) {
          signals[signal.path].emplace_back(row, row + signal.size());
          row += signal.size();
        }
      });
  EXPECT_EQ(summary.status, TransientSummary::Status::complete) << summary.message;
  return signals;
}

/// What does not depend on coordinates: motion of bodies, reactions, forces and energies.
bool is_physical(const std::string& path) {
  for (const char* part : {"/bodies/", "/force", "/moment", "/energy/"})
    if (path.find(part) != std::string::npos) return true;
  return false;
}

double largest(const std::vector<std::vector<double>>& rows) {
  double value = 0;
  for (const auto& row : rows)
    for (const double x : row) value = std::max(value, std::abs(x));
  return value;
}

class Cuts : public testing::TestWithParam<const char*> {};

TEST_P(Cuts, ChangeNeitherMotionNorReactions) {
  const Signals reference = run(scene_cut_at(""));
  const Signals other = run(scene_cut_at(GetParam()));
  ASSERT_GT(largest(reference.at("/joints/far/force")), 1.0) << "something is to be compared [N]";
  ASSERT_GT(largest(reference.at("/bodies/rocker/angular_velocity")), 0.1) << "it moves [rad/s]";
  int compared = 0;
  for (const auto& [path, rows] : reference) {
    if (!is_physical(path)) continue;
    ASSERT_TRUE(other.contains(path)) << path;
    const double scale = std::max(1.0, largest(rows));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t k = 0; k < rows[i].size(); ++k)
        EXPECT_NEAR(rows[i][k], other.at(path)[i][k], 1e-7 * scale) << path << " row " << i;
    ++compared;
  }
  EXPECT_GE(compared, 3 * 4 + 4 * 2) << "bodies and joints";
}
INSTANTIATE_TEST_SUITE_P(, Cuts, testing::Values("MOTOR", "NEAR", "FAR", "HINGE"),
                         [](const auto& p) { return std::string(p.param); });

TEST(CutJoints, CostAsManyRowsAsTheirJoints) {
  const auto rows = [](const char* joint) {
    const Scene scene = scene_cut_at(joint);
    return make_plan(scene, compile(scene)).closure_rows;
  };
  EXPECT_EQ(rows(""), 3) << "a ball joint is cheapest";
  EXPECT_EQ(rows("FAR"), 3);
  EXPECT_EQ(rows("MOTOR"), 5);
  EXPECT_EQ(rows("HINGE"), 5);
}

TEST(CutJoints, AreExplainedInThePlan) {
  const auto choice = [](const char* pin, std::size_t joint) {
    const Scene scene = scene_cut_at(pin);
    return make_plan(scene, compile(scene)).joints.at(joint);
  };
  const JointChoice far = choice("", 2);
  EXPECT_TRUE(far.cut);
  EXPECT_FALSE(far.pinned);
  EXPECT_EQ(far.saved, 2);
  EXPECT_THAT(far.loop, ElementsAre("motor", "near", "hinge"));
  const JointChoice motor = choice("MOTOR", 0);
  EXPECT_TRUE(motor.cut && motor.pinned);
  EXPECT_EQ(motor.saved, -2);
  EXPECT_THAT(motor.reason, HasSubstr("pinned"));
  EXPECT_FALSE(choice("MOTOR", 1).cut);
}

TEST(CutJoints, MobilityIsThatOfTheMechanism) {
  // the crank, and the spin of the coupler about its ball joints
  for (const char* joint : {"", "MOTOR", "NEAR", "FAR", "HINGE"}) {
    const Scene scene = scene_cut_at(joint);
    const Plan plan = make_plan(scene, compile(scene));
    EXPECT_EQ(plan.mobility, 2) << joint;
    EXPECT_EQ(plan.rank, plan.closure_rows) << joint;
  }
}

TEST(SpanningTree, CutsTheCheapestJointOfALoop) {
  // a triangle on the ground: joints of 5, 3 and 5 rows
  const SpanningTree tree =
      span({{}, {}}, {{-1, 0, 5, {}, false}, {0, 1, 3, {}, false}, {1, -1, 5, {}, false}});
  EXPECT_THAT(tree.roles,
              ElementsAre(JointRole::carries_second, JointRole::closes, JointRole::carries_first));
}

}  // namespace
}  // namespace wishbone
