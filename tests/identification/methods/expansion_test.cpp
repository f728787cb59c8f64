#include "identification/methods/expansion.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/methods/support_matrices.h"
#include "identification/structures.h"

namespace wishbone {
namespace {

/// All freedoms of some nodes of a structure.
std::vector<int> rows_of(const std::vector<int>& nodes) {
  std::vector<int> rows;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * (node - 1) + axis);
  return rows;
}

TEST(Serep, RestoresModesOfTheModel) {
  const TestStructure s = chassis();
  const Modes modes = s.elastic().lowest(12);
  const std::vector<int> measured = rows_of({1, 3, 8, 9, 14, 18, 20});
  const MatrixX seen = modes.shapes(measured, Eigen::all);
  EXPECT_LE((expand_serep(modes.shapes, measured, seen) - modes.shapes).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Serep, RefusesMoreModesThanTheMeasurementCanTellApart) {
  const TestStructure s = chassis();
  const MatrixX Phi = s.elastic().shapes.leftCols(12);
  const std::vector<int> measured = rows_of({1, 20});
  EXPECT_THROW(expand_serep(Phi, measured, Phi(measured, Eigen::all)), InputError);
}

TEST(StaticTransformation, LetsTheOthersFollowWithoutForce) {
  const TestStructure s = l_shape();
  std::vector<int> masters{0, 1, 2, 9, 10, 11, 30, 31, 32};
  const MatrixX T = static_transformation(s.K, masters);
  EXPECT_LE((T(masters, Eigen::all) - MatrixX::Identity(9, 9)).cwiseAbs().maxCoeff(), 0);
  MatrixX forces = s.K * T;
  forces(masters, Eigen::all).setZero();
  EXPECT_LE(forces.cwiseAbs().maxCoeff(), 1e-10 * s.K.norm());
  // rigid motion of the masters carries the whole body rigidly
  EXPECT_LE((T * s.rigid(masters, Eigen::all) - s.rigid).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(StaticTransformation, ReducesToUpperBoundsOfTheFrequencies) {
  const TestStructure s = chassis();
  const MatrixX T = static_transformation(s.K, rows_of({1, 2, 3, 4, 9, 10, 11, 12, 17, 18, 19, 20}));
  const Modes reduced_modes = solve_eigenproblem(reduced(s.K, T), reduced(s.M, T));
  const VectorX truth = s.elastic().lambda;
  for (Eigen::Index j = 0; j < 6; ++j) {
    EXPECT_GE(reduced_modes.lambda[6 + j], (1 - 1e-9) * truth[j]);
    EXPECT_LE(reduced_modes.lambda[6 + j], 1.6 * truth[j]);
  }
}

TEST(StaticTransformation, RefusesMastersThatDoNotHoldTheBody) {
  EXPECT_THROW(static_transformation(chassis().K, {0, 1, 2}), InputError);
}

TEST(StaticTransformation, HoldsJointsWhereNothingWasMeasured) {
  const TestStructure s = chassis();
  const std::vector<int> masters{0, 1, 2, 51, 52, 53, 10, 30};
  Support support = joints_at({{5, "xyz"}, {8, "z"}});
  support.joints.push_back({11, Vector3(1, 2, -1).normalized()});
  const SparseMatrix D = support_matrices(support, s.freedoms()).D;
  const MatrixX T = static_transformation(s.K, D, masters);
  EXPECT_LE((T(masters, Eigen::all) - MatrixX::Identity(8, 8)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((D * T).cwiseAbs().maxCoeff(), 1e-11);
  // besides masters only the joints push, along their directions
  MatrixX forces = s.K * T;
  forces(masters, Eigen::all).setZero();
  MatrixX pushes = D;
  pushes(Eigen::all, masters).setZero();
  const MatrixX mu = pushes.transpose().colPivHouseholderQr().solve(forces);
  EXPECT_LE((forces - pushes.transpose() * mu).cwiseAbs().maxCoeff(), 1e-9 * forces.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace wishbone
