// Flexible bodies of scenes whose modes are identified.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compiled_modes.h"
#include "core/error.h"
#include "identification/formats/mode_file.h"
#include "models/compile.h"
#include "models/identification_files.h"
#include "models/plan.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view kScene = R"(wishbone: 1
parameters:
  form: {default: modal, choices: [rigid, modal]}
bodies:
  frame:
    form: = form
    mass: 100
    inertia: [1, 2, 2]
    position: [0, 0, 0]
    flexible:
      block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}
      material: {young: 210 MPa, poisson: 0.3, density: 2600}
      modes:
        measured: {from: model}
        support: {springs: [{nodes: [1, 2, 11, 12], stiffness: 47 kN/m}]}
joints:
  hold: {type: spherical, bodies: [ground, {body: frame, node: 1}], cut: true}
analysis: {duration: 1 ms}
)";
constexpr std::string_view kModes = R"(        measured: {from: model}
        support: {springs: [{nodes: [1, 2, 11, 12], stiffness: 47 kN/m}]}
)";
constexpr std::string_view kBlock = R"(      block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}
      material: {young: 210 MPa, poisson: 0.3, density: 2600}
)";

class IdentifiedBodies : public testing::Test {
 protected:
  Scene load(const std::vector<std::pair<std::string_view, std::string_view>>& changes = {},
             const std::vector<std::string>& set = {}) const {
    std::string text(kScene);
    for (const auto& [old, replacement] : changes) {
      const auto at = text.find(old);
      EXPECT_NE(at, std::string::npos) << old;
      text.replace(at, old.size(), replacement);
    }
    return load_scene(files_.write("scene.yaml", text), set);
  }
  template <class Step>
  std::string message(Step step) const {
    return files_.relative(message_of<InputError>(step));
  }
  IdentificationFiles files_;
};

TEST_F(IdentifiedBodies, HaveTheModesOfTheirModel) {
  const CompiledScene identified = compile(load());
  const CompiledScene block =
      compile(load({{std::string("modes:\n") + std::string(kModes), "modes: all\n"}}));
  ASSERT_EQ(compiled_modes(identified).mode_count(), 30);
  EXPECT_LE((compiled_modes(identified).omega - compiled_modes(block).omega).cwiseAbs().maxCoeff(),
            1e-8 * compiled_modes(block).omega.maxCoeff());
  EXPECT_LE((compiled_modes(identified).node_position - compiled_modes(block).node_position).norm(), 1e-12);
}

TEST_F(IdentifiedBodies, NeedNoBlock) {
  const Scene scene = load({{kBlock, ""},
                            {kModes,
                             "        measured: {file: test.csv}\n        support: {springs: [{nodes: [1, 2, "
                             "11, 12], stiffness: 47 kN/m}]}\n"}});
  EXPECT_EQ(scene.bodies[0].flexible->node_ids.size(), 12u);
  EXPECT_EQ(compiled_modes(compile(scene)).mode_count(), 30);
  EXPECT_THAT(scene.data_files, testing::Contains((files_ / "test_shapes.csv").string()));
}

TEST_F(IdentifiedBodies, AreNotIdentifiedWhenRigidButHaveTheirNodes) {
  const Scene scene = load({}, {"form=rigid"});
  const CompiledScene compiled = compile(scene);
  EXPECT_TRUE(compiled.identified.empty());
  EXPECT_TRUE(compiled.system.flexible.empty());
  EXPECT_EQ(scene.bodies[0].flexible->node_ids.size(), 12u);
}

TEST_F(IdentifiedBodies, AreDampedAsMeasuredUnlessTheSceneSaysOtherwise) {
  const auto ratios = [&](std::string_view damping) {
    const CompiledScene compiled = compile(load({{"      modes:\n", damping}}));
    return compiled_modes(compiled).damping_ratio;
  };
  EXPECT_EQ(ratios("      modes:\n"), VectorX::Zero(30));
  EXPECT_LE((ratios("      damping: 2 %\n      modes:\n").array() - 0.02).abs().maxCoeff(), 1e-16);
  std::string list = "      damping: [0.001";
  for (int j = 2; j <= 30; ++j) list += ", " + std::to_string(j) + "e-3";
  EXPECT_DOUBLE_EQ(ratios(list + "]\n      modes:\n")[29], 0.03);
}

TEST_F(IdentifiedBodies, WantAsManyDampingRatiosAsModes) {
  for (const auto& [list, count] : {std::pair<const char*, const char*>{"[1 %]", "1"}, {"[1 %, 2 %]", "2"}}) {
    const Scene scene =
        load({{"      modes:\n", std::string("      damping: ") + list + "\n      modes:\n"}});
    EXPECT_EQ(message([&] { compile(scene); }),
              std::string("scene.yaml:5:3: bodies.frame.flexible.damping: error: there are ") + count +
                  " damping ratios for 30 identified modes\n  give one ratio for all modes, or one per mode");
  }
}

TEST_F(IdentifiedBodies, MustBeFree) {
  EXPECT_EQ(message([&] {
              load({{kModes, std::string(kModes) +
                                 "        find: held\n        new_support: {joints: [{nodes: [1, 2, 12], "
                                 "axes: xyz}]}\n"}});
            }),
            "scene.yaml:13:7: bodies.frame.flexible.modes: error: a flexible body needs free-free modes\n"
            "  write 'find: free', 'changed' or 'corrected'");
}

TEST_F(IdentifiedBodies, MayBeCorrectedModels) {
  EXPECT_EQ(compiled_modes(compile(load({{kModes, std::string(kModes) + "        find: corrected\n"}})))
                .mode_count(),
            30);
}

TEST_F(IdentifiedBodies, HaveTheirOriginAtTheMassCentreOfTheChangedStructure) {
  const Scene scene =
      load({{kModes, std::string(kModes) +
                         "        find: changed\n        change: {masses: [{node: 12, mass: 40}]}\n"}});
  const CompiledScene compiled = compile(scene);
  EXPECT_LE((scene.bodies[0].flexible->node_position - compiled_modes(compiled).node_position).norm(), 1e-12);
  EXPECT_GT(scene.bodies[0].flexible->node_position.rowwise().mean().norm(), 0.01);
}

TEST_F(IdentifiedBodies, TellWhereTheIdentificationFailed) {
  const Scene scene = load({{"{from: model}", "{from: model, modes: 5}"}});
  EXPECT_EQ(
      message([&] { compile(scene); }),
      "scene.yaml:5:3: bodies.frame: support: error: there must be more modes than rigid-body motions on "
      "springs (got 5 modes, 6 such motions)\n  measure more modes");
  EXPECT_EQ(message([&] {
              load({{"{from: model}", "{file: absent.csv}"}});
            }),
            "scene.yaml:14:26: bodies.frame.flexible.modes.measured.file: error: there is no file "
            "absent_nodes.csv (got 'absent.csv')\n  names are relative to the file that they stand in");
  EXPECT_THAT(
      message([&] {
        load({{"node: 1}", "node: 13}"}});
      }),
      AllOf(HasSubstr("the body 'frame' has no such node (got '13')"), HasSubstr("its nodes are 1 to 12")));
}

TEST_F(IdentifiedBodies, AreListedInThePlan) {
  const Scene modal = load(), rigid = load({}, {"form=rigid"});
  EXPECT_THAT(make_plan(modal, compile(modal)).identified,
              ElementsAre("frame: 30 modes identified from 36 measured ones on 12 springs"));
  EXPECT_THAT(make_plan(rigid, compile(rigid)).identified, testing::IsEmpty());
}

TEST_F(IdentifiedBodies, AreKeptBesideTheResults) {
  const Scene scene = load();
  const CompiledScene compiled = compile(scene);
  const std::string results = files_ / "run.h5";
  run_scene(scene, compiled, {"scene.yaml", results, {}, {}});
  const ModalData kept = read_mode_file(identified_modes_path(results, "frame"));
  EXPECT_EQ(kept.omega, compiled.identified.at(0).identification.modes.omega);
  EXPECT_EQ(kept.shapes, compiled.identified.at(0).identification.modes.shapes);
}

}  // namespace
}  // namespace wishbone
