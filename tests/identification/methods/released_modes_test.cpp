// Free-free modes from supported ones: complete sets give back the truth, incomplete ones bound it.
#include "identification/methods/released_modes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "identification/methods/joint_support.h"
#include "identification/methods/residual.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/spring_support.h"
#include "identification/methods/support_matrices.h"
#include "identification/structures.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

SupportMatrices matrices(const Support& support, const TestStructure& s) {
  return support_matrices(support, s.freedoms());
}

ReleasedModes release_from(const TestStructure& s, const Support& support, Eigen::Index kept = -1) {
  const SupportMatrices held = matrices(support, s);
  const Modes all = modes_on(s, held);
  return release(kept < 0 ? all : all.lowest(kept), s.M, held, s.rigid);
}

void expect_orthonormal(const Modes& modes, const TestStructure& s) {
  const MatrixX gram = modes.shapes.transpose() * (s.M * modes.shapes);
  EXPECT_LE((gram - MatrixX::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((s.rigid.transpose() * (s.M * modes.shapes)).cwiseAbs().maxCoeff(), 1e-12);
}

VectorX as_vector(const std::vector<double>& values) {
  return Eigen::Map<const VectorX>(values.data(), static_cast<Eigen::Index>(values.size()));
}

TEST(ChassisOnSprings, HasThePublishedFrequencies) {
  const TestStructure s = chassis();
  const VectorX found = modes_on(s, matrices(springs_at({1, 2, 17, 18}, 47e3), s)).frequency_hz();
  const VectorX table = as_vector(published("chassis_on_springs.csv"));
  ASSERT_EQ(table.size(), found.size());
  EXPECT_LE(worst_relative(found, table), 5e-5);  // five digits are printed
}

TEST(ChassisOnJoints, HasThePublishedFrequencies) {
  const TestStructure s = chassis();
  const VectorX found = modes_on(s, matrices(chassis_joints(), s)).frequency_hz();
  const VectorX table = as_vector(published("chassis_on_joints.csv"));
  ASSERT_EQ(table.size(), found.size());
  EXPECT_LE(worst_relative(found, table), 5e-5);
}

class ChassisSupport : public testing::TestWithParam<double> {};

TEST_P(ChassisSupport, CompleteSetGivesTheFreeFrequencies) {
  const TestStructure s = chassis();
  const double k = GetParam();
  const ReleasedModes released =
      release_from(s, std::isfinite(k) ? springs_at({1, 2, 17, 18}, k) : chassis_joints());
  ASSERT_EQ(released.modes.count(), 54);
  EXPECT_LE(worst_relative(released.modes.frequency_hz(), s.elastic().frequency_hz()), 1e-9);
  EXPECT_LE(worst_relative(released.modes.frequency_hz(), as_vector(published("chassis_free_free.csv"))),
            1e-5);
  EXPECT_EQ(released.lost_modes, 0);
  EXPECT_LE(released.residual.maxCoeff(), 1e-7);
  expect_orthonormal(released.modes, s);
}

INSTANTIATE_TEST_SUITE_P(Stiffness, ChassisSupport,
                         testing::Values(1e2, 47e3, 1e6, 1e8, std::numeric_limits<double>::infinity()));

TEST(ReleasedModes, ComeBackFromAnyBodyAndSupport) {
  std::vector<TestStructure> structures{distorted_block({2, 2, 1}, 5), distorted_block({3, 1, 1}, 6),
                                        l_shape(), random_lumped(9, 7)};
  for (const TestStructure& s : structures) {
    const int a = s.node_ids[0], b = s.node_ids[2], c = s.node_ids[5];
    const Vector3 u = Vector3(1, -2, 0.5).normalized();
    Support slanted = springs_at({a, b}, 3e5);
    slanted.springs.push_back({c, u, 2e6});
    slanted.masses = {{a, 0.7}, {c, 1.3}};
    Support mixed = joints_at({{a, "xyz"}});
    mixed.springs = springs_at({b, c}, 1e5).springs;
    Support slanted_joints = joints_at({{a, "xyz"}, {b, "xy"}});
    slanted_joints.joints.push_back({c, u});
    for (const Support& support : {slanted, mixed, slanted_joints}) {
      const ReleasedModes released = release_from(s, support);
      ASSERT_EQ(released.modes.count(), s.n() - 6);
      EXPECT_LE(worst_relative(released.modes.frequency_hz(), s.elastic().frequency_hz()), 1e-8);
      EXPECT_EQ(released.lost_modes, 0);
      expect_orthonormal(released.modes, s);
    }
  }
}

TEST(ReleasedModes, CombineTheGivenOnesAsTheCoefficientsSay) {
  const TestStructure s = chassis();
  const SupportMatrices held = matrices(springs_at({1, 2, 17, 18}, 47e3), s);
  const Modes given = modes_on(s, held).lowest(27);
  const ReleasedModes released = release(given, s.M, held, s.rigid);
  MatrixX x = given.shapes * released.coefficients;
  x -= s.rigid * (s.rigid.transpose() * (s.M * x));
  EXPECT_LE((x - released.modes.shapes).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(ReleasedModes, OfIncompleteSetsLieAboveTheTruthAndWithinTheBound) {
  const TestStructure s = chassis();
  const VectorX truth = s.elastic().lambda;
  for (const Support& support :
       {springs_at({1, 2, 17, 18}, 1e3), springs_at({1, 2, 17, 18}, 1e6), chassis_joints()})
    for (const int kept : {10, 20, 27}) {
      const ReleasedModes released = release_from(s, support, kept);
      for (Eigen::Index j = 0; j < released.modes.count(); ++j) {
        EXPECT_GE(released.modes.lambda[j], (1 - 1e-9) * truth[j]);
        const double nearest = (truth.array() - released.modes.lambda[j]).abs().minCoeff();
        EXPECT_LE(nearest, (1e-9 + released.residual[j]) * released.modes.lambda[j]);
      }
      expect_orthonormal(released.modes, s);
    }
}

TEST(ReleasedModes, OfIncompleteSetsHaveErrorsOfTheEstimatedSize) {
  // for modes well below the last one kept the second-order estimate is right within a factor of five
  const TestStructure s = chassis();
  const VectorX truth = s.elastic().frequency_hz();
  for (const Support& support :
       {springs_at({1, 2, 17, 18}, 1e6), springs_at({1, 2, 17, 18}, 1e7), chassis_joints()})
    for (const int kept : {20, 27}) {
      const SupportMatrices held = matrices(support, s);
      const Modes given = modes_on(s, held).lowest(kept);
      const ReleasedModes released = release(given, s.M, held, s.rigid);
      const VectorX estimate =
          frequency_error_estimate(released.modes.lambda, released.residual, given.lambda[kept - 1]);
      const VectorX found = released.modes.frequency_hz();
      for (Eigen::Index j = 0; j < 4; ++j) {
        const double error = found[j] / truth[j] - 1;
        EXPECT_LE(error, 5 * estimate[j]) << kept << " modes, mode " << j;
        EXPECT_GE(error, estimate[j] / 5) << kept << " modes, mode " << j;
      }
    }
}

TEST(ReleasedModes, OfSoftSpringsNeedFewModes) {
  // a body on soft springs nearly vibrates as a free one: the kept modes are right, however few
  const TestStructure s = chassis();
  const ReleasedModes released = release_from(s, springs_at({1, 2, 17, 18}, 100), 20);
  ASSERT_EQ(released.modes.count(), 14);
  EXPECT_LE(worst_relative(released.modes.frequency_hz(), s.elastic().frequency_hz().head(14)), 1e-6);
}

TEST(ReleasedModes, ModalAndPhysicalSpaceAgree) {
  const TestStructure s = chassis();
  for (const double k : {1e2, 1e4, 1e6, 1e8})
    for (const int kept : {10, 20, 27, 60}) {
      const SupportMatrices held = matrices(springs_at({1, 2, 17, 18}, k), s);
      const Modes given = modes_on(s, held).lowest(kept);
      const Modes modal = release_from_springs(Space::kModal, given, s.M, held.M_s, held.K_s);
      const Modes physical = release_from_springs(Space::kPhysical, given, s.M, held.M_s, held.K_s);
      EXPECT_LE((modal.lambda - physical.lambda).cwiseAbs().maxCoeff(), 1e-12 * modal.lambda.maxCoeff());
    }
}

TEST(ReleasedModes, OfOverconstrainedBodiesCountWhatIsLost) {
  // four spherical joints take twelve freedoms of which six hold rigid motion: six elastic motions stay hidden
  const TestStructure s = slender_block();
  const SupportMatrices held = matrices(joints_at({{1, "xyz"}, {2, "xyz"}, {3, "xyz"}, {4, "xyz"}}), s);
  const ReleasedModes released = release(modes_on(s, held), s.M, held, s.rigid);
  EXPECT_EQ(released.lost_modes, 6);
  EXPECT_EQ(released.modes.count(), s.n() - 6 - 6);
  EXPECT_TRUE(std::isnan(released.residual[0]));
  expect_orthonormal(released.modes, s);
  // held at one end, the significant modes hardly strain the section that is held
  EXPECT_LE(worst_relative(released.modes.frequency_hz().head(5), s.elastic().frequency_hz().head(5)), 1e-3);
  EXPECT_LE(worst_relative(released.modes.frequency_hz().head(8), s.elastic().frequency_hz().head(8)), 5e-3);
}

TEST(ReleasedModes, OfOverconstrainedBodiesAreTheLeastSquaresSolution) {
  const TestStructure s = distorted_block({3, 1, 1}, 12);
  const SupportMatrices held = matrices(joints_at({{1, "xyz"}, {2, "xyz"}, {15, "xyz"}, {16, "xyz"}}), s);
  const Modes given = modes_on(s, held);
  const MatrixX K = stiffness_without_joints(given, s.M, held.D, s.rigid);
  EXPECT_LE((K - K.transpose()).norm(), 1e-12 * K.norm());
  EXPECT_LE((K * s.rigid).norm(), 1e-12 * K.norm() * s.rigid.norm());
  const Modes all = solve_eigenproblem(K, MatrixX(s.M));
  EXPECT_GE(all.lambda[0], -1e-9 * all.lambda[all.count() - 1]) << "positive semidefinite";
  // twelve motions without stiffness, six of them rigid
  EXPECT_LE(all.lambda[11], 1e-9 * all.lambda[all.count() - 1]);
  EXPECT_GE(all.lambda[12], 1e-4 * all.lambda[all.count() - 1]);
}

TEST(StiffnessWithoutJoints, IsTheStiffnessOfTheFreeBodyForSixJoints) {
  for (const TestStructure& s : {chassis(), l_shape(), random_lumped(6, 3)}) {
    Support support = joints_at({{s.node_ids[0], "xyz"}, {s.node_ids[2], "xz"}});
    support.joints.push_back({s.node_ids[5], Vector3(1, 1, 0.2).normalized()});
    const SupportMatrices held = matrices(support, s);
    const MatrixX K = stiffness_without_joints(modes_on(s, held), s.M, held.D, s.rigid);
    EXPECT_LE((K - MatrixX(s.K)).norm(), 1e-10 * K.norm());
  }
}

TEST(ReleasedModes, RefuseASupportThatLeavesRigidMotionFree) {
  const TestStructure s = chassis();
  const SupportMatrices held = matrices(joints_at({{1, "xyz"}, {2, "z"}}), s);
  const Modes given = modes_on(s, held);
  try {
    release({given.lambda.tail(54), given.shapes.rightCols(54)}, s.M, held, s.rigid);
    FAIL() << "an under-constrained support was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("leave rigid-body motion of the structure free"));
    EXPECT_THAT(error.what(), HasSubstr("4 of 6"));
  }
}

TEST(ReleasedModes, RefuseFewerModesThanRigidMotionsOnSprings) {
  const TestStructure s = chassis();
  EXPECT_THROW(release_from(s, springs_at({1, 2, 17, 18}, 47e3), 6), InputError);
}

TEST(SupportMatrices, NameAFreedomThatWasNotMeasured) {
  const std::vector<Freedom> only_z{{1, 2}, {2, 2}, {3, 2}};
  try {
    support_matrices(springs_at({2}, 1e3), only_z);
    FAIL() << "a spring on an unknown freedom was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("2 x"));
  }
}

}  // namespace
}  // namespace wishbone
