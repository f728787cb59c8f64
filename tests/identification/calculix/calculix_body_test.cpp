// A flexible body of a scene from the matrices that CalculiX stored: 3885 freedoms, reduced to a few modes.
#include <gtest/gtest.h>

#include <fstream>

#include "compiled_modes.h"
#include "core/error.h"
#include "identification/calculix/calculix_structure.h"
#include "identification/formats/calculix_matrices.h"
#include "identification/identify.h"
#include "identification/methods/attachment_modes.h"
#include "identification/methods/lowest_modes.h"
#include "identification/methods/lumping.h"
#include "models/compile.h"
#include "models/identification_loader.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

class CalculixBody : public testing::Test {
 protected:
  void SetUp() override {
    if (!calculix_is_installed()) GTEST_SKIP() << "CalculiX (ccx) is not installed";
    store_calculix_matrices(calculix_frame(), files_ / "", "frame");
  }
  CompiledScene compile_body(const std::string& model, const std::string& modes) const {
    return compile(load_scene(files_.write("scene.yaml",
                                           "wishbone: 1\nbodies:\n  frame:\n    form: modal\n"
                                           "    position: [0, 0, 0]\n    flexible:\n      model: " +
                                               model + "\n      modes: " + modes +
                                               "\nloads:\n  push: {body: frame, node: 7, force: [0, 0, 1]}\n"
                                               "  pull: {body: frame, node: 1200, force: [0, 0, -1]}\n")));
  }
  std::string message(const std::string& model) const {
    return files_.relative(message_of<InputError>([&] { compile_body(model, "10"); }));
  }
  TextFiles files_;
};

ModeSet modes_of(const CompiledScene& compiled) {
  return compiled_modes(compiled);
}

TEST_F(CalculixBody, HasTheModesAndTheStaticsOfItsLumpedModel) {
  const ModeSet set =
      modes_of(compile_body("{calculix: frame, lumping: row_sum}", "20\n      attachment: interfaces"));
  EXPECT_EQ(set.node_count(), 1295);
  EXPECT_EQ(set.mode_count(), 26);
  const CalculixMatrices frame = read_calculix_matrices(files_ / "frame", files_ / "frame.inp");
  const VectorX mass = lumped_masses(frame.M, Lumping::row_sum);
  EXPECT_NEAR(set.mass(), mass.sum(), 1e-9);
  const SparseMatrix M = lumped_mass_matrix(mass);
  const Modes normal = lowest_modes(frame.K, M, 26);
  for (Eigen::Index j = 0; j < 20; ++j)
    EXPECT_NEAR(set.omega[j], std::sqrt(normal.lambda[6 + j]), 1e-8 * set.omega[j]);

  std::vector<int> rows;
  for (const int node : {7, 1200})
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * set.node_index(node) + axis);
  const MatrixX rigid = rigid_body_modes(mass, set.node_position);
  const MatrixX truth = attachment_modes(frame.K, M, rigid, rows)(rows, Eigen::all);
  const MatrixX Psi = set.shapes(rows, Eigen::all);
  const MatrixX found = Psi * set.omega.cwiseAbs2().cwiseInverse().asDiagonal() * Psi.transpose();
  EXPECT_LE((found - truth).norm(), 1e-10 * truth.norm());
}

TEST_F(CalculixBody, IsLumpedNearTheFrequenciesOfTheConsistentModel) {
  const CalculixMatrices frame = read_calculix_matrices(files_ / "frame", files_ / "frame.inp");
  const Modes consistent = lowest_modes(frame.K, frame.M, 16);
  for (const char* lumping : {"row_sum", "diagonal"}) {
    const ModeSet set =
        modes_of(compile_body(std::string("{calculix: frame, lumping: ") + lumping + "}", "10"));
    for (Eigen::Index j = 0; j < 10; ++j)
      EXPECT_NEAR(set.omega[j] / std::sqrt(consistent.lambda[6 + j]), 1, 0.05) << lumping << j;
  }
}

TEST_F(CalculixBody, TakesItsNodesFromResultsToo) {
  std::string text = "    2C                          1295                                     1\n";
  const Mesh mesh = calculix_frame().mesh;
  for (std::size_t i = 0; i < mesh.node_ids.size(); ++i) {
    const Vector3 p = mesh.nodes.col(static_cast<Eigen::Index>(i));
    text += fmt::format(" -1{:10d}{:12.5E}{:12.5E}{:12.5E}\n", mesh.node_ids[i], p.x(), p.y(), p.z());
  }
  files_.write("places.frd", "    1C\n" + text + " -3\n");
  const ModeSet deck = modes_of(compile_body("{calculix: frame, lumping: diagonal}", "3"));
  const ModeSet results =
      modes_of(compile_body("{calculix: frame, nodes: places.frd, lumping: diagonal}", "3"));
  EXPECT_LE((deck.node_position - results.node_position).cwiseAbs().maxCoeff(), 2e-5);
}

TEST_F(CalculixBody, GivesAnIdentificationItsConsistentMasses) {
  const auto task_of = [&](const std::string& rest) {
    return load_identification(
               files_.write("ident.yaml",
                            "wishbone: 1\nidentification:\n  measured: {from: model, modes: 4}\n"
                            "  model: {calculix: frame" +
                                rest + "}\n"))
        .task;
  };
  const IdentificationTask consistent = task_of("");
  ASSERT_TRUE(consistent.mass);
  const Judgement judgement = identify(consistent).judgement;
  EXPECT_LT(judgement.input_orthogonality_error, 1e-6);
  EXPECT_FALSE(task_of(", lumping: row_sum").mass);
}

TEST_F(CalculixBody, IsRefusedWithPlaceValueAndRemedy) {
  EXPECT_EQ(message("{calculix: frame}"),
            "scene.yaml:7:7: bodies.frame.flexible.model: error: a flexible body needs lumped masses, and "
            "this mass "
            "matrix is not lumped\n"
            "  add 'lumping: row_sum' or 'lumping: diagonal' to the model");
  EXPECT_EQ(
      message("{calculix: fram}"),
      "scene.yaml:7:25: bodies.frame.flexible.model.calculix: error: there is no file fram.dof (got 'fram')\n"
      "  names are relative to the file that they stand in");
  files_.write("part.inp", "*NODE\n1, 0, 0, 0\n*INCLUDE, INPUT=mesh.inp\n");
  EXPECT_EQ(
      message("{calculix: frame, nodes: part.inp, lumping: diagonal}"),
      "part.inp:3 (byte 17): error: nodes of other files are not read (got '*INCLUDE, INPUT=mesh.inp')\n"
      "  name a result file: 'nodes: JOB.frd'");
  files_.write("part.inp", "*NODE\n1, 0, 0, 0\n");
  EXPECT_EQ(message("{calculix: frame, nodes: part.inp, lumping: diagonal}"),
            "part.inp: error: the place of a node is not known (got node 2)\n"
            "  name the deck or result file of the same model");
}

TEST_F(CalculixBody, IsRefusedWhenItWasHeld) {
  CalculixModel held = calculix_frame();
  held.support.joints.push_back({5, Vector3::UnitY()});
  store_calculix_matrices(held, files_ / "", "held");
  EXPECT_EQ(
      message("{calculix: held, lumping: diagonal}"),
      "held.dof: error: the structure must be free in every direction of its nodes (got 5 y is missing)\n"
      "  remove *BOUNDARY and equations from the deck, and run it again");
}

}  // namespace
}  // namespace wishbone
