// Warnings appear when they should; known modes are compared with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "identification/identify.h"
#include "identification/measured.h"
#include "identification/mode_set_of.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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

}  // namespace
}  // namespace wishbone
