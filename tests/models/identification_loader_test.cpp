// Files that describe identifications: what every key means.
#include "models/identification_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "models/identification_files.h"

namespace wishbone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The good identification with some texts replaced.
LoadedIdentification load(const IdentificationFiles& files,
                          const std::vector<std::pair<std::string, std::string>>& changes = {},
                          const std::vector<std::string>& overrides = {}) {
  std::string text(kGoodIdentification);
  for (const auto& [old, replacement] : changes) {
    const auto at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), replacement);
  }
  return load_identification(files.write("frame.yaml", text), overrides);
}

TEST(IdentificationLoader, ReadsEveryKey) {
  const IdentificationFiles files;
  const IdentificationTask task = load(files).task;
  EXPECT_EQ(task.title, "Frame on springs");
  EXPECT_EQ(task.goal, Goal::kChanged);
  EXPECT_EQ(task.space, Space::kModal);
  EXPECT_EQ(task.coverage, Coverage::kAsMeasured);
  EXPECT_EQ(task.keep, 20);
  EXPECT_EQ(task.measured.mode_count(), 30);
  EXPECT_EQ(task.measured.node_count(), 12);
  EXPECT_DOUBLE_EQ(task.measured.node_mass[2], 1.003);
  ASSERT_TRUE(task.noise);
  EXPECT_DOUBLE_EQ(task.noise->frequency, 0.001);
  EXPECT_DOUBLE_EQ(task.noise->shape, 0.01);
  EXPECT_EQ(task.noise->samples, 50);
  EXPECT_EQ(task.noise->seed, 7u);
  ASSERT_TRUE(task.reference);
  EXPECT_EQ(task.reference->mode_count(), 10);
  EXPECT_EQ(task.reference_name, "model");
  EXPECT_FALSE(task.model) << "it only served for the reference";
}

TEST(IdentificationLoader, ReadsTheSupport) {
  const IdentificationFiles files;
  const Support support = load(files).task.measured.support;
  ASSERT_EQ(support.springs.size(), 14u);
  EXPECT_EQ(support.springs[5].node, 2);
  EXPECT_EQ(support.springs[5].direction, Vector3::UnitZ());
  EXPECT_EQ(support.springs[5].stiffness, 47e3);
  EXPECT_EQ(support.springs[12].node, 3) << "two of its three stiffnesses are zero";
  EXPECT_EQ(support.springs[12].direction, Vector3::UnitZ());
  EXPECT_EQ(support.springs[12].stiffness, 2e3);
  EXPECT_LE((support.springs[13].direction - Vector3(0, 0.6, 0.8)).norm(), 1e-15);
  ASSERT_EQ(support.joints.size(), 3u);
  EXPECT_EQ(support.joints[1].node, 9);
  EXPECT_EQ(support.joints[1].direction, Vector3::UnitZ());
  EXPECT_EQ(support.joints[2].direction, Vector3::UnitY());
  ASSERT_EQ(support.masses.size(), 1u);
  EXPECT_EQ(support.masses[0].node, 5);
  EXPECT_EQ(support.masses[0].mass, 0.5);
}

TEST(IdentificationLoader, ReadsTheChange) {
  const IdentificationFiles files;
  const IdentificationTask task = load(files).task;
  const StructureChange& change = task.change;
  ASSERT_EQ(change.masses.size(), 2u);
  EXPECT_EQ(change.masses[1].node, 7);
  EXPECT_EQ(change.masses[1].mass, -1);
  ASSERT_EQ(change.springs.size(), 2u);
  EXPECT_EQ(change.springs[0].nodes, (std::array{1, 2}));
  const ModalData& data = task.measured;
  EXPECT_LE(
      (change.springs[0].direction - (data.node_position.col(1) - data.node_position.col(0)).normalized())
          .norm(),
      1e-15)
      << "along the connection";
  EXPECT_EQ(change.springs[1].direction, Vector3::UnitZ());
  EXPECT_EQ(change.springs[1].stiffness, -6e3);
  EXPECT_EQ(change.dM->nonZeros(), 1);
  EXPECT_EQ(change.dK->rows(), 36);
}

TEST(IdentificationLoader, NamesEveryFileThatItReads) {
  const IdentificationFiles files;
  files.write("common.yaml", "parameters: {other: 1}\n");
  const auto read = load(files, {{"title:", "include: common.yaml\ntitle:"}}).files;
  std::vector<std::string> names;
  for (const std::string& file : read) names.push_back(std::filesystem::path(file).filename());
  EXPECT_THAT(names, testing::IsSupersetOf({"frame.yaml", "test_nodes.csv", "test_frequencies.csv",
                                            "test_shapes.csv", "masses.csv", "dM.mtx", "dK.mtx"}));
  for (const std::string& file : read) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST(IdentificationLoader, ChoosesModes) {
  const IdentificationFiles files;
  const auto modes = [&](const std::string& choice) {
    return load(files, {{"modes: = modes", "modes: " + choice}}).task.measured.omega;
  };
  const VectorX all = modes("all");
  ASSERT_EQ(all.size(), 36);
  EXPECT_EQ(modes("4"), all.head(4));
  EXPECT_EQ(modes("[9, 2]"), VectorX(all(std::vector{1, 8})));
  const double hz = (all[6] + all[7]) / 2 / (2 * std::numbers::pi);
  EXPECT_EQ(modes("{above: " + std::to_string(hz) + " Hz}"), all.tail(29));
  EXPECT_EQ(modes("{below: " + std::to_string(hz) + "}"), all.head(7));
}

TEST(IdentificationLoader, TakesOverridesOfParameters) {
  const IdentificationFiles files;
  EXPECT_EQ(load(files, {}, {"modes=25"}).task.measured.mode_count(), 25);
}

TEST(IdentificationLoader, ReadsMassesOfTheBodyOrAMatrix) {
  const IdentificationFiles files;
  const auto body =
      load(files, {{"{file: masses.csv}", "{total: 3 kg, centre: [1 mm, 0, 0], inertia: [2, 3, 4]}"}});
  ASSERT_TRUE(body.task.rigid_body);
  EXPECT_EQ(body.task.rigid_body->mass, 3);
  EXPECT_EQ(body.task.rigid_body->centre.x(), 1e-3);
  EXPECT_EQ(body.task.rigid_body->inertia(2, 2), 4);
  const auto matrix = load(files, {{"{file: masses.csv}", "{matrix: dM.mtx}"}});
  EXPECT_EQ(matrix.task.mass->rows(), 36);
  EXPECT_FALSE(matrix.task.measured.has_masses());
}

TEST(IdentificationLoader, ReadsAModelFromFiles) {
  const IdentificationFiles files;
  const AnalyticalModel block = [&] {
    const auto path = files.write("block.yaml", R"(wishbone: 1
identification:
  measured: {from: model}
  model:
    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}
    material: {young: 210 MPa, poisson: 0.3, density: 2600}
  find: corrected
)");
    return *load_identification(path).task.model;
  }();
  const SparseMatrix transposed = block.K.transpose();
  write_matrix_market(files / "K.mtx", SparseMatrix((block.K + transposed) / 2), true);
  write_matrix_market(files / "M.mtx", block.M, true);
  for (const char* mass : {", mass: M.mtx", ""}) {
    const auto loaded = load_identification(
        files.write("files.yaml",
                    "wishbone: 1\nidentification:\n  measured: {from: model}\n  find: corrected\n"
                    "  model: {nodes: test_nodes.csv, stiffness: K.mtx" +
                        std::string(mass) + "}\n"));
    EXPECT_LE((MatrixX(loaded.task.model->K) - MatrixX(block.K)).norm(), 1e-12 * block.K.norm());
    EXPECT_LE((MatrixX(loaded.task.model->M) - MatrixX(block.M)).norm(), 1e-12 * block.M.norm());
    EXPECT_EQ(loaded.task.measured.mode_count(), 30) << "elastic modes of the free model";
    EXPECT_TRUE(loaded.task.measured.support.empty());
  }
}

TEST(IdentificationLoader, HasFreeModesAsMeasuredByDefault) {
  const IdentificationFiles files;
  const IdentificationTask task =
      load_identification(
          files.write("short.yaml", "wishbone: 1\nidentification: {measured: {file: test.csv}}\n"))
          .task;
  EXPECT_EQ(task.goal, Goal::kFree);
  EXPECT_EQ(task.space, Space::kModal);
  EXPECT_EQ(task.coverage, Coverage::kAsMeasured);
  EXPECT_EQ(task.measured.mode_count(), 36);
  EXPECT_TRUE(task.measured.support.empty()) << "tables have no place for one";
  EXPECT_TRUE(task.measured.has_masses());
  EXPECT_FALSE(task.keep || task.noise || task.reference || task.mass || task.rigid_body);
}

}  // namespace
}  // namespace wishbone
