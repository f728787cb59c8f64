// What becomes of the damping of measured modes.
#include <gtest/gtest.h>

#include <cmath>

#include "identification/identify.h"
#include "identification/measured.h"
#include "identification/methods/support_matrices.h"

namespace wishbone {
namespace {

/// Damping ratios of the identified modes for those of the measured ones.
VectorX damping_from(IdentificationTask task, const VectorX& measured) {
  task.measured.damping_ratio = measured;
  return identify(task).modes.damping_ratio;
}

TEST(Damping, OfFreeModesStays) {
  IdentificationTask task = task_on(chassis(), {}, 20);
  const VectorX zeta = VectorX::LinSpaced(20, 0.01, 0.05);
  EXPECT_LE((damping_from(task, zeta) - zeta).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Damping, ProportionalToMassStaysProportionalOffSprings) {
  // D = alpha M: zeta omega = alpha / 2 of every mode, on springs and off them
  IdentificationTask task = task_on(chassis(), chassis_springs());
  constexpr double kAlpha = 3;
  const VectorX found = damping_from(task, (kAlpha / 2 / task.measured.omega.array()).matrix());
  const VectorX omega = identify(task).modes.omega;
  EXPECT_LE(worst_relative(found.cwiseProduct(omega), VectorX::Constant(54, kAlpha / 2)), 1e-8);
}

TEST(Damping, ProportionalToStiffnessStaysProportionalOffJoints) {
  // D = beta K of the structure alone, which no rigid motion feels: zeta = beta omega / 2, of an incomplete set too
  constexpr double kBeta = 1e-4;
  for (const Eigen::Index kept : {54, 30}) {
    IdentificationTask task = task_on(chassis(), chassis_joints(), kept);
    const VectorX found = damping_from(task, kBeta / 2 * task.measured.omega);
    EXPECT_LE(worst_relative(found, kBeta / 2 * identify(task).modes.omega), 1e-8);
  }
}

TEST(Damping, OfTheSupportIsCountedIn) {
  // D = beta (K + K_s): what the springs dissipate in a mode stays with it
  constexpr double kBeta = 1e-4;
  const TestStructure s = chassis();
  IdentificationTask task = task_on(s, chassis_springs());
  const VectorX found = damping_from(task, kBeta / 2 * task.measured.omega);
  const Identification free = identify(task);
  const SparseMatrix K_s = support_matrices(chassis_springs(), s.freedoms()).K_s;
  for (Eigen::Index j = 0; j < found.size(); ++j) {
    const VectorX x = free.modes.shapes.col(j);
    const double omega = free.modes.omega[j];
    EXPECT_NEAR(found[j], kBeta / 2 * (omega * omega + x.dot(K_s * x)) / omega, 1e-8 * found[j]);
  }
}

TEST(Damping, FollowsTheModesOntoJoints) {
  constexpr double kBeta = 1e-4;
  IdentificationTask task = task_on(chassis(), {});
  task.goal = Goal::kHeld;
  task.support = chassis_joints();
  const VectorX found = damping_from(task, kBeta / 2 * task.measured.omega);
  EXPECT_LE(worst_relative(found, kBeta / 2 * identify(task).modes.omega), 1e-8);
}

TEST(Damping, OfOneRatioStaysWithinItsBounds) {
  // zeta_k omega_k = zeta sum c^2 omega_j, and sum c^2 omega_j^2 = omega_k^2 + x^T K_s x with sum c^2 = 1 (Jensen)
  const TestStructure s = chassis();
  IdentificationTask task = task_on(s, chassis_springs());
  const VectorX found = damping_from(task, VectorX::Constant(60, 0.02));
  const Identification free = identify(task);
  const SparseMatrix K_s = support_matrices(chassis_springs(), s.freedoms()).K_s;
  for (Eigen::Index j = 0; j < found.size(); ++j) {
    const VectorX x = free.modes.shapes.col(j);
    EXPECT_LE(found[j], 0.02 * std::sqrt(1 + x.dot(K_s * x) / std::pow(free.modes.omega[j], 2)) * (1 + 1e-9));
    EXPECT_GT(found[j], 0.019);
  }
}

}  // namespace
}  // namespace wishbone
