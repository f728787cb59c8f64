// A task from beginning to end, against truths that dense matrices give without it.
#include "identification/identify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "identification/body_nodes.h"
#include "identification/measured.h"
#include "identification/methods/support_matrices.h"
#include "identification/mode_set_of.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Support chassis_springs() {
  return springs_at({1, 2, 17, 18}, 47e3);
}

/// The bottom corners on springs that carry 3 kg and 1 kg of fixtures.
Support chassis_springs_with_masses() {
  Support support = chassis_springs();
  support.masses = {{1, 3}, {18, 1}};
  return support;
}

/// Laid on nothing that resists, with two sensors.
Support chassis_sensors() {
  Support support;
  support.masses = {{3, 2}, {12, 0.5}};
  return support;
}

/// Three springs along z: no motion in the plane is resisted.
Support chassis_bounce_springs() {
  Support support;
  for (const int node : {1, 2, 17}) support.springs.push_back({node, Vector3::UnitZ(), 47e3});
  support.masses = {{3, 2}};
  return support;
}

/// One corner on a joint, the others on springs, and a sensor of 0.4 kg.
Support chassis_joint_and_springs() {
  Support support = joints_at({{1, "xyz"}});
  support.springs = {{18, Vector3::UnitY(), 3e5}, {2, Vector3::UnitZ(), 2e5}, {17, Vector3::UnitZ(), 4e5}};
  support.masses = {{20, 0.4}};
  return support;
}

IdentificationTask task_on(const TestStructure& s, const Support& support, Eigen::Index lowest = -1) {
  IdentificationTask task;
  task.measured = measured_on(s, support, lowest);
  return task;
}

VectorX frequencies(const Identification& found) {
  return found.modes.omega / (2 * std::numbers::pi);
}

VectorX free_frequencies(const TestStructure& s) {
  return true_frequencies(s.K, s.M, true);
}

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

TEST(Masses, FollowFromTotalCentreAndInertia) {
  for (Support (*support)() : {chassis_springs, chassis_joints, chassis_springs_with_masses}) {
    const TestStructure s = chassis();
    IdentificationTask task = task_on(s, support());
    RigidBodyData body;
    body.mass = s.node_mass.sum();
    body.centre = s.nodes * s.node_mass / body.mass;
    for (Eigen::Index i = 0; i < s.node_mass.size(); ++i) {
      const Vector3 p = s.nodes.col(i) - body.centre;
      body.inertia += s.node_mass[i] * (p.squaredNorm() * Matrix3::Identity() - p * p.transpose());
    }
    task.measured.node_mass.resize(0);
    task.rigid_body = body;
    const Identification found = identify(task);
    EXPECT_LE(worst_relative(found.modes.node_mass, s.node_mass), 1e-6);
    EXPECT_LE(worst_relative(frequencies(found), free_frequencies(s)), 1e-6);
    EXPECT_THAT(found.judgement.warnings, IsEmpty());
  }
}

TEST(Masses, MayBeAMatrix) {
  const TestStructure s = chassis();
  IdentificationTask task = task_on(s, chassis_springs());
  task.measured.node_mass.resize(0);
  task.mass = s.M;
  EXPECT_LE(worst_relative(frequencies(identify(task)), free_frequencies(s)), 1e-8);
  for (const SparseMatrix& wrong : {SparseMatrix(57, 57), SparseMatrix(60, 57)}) {
    task.mass = wrong;
    EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
                HasSubstr("the mass matrix must have a row and a column for every freedom of the modes"));
  }
}

TEST(Masses, MustBeKnown) {
  IdentificationTask task = task_on(chassis(), chassis_springs());
  task.measured.node_mass.resize(0);
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
              HasSubstr("the masses of the nodes are not known (got 20 nodes)"));
}

const std::vector<int> kEndsAndMiddle{1, 2, 3, 4, 9, 10, 11, 12, 17, 18, 19, 20};

TEST(Coverage, SerepRecoversModesThatLieInTheSpanOfTheModel) {
  const TestStructure s = chassis();
  const IdentificationTask full = task_on(s, chassis_springs(), 15);
  IdentificationTask task = full;
  task.measured = seen_at(kEndsAndMiddle, full.measured);
  task.model = model_of(s);
  task.coverage = Coverage::kSerep;
  const Identification found = identify(task), truth = identify(full);
  ASSERT_EQ(found.modes.freedom_count(), 60);
  EXPECT_LE(plane_distance(found.input.shapes, full.measured.shapes, s.M), 1e-8);
  EXPECT_LE(worst_relative(found.modes.omega, truth.modes.omega), 1e-8);
  EXPECT_EQ(mode_set_of(found.modes).node_ids, s.node_ids);
}

/// The chassis with next to no mass at nodes that are not seen, which makes these follow statically.
TestStructure massive_at(const std::vector<int>& seen) {
  TestStructure s = chassis();
  for (std::size_t i = 0; i < s.node_ids.size(); ++i)
    if (std::find(seen.begin(), seen.end(), s.node_ids[i]) == seen.end())
      s.node_mass[static_cast<Eigen::Index>(i)] *= 1e-12;
  s.M = lumped_mass_matrix(s.node_mass);
  return s;
}

/// Its seen freedoms alone, with the stiffness that these have: K_mm - K_ms K_ss^-1 K_sm.
TestStructure condensed_to(const std::vector<int>& seen, const TestStructure& s) {
  std::vector<int> m, rest;
  for (const Freedom& freedom : s.freedoms()) {
    const bool is_seen = std::find(seen.begin(), seen.end(), freedom.node) != seen.end();
    (is_seen ? m : rest).push_back(3 * (freedom.node - 1) + freedom.axis);
  }
  const MatrixX K = s.K;
  TestStructure small;
  small.K = (K(m, m) - K(m, rest) * K(rest, rest).inverse() * K(rest, m)).sparseView();
  small.node_ids = seen;
  std::vector<int> columns;
  for (const int node : seen) columns.push_back(node - 1);
  small.nodes = s.nodes(Eigen::all, columns);
  small.node_mass = s.node_mass(columns);
  small.M = lumped_mass_matrix(small.node_mass);
  return small;
}

class StaticCoverage : public testing::TestWithParam<Coverage> {};

TEST_P(StaticCoverage, IsExactWhereUnseenNodesHaveNoMass) {
  const TestStructure s = massive_at(kEndsAndMiddle);
  const TestStructure condensed = condensed_to(kEndsAndMiddle, s);
  const VectorX truth = true_frequencies(condensed.K, condensed.M, true);
  for (const Support& support : {chassis_springs(), chassis_joints()}) {
    IdentificationTask task = task_on(condensed, support);
    task.model = model_of(s);
    task.coverage = GetParam();
    const Identification found = identify(task);
    ASSERT_EQ(found.modes.mode_count(), 30);
    EXPECT_LE(worst_relative(frequencies(found), truth), 1e-7);
    EXPECT_EQ(found.modes.freedom_count(), GetParam() == Coverage::kGuyan ? 36 : 60);
  }
}

TEST_P(StaticCoverage, TakesAMassMatrixOfTheModelOnlyWhenItExpands) {
  const TestStructure s = massive_at(kEndsAndMiddle);
  IdentificationTask task = task_on(condensed_to(kEndsAndMiddle, s), chassis_springs());
  task.model = model_of(s);
  task.coverage = GetParam();
  task.mass = s.M;
  if (GetParam() == Coverage::kStatic)
    EXPECT_NO_THROW(identify(task));
  else
    EXPECT_THAT(message_of<InputError>([&] { identify(task); }), HasSubstr("and given besides"));
}

INSTANTIATE_TEST_SUITE_P(Chassis, StaticCoverage, testing::Values(Coverage::kStatic, Coverage::kGuyan),
                         [](const auto& c) { return c.param == Coverage::kStatic ? "Static" : "Guyan"; });

TEST(Coverage, WantsTheModelToHaveTheNodesMeasured) {
  IdentificationTask task = task_on(chassis(), chassis_springs(), 15);
  task.coverage = Coverage::kSerep;
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }), HasSubstr("need a model"));
  task.model = model_of(slender_block());
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
              HasSubstr("the model has no such node (got 17 x)"));
}

std::vector<std::string> warnings_of(const IdentificationTask& task) {
  return identify(task).judgement.warnings;
}

TEST(Warnings, TellOfSpringsStatedWrongly) {
  IdentificationTask task = task_on(chassis(), chassis_springs());
  for (Support::Spring& spring : task.measured.support.springs) spring.stiffness *= 0.8;
  EXPECT_THAT(warnings_of(task), Contains(HasSubstr("inertia and spring forces are out of balance by")));
}

TEST(Warnings, TellOfMassesOnTheWrongNodes) {
  IdentificationTask task = task_on(chassis(), chassis_springs());
  task.measured.node_mass.reverseInPlace();
  EXPECT_THAT(warnings_of(task), IsEmpty()) << "the chassis is its own mirror image";
  task.measured.node_mass = VectorX(20);
  for (int i = 0; i < 20; ++i) task.measured.node_mass[i] = chassis().node_mass[(i + 3) % 20];
  EXPECT_THAT(warnings_of(task), Contains(HasSubstr("not orthogonal in the given masses")));
}

TEST(Warnings, TellOfASupportTooStiffForTheKeptModes) {
  const auto stiff = [](Eigen::Index kept) {
    return warnings_of(task_on(chassis(), springs_at({1, 2, 17, 18}, 1e9), kept));
  };
  EXPECT_THAT(stiff(20), Contains(HasSubstr("the kept modes cannot carry the support")));
  for (const std::string& warning : stiff(-1)) EXPECT_THAT(warning, Not(HasSubstr("cannot carry")));
}

TEST(Warnings, TellOfModesThatTheSupportHides) {
  Support support = chassis_joints();
  support.joints.push_back({20, Vector3::UnitZ()});
  support.joints.push_back({19, Vector3::UnitX()});
  const Identification found = identify(task_on(chassis(), support));
  EXPECT_EQ(found.judgement.lost_modes, 2);
  EXPECT_THAT(found.judgement.warnings,
              Contains(HasSubstr("over-constrained: 2 elastic modes cannot be recovered")));
  EXPECT_EQ(identify(task_on(chassis(), chassis_joints())).judgement.lost_modes, 0);
}

TEST(Warnings, TellOfDirectionsThatWereNotMeasured) {
  IdentificationTask task = task_on(chassis(), {}, 10);
  std::vector<int> rows;
  std::vector<Freedom> freedoms;
  for (int i = 0; i < 60; ++i)
    if (i % 3 != 0) {
      rows.push_back(i);
      freedoms.push_back(task.measured.freedoms[static_cast<std::size_t>(i)]);
    }
  task.measured.shapes = MatrixX(task.measured.shapes(rows, Eigen::all));
  task.measured.freedoms = freedoms;
  const Identification found = identify(task);
  EXPECT_THAT(found.judgement.warnings, Contains(HasSubstr("40 of 60 freedoms of 20 nodes were measured")));
  EXPECT_THAT(message_of<InputError>([&] { mode_set_of(found.modes); }), HasSubstr("1 x is missing"));
}

TEST(Warnings, TellOfAModelThatLiesElsewhere) {
  IdentificationTask task = task_on(chassis(), {}, 15);
  task.model = model_of(chassis());
  task.coverage = Coverage::kStatic;
  EXPECT_THAT(warnings_of(task), Not(Contains(HasSubstr("lies"))));
  task.model->node_position.col(4).x() += 0.3;
  EXPECT_THAT(warnings_of(task), Contains(HasSubstr("node 5 of the model lies 0.3 m from where it was "
                                                    "measured")));
}

TEST(Reference, IsComparedModeByMode) {
  const TestStructure s = chassis();
  IdentificationTask task = task_on(s, chassis_joints());
  task.reference = measured_on(s, {}, 12);
  task.reference->omega *= 0.98;
  task.reference_name = "finite elements";
  task.keep = 10;
  const Identification found = identify(task);
  const ReferenceComparison& comparison = *found.judgement.reference;
  EXPECT_EQ(comparison.name, "finite elements");
  EXPECT_EQ(comparison.mac.rows(), 10);
  EXPECT_EQ(comparison.mac.cols(), 12);
  EXPECT_LE((comparison.frequency_error.array() - (1 / 0.98 - 1)).abs().maxCoeff(), 1e-3)
      << "pairs of equal frequency may change partners, which changes nothing";
  std::vector<int> partner = comparison.partner;
  std::sort(partner.begin(), partner.end());
  EXPECT_THAT(partner, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  task.reference->node_ids = std::vector<int>(20);
  for (int i = 0; i < 20; ++i) task.reference->node_ids[static_cast<std::size_t>(i)] = 100 + i;
  task.reference->freedoms = all_freedoms(task.reference->node_ids);
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }), HasSubstr("no freedom in common"));
}

TEST(Nodes, OfTheBodyAreKnownBeforeItsModes) {
  const TestStructure s = distorted_block({2, 1, 1}, 3);
  std::vector<IdentificationTask> tasks(3, task_on(s, springs_at({1, 2, 5, 8}, 1e5)));
  tasks[1].goal = Goal::kChanged;
  tasks[1].change.masses = {{4, 30}, {1, -2}, {4, 5}};
  tasks[2].measured =
      seen_at({1, 2, 3, 5, 7, 8, 11, 12}, task_on(s, springs_at({1, 2, 5, 8}, 1e5), 9).measured);
  tasks[2].model = model_of(s);
  tasks[2].coverage = Coverage::kSerep;
  for (const IdentificationTask& task : tasks) {
    const BodyNodes nodes = body_nodes(task);
    const ModeSet set = mode_set_of(identify(task).modes);
    EXPECT_EQ(nodes.ids, set.node_ids);
    EXPECT_LE((nodes.position - set.node_position).cwiseAbs().maxCoeff(), 1e-12);
  }
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
