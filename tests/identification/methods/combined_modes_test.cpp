// Normal modes with static shapes: statics at the interfaces, and a valid set of modes whatever is combined.
#include "identification/methods/combined_modes.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/methods/attachment_modes.h"
#include "identification/methods/constraint_modes.h"
#include "identification/methods/support_matrices.h"
#include "identification/structures.h"
#include "text_files.h"

namespace wishbone {
namespace {

MatrixX none(const TestStructure& s) {
  return MatrixX(s.n(), 0);
}

/// x, y, z of three nodes far apart.
std::vector<int> interfaces(const TestStructure& s) {
  const auto n = static_cast<int>(s.n());
  return {0, 1, 2, 3 * (n / 6), 3 * (n / 6) + 1, 3 * (n / 6) + 2, n - 3, n - 2, n - 1};
}

/// Static deflection under unit forces on the freedoms, in the span of the modes.
MatrixX statics(const Modes& modes, const std::vector<int>& freedoms) {
  return modes.shapes * modes.lambda.cwiseInverse().asDiagonal() *
         modes.shapes(freedoms, Eigen::all).transpose();
}

void expect_valid(const TestStructure& s, const CombinedModes& all) {
  const MatrixX& Psi = all.modes.shapes;
  const VectorX& lambda = all.modes.lambda;
  const Eigen::Index m = all.modes.count();
  ASSERT_EQ(all.kinds.size(), static_cast<std::size_t>(m));
  EXPECT_LE((Psi.transpose() * (s.M * Psi) - MatrixX::Identity(m, m)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((s.rigid.transpose() * (s.M * Psi)).cwiseAbs().maxCoeff(), 1e-12);
  const VectorX scale = lambda.cwiseSqrt().cwiseInverse();
  const MatrixX energy = scale.asDiagonal() * (Psi.transpose() * (s.K * Psi)) * scale.asDiagonal();
  EXPECT_LE((energy - MatrixX::Identity(m, m)).cwiseAbs().maxCoeff(), 1e-10);
  for (Eigen::Index j = 1; j < m; ++j) EXPECT_LE(lambda[j - 1], lambda[j]);
}

TEST(CombinedModes, KeepTheStaticsAtTheirInterfacesHoweverFewNormalModesThereAre) {
  for (const TestStructure& s : {chassis(), slender_block(), l_shape(), random_lumped(9, 3)}) {
    const std::vector<int> freedoms = interfaces(s);
    const MatrixX attachment = attachment_modes(s.K, s.M, s.rigid, freedoms);
    const MatrixX truth = statics(s.elastic(), freedoms);
    for (const int kept : {0, 1, 2, 7, 12, 17}) {
      const CombinedModes all =
          combined_modes(s.K, s.M, s.rigid, s.elastic().lowest(kept), attachment, none(s));
      expect_valid(s, all);
      EXPECT_LE((statics(all.modes, freedoms) - truth).norm(), 1e-10 * truth.norm()) << kept;
    }
  }
}

TEST(CombinedModes, LeaveTheNormalModesAsTheyAre) {
  const TestStructure s = chassis();
  const Modes kept = s.elastic().lowest(10);
  const CombinedModes all =
      combined_modes(s.K, s.M, s.rigid, kept, attachment_modes(s.K, s.M, s.rigid, interfaces(s)), none(s));
  EXPECT_EQ(all.modes.count(), 19);
  EXPECT_EQ(all.left_out, 0);
  for (Eigen::Index j = 0; j < 10; ++j) {
    EXPECT_EQ(all.kinds[static_cast<std::size_t>(j)], ModeKind::normal);
    EXPECT_EQ(all.modes.lambda[j], kept.lambda[j]);
    EXPECT_EQ(all.modes.shapes.col(j), kept.shapes.col(j));
  }
  // orthogonal to the modes below, the others lie above the first that was left out
  EXPECT_EQ(all.kinds[10], ModeKind::attachment);
  EXPECT_GE(all.modes.lambda[10], (1 - 1e-12) * s.elastic().lambda[10]);
}

TEST(CombinedModes, OfACompleteSetAreThatSetToTheLastBit) {
  for (const TestStructure& s : {chassis(), l_shape(), random_lumped(8, 11)}) {
    const Modes complete = s.elastic();
    const MatrixX attachment = attachment_modes(s.K, s.M, s.rigid, interfaces(s));
    const MatrixX constraint = constraint_modes(s.K, s.rigid, interfaces(s));
    const CombinedModes all = combined_modes(s.K, s.M, s.rigid, complete, attachment, constraint);
    EXPECT_EQ(all.left_out, 18);
    EXPECT_EQ(all.modes.lambda, complete.lambda);
    EXPECT_EQ(all.modes.shapes, complete.shapes);
  }
}

TEST(CombinedModes, TakeWhatIsNamedTwiceOnce) {
  const TestStructure s = chassis();
  const Modes kept = s.elastic().lowest(5);
  const MatrixX once = attachment_modes(s.K, s.M, s.rigid, {0, 1, 2});
  MatrixX twice(s.n(), 7);
  twice << once, 1e3 * once, s.rigid.col(3);
  const CombinedModes all = combined_modes(s.K, s.M, s.rigid, kept, twice, none(s));
  EXPECT_EQ(all.modes.count(), 8);
  EXPECT_EQ(all.left_out, 4);
  expect_valid(s, all);
  const CombinedModes expected = combined_modes(s.K, s.M, s.rigid, kept, once, none(s));
  EXPECT_LE(worst_relative(all.modes.lambda, expected.modes.lambda), 1e-10);
}

TEST(CombinedModes, OfConstraintModesKeepTheStaticsOfABodyHeldAtItsInterfaces) {
  // Craig and Bampton: exact where forces act at interfaces only and no inertia does
  const TestStructure s = l_shape();
  const std::vector<int> freedoms = interfaces(s);
  const CombinedModes all = combined_modes(s.K, s.M, s.rigid, s.elastic().lowest(3), none(s),
                                           constraint_modes(s.K, s.rigid, freedoms));
  expect_valid(s, all);
  EXPECT_EQ(all.modes.count(), 6);  // nine displacements less six of rigid motion
  // forces at the interfaces that are in equilibrium
  const MatrixX B = s.rigid(freedoms, Eigen::all);
  const MatrixX balanced = MatrixX::Identity(9, 9) - B * (B.transpose() * B).inverse() * B.transpose();
  const MatrixX truth = statics(s.elastic(), freedoms) * balanced;
  EXPECT_LE((statics(all.modes, freedoms) * balanced - truth).norm(), 1e-10 * truth.norm());
  EXPECT_GE((statics(s.elastic().lowest(6), freedoms) * balanced - truth).norm(), 0.01 * truth.norm());
}

TEST(CombinedModes, AreTheClosestModesOfTheHeldBodyFromAboveWithConstraintModes) {
  const TestStructure s = chassis();
  const SupportMatrices support = support_matrices(chassis_joints(), s.freedoms());
  const Modes truth = modes_on(s, support);
  const MatrixX constraint = constraint_modes(s.K, s.rigid, interfaces(s));
  double before = std::numeric_limits<double>::infinity();
  for (const int kept : {0, 5, 10, 20, 40}) {
    const CombinedModes all =
        combined_modes(s.K, s.M, s.rigid, s.elastic().lowest(kept), none(s), constraint);
    expect_valid(s, all);
    MatrixX X(s.n(), all.modes.count() + 6);
    X << s.rigid, all.modes.shapes;
    // on stiff springs in place of the joints
    const SparseMatrix K_held = s.K + SparseMatrix(support.D.transpose() * support.D) * 1e12;
    const Modes held = solve_eigenproblem(X.transpose() * (K_held * X), X.transpose() * (s.M * X));
    EXPECT_GE(held.lambda[0], (1 - 1e-5) * truth.lambda[0]);
    EXPECT_LE(held.lambda[0], before * (1 + 1e-9));
    before = held.lambda[0];
  }
}

TEST(CombinedModes, TellWhereTheyComeFrom) {
  const TestStructure s = l_shape();
  const MatrixX attachment = attachment_modes(s.K, s.M, s.rigid, {0, 1, 2});
  const MatrixX constraint = constraint_modes(s.K, s.rigid, interfaces(s));
  const CombinedModes all = combined_modes(s.K, s.M, s.rigid, s.elastic().lowest(4), attachment, constraint);
  expect_valid(s, all);
  const auto count = [&](ModeKind kind) { return std::count(all.kinds.begin(), all.kinds.end(), kind); };
  EXPECT_EQ(count(ModeKind::normal), 4);
  EXPECT_EQ(count(ModeKind::attachment) + count(ModeKind::constraint) + all.left_out, 12);
  EXPECT_GE(count(ModeKind::attachment), 1);
  EXPECT_GE(count(ModeKind::constraint), 1);
  EXPECT_STREQ(to_string(ModeKind::attachment), "attachment");
}

TEST(CombinedModes, AreRefusedWhenTheModesAreOfAnotherStructure) {
  const TestStructure s = chassis();
  Modes foreign = s.elastic().lowest(10);
  foreign.shapes.col(3) = (s.elastic().shapes.col(3) + s.elastic().shapes.col(30)) / std::sqrt(2.0);
  EXPECT_EQ(
      message_of<InputError>([&] {
        combined_modes(s.K, s.M, s.rigid, foreign, attachment_modes(s.K, s.M, s.rigid, {0, 1}), none(s));
      }).substr(0, 82),
      "modes: error: the kept modes must be modes of this stiffness and mass (got couplin");
}

}  // namespace
}  // namespace wishbone
