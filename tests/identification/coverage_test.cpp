// Measurements that show some nodes of a model only.
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

using testing::HasSubstr;

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

}  // namespace
}  // namespace wishbone
