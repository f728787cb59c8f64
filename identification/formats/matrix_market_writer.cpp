#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "identification/formats/matrix_market.h"
#include "identification/formats/text_writer.h"

namespace wishbone {
namespace {

void check_finite(const std::string& path, const SparseMatrix& matrix) {
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (!std::isfinite(entry.value()))
        throw InputError({path,
                          fmt::format("element ({}, {}) is not a finite number", entry.row() + 1, column + 1),
                          fmt::format("{}", entry.value()), "check how the matrix was made"});
}

void check_symmetric(const std::string& path, const SparseMatrix& matrix) {
  constexpr std::string_view kRemedy = "write it as a general matrix, or make it symmetric first";
  if (matrix.rows() != matrix.cols())
    throw InputError({path, "a symmetric matrix has as many columns as rows",
                      fmt::format("{} x {}", matrix.rows(), matrix.cols()), std::string(kRemedy)});
  const SparseMatrix transposed = matrix.transpose();
  const SparseMatrix difference = matrix - transposed;
  for (Eigen::Index column = 0; column < difference.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(difference, column); entry; ++entry)
      if (entry.value() != 0)
        throw InputError(
            {path,
             fmt::format("the matrix is not symmetric: elements ({0}, {1}) and ({1}, {0}) differ",
                         entry.row() + 1, column + 1),
             fmt::format("by {}", entry.value()), std::string(kRemedy)});
}

}  // namespace

void write_matrix_market(const std::filesystem::path& path, const SparseMatrix& matrix, bool symmetric) {
  check_finite(path.string(), matrix);
  if (symmetric) check_symmetric(path.string(), matrix);
  const auto is_written = [&](const SparseMatrix::InnerIterator& entry) {
    return !symmetric || entry.row() >= entry.col();
  };
  Eigen::Index entries = 0;
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) entries += is_written(entry);

  TextWriter out(path);
  out.print("%%MatrixMarket matrix coordinate real {}\n", symmetric ? "symmetric" : "general");
  out.print("{} {} {}\n", matrix.rows(), matrix.cols(), entries);
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (is_written(entry)) out.print("{} {} {}\n", entry.row() + 1, column + 1, entry.value());
  out.close();
}

}  // namespace wishbone
