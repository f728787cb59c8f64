// Normal modes of held interfaces, alone and with constraint modes as the reduction of Craig and Bampton.
#include "identification/fixed_interface_modes.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/null_space.h"
#include "identification/flexible_modes.h"
#include "identification/measured.h"
#include "identification/structures.h"
#include "text_files.h"

namespace wishbone {
namespace {

/// Three nodes far apart.
std::vector<int> far_nodes(const TestStructure& s) {
  return {s.node_ids.front(), s.node_ids[s.node_ids.size() / 2], s.node_ids.back()};
}

std::vector<int> far_freedoms(const TestStructure& s) {
  const int middle = 3 * static_cast<int>(s.node_ids.size() / 2), last = static_cast<int>(s.n()) - 3;
  return {0, 1, 2, middle, middle + 1, middle + 2, last, last + 1, last + 2};
}

FlexibleModes craig_bampton(const TestStructure& s, const ModeChoice& fixed) {
  return flexible_modes(model_of(s), fixed, {}, far_nodes(s), NormalModes::of_held_interfaces);
}

/// The matrices without the rows and columns of the interfaces.
Modes dense_held_modes(const TestStructure& s) {
  std::vector<int> inner;
  const std::vector<int> held = far_freedoms(s);
  for (int i = 0; i < s.n(); ++i)
    if (std::find(held.begin(), held.end(), i) == held.end()) inner.push_back(i);
  return solve_eigenproblem(MatrixX(s.K)(inner, inner), MatrixX(s.M)(inner, inner));
}

TEST(FixedInterfaceModes, AreThoseOfTheMatricesWithoutTheInterfaces) {
  for (const TestStructure& s : {chassis(), l_shape(), distorted_block({5, 4, 6}, 2)}) {
    const VectorX truth = dense_held_modes(s).lambda;
    const auto expect = [&](const ModeChoice& choice, const std::vector<int>& columns) {
      const Modes modes = fixed_interface_modes(model_of(s), choice, far_freedoms(s));
      ASSERT_EQ(modes.count(), static_cast<Eigen::Index>(columns.size()));
      EXPECT_LE(worst_relative(modes.lambda, truth(columns)), 1e-9);
      EXPECT_TRUE(modes.shapes(far_freedoms(s), Eigen::all).isZero(0));
      // K phi - lambda M phi is a force at the interfaces only
      MatrixX force = s.K * modes.shapes - (s.M * modes.shapes) * modes.lambda.asDiagonal();
      for (const int freedom : far_freedoms(s)) force.row(freedom).setZero();
      EXPECT_LE(force.norm(), 1e-6 * (s.K * modes.shapes).norm());
    };
    expect(LowestModes{4}, {0, 1, 2, 3});
    expect(ListedModes{{2, 7}}, {1, 6});
    expect(ModesBelow{std::sqrt((truth[4] + truth[5]) / 2)}, {0, 1, 2, 3, 4});
  }
  EXPECT_EQ(fixed_interface_modes(model_of(chassis()), AllModes{}, far_freedoms(chassis())).count(), 60 - 9);
}

TEST(CraigBampton, FrequenciesConvergeFromAboveToThoseOfTheFullModel) {
  for (const TestStructure& s : {chassis(), l_shape(), distorted_block({4, 2, 3}, 5)}) {
    constexpr int kWatched = 3;
    const VectorX truth = s.elastic().lambda;
    VectorX before = VectorX::Constant(kWatched, std::numeric_limits<double>::infinity());
    double first_error = 0, error = 0;
    for (const int fixed : {1, 4, 10, 20, 40}) {
      const FlexibleModes modes = craig_bampton(s, LowestModes{fixed});
      EXPECT_NO_THROW(modes.set.validate());
      EXPECT_EQ(modes.set.mode_count(), fixed + 9 - 6);
      const VectorX lambda = modes.set.omega.head(kWatched).cwiseAbs2();
      for (int j = 0; j < kWatched; ++j) {
        EXPECT_GE(lambda[j], truth[j] * (1 - 1e-10));  // Ritz
        EXPECT_LE(lambda[j], before[j] * (1 + 1e-10));
      }
      before = lambda;
      error = worst_relative(lambda, truth.head(kWatched));
      if (fixed == 1) first_error = error;
    }
    EXPECT_GT(first_error, 0.05);
    EXPECT_LT(error, 0.01 * first_error);
  }
}

TEST(CraigBampton, WithAllFixedInterfaceModesIsTheFullModel) {
  const TestStructure s = chassis();
  const ModeSet set = craig_bampton(s, AllModes{}).set;
  ASSERT_EQ(set.mode_count(), 54);
  EXPECT_LE(worst_relative(set.omega.cwiseAbs2(), s.elastic().lambda), 1e-9);
}

TEST(CraigBampton, StaticsUnderBalancedForcesAtTheInterfacesAreExact) {
  for (const TestStructure& s : {chassis(), l_shape(), distorted_block({5, 4, 6}, 2)}) {
    const std::vector<int> rows = far_freedoms(s);
    const MatrixX B = s.rigid(rows, Eigen::all);
    const MatrixX balanced = MatrixX::Identity(9, 9) - B * (B.transpose() * B).inverse() * B.transpose();
    const auto statics = [&](const MatrixX& shapes, const VectorX& lambda) {
      return MatrixX(shapes * lambda.cwiseInverse().asDiagonal() * shapes(rows, Eigen::all).transpose() *
                     balanced);
    };
    const MatrixX truth = statics(s.elastic().shapes, s.elastic().lambda);
    const ModeSet set = craig_bampton(s, LowestModes{2}).set;
    EXPECT_LE((statics(set.shapes, set.omega.cwiseAbs2()) - truth).norm(), 1e-9 * truth.norm());
    const Modes normal = s.elastic().lowest(set.mode_count());
    EXPECT_GE((statics(normal.shapes, normal.lambda) - truth).norm(), 0.01 * truth.norm());
  }
}

TEST(CraigBampton, VibratesExactlyWhereTheInterfacesStandStill) {
  // unlike free modes with constraint modes: the fixed-interface modes lie in the span as they are
  const TestStructure s = l_shape();
  constexpr int kFixed = 6;
  const ModeSet set = craig_bampton(s, LowestModes{kFixed}).set;
  MatrixX X(s.n(), set.mode_count() + 6);
  X << s.rigid, set.shapes;
  const MatrixX held = X * null_space(X(far_freedoms(s), Eigen::all));
  ASSERT_EQ(held.cols(), kFixed);
  const Modes found = solve_eigenproblem(held.transpose() * (s.K * held), held.transpose() * (s.M * held));
  EXPECT_LE(worst_relative(found.lambda, dense_held_modes(s).lambda.head(kFixed)), 1e-9);
}

TEST(CraigBampton, TellsWhereItsModesComeFrom) {
  const FlexibleModes modes = craig_bampton(chassis(), LowestModes{12});
  const auto count = [&](ModeKind kind) { return std::count(modes.kinds.begin(), modes.kinds.end(), kind); };
  EXPECT_EQ(count(ModeKind::normal), 0);
  EXPECT_GE(count(ModeKind::constraint), 1);
  EXPECT_GE(count(ModeKind::fixed_interface), 8);
  EXPECT_EQ(modes.left_out, 6);  // rigid motion among the constraint modes
  EXPECT_STREQ(to_string(ModeKind::fixed_interface), "fixed-interface");
  EXPECT_EQ(describe(LowestModes{12}, "fixed-interface"), "the 12 lowest fixed-interface modes");
}

TEST(CraigBampton, IsRefusedWithoutInterfacesThatHoldTheBody) {
  const TestStructure s = chassis();
  const auto refused = [&](const ModeChoice& choice, const std::vector<int>& nodes) {
    return message_of<InputError>(
        [&] { flexible_modes(model_of(s), choice, {}, nodes, NormalModes::of_held_interfaces); });
  };
  EXPECT_EQ(refused(LowestModes{2}, {}),
            "flexible body: error: modes with held interfaces need interfaces (got none)\n"
            "  join the body to others at nodes or frames, or name nodes under 'constraint'");
  EXPECT_EQ(refused(LowestModes{2}, {1, 2}),
            "constraint modes: error: the interface nodes must hold the body, for all its other nodes follow "
            "statically (got 5 of 6 rigid motions are held)\n"
            "  name at least three nodes that do not lie on one line, or take attachment modes");
  EXPECT_EQ(refused(LowestModes{52}, far_nodes(s)),
            "flexible body: error: the body has 51 modes while its interfaces are held (got 52 wanted)\n"
            "  choose fewer");
}

}  // namespace
}  // namespace wishbone
