// What meshes say of their own lowest modes, against beams whose frequencies are known.
#include "identification/elements/mesh_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "identification/free_free_modes.h"

namespace wishbone {
namespace {

constexpr IsotropicMaterial kStructuralSteel{210e9, 0.3, 7850};
const Vector3 kBar(1, 0.03, 0.03);

/// omega of the first bending of a free bar [Timoshenko], and what the estimate says of it, over what the mesh gives.
struct Compared {
  double true_ratio = 0, estimate = 0;
};
Compared first_bending(const Mesh& mesh) {
  const ModeSet set = free_free_modes(mesh, kStructuralSteel);
  // 4.7300^2 sqrt(E I / (rho A L^4)); rotary inertia and shear take 0.9 percent at L/h = 33
  const double beam =
      0.991 * 4.73004 * 4.73004 *
      std::sqrt(kStructuralSteel.youngs_modulus / kStructuralSteel.density * 0.03 * 0.03 / 12);
  return {set.omega[0] / beam, frequency_ratios(mesh, kStructuralSteel, set.shapes.leftCols<1>())[0]};
}

TEST(MeshEstimate, KnowsTheErrorOfTooFewElements) {
  for (const int along : {2, 3, 4, 6, 8, 12}) {
    const Compared c = first_bending(make_block(kBar, {along, 1, 1}));
    EXPECT_LT(c.true_ratio, 1) << along;  // masses at the nodes make it slow
    EXPECT_GT((1 - c.estimate) / (1 - c.true_ratio), 0.8) << along;
    EXPECT_LT((1 - c.estimate) / (1 - c.true_ratio), 3) << along;
  }
  EXPECT_NEAR(first_bending(make_block(kBar, {60, 1, 1})).estimate, 1, 0.01);
}

TEST(MeshEstimate, KnowsElementsThatLock) {
  for (const int across : {1, 2}) {
    const Compared c =
        first_bending(make_block(kBar, {10 * across, across, across}, ElementType::mean_dilatation));
    EXPECT_GT(c.true_ratio, 1.3);
    EXPECT_GT(c.estimate, 1.3);
  }
}

TEST(MeshEstimate, KnowsElementsThatYield) {
  const Compared c = first_bending(make_block(kBar, {80, 1, 1}, ElementType::mean_dilatation));
  EXPECT_LT(c.true_ratio, 0.85);
  EXPECT_LT(c.estimate, 0.77);
}

TEST(MeshEstimate, KnowsTheMassOfQuadraticElements) {
  for (const int along : {2, 3, 4, 8}) {
    const Compared c = first_bending(with_middle_nodes(make_block(kBar, {along, 1, 1})));
    EXPECT_LT(c.true_ratio, 1) << along;
    EXPECT_GT((1 - c.estimate) / (1 - c.true_ratio), 0.8) << along;
    EXPECT_LT((1 - c.estimate) / (1 - c.true_ratio), 3) << along;
  }
}

}  // namespace
}  // namespace wishbone
