#include "identification/methods/lumping.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "text_files.h"

namespace wishbone {
namespace {

/// The same in x, y and z of every node.
SparseMatrix in_three_directions(const MatrixX& m) {
  SparseMatrix M(3 * m.rows(), 3 * m.cols());
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      for (int axis = 0; axis < 3; ++axis) M.insert(3 * i + axis, 3 * j + axis) = m(i, j);
  return M;
}

TEST(Lumping, FindsTheMassesOfALumpedMatrix) {
  const VectorX masses = VectorX::LinSpaced(4, 1, 7);
  const auto found = nodal_masses(lumped_mass_matrix(masses));
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, masses);
  EXPECT_FALSE(nodal_masses(in_three_directions(MatrixX{{2, 1}, {1, 2}})));
  SparseMatrix uneven = lumped_mass_matrix(masses);
  uneven.coeffRef(4, 4) += 1;
  EXPECT_FALSE(nodal_masses(uneven));
}

TEST(Lumping, OfABarIsThatOfTheBooks) {
  // linear bar of mass m: m/6 [2 1; 1 2]; quadratic bar with its middle node second: m/30 [4 2 -1; 2 16 2; -1 2 4]
  const SparseMatrix linear = in_three_directions(MatrixX{{2, 1}, {1, 2}} * (5.0 / 6));
  const SparseMatrix quadratic =
      in_three_directions(MatrixX{{4, 2, -1}, {2, 16, 2}, {-1, 2, 4}} * (6.0 / 30));
  for (const Lumping lumping : {Lumping::row_sum, Lumping::diagonal}) {
    EXPECT_LE((lumped_masses(linear, lumping) - VectorX{{2.5, 2.5}}).norm(), 1e-14);
    EXPECT_LE((lumped_masses(quadratic, lumping) - VectorX{{1, 4, 1}}).norm(), 1e-14);
  }
}

TEST(Lumping, ByRowsKeepsTheMassCentreAndByTheDiagonalTheMass) {
  // a bar whose mass per length grows linearly from 1 to 3 over the length 1: 1/12 [3a + b, a + b; a + b, a + 3b]
  const SparseMatrix M = in_three_directions(MatrixX{{6, 4}, {4, 10}} / 12.0);
  EXPECT_LE((lumped_masses(M, Lumping::row_sum) - VectorX{{10, 14}} / 12.0).norm(), 1e-15);  // centre at 7/12
  EXPECT_LE((lumped_masses(M, Lumping::diagonal) - VectorX{{6, 10}} / 8.0).norm(), 1e-15);
}

TEST(Lumping, RefusesMassesThatAreNotPositiveOrDifferByDirection) {
  const SparseMatrix corner = in_three_directions(MatrixX{{2, -3}, {-3, 20}});
  EXPECT_EQ(message_of<InputError>([&] { lumped_masses(corner, Lumping::row_sum); }),
            "mass matrix: error: the lumped mass of node number 1 must be positive (got -1 kg)\n"
            "  lump by 'diagonal', which keeps the sign");
  EXPECT_GT(lumped_masses(corner, Lumping::diagonal).minCoeff(), 0);

  SparseMatrix uneven = in_three_directions(MatrixX{{2, 1}, {1, 2}});
  uneven.coeffRef(5, 5) += 1;
  EXPECT_EQ(
      message_of<InputError>([&] { lumped_masses(uneven, Lumping::row_sum); }),
      "mass matrix: error: the lumped mass of node number 2 must be the same in x, y and z (got 3, 3, 4 kg)\n"
      "  leave out what moves with a node in one direction only");
  EXPECT_EQ(message_of<InputError>([] { lumped_masses(SparseMatrix(4, 4), Lumping::row_sum); }),
            "mass matrix: error: it must have three rows and columns for every node (got 4 x 4)\n"
            "  list x, y, z of each node");
}

}  // namespace
}  // namespace wishbone
