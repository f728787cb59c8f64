// Supported modes from free-free ones, and the effect of design changes.
#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/methods/joint_support.h"
#include "identification/methods/spring_support.h"
#include "identification/methods/stiffness_from_modes.h"
#include "identification/methods/support_matrices.h"
#include "identification/structures.h"

namespace wishbone {
namespace {

TEST(StiffnessFromModes, ReproducesCompleteAndKeptSets) {
  const TestStructure s = chassis();
  const Modes modes = s.with_rigid();
  EXPECT_LE((stiffness_from_modes(modes, s.M) - MatrixX(s.K)).norm(), 1e-12 * s.K.norm());
  // K* is that of the kept modes and nothing else: K* psi = lambda M psi, and zero on the others
  const MatrixX K_kept = stiffness_from_modes(modes.lowest(20), s.M);
  const MatrixX inertia = s.M * modes.shapes.leftCols(20) * modes.lambda.head(20).asDiagonal();
  EXPECT_LE((K_kept * modes.shapes.leftCols(20) - inertia).norm(), 1e-11 * inertia.norm());
  EXPECT_LE((K_kept * modes.shapes.rightCols(40)).norm(), 1e-11 * inertia.norm());
}

TEST(HoldBySprings, CompleteSetIsTheSupportedStructure) {
  const TestStructure s = l_shape();
  const SupportMatrices support = support_matrices(springs_at({101, 110, 120}, 2e5), s.freedoms());
  const Modes truth = modes_on(s, support);
  for (const Space space : {Space::kModal, Space::kPhysical})
    EXPECT_LE(worst_relative(hold_by_springs(space, s.with_rigid(), s.M, support.K_s).lambda, truth.lambda),
              1e-10);
}

TEST(HoldBySprings, IncompleteSetsLieAboveTheTruthInBothSpaces) {
  const TestStructure s = chassis();
  for (const double k : {1e2, 1e4, 1e6}) {
    const SupportMatrices support = support_matrices(springs_at({1, 2, 17, 18}, k), s.freedoms());
    const Modes truth = modes_on(s, support);
    for (const int kept : {10, 20, 27}) {
      const Modes modal = hold_by_springs(Space::kModal, s.with_rigid().lowest(kept), s.M, support.K_s);
      const Modes physical = hold_by_springs(Space::kPhysical, s.with_rigid().lowest(kept), s.M, support.K_s);
      EXPECT_LE(worst_relative(modal.lambda, physical.lambda), 1e-9);
      EXPECT_GE((modal.lambda - truth.lambda.head(kept)).minCoeff(), -1e-9 * truth.lambda[kept]);
    }
  }
}

TEST(HoldByJoints, CompleteSetIsTheHeldStructure) {
  const TestStructure s = chassis();
  const SupportMatrices support = support_matrices(chassis_joints(), s.freedoms());
  const Modes truth = modes_on(s, support);
  EXPECT_LE(worst_relative(hold_by_joints(MatrixX(s.K), s.M, {0, 1, 2, 52, 5, 50}).lambda, truth.lambda),
            1e-10);
  EXPECT_LE(worst_relative(hold_by_joints_null_space(s.with_rigid(), s.M, support.D).lambda, truth.lambda),
            1e-10);
}

TEST(HoldByJoints, MultiplierAndNullSpaceFormsAgree) {
  const TestStructure s = chassis();
  const SupportMatrices support = support_matrices(chassis_joints(), s.freedoms());
  for (const int kept : {10, 20, 27, 60}) {
    const Modes null_space = hold_by_joints_null_space(s.with_rigid().lowest(kept), s.M, support.D);
    const Modes multipliers = hold_by_joints_multipliers(s.with_rigid().lowest(kept), s.M, support.D);
    ASSERT_EQ(multipliers.count(), kept - 6);
    EXPECT_LE(worst_relative(multipliers.lambda, null_space.lambda), 1e-8);
    EXPECT_LE((support.D * multipliers.shapes).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LE((support.D * null_space.shapes).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(HoldByJoints, RedundantJointsAreCountedOnce) {
  const TestStructure s = chassis();
  Support twice = chassis_joints();
  twice.joints.push_back(twice.joints.front());
  const SupportMatrices once = support_matrices(chassis_joints(), s.freedoms());
  const SupportMatrices redundant = support_matrices(twice, s.freedoms());
  const VectorX expected = hold_by_joints_null_space(s.with_rigid(), s.M, once.D).lambda;
  EXPECT_LE(worst_relative(hold_by_joints_null_space(s.with_rigid(), s.M, redundant.D).lambda, expected),
            1e-9);
  EXPECT_LE(worst_relative(hold_by_joints_multipliers(s.with_rigid(), s.M, redundant.D).lambda, expected),
            1e-8);
}

TEST(HoldByJoints, RefuseToLeaveNoMode) {
  const TestStructure s = chassis();
  const SupportMatrices support = support_matrices(chassis_joints(), s.freedoms());
  EXPECT_THROW(hold_by_joints_null_space(s.with_rigid().lowest(6), s.M, support.D), InputError);
}

TEST(DesignChange, CompleteSetIsTheChangedStructure) {
  const TestStructure s = distorted_block({2, 1, 1}, 2);
  // 2 kg more at one node, less at another; a spring between two nodes
  VectorX mass = VectorX::Zero(s.n());
  mass.segment(3, 3).setConstant(2);
  mass.segment(12, 3).setConstant(-1.5);
  const SparseMatrix dM = diagonal_matrix(mass);
  MatrixX row = MatrixX::Zero(1, s.n());
  row(0, 0) = 1, row(0, 9) = -1;
  const SparseMatrix dK = (5e6 * row.transpose() * row).sparseView();
  const Modes truth = solve_eigenproblem(MatrixX(s.K + dK), MatrixX(s.M + dM));
  for (const Space space : {Space::kModal, Space::kPhysical}) {
    const Modes changed = change_structure(space, s.with_rigid(), s.M, dM, dK);
    EXPECT_LE(worst_relative(changed.lambda.tail(s.n() - 6), truth.lambda.tail(s.n() - 6)), 1e-9);
    const MatrixX gram = changed.shapes.transpose() * ((s.M + dM) * changed.shapes);
    EXPECT_LE((gram - MatrixX::Identity(s.n(), s.n())).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(DesignChange, PhysicalSpaceIsTheDenseEigenproblemWithoutItsZeros) {
  const TestStructure s = chassis();
  const Modes kept = s.with_rigid().lowest(20);
  VectorX mass = VectorX::Zero(s.n());
  mass.segment(30, 3).setConstant(40);
  const SparseMatrix dM = diagonal_matrix(mass);
  const SparseMatrix dK = support_matrices(springs_at({1, 2, 17, 18}, 47e3), s.freedoms()).K_s;
  // K* + dK* of [2.15-2.26], dense
  const MatrixX B = s.M * kept.shapes;
  const MatrixX K =
      stiffness_from_modes(kept, s.M) + B * (kept.shapes.transpose() * dK * kept.shapes) * B.transpose();
  const Modes dense = solve_eigenproblem(K, MatrixX(s.M + dM));
  const Modes found = change_in_physical_space(kept, s.M, dM, dK);
  EXPECT_LE(worst_relative(found.lambda, dense.lambda.tail(20)), 1e-9);
}

TEST(DesignChange, RefusesMoreMassTakenAwayThanThereIs) {
  const TestStructure s = chassis();
  VectorX mass = VectorX::Zero(s.n());
  mass[4] = -1e4;
  const SparseMatrix dM = diagonal_matrix(mass), none(s.n(), s.n());
  EXPECT_THROW(change_in_physical_space(s.with_rigid(), s.M, dM, none), InputError);
  EXPECT_THROW(change_in_modal_space(s.with_rigid(), s.M, dM, none), InputError);
}

}  // namespace
}  // namespace wishbone
