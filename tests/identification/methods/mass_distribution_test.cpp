#include "identification/methods/mass_distribution.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "bodies/mode_set.h"
#include "core/error.h"
#include "identification/methods/nnls.h"
#include "identification/methods/support_matrices.h"
#include "identification/structures.h"

namespace wishbone {
namespace {

RigidBodyData rigid_data(const TestStructure& s) {
  RigidBodyData body;
  body.mass = s.node_mass.sum();
  body.centre = s.nodes * s.node_mass / body.mass;
  body.inertia = point_mass_inertia(s.node_mass, s.nodes.colwise() - body.centre);
  return body;
}

TEST(NonnegativeLeastSquares, SatisfiesTheOptimalityConditions) {
  // x >= 0, gradient >= 0, and one of the two zero in every component [Lawson, Hanson 1974, 23.4]
  for (int seed = 0; seed < 20; ++seed) {
    std::srand(static_cast<unsigned>(seed));
    const MatrixX A = MatrixX::Random(12, 8);
    const VectorX b = VectorX::Random(12);
    const VectorX x = nonnegative_least_squares(A, b);
    const VectorX gradient = A.transpose() * (A * x - b);
    EXPECT_GE(x.minCoeff(), 0);
    EXPECT_GE(gradient.minCoeff(), -1e-12);
    EXPECT_LE(x.cwiseProduct(gradient).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(NonnegativeLeastSquares, IsLeastSquaresWhereThatIsPositive) {
  std::srand(4);
  const MatrixX A = MatrixX::Random(9, 4);
  const VectorX x = VectorX::Random(4).cwiseAbs() + VectorX::Ones(4);
  EXPECT_LE((nonnegative_least_squares(A, A * x) - x).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(MassDistribution, IsFoundFromEnoughModes) {
  for (const TestStructure& s : {chassis(), l_shape(), random_lumped(8, 1)}) {
    const MassDistribution found =
        distribute_mass(rigid_data(s), s.nodes, s.elastic().shapes.leftCols(12), SparseMatrix(s.n(), s.n()));
    EXPECT_EQ(found.rank, s.nodes.cols());
    EXPECT_EQ(found.equations, 10 + 66);
    EXPECT_LE(worst_relative(found.node_mass, s.node_mass), 1e-6);
    EXPECT_LE(found.residual, 1e-7);
  }
}

TEST(MassDistribution, TakesTheMassesOfTheSupportOut) {
  const TestStructure s = chassis();
  Support support = springs_at({1, 2, 17, 18}, 47e3);
  support.masses = {{1, 5}, {2, 5}, {17, 8}, {18, 8}};
  const SupportMatrices held = support_matrices(support, s.freedoms());
  const MassDistribution found =
      distribute_mass(rigid_data(s), s.nodes, modes_on(s, held).shapes.leftCols(15), held.M_s);
  EXPECT_LE(worst_relative(found.node_mass, s.node_mass), 1e-6);
}

TEST(MassDistribution, KeepsMassCentreAndInertiaWhenModesAreFew) {
  const TestStructure s = chassis();
  const RigidBodyData body = rigid_data(s);
  const MassDistribution found =
      distribute_mass(body, s.nodes, s.elastic().shapes.leftCols(2), SparseMatrix(s.n(), s.n()));
  EXPECT_LT(found.rank, 20);
  EXPECT_GE(found.node_mass.minCoeff(), 0);
  EXPECT_NEAR(found.node_mass.sum(), body.mass, 1e-6 * body.mass);
  EXPECT_LE((s.nodes * found.node_mass).norm(), 1e-6 * body.mass);
  EXPECT_LE((point_mass_inertia(found.node_mass, s.nodes) - body.inertia).norm(), 1e-6 * body.inertia.norm());
}

TEST(MassDistribution, ReportsWhatNoMassesCanExplain) {
  // no masses on these nodes have an inertia twice that of the outermost points
  const TestStructure s = chassis();
  RigidBodyData body = rigid_data(s);
  body.inertia *= 4;
  const MassDistribution found =
      distribute_mass(body, s.nodes, s.elastic().shapes.leftCols(12), SparseMatrix(s.n(), s.n()));
  EXPECT_GE(found.residual, 0.1);
}

TEST(MassDistribution, RefusesImpossibleData) {
  const TestStructure s = chassis();
  const SparseMatrix none(s.n(), s.n());
  RigidBodyData body = rigid_data(s);
  body.mass = 0;
  EXPECT_THROW(distribute_mass(body, s.nodes, s.elastic().shapes, none), InputError);
  body = rigid_data(s);
  body.inertia(0, 0) = -1;
  EXPECT_THROW(distribute_mass(body, s.nodes, s.elastic().shapes, none), InputError);
  EXPECT_THROW(distribute_mass(rigid_data(s), s.nodes.leftCols(3), s.elastic().shapes, none), InputError);
}

}  // namespace
}  // namespace wishbone
