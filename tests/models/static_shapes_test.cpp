// Which modes a flexible body of a scene is given: chosen normal modes and static shapes at its interfaces.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "compiled_modes.h"
#include "core/error.h"
#include "models/interface_nodes.h"
#include "models/plan.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "solver/result_file.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::ElementsAre;

// Nodes 1 to 12; held at 1, sprung at 4 and 7, driven at 12.
constexpr std::string_view kScene = R"(wishbone: 1
bodies:
  beam:
    form: modal
    position: [0.5, 0.05, 0.05]
    flexible:
      block: {size: [1, 0.1, 0.1], elements: [2, 1, 1], element: mean_dilatation}
      material: {young: 210 MPa, poisson: 0.3, density: 2600}
      modes: all
  stone: {mass: 1, inertia: [1, 1, 1], position: [1, 0, 0.1]}
joints:
  hold: {type: spherical, bodies: [ground, {body: beam, node: 1}]}
closures:
  guide: {type: point_on_plane, from: {ground: [0, 0, 0.1]}, to: {body: beam, node: 4}, direction: [0, 1, 0]}
springs:
  coil: {from: {body: beam, node: 7}, to: {body: stone}, stiffness: 2 kN/m, damping: 5, free_length: 0.5 m}
loads:
  push: {body: beam, node: 12, force: [0, 0, 10 N]}
signals:
  height: {body: beam, node: 9, component: z}
analysis: {duration: 50 ms, rtol: 1e-8}
output: {interval: 5 ms, nodes: {beam: [12]}, points: {tip: {body: beam, node: 10}}}
)";

class StaticShapes : public testing::Test {
 protected:
  Scene load(std::string_view modes, std::string_view old = "modes: all") const {
    std::string text(kScene);
    text.replace(text.find(old), old.size(), modes);
    return load_scene(files_.write("scene.yaml", text));
  }
  std::string message(std::string_view modes) const {
    return files_.relative(message_of<InputError>([&] { compile(load(modes)); }));
  }
  TextFiles files_;
};

std::vector<ModeKind> kinds_of(const CompiledScene& compiled) {
  std::vector<ModeKind> kinds;
  for (const ModeRow& row : compiled.modes.at(0).modes) kinds.push_back(row.kind);
  return kinds;
}

/// Static deflections of the nodes under unit forces on them, with inertia relief.
MatrixX statics(const ModeSet& set, const std::vector<int>& nodes) {
  std::vector<int> rows;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * set.node_index(node) + axis);
  const MatrixX Psi = set.shapes(rows, Eigen::all);
  return Psi * set.omega.cwiseAbs2().cwiseInverse().asDiagonal() * Psi.transpose();
}

TEST_F(StaticShapes, InterfacesAreWhatJointsClosuresSpringsAndLoadsTakeHoldOf) {
  EXPECT_THAT(interface_nodes(load("modes: all"), 0), ElementsAre(1, 4, 7, 12));
  EXPECT_TRUE(interface_nodes(load("modes: all"), 1).empty());
}

TEST_F(StaticShapes, NormalModesAreChosen) {
  const ModeSet all = compiled_modes(compile(load("modes: all")));
  const auto omega = [&](std::string_view modes) { return compiled_modes(compile(load(modes))).omega; };
  EXPECT_EQ(omega("modes: 4"), all.omega.head(4));
  EXPECT_EQ(omega("modes: {lowest: 4}"), all.omega.head(4));
  EXPECT_EQ(omega("modes: {list: [9, 2, 5]}"), all.omega(std::vector<int>{1, 4, 8}));
  const double limit = (all.omega[6] + all.omega[7]) / (4 * std::numbers::pi);
  EXPECT_EQ(omega("modes: {below: " + std::to_string(limit) + " Hz}"), all.omega.head(7));
}

TEST_F(StaticShapes, AttachmentModesAreTakenAtInterfacesOrNamedNodes) {
  const CompiledScene compiled = compile(load("modes: 3\n      attachment: interfaces"));
  const std::vector<ModeKind> kinds = kinds_of(compiled);
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), ModeKind::normal), 3);
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), ModeKind::attachment), 12);
  const ModeSet named = compiled_modes(compile(load("modes: 3\n      attachment: [1, 4, 7, 12]")));
  EXPECT_EQ(compiled_modes(compiled).omega, named.omega);
  EXPECT_EQ(compiled_modes(compiled).shapes, named.shapes);

  const MatrixX truth = statics(compiled_modes(compile(load("modes: all"))), {1, 4, 7, 12});
  EXPECT_LE((statics(named, {1, 4, 7, 12}) - truth).norm(), 1e-10 * truth.norm());
}

TEST_F(StaticShapes, AChoiceThatSeparatesModesOfEqualFrequencyIsDoubted) {
  // the section is square: bending modes come in pairs, the first of them 2 and 3
  const auto warnings = [&](std::string_view modes) {
    Warnings split = compile(load(modes)).modes.at(0).warnings;
    std::erase_if(split, [](const Diagnostic& warning) {
      return warning.what.find("modes of equal frequency") == std::string::npos;
    });
    return split;
  };
  const double hertz = compiled_modes(compile(load("modes: all"))).omega[1] / (2 * std::numbers::pi);
  ASSERT_EQ(warnings("modes: 2").size(), 1u);
  EXPECT_EQ(warnings("modes: 2")[0].value, fmt::format("{:.4g} Hz", hertz));
  EXPECT_EQ(warnings("modes: 2")[0].remedy, "choose one more or one less");
  EXPECT_EQ(warnings("modes: {list: [1, 3]}").size(), 1u);
  EXPECT_THAT(warnings("modes: 3"), testing::IsEmpty());
  EXPECT_THAT(warnings("modes: all"), testing::IsEmpty());
}

TEST_F(StaticShapes, ConstraintModesAreTakenToo) {
  const CompiledScene compiled =
      compile(load("modes: 2\n      attachment: [12]\n      constraint: interfaces"));
  const std::vector<ModeKind> kinds = kinds_of(compiled);
  EXPECT_EQ(kinds.size(), 2u + 3u + 6u);  // twelve displacements less six of rigid motion
  EXPECT_EQ(
      compiled.modes.at(0).choice,
      "the 2 lowest normal modes and attachment modes of 1 node and constraint modes of 4 interfaces; 6 "
      "static shapes add no more");
  EXPECT_EQ(
      message("modes: 2\n      constraint: [1, 2]"),
      "scene.yaml:3:3: bodies.beam: constraint modes: error: the interface nodes must hold the body, for all "
      "its other nodes follow statically (got 5 of 6 rigid motions are held)\n"
      "  name at least three nodes that do not lie on one line, or take attachment modes");
}

TEST_F(StaticShapes, ModesOfHeldInterfacesComeWithTheirConstraintModes) {
  const CompiledScene compiled = compile(load("modes: {fixed_interface: 7}"));
  const std::vector<ModeKind> kinds = kinds_of(compiled);
  EXPECT_EQ(kinds.size(), 7u + 6u);  // twelve displacements less six of rigid motion
  EXPECT_GE(std::count(kinds.begin(), kinds.end(), ModeKind::fixed_interface), 1);
  EXPECT_EQ(std::count(kinds.begin(), kinds.end(), ModeKind::normal), 0);
  EXPECT_EQ(compiled.modes.at(0).choice,
            "the 7 lowest fixed-interface modes and constraint modes of 4 interfaces; 6 static shapes add no "
            "more");
  const ModeSet found = compiled_modes(compiled);
  const auto omega = [&](std::string_view modes) { return compiled_modes(compile(load(modes))).omega; };
  EXPECT_EQ(omega("modes: {fixed_interface: {lowest: 7}}"), found.omega);
  EXPECT_EQ(omega("modes: {fixed_interface: 7}\n      constraint: [1, 4, 7, 12]"), found.omega);
  EXPECT_GT(omega("modes: {fixed_interface: {below: 100 kHz}}").size(), 13);
  // Ritz's frequencies lie above those of the full body, and are these with all modes
  const VectorX truth = omega("modes: all");
  for (int j = 0; j < 13; ++j) EXPECT_GE(found.omega[j], truth[j] * (1 - 1e-9));
  const VectorX all = omega("modes: {fixed_interface: all}");
  ASSERT_EQ(all.size(), 30);
  EXPECT_LE((all - truth).cwiseQuotient(truth).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(StaticShapes, AutomaticIsAllBelowALimitAndTheAttachmentModesOfEveryInterface) {
  const ModeSet all = compiled_modes(compile(load("modes: all")));
  const double limit = (all.omega[4] + all.omega[5]) / (4 * std::numbers::pi);
  const std::string below = std::to_string(limit) + " Hz";
  const CompiledScene automatic = compile(load("modes: automatic\n      below: " + below));
  const CompiledScene spelt = compile(load("modes: {below: " + below + "}\n      attachment: interfaces"));
  EXPECT_EQ(compiled_modes(automatic).omega, compiled_modes(spelt).omega);
  EXPECT_EQ(compiled_modes(automatic).shapes, compiled_modes(spelt).shapes);
  EXPECT_EQ(compiled_modes(automatic).mode_count(), 17);
  EXPECT_THAT(automatic.modes.at(0).choice, testing::StartsWith("automatic: the normal modes below "));
}

TEST_F(StaticShapes, AFullSetGainsNothing) {
  const ModeSet all = compiled_modes(compile(load("modes: all")));
  const CompiledScene compiled = compile(load("modes: all\n      attachment: interfaces"));
  EXPECT_EQ(compiled_modes(compiled).shapes, all.shapes);
  EXPECT_EQ(compiled.modes.at(0).choice,
            "all normal modes and attachment modes of 4 interfaces; 12 static shapes add no more");
}

TEST_F(StaticShapes, HaveTheDampingOfTheBodyOrOneEach) {
  const VectorX common =
      compiled_modes(compile(load("modes: 2\n      attachment: [12]\n      damping: 3 %"))).damping_ratio;
  ASSERT_EQ(common.size(), 5);
  EXPECT_LE((common.array() - 0.03).abs().maxCoeff(), 1e-16);
  const VectorX each =
      compiled_modes(compile(load("modes: 2\n      attachment: [12]\n      damping: [0, 0, 1, 1, 1]")))
          .damping_ratio;
  ASSERT_EQ(each.size(), 5);
  EXPECT_LE((each - VectorX{{0, 0, 1, 1, 1}}).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(message("modes: 2\n      attachment: [12]\n      damping: [0, 0]"),
            "scene.yaml:3:3: bodies.beam.flexible.damping: error: there are 2 damping ratios for 5 modes\n"
            "  give one ratio for all modes, or one per mode");
}

TEST_F(StaticShapes, NoModesAreTheRigidBodyToTheLastBit) {
  const Scene none = load("modes: none");
  const Scene::Body& beam = none.bodies[0];
  EXPECT_EQ(beam.form, Scene::BodyForm::kRigid);
  EXPECT_NEAR(beam.mass, 26, 1e-12);
  std::string inertia;
  for (const auto& [i, j] : {std::pair(0, 0), {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}})
    inertia += (inertia.empty() ? "" : ", ") + fmt::format("{:.17g}", beam.inertia(i, j));
  const Scene rigid = load(
      fmt::format("form: rigid\n    mass: {:.17g}\n    inertia: [{}]", beam.mass, inertia), "form: modal");

  const auto run = [&](const Scene& scene, const std::string& name) {
    CompiledScene compiled = compile(scene);
    EXPECT_TRUE(compiled.system.flexible.empty());
    const auto file = files_ / name;
    EXPECT_EQ(run_scene(scene, compiled, {name, file, {}, {}}).summary.status,
              TransientSummary::Status::complete);
    return file;
  };
  const ResultFile a(run(none, "none.h5").string()), b(run(rigid, "rigid.h5").string());
  ASSERT_EQ(a.signals().size(), b.signals().size());
  for (const Signal& signal : a.signals()) EXPECT_EQ(a.read(signal.path), b.read(signal.path)) << signal.path;
}

TEST_F(StaticShapes, AreListedInThePlan) {
  const Scene scene = load("modes: 2\n      attachment: [12]\n      damping: 1 %");
  const Plan plan = make_plan(scene, compile(scene));
  ASSERT_EQ(plan.modes.size(), 1u);
  EXPECT_EQ(plan.modes[0].body, "beam");
  EXPECT_EQ(plan.modes[0].choice, "the 2 lowest normal modes and attachment modes of 1 node");
  ASSERT_EQ(plan.modes[0].modes.size(), 5u);
  for (const ModeRow& mode : plan.modes[0].modes) {
    EXPECT_EQ(mode.damping_ratio, 0.01);
    EXPECT_THAT(mode.node, testing::AnyOf(1, 4, 7, 12));
    EXPECT_GT(mode.effective_mass, 0);
  }
}

TEST(CarOfFewModes, BendsUnderItsSuspensionAsTheFullOneWithAttachmentModes) {
  // the chassis of 54 elastic modes: deflections of its twelve interfaces under unit forces on them
  const auto compiled = [](std::vector<std::string> set) {
    const Scene scene = load_scene(std::string(WISHBONE_SCENES) + "/sine_depression.yaml", set);
    EXPECT_THAT(interface_nodes(scene, 0), ElementsAre(1, 2, 3, 4, 5, 6, 13, 14, 17, 18, 19, 20));
    return compile(scene);
  };
  const std::vector<int> nodes{1, 2, 3, 4, 5, 6, 13, 14, 17, 18, 19, 20};
  const MatrixX truth = statics(compiled_modes(compiled({"modes=54"})), nodes);
  const auto error = [&](const ModeSet& set) {
    return (statics(set, nodes) - truth).colwise().norm().maxCoeff() / truth.colwise().norm().maxCoeff();
  };
  const double ten = error(compiled_modes(compiled({"modes=10"}))),
               half = error(compiled_modes(compiled({"modes=27"})));
  const double corrected = error(compiled_modes(compiled({"modes=10", "correction=interfaces"})));
  EXPECT_LT(half, ten);
  EXPECT_GT(half, 1e-3);
  EXPECT_LT(corrected, 0.1 * half);
  EXPECT_LT(corrected, 1e-10);
}

}  // namespace
}  // namespace wishbone
