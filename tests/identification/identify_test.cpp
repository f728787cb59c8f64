// A task from beginning to end, against truths that dense matrices give without it.
#include "identification/identify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "identification/measured.h"
#include "identification/methods/support_matrices.h"
#include "identification/mode_set_of.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// Rows of joints along the axes.
std::vector<int> held_rows(const TestStructure& s, const Support& support) {
  std::vector<int> rows;
  const std::vector<Freedom> freedoms = s.freedoms();
  for (const Support::Joint& joint : support.joints)
    for (int axis = 0; axis < 3; ++axis)
      if (joint.direction[axis] != 0)
        rows.push_back(static_cast<int>(
            std::find(freedoms.begin(), freedoms.end(), Freedom{joint.node, axis}) - freedoms.begin()));
  return rows;
}

struct Case {
  const char* name;
  Support (*support)();
  Space space;
  friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }
};

const Case kCases[] = {
    {"FreeInModalSpace", [] { return Support{}; }, Space::kModal},
    {"FreeInPhysicalSpace", [] { return Support{}; }, Space::kPhysical},
    {"SpringsInModalSpace", chassis_springs, Space::kModal},
    {"SpringsInPhysicalSpace", chassis_springs, Space::kPhysical},
    {"JointsInModalSpace", chassis_joints, Space::kModal},
    {"JointsInPhysicalSpace", chassis_joints, Space::kPhysical},
    {"SpringsWithMassesInModalSpace", chassis_springs_with_masses, Space::kModal},
    {"SpringsWithMassesInPhysicalSpace", chassis_springs_with_masses, Space::kPhysical},
    {"SensorsInModalSpace", chassis_sensors, Space::kModal},
    {"SensorsInPhysicalSpace", chassis_sensors, Space::kPhysical},
    {"BounceSpringsInModalSpace", chassis_bounce_springs, Space::kModal},
    {"BounceSpringsInPhysicalSpace", chassis_bounce_springs, Space::kPhysical},
    {"JointSpringsAndMassInModalSpace", chassis_joint_and_springs, Space::kModal},
};

class CompleteTest : public testing::TestWithParam<Case> {
 protected:
  IdentificationTask task() const {
    IdentificationTask task = task_on(s_, GetParam().support());
    task.space = GetParam().space;
    return task;
  }
  TestStructure s_ = chassis();
};

TEST_P(CompleteTest, GivesTheFreeModes) {
  const Identification found = identify(task());
  EXPECT_LE(worst_relative(frequencies(found), free_frequencies(s_)), 1e-8);
  EXPECT_TRUE(found.modes.support.empty());
  EXPECT_THAT(found.judgement.warnings, IsEmpty());
  EXPECT_LE(found.judgement.orthogonality_error, 1e-11);
  EXPECT_LE(found.judgement.rigid_body_error, 1e-11);
  const ModeSet set = mode_set_of(found.modes);
  // every shape solves the eigenproblem of the free structure
  const MatrixX residual =
      s_.K * found.modes.shapes - s_.M * found.modes.shapes * set.omega.cwiseAbs2().asDiagonal();
  EXPECT_LE(residual.cwiseAbs().maxCoeff(), 1e-7 * (s_.K * found.modes.shapes).cwiseAbs().maxCoeff());
}

TEST_P(CompleteTest, GivesTheModesOnOtherSprings) {
  IdentificationTask task = this->task();
  task.goal = Goal::kHeld;
  task.support = springs_at({3, 4, 9, 20}, 2e5);
  task.support.masses = {{9, 2.5}};
  const SupportMatrices m = support_matrices(task.support, s_.freedoms());
  const Identification found = identify(task);
  EXPECT_LE(worst_relative(frequencies(found), true_frequencies(s_.K + m.K_s, s_.M + m.M_s, false)), 1e-8);
  EXPECT_EQ(found.modes.support.springs.size(), 12u);
  EXPECT_THAT(found.judgement.warnings, IsEmpty());
}

TEST_P(CompleteTest, GivesTheModesOnOtherJoints) {
  IdentificationTask task = this->task();
  task.goal = Goal::kHeld;
  task.support = joints_at({{3, "xyz"}, {20, "yz"}, {6, "x"}, {11, "y"}});
  const Identification found = identify(task);
  EXPECT_LE(
      worst_relative(frequencies(found), true_frequencies(s_.K, s_.M, false, held_rows(s_, task.support))),
      1e-8);
  for (const int row : held_rows(s_, task.support))
    EXPECT_LE(found.modes.shapes.row(row).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(CompleteTest, GivesTheModesOnJointsAndSprings) {
  IdentificationTask task = this->task();
  task.goal = Goal::kHeld;
  task.support = joints_at({{3, "xyz"}});
  task.support.springs = springs_at({18, 20}, 1e6).springs;
  task.support.masses = {{18, 1.5}};
  const SupportMatrices m = support_matrices(task.support, s_.freedoms());
  const VectorX truth = true_frequencies(s_.K + m.K_s, s_.M + m.M_s, false, held_rows(s_, task.support));
  EXPECT_LE(worst_relative(frequencies(identify(task)), truth), 1e-8);
}

TEST_P(CompleteTest, GivesTheModesOfTheChangedStructure) {
  IdentificationTask task = this->task();
  task.goal = Goal::kChanged;
  task.change.masses = {{20, 40}, {2, -5}};
  const Vector3 u = (s_.nodes.col(18) - s_.nodes.col(0)).normalized();
  task.change.springs = {{{1, 19}, u, 3e5}};
  MatrixX K = s_.K, M = s_.M;
  for (int axis = 0; axis < 3; ++axis) {
    M(57 + axis, 57 + axis) += 40;
    M(3 + axis, 3 + axis) -= 5;
  }
  VectorX direction = VectorX::Zero(60);  // of the stretch of the spring
  direction.head(3) = -u;
  direction.segment(54, 3) = u;
  K += 3e5 * direction * direction.transpose();

  const Identification found = identify(task);
  EXPECT_LE(worst_relative(frequencies(found), true_frequencies(K, M, true)), 1e-8);
  EXPECT_NEAR(found.modes.node_mass.sum(), s_.node_mass.sum() + 35, 1e-9);
  EXPECT_THAT(found.judgement.warnings, IsEmpty());
  EXPECT_EQ(mode_set_of(found.modes).mode_count(), 54) << "a body can be made of it";

  IdentificationTask by_matrices = this->task();
  by_matrices.goal = Goal::kChanged;
  by_matrices.change.dM = SparseMatrix((M - MatrixX(s_.M)).sparseView());
  by_matrices.change.dK = SparseMatrix((K - MatrixX(s_.K)).sparseView());
  EXPECT_LE(worst_relative(frequencies(identify(by_matrices)), true_frequencies(K, M, true)), 1e-8);
}

TEST_P(CompleteTest, CorrectsAModelIntoTheStructure) {
  // every mode is measured, so the corrected model is the structure itself, whatever the model was
  IdentificationTask task = this->task();
  task.goal = Goal::kCorrected;
  task.model = model_of(s_);
  task.model->K *= 1.3;
  const Identification found = identify(task);
  ASSERT_TRUE(found.corrected);
  EXPECT_LE((found.corrected->K - MatrixX(s_.K)).cwiseAbs().maxCoeff(),
            1e-7 * MatrixX(s_.K).cwiseAbs().maxCoeff());
  EXPECT_LE((found.corrected->M - MatrixX(s_.M)).cwiseAbs().maxCoeff(), 1e-9 * s_.node_mass.maxCoeff());
  EXPECT_LE(worst_relative(frequencies(found), free_frequencies(s_)), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Chassis, CompleteTest, testing::ValuesIn(kCases),
                         [](const auto& c) { return std::string(c.param.name); });

TEST(Identify, RefusesWhatPhysicalSpaceCannotDo) {
  IdentificationTask task = task_on(chassis(), chassis_joint_and_springs());
  task.space = Space::kPhysical;
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
              AllOf(HasSubstr("springs or masses beside joints are taken off in modal space only"),
                    HasSubstr("take 'space: modal'")));
}

TEST(Identify, RefusesANewSupportThatHoldsTooLittle) {
  for (const Support& support :
       {joints_at({{3, "xyz"}, {20, "yz"}, {7, "x"}}), chassis_bounce_springs(), chassis_sensors()}) {
    IdentificationTask task = task_on(chassis(), chassis_springs());
    task.goal = Goal::kHeld;
    task.support = support;
    EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
                HasSubstr("it leaves rigid-body motion of the structure free (got "));
  }
}

TEST(Identify, GivesUpperBoundsFromIncompleteSets) {
  const TestStructure s = chassis();
  const VectorX truth = free_frequencies(s);
  for (const Support& support : {chassis_springs(), chassis_joints(), chassis_joint_and_springs()})
    for (const int kept : {12, 25, 40}) {
      const VectorX found = frequencies(identify(task_on(s, support, kept)));
      for (Eigen::Index j = 0; j < found.size(); ++j) EXPECT_GE(found[j], truth[j] * (1 - 1e-10));
    }
}

TEST(Identify, KeepsTheLowestModes) {
  const TestStructure s = chassis();
  IdentificationTask task = task_on(s, chassis_springs());
  task.keep = 7;
  const Identification found = identify(task);
  EXPECT_LE(worst_relative(frequencies(found), free_frequencies(s).head(7)), 1e-8);
  EXPECT_EQ(found.modes.shapes.cols(), 7);
  EXPECT_EQ(found.judgement.residual.size(), 7);
  EXPECT_EQ(found.judgement.input_mac.rows(), 7);
  EXPECT_EQ(found.judgement.input_mac.cols(), 60);
}

TEST(Correction, GivesTheModelTheMeasuredModesAndKeepsItFree) {
  const TestStructure s = chassis();
  IdentificationTask task = task_on(s, chassis_springs(), 20);
  task.goal = Goal::kCorrected;
  task.model = model_of(s);
  task.model->K *= 1.1;
  const Identification found = identify(task);
  IdentificationTask free_task = task_on(s, chassis_springs(), 20);
  const VectorX measured = frequencies(identify(free_task));
  const VectorX corrected = true_frequencies(found.corrected->K, found.corrected->M, true);
  for (const double f : measured)
    EXPECT_LE((corrected.array() / f - 1).abs().minCoeff(), 1e-8) << f << " Hz is not among its modes";
  EXPECT_LE((found.corrected->K * s.rigid).cwiseAbs().maxCoeff(), 1e-8 * MatrixX(s.K).cwiseAbs().maxCoeff());
  EXPECT_EQ(mode_set_of(found.modes).mode_count(), 54) << "a body can be made of it";
}

TEST(Correction, WantsAModelOverTheFreedomsOfTheModes) {
  IdentificationTask task = task_on(chassis(), chassis_springs());
  task.goal = Goal::kCorrected;
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }), HasSubstr("(got no model)"));
  task.model = model_of(slender_block());
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
              HasSubstr("48 freedoms of the model, 60 of the modes"));
}

TEST(Identify, RefusesForcesAndMassesOnNodesThatTheModesDoNotShow) {
  const auto message = [](auto change) {
    IdentificationTask task = task_on(chassis(), chassis_springs());
    change(task);
    return message_of<InputError>([&] { identify(task); });
  };
  EXPECT_THAT(message([](IdentificationTask& task) { task.measured.support.springs[0].node = 99; }),
              HasSubstr("a support spring names a node that has no position (got node 99)"));
  EXPECT_THAT(message([](IdentificationTask& task) {
                task.goal = Goal::kHeld;
                task.support = joints_at({{99, "y"}});
              }),
              HasSubstr("it acts on a freedom that the modes do not show (got 99 y)"));
  for (const bool lumped : {true, false})
    EXPECT_THAT(message([lumped](IdentificationTask& task) {
                  task.goal = Goal::kChanged;
                  task.change.masses = {{99, 1}};
                  if (lumped) return;
                  task.mass = chassis().M;
                  task.measured.node_mass.resize(0);
                }),
                HasSubstr("a mass stands on a node that the modes do not show (got node 99)"));
  EXPECT_THAT(message([](IdentificationTask& task) {
                task.goal = Goal::kHeld;
                task.support = chassis_joints();
                task.support.masses = {{99, 1}};
              }),
              HasSubstr("a mass stands on a node that the modes do not show (got node 99)"));
  EXPECT_THAT(message([](IdentificationTask& task) {
                task.goal = Goal::kChanged;
                task.change.dK = SparseMatrix(3, 3);
              }),
              HasSubstr("60 freedoms need a change of stiffness of 60 x 60 (got 3 x 3)"));
}

TEST(Identify, TellsWhenModesContradictTheirSprings) {
  IdentificationTask task = task_on(chassis(), chassis_springs());
  for (Support::Spring& spring : task.measured.support.springs) spring.stiffness *= 1e4;
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
              HasSubstr("an identified mode has no stiffness"));
}

TEST(Identify, RepeatsBitForBit) {
  IdentificationTask task = task_on(chassis(), chassis_joint_and_springs(), 30);
  task.measured.damping_ratio.setConstant(0.01);
  task.noise = MeasurementNoise{0.001, 0.01, 20, 3};
  const Identification a = identify(task), b = identify(task);
  EXPECT_EQ(a.modes.omega, b.modes.omega);
  EXPECT_EQ(a.modes.shapes, b.modes.shapes);
  EXPECT_EQ(a.modes.damping_ratio, b.modes.damping_ratio);
  EXPECT_EQ(a.judgement.residual, b.judgement.residual);
  EXPECT_TRUE(a.judgement.frequency_std_hz.allFinite());
  EXPECT_EQ(a.judgement.frequency_std_hz, b.judgement.frequency_std_hz);
}

}  // namespace
}  // namespace wishbone
