// Examples 3.1 and 4.2 of the source: three sliders of 5, 1 and 2 kg, every pair joined by a unit spring.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "identification/methods/joint_support.h"
#include "identification/methods/released_modes.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/spring_support.h"
#include "identification/methods/stiffness_from_modes.h"

namespace wishbone {
namespace {

class Sliders : public testing::Test {
 protected:
  Sliders() {
    const YAML::Node file = YAML::LoadFile(WISHBONE_TEST_DATA "/sliders.yaml");
    M = diagonal_matrix(vector(file["mass"]));
    K = matrix(file["stiffness"]);
    free = {vector(file["free_free"]["lambda"]), matrix(file["free_free"]["shapes"]).transpose()};
    modal_mass = vector(file["free_free"]["modal_mass"]);
    held_lambda = vector(file["slider_1_fixed"]["lambda"]);
    held_shapes = matrix(file["slider_1_fixed"]["shapes"]).transpose();
    D = SparseMatrix(1, 3);
    D.insert(0, 0) = 1;
  }

  static VectorX vector(const YAML::Node& node) {
    VectorX v(static_cast<Eigen::Index>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i) v[static_cast<Eigen::Index>(i)] = node[i].as<double>();
    return v;
  }
  static MatrixX matrix(const YAML::Node& node) {
    MatrixX A(static_cast<Eigen::Index>(node.size()), static_cast<Eigen::Index>(node[0].size()));
    for (std::size_t i = 0; i < node.size(); ++i) A.row(static_cast<Eigen::Index>(i)) = vector(node[i]);
    return A;
  }

  /// Example 3.1: the first slider stands still, the others move as published.
  void expect_held(const Modes& held) const {
    ASSERT_EQ(held.count(), 2);
    EXPECT_LE((held.lambda - held_lambda).cwiseAbs().maxCoeff(), 1e-12);
    for (int j = 0; j < 2; ++j) {
      const VectorX shape = held.shapes.col(j) / held.shapes.col(j).maxCoeff();
      EXPECT_LE(std::abs(shape[0]), 1e-12);
      EXPECT_LE((shape.tail(2) - held_shapes.col(j)).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
  /// Example 4.2: the elastic modes of the free sliders as published.
  void expect_free(const Modes& released) const {
    ASSERT_EQ(released.count(), 2);
    EXPECT_LE((released.lambda - free.lambda.tail(2)).cwiseAbs().maxCoeff(), 1e-12);
    for (int j = 0; j < 2; ++j) {
      const VectorX shape = released.shapes.col(j) / released.shapes.col(j).maxCoeff();
      EXPECT_LE((shape - free.shapes.col(j + 1)).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
  Modes held_modes() const {
    MatrixX shapes = MatrixX::Zero(3, 2);
    shapes.bottomRows(2) = held_shapes;
    return {held_lambda, shapes};
  }
  MatrixX rigid() const {
    MatrixX shapes = MatrixX::Zero(3, 6);
    shapes.col(0).setOnes();
    return rigid_body_basis(shapes, M);
  }

  SparseMatrix M, D;
  MatrixX K, held_shapes;
  Modes free;
  VectorX modal_mass, held_lambda;
};

TEST_F(Sliders, HaveThePublishedModalMasses) {
  EXPECT_LE((modal_masses(free.shapes, M) - modal_mass).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_F(Sliders, GiveTheirStiffnessBack) {
  EXPECT_LE((stiffness_from_modes(free, M) - K).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Sliders, MoveAlongTheirOneRigidMotion) {
  const MatrixX Psi_0 = rigid();
  ASSERT_EQ(Psi_0.cols(), 1);
  EXPECT_LE((Psi_0.array().abs() - 1 / std::sqrt(8.0)).abs().maxCoeff(), 1e-15);
}

TEST_F(Sliders, Example31HoldsTheFirst) {
  expect_held(hold_by_joints(K, M, {0}));
  expect_held(hold_by_joints_null_space(free, M, D));
}

TEST_F(Sliders, Example31WithMultipliers) {
  expect_held(hold_by_joints_multipliers(free, M, D));
}

TEST_F(Sliders, Example42ReleasesTheFirst) {
  const SupportMatrices support{SparseMatrix(3, 3), SparseMatrix(3, 3), D};
  const ReleasedModes released = release(held_modes(), M, support, rigid());
  expect_free(released.modes);
  EXPECT_EQ(released.lost_modes, 0);
  EXPECT_LE(released.residual.maxCoeff(), 1e-12);
}

TEST_F(Sliders, Example42RecoversTheMissingBlocks) {
  EXPECT_LE((stiffness_without_joints(held_modes(), M, D, rigid()) - K).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(Sliders, SpringsPutOnAndTakenOffLeaveNothing) {
  SparseMatrix K_s(3, 3);
  K_s.insert(1, 1) = 3;
  for (const Space space : {Space::kModal, Space::kPhysical}) {
    const Modes on_springs = hold_by_springs(space, free, M, K_s);
    EXPECT_LE(
        (on_springs.lambda - solve_eigenproblem(K + MatrixX(K_s), MatrixX(M)).lambda).cwiseAbs().maxCoeff(),
        1e-12);
    const Modes back = release_from_springs(space, on_springs, M, SparseMatrix(3, 3), K_s);
    EXPECT_LE((back.lambda - free.lambda).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace wishbone
