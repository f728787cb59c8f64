#include "bodies/nodal_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "identification/free_free_modes.h"
#include "identification/nodal_model.h"

namespace wishbone {
namespace {

using ::testing::HasSubstr;

constexpr IsotropicMaterial kMaterial{2.1e8, 0.3, 2600};

Mesh block() {
  return make_block({2.4, 0.4, 0.3}, {3, 1, 1});
}

MatrixX block_stiffness() {
  return MatrixX(stiffness_matrix(block(), kMaterial));
}

NodalModel model() {
  return nodal_model(free_free_modes(block(), kMaterial));
}

std::string complaint(const std::array<int, 3>& nodes) {
  try {
    fixed_axis_shapes(model(), nodes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(NodalShapes, RebuildTheStiffnessFromAllModes) {
  const MatrixX K = block_stiffness();
  EXPECT_LE((model().stiffness - K).norm(), 1e-12 * K.norm());
  EXPECT_THROW(nodal_model(free_free_modes(block(), kMaterial).lowest(41)), InputError);
}

TEST(NodalShapes, SpanTheDeflectionsThatTheReferenceConditionAllows) {
  const NodalModel given = model();
  const MatrixX K = block_stiffness();
  const VectorX load = VectorX::LinSpaced(48, -1, 2);
  for (const ShapeSet& set : {mean_axis_shapes(given), fixed_axis_shapes(given, {1, 13, 3})}) {
    EXPECT_NO_THROW(set.validate());
    EXPECT_EQ(set.shape_count(), 42);
    // whatever the axes, the same strain energy under the same load: delta^T K delta with K delta = Phi-part of the load
    const VectorX z = set.stiffness.ldlt().solve(set.shapes.transpose() * load);
    const VectorX delta = set.shapes * z;
    EXPECT_NEAR(z.dot(set.stiffness * z), delta.dot(K * delta), 1e-10 * delta.dot(K * delta));
  }
}

TEST(NodalShapes, LeaveSixFreedomsOfThreeNodesWhereTheyAre) {
  const ShapeSet set = fixed_axis_shapes(model(), {1, 13, 3});  // 13 lies along x from 1, 3 across y and z
  int held = 0;
  for (Eigen::Index row = 0; row < set.shapes.rows(); ++row) held += set.shapes.row(row).isZero(0);
  EXPECT_EQ(held, 6);
  EXPECT_TRUE(set.shapes.topRows<3>().isZero(0));               // node 1
  EXPECT_TRUE(set.shapes.middleRows<2>(3 * 12 + 1).isZero(0));  // node 13: y and z
  const auto node_3 = set.shapes.middleRows<3>(3 * 2);
  EXPECT_TRUE(node_3.row(1).isZero(0) || node_3.row(2).isZero(0));
}

TEST(NodalShapes, NameNodesThatAxesCannotBeFixedTo) {
  EXPECT_THAT(complaint({1, 99, 3}), HasSubstr("node 99"));
  EXPECT_THAT(complaint({1, 5, 9}), HasSubstr("one line"));  // along x
  EXPECT_THAT(complaint({1, 1, 3}), HasSubstr("one line"));
}

}  // namespace
}  // namespace wishbone
