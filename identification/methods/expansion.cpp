#include "identification/methods/expansion.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <algorithm>

#include "core/error.h"

namespace wishbone {
namespace {

/// Entries of a sparse matrix between two groups of freedoms; `place` has the number of a freedom inside its group,
/// -1 for the other group.
SparseMatrix block(const SparseMatrix& A, const std::vector<int>& row_place, Eigen::Index rows,
                   const std::vector<int>& column_place, Eigen::Index columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
    const int column = column_place[static_cast<std::size_t>(j)];
    if (column < 0) continue;
    for (SparseMatrix::InnerIterator it(A, j); it; ++it)
      if (const int row = row_place[static_cast<std::size_t>(it.row())]; row >= 0)
        entries.emplace_back(row, column, it.value());
  }
  SparseMatrix B(rows, columns);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

/// Phi_m, factored.
Eigen::ColPivHouseholderQR<MatrixX> measured_part(const MatrixX& model_shapes,
                                                  const std::vector<int>& measured) {
  Eigen::ColPivHouseholderQR<MatrixX> Phi_m;
  Phi_m.setThreshold(1e-9);
  Phi_m.compute(model_shapes(measured, Eigen::all));
  return Phi_m;
}

}  // namespace

Eigen::Index serep_rank(const MatrixX& model_shapes, const std::vector<int>& measured) {
  return measured_part(model_shapes, measured).rank();
}

MatrixX expand_serep(const MatrixX& model_shapes, const std::vector<int>& measured, const MatrixX& shapes) {
  const Eigen::ColPivHouseholderQR<MatrixX> Phi_m = measured_part(model_shapes, measured);
  if (Phi_m.rank() < model_shapes.cols())
    throw InputError(
        {"expansion", "the measured freedoms must tell the modes of the model apart",
         fmt::format("{} freedoms, rank {} of {} modes", measured.size(), Phi_m.rank(), model_shapes.cols()),
         "measure more freedoms, or expand with fewer modes of the model"});
  return model_shapes * Phi_m.solve(shapes);
}

MatrixX static_transformation(const SparseMatrix& K, const std::vector<int>& masters) {
  const Eigen::Index n = K.rows(), r = static_cast<Eigen::Index>(masters.size());
  std::vector<int> master_place(static_cast<std::size_t>(n), -1),
      slave_place(static_cast<std::size_t>(n), -1);
  for (std::size_t i = 0; i < masters.size(); ++i)
    master_place[static_cast<std::size_t>(masters[i])] = static_cast<int>(i);
  int slaves = 0;
  for (std::size_t i = 0; i < slave_place.size(); ++i)
    if (master_place[i] < 0) slave_place[i] = slaves++;

  MatrixX T = MatrixX::Zero(n, r);
  for (Eigen::Index i = 0; i < r; ++i) T(masters[static_cast<std::size_t>(i)], i) = 1;
  if (slaves == 0) return T;
  const Eigen::SimplicialLLT<SparseMatrix> K_ss(block(K, slave_place, slaves, slave_place, slaves));
  if (K_ss.info() != Eigen::Success)
    throw InputError({"expansion",
                      "the measured freedoms must hold the structure, for the others follow statically",
                      fmt::format("{} of {} freedoms", r, n),
                      "measure freedoms that stop every rigid-body motion, or expand by SEREP"});
  const MatrixX K_sm(block(K, slave_place, slaves, master_place, r));
  const MatrixX T_s = -K_ss.solve(K_sm);
  for (std::size_t i = 0; i < slave_place.size(); ++i)
    if (slave_place[i] >= 0) T.row(static_cast<Eigen::Index>(i)) = T_s.row(slave_place[i]);
  return T;
}

MatrixX static_transformation(const SparseMatrix& K, const SparseMatrix& D, const std::vector<int>& masters) {
  std::vector<int> all = masters;  // and the freedoms h that joints touch
  for (int j = 0; j < D.outerSize(); ++j)
    if (SparseMatrix::InnerIterator(D, j) && std::find(masters.begin(), masters.end(), j) == masters.end())
      all.push_back(j);
  const MatrixX T = static_transformation(K, all);
  const auto r = static_cast<Eigen::Index>(masters.size()), h = static_cast<Eigen::Index>(all.size()) - r;
  if (h == 0) return T;
  // [K_hh D_h^T; D_h 0] [x_h; mu] = -[K_hr; D_r] x_r
  const MatrixX K_all = reduced(K, T), D_all = MatrixX(D)(Eigen::all, all);
  const Eigen::Index c = D.rows();
  MatrixX A(h + c, h + c), b(h + c, r);
  const double scale = K_all.diagonal().maxCoeff();  // so that the two kinds of rows compare
  A << K_all.bottomRightCorner(h, h) / scale, D_all.rightCols(h).transpose(), D_all.rightCols(h),
      MatrixX::Zero(c, c);
  b << K_all.bottomLeftCorner(h, r) / scale, D_all.leftCols(r);
  const MatrixX x = A.completeOrthogonalDecomposition().solve(-b);
  return T.leftCols(r) + T.rightCols(h) * x.topRows(h);
}

MatrixX reduced(const SparseMatrix& A, const MatrixX& T) {
  const MatrixX A_T = A * T;
  const MatrixX B = T.transpose() * A_T;
  return (B + B.transpose()) / 2;
}

}  // namespace wishbone
