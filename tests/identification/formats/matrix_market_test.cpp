#include "identification/formats/matrix_market.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <unsupported/Eigen/SparseExtra>

#include "core/error.h"
#include "identification/formats/modal_data_example.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

std::string text_of(const std::filesystem::path& file) {
  return (std::ostringstream() << std::ifstream(file, std::ios::binary).rdbuf()).str();
}

/// A thousand rows, about `per_column` entries in each, of any magnitude.
SparseMatrix random_matrix(int per_column) {
  constexpr int kSize = 1000;
  std::mt19937_64 random(11);
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < kSize; ++column)
    for (int k = 0; k < per_column; ++k)
      entries.emplace_back(
          static_cast<int>(random() % kSize), column,
          std::ldexp(static_cast<double>(random()) - 9e18, static_cast<int>(random() % 200) - 160));
  SparseMatrix matrix(kSize, kSize);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void expect_same_entries(const SparseMatrix& a, const SparseMatrix& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  ASSERT_EQ(a.nonZeros(), b.nonZeros());
  for (Eigen::Index column = 0; column < a.cols(); ++column) {
    SparseMatrix::InnerIterator image(b, column);
    for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry, ++image) {
      ASSERT_EQ(entry.row(), image.row());
      ASSERT_EQ(entry.value(), image.value());
    }
  }
}

TEST(MatrixMarket, GivesBackAThousandRowsToTheLastBit) {
  const TextFiles files;
  const SparseMatrix general = random_matrix(12);
  write_matrix_market(files / "a.mtx", general, false);
  expect_same_entries(read_matrix_market(files / "a.mtx"), general);

  const SparseMatrix transposed = general.transpose();
  const SparseMatrix symmetric = general + transposed;
  write_matrix_market(files / "s.mtx", symmetric, true);
  expect_same_entries(read_matrix_market(files / "s.mtx"), symmetric);
  write_matrix_market(files / "t.mtx", symmetric, false);
  expect_same_entries(read_matrix_market(files / "t.mtx"), symmetric);
  EXPECT_LT(text_of(files / "s.mtx").size(), 0.51 * static_cast<double>(text_of(files / "t.mtx").size()));
}

TEST(MatrixMarket, IsReadAlikeByEigen) {
  const TextFiles files;
  const SparseMatrix general = random_matrix(3);
  write_matrix_market(files / "a.mtx", general, false);
  SparseMatrix theirs;
  ASSERT_TRUE(Eigen::loadMarket(theirs, (files / "a.mtx").string()));
  expect_same_entries(theirs, general);
  ASSERT_TRUE(Eigen::saveMarket(general, (files / "b.mtx").string()));
  EXPECT_LT((read_matrix_market(files / "b.mtx") - general).norm(), 1e-15 * general.norm());
}

TEST(MatrixMarket, OfAnyKindIsTheMatrixThatItMeans) {
  const TextFiles files;
  const auto read = [&](std::string_view text) {
    return MatrixX(read_matrix_market(files.write("a.mtx", text)));
  };
  const MatrixX general = (MatrixX(2, 3) << 1, 0, -2.5, 0, 4, 0).finished();
  const MatrixX symmetric = (MatrixX(2, 2) << 1, 3, 3, 4).finished();
  const MatrixX skew = (MatrixX(2, 2) << 0, -3, 3, 0).finished();
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real general\n2 3 3\n1 1 1\n1 3 -2.5\n2 2 4\n"), general);
  EXPECT_EQ(read("%%MatrixMarket matrix array real general\n2 3\n1\n0\n0\n4\n-2.5\n0\n"), general);
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate integer symmetric\n2 2 3\n1 1 1\n2 1 3\n2 2 4\n"),
            symmetric);
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n1 2 3\n2 2 4\n"), symmetric);
  EXPECT_EQ(read("%%MatrixMarket matrix array integer symmetric\n2 2\n1\n3\n4\n"), symmetric);
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 1 3\n"), skew);
  EXPECT_EQ(read("%%MatrixMarket matrix array real skew-symmetric\n2 2\n3\n"), skew);
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real general\n2 2 0\n"), MatrixX::Zero(2, 2));
  EXPECT_EQ(read("%%MatrixMarket matrix array real general\n0 3\n").cols(), 3);
}

TEST(MatrixMarket, OfCalculixHasTheFrequenciesThatCalculixPrints) {
  const std::string folder = std::string(WISHBONE_TEST_DATA) + "/calculix/";
  const MatrixX K = read_matrix_market(folder + "beam_stiffness.mtx");
  const MatrixX M = read_matrix_market(folder + "beam_mass.mtx");
  const VectorX frequency = solve_eigenproblem(K, M).frequency_hz();
  EXPECT_LT(frequency.head(6).maxCoeff(), 0.1);  // free
  const Eigen::Vector4d printed(914.6903, 914.6903, 1650.568, 2676.603);
  EXPECT_LT((frequency.segment<4>(6) - printed).cwiseQuotient(printed).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(MatrixMarket, MayBeSpacedAndCommentedAnyway) {
  const TextFiles files;
  const std::string_view text =
      "%%matrixmarket MATRIX\tCoordinate REAL General  \r\n% comment\r\n\r\n  2\t2 2 \r\n%\r\n 1 1  "
      "+1.5E0\r\n\r\n"
      "2 2 .5\r\n\r\n% end";
  EXPECT_EQ(MatrixX(read_matrix_market(files.write("a.mtx", text))),
            MatrixX(Vector3(1.5, 0.5, 0).head(2).asDiagonal()));
}

TEST(MatrixMarket, KeepsEntriesThatAreZero) {
  const TextFiles files;
  SparseMatrix matrix(2, 2);
  matrix.insert(1, 0) = 0;
  write_matrix_market(files / "a.mtx", matrix, false);
  EXPECT_EQ(read_matrix_market(files / "a.mtx").nonZeros(), 1);
}

TEST(MatrixMarket, IsNotWrittenSymmetricUnlessItIs) {
  const TextFiles files;
  SparseMatrix matrix(3, 3);
  matrix.insert(2, 1) = 5;
  const auto write = [&] { write_matrix_market(files / "a.mtx", matrix, true); };
  EXPECT_THAT(message_of<InputError>(write), HasSubstr("elements (3, 2) and (2, 3) differ"));
  matrix.insert(1, 2) = std::nextafter(5.0, 6.0);
  EXPECT_THAT(message_of<InputError>(write), HasSubstr("not symmetric"));
  matrix.coeffRef(1, 2) = 5;
  write();
  EXPECT_EQ(MatrixX(read_matrix_market(files / "a.mtx")), MatrixX(matrix));
  EXPECT_THROW(write_matrix_market(files / "a.mtx", SparseMatrix(2, 3), true), InputError);
}

TEST(MatrixMarket, IsNotWrittenWithWhatIsNoNumber) {
  const TextFiles files;
  SparseMatrix matrix(3, 3);
  matrix.insert(2, 1) = std::nan("");
  EXPECT_THAT(message_of<InputError>([&] { write_matrix_market(files / "a.mtx", matrix, false); }),
              HasSubstr("element (3, 2) is not a finite number"));
  EXPECT_FALSE(std::filesystem::exists(files / "a.mtx"));
  EXPECT_THROW(write_matrix_market(files / "absent/a.mtx", SparseMatrix(1, 1), false), NumericsError);
}

}  // namespace
}  // namespace wishbone
