// Modes of a free model as a flexible body has them: chosen normal modes and static shapes.
#include "identification/flexible_modes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "core/error.h"
#include "identification/free_free_modes.h"
#include "identification/measured.h"
#include "identification/methods/attachment_modes.h"
#include "identification/methods/modes_below.h"
#include "identification/mode_table.h"
#include "identification/normal_modes.h"
#include "identification/structures.h"
#include "text_files.h"

namespace wishbone {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// 6 x 5 x 7 nodes without symmetry, 630 freedoms: beyond the size of dense eigenproblems.
TestStructure large_block() {
  return distorted_block({5, 4, 6}, 2);
}

TEST(NormalModes, AreChosenByNumberFrequencyAndList) {
  const TestStructure s = chassis();
  const AnalyticalModel model = model_of(s);
  const Modes all = s.elastic();
  const auto expect = [&](const ModeChoice& choice, const std::vector<int>& columns) {
    const Modes chosen = normal_modes(model, choice);
    EXPECT_EQ(chosen.lambda, all.lambda(columns));
    EXPECT_EQ(chosen.shapes, all.shapes(Eigen::all, columns));
  };
  expect(LowestModes{3}, {0, 1, 2});
  expect(ListedModes{{1, 5, 54}}, {0, 4, 53});
  expect(ModesBelow{std::sqrt(all.lambda[1]) * 1.0001}, {0, 1});  // two of equal frequency
  EXPECT_EQ(normal_modes(model, AllModes{}).count(), 54);
  EXPECT_EQ(normal_modes(model, ModesBelow{1e-3}).count(), 0);
}

TEST(NormalModes, OfEqualFrequencyAreNotSeparatedUnnoticed) {
  const AnalyticalModel model = model_of(chassis());  // modes 1 and 2 are a pair, the section is square
  const double pair = std::sqrt(chassis().elastic().lambda[0]);
  EXPECT_THAT(normal_modes(model, LowestModes{1}).split, ElementsAre(DoubleNear(pair, 1e-9 * pair)));
  EXPECT_THAT(normal_modes(model, ListedModes{{2}}).split, ElementsAre(DoubleNear(pair, 1e-9 * pair)));
  EXPECT_THAT(normal_modes(model, LowestModes{2}).split, IsEmpty());
  EXPECT_THAT(normal_modes(model, AllModes{}).split, IsEmpty());
}

TEST(NormalModes, OfALargeModelAreThoseOfTheDenseEigenproblem) {
  const TestStructure s = large_block();
  const Modes all = s.elastic();
  for (const ModeChoice& choice :
       {ModeChoice(LowestModes{12}), ModeChoice(ModesBelow{std::sqrt(all.lambda[11] * 1.001)})}) {
    const Modes found = normal_modes(model_of(s), choice);
    ASSERT_EQ(found.count(), 12);
    EXPECT_LE(worst_relative(found.lambda, all.lambda.head(12)), 1e-10);
    EXPECT_LE((found.shapes - all.shapes.leftCols(12)).norm(), 1e-6 * all.shapes.leftCols(12).norm());
  }
  EXPECT_EQ(normal_modes(model_of(s), ListedModes{{2, 9}}).lambda.size(), 2);
}

TEST(NormalModes, AreCountedBelowALimit) {
  const TestStructure s = large_block();
  const VectorX lambda = s.with_rigid().lambda;
  for (const int count : {7, 8, 20, 100})
    EXPECT_EQ(modes_below(s.K, s.M, (lambda[count - 1] + lambda[count]) / 2), count);
  EXPECT_EQ(modes_below(s.K, s.M, -1), 0);
}

TEST(NormalModes, AreRefusedOfStructuresThatAreHeldOrHaveLooseParts) {
  AnalyticalModel held = model_of(large_block());
  held.K.coeffRef(0, 0) += 1e9;
  EXPECT_EQ(
      message_of<InputError>([&] { normal_modes(held, LowestModes{5}); }).substr(0, 109),
      "flexible body: error: the stiffness must resist every motion but the six of a rigid body, and none of "
      "these (");
  const AnalyticalModel model = model_of(chassis());
  EXPECT_EQ(message_of<InputError>([&] { normal_modes(model, LowestModes{55}); }),
            "flexible body: error: the body has 54 elastic modes (got 55 wanted)\n"
            "  choose fewer");
}

TEST(FlexibleModes, AreASetThatABodyCanBeMadeOf) {
  for (const TestStructure& s : {chassis(), large_block()}) {
    const int last = s.node_ids.back();
    const FlexibleModes modes = flexible_modes(model_of(s), LowestModes{8}, {1, last}, {2, 3, last});
    EXPECT_NO_THROW(modes.set.validate());
    EXPECT_EQ(modes.set.mode_count() + modes.left_out, 8 + 6 + 9);
    EXPECT_EQ(modes.kinds.size(), static_cast<std::size_t>(modes.set.mode_count()));
  }
}

TEST(FlexibleModes, WithoutStaticShapesAreTheModesOfTheBlock) {
  const TestStructure s = chassis();
  const ModeSet expected = free_free_modes(s.node_ids, s.node_mass, s.nodes, MatrixX(s.K)).lowest(20);
  const ModeSet found = flexible_modes(model_of(s), LowestModes{20}, {}, {}).set;
  EXPECT_EQ(found.omega, expected.omega);
  EXPECT_EQ(found.shapes, expected.shapes);
  EXPECT_EQ(found.node_position, expected.node_position);
}

TEST(FlexibleModes, OfALargeModelKeepItsStaticsAtTheInterfaces) {
  const TestStructure s = large_block();
  const std::vector<int> nodes{1, 30, 77, s.node_ids.back()};
  const ModeSet set = flexible_modes(model_of(s), LowestModes{10}, nodes, {}).set;
  std::vector<int> freedoms;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) freedoms.push_back(3 * set.node_index(node) + axis);
  const MatrixX Psi = set.shapes(freedoms, Eigen::all);
  const Modes all = s.elastic();
  const MatrixX Psi_all = all.shapes(freedoms, Eigen::all);
  const MatrixX truth = Psi_all * all.lambda.cwiseInverse().asDiagonal() * Psi_all.transpose();
  const MatrixX found = Psi * set.omega.cwiseAbs2().cwiseInverse().asDiagonal() * Psi.transpose();
  EXPECT_LE((found - truth).norm(), 1e-10 * truth.norm());
}

TEST(FlexibleModes, AreRefusedWithoutModesOrNodes) {
  AnalyticalModel model = model_of(chassis());
  EXPECT_EQ(message_of<InputError>([&] { flexible_modes(model, ModesBelow{0.1}, {}, {}); }),
            "flexible body: error: no mode is chosen (got the normal modes below 0.0159155 Hz)\n"
            "  raise the limit, or write 'modes: none' for a rigid body");
  EXPECT_EQ(message_of<InputError>([&] { flexible_modes(model, AllModes{}, {99}, {}); }),
            "flexible body: error: the body has no such node (got node 99)\n"
            "  name nodes of the body");
  model.node_mass.resize(0);
  EXPECT_EQ(message_of<InputError>([&] { flexible_modes(model, AllModes{}, {}, {}); }),
            "flexible body: error: its masses must be lumped (got a mass matrix that is not lumped)\n"
            "  lump it: 'lumping: row_sum' or 'lumping: diagonal'");
}

TEST(ModeTable, OfACompleteSetShareOutTheMobilityOfANode) {
  // sum_j |Psi_ij|^2 over all modes, rigid ones too, is 3 / m_i, for Psi Psi^T = M^-1
  const TestStructure s = chassis();
  const FlexibleModes modes = flexible_modes(model_of(s), AllModes{}, {}, {});
  const std::vector<ModeRow> rows = mode_table(modes.set, modes.kinds, {7});
  ASSERT_EQ(rows.size(), 54u);
  double mobility = s.rigid.middleRows<3>(3 * modes.set.node_index(7)).squaredNorm();
  for (const ModeRow& row : rows) {
    EXPECT_EQ(row.node, 7);
    mobility += 1 / row.effective_mass;
  }
  EXPECT_NEAR(mobility * modes.set.node_mass[modes.set.node_index(7)], 3, 1e-12);
  EXPECT_DOUBLE_EQ(rows[0].frequency, modes.set.omega[0] / (2 * std::numbers::pi));
}

TEST(ModeTable, NamesTheInterfaceThatAModeMovesMost) {
  const TestStructure s = slender_block();
  const FlexibleModes modes = flexible_modes(model_of(s), LowestModes{4}, {}, {});
  const std::vector<ModeRow> some = mode_table(modes.set, modes.kinds, {1, 6});
  const std::vector<ModeRow> all = mode_table(modes.set, modes.kinds, {});
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_TRUE(some[j].node == 1 || some[j].node == 6);
    EXPECT_LE(all[j].effective_mass, some[j].effective_mass);
    EXPECT_EQ(some[j].kind, ModeKind::normal);
  }
}

TEST(ModeChoices, AreToldInWords) {
  EXPECT_EQ(describe(AllModes{}), "all normal modes");
  EXPECT_EQ(describe(LowestModes{1}), "the lowest normal mode");
  EXPECT_EQ(describe(LowestModes{10}), "the 10 lowest normal modes");
  EXPECT_EQ(describe(ModesBelow{400 * std::numbers::pi}), "the normal modes below 200 Hz");
  EXPECT_EQ(describe(ListedModes{{1, 2, 5}}), "normal modes 1, 2, 5");
}

}  // namespace
}  // namespace wishbone
