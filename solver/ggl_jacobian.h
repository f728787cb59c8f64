#pragma once

#include <vector>

#include "core/dual.h"
#include "solver/ggl_residual.h"

namespace wishbone {

/// dF/dy + c dF/dy' of the GGL form, exact: columns are the derivatives of the residual along (e_k, c e_k), Dual::kDirections
/// at a time. Large and sparse matrices are held by columns, and columns that share no row are differentiated together; in
/// these the rows of the two energies keep their diagonal alone (nothing depends on them).
class GglJacobian {
 public:
  GglJacobian(const System& system, const std::vector<int>& kept);

  bool sparse() const { return sparse_; }
  int size() const { return size_; }
  long entries() const { return static_cast<long>(row_indices_.size()); }
  const std::vector<int>& column_starts() const { return column_starts_; }
  const std::vector<int>& row_indices() const { return row_indices_; }

  /// `values`: size x size by columns when dense, one for each row index when sparse.
  void calc(double t, double c, const double* y, const double* y_rate, const Memory& memory, double* values);

 private:
  void set_seeds(const double* y, const double* y_rate, int first_colour, double c);
  void store(int first_colour, double* values) const;

  int size_;
  int n_;  // of (q, v, x, work)
  bool sparse_;
  GglResidual<Dual> residual_;
  std::vector<int> colours_;  // of the columns
  int colour_count_ = 0;
  std::vector<int> column_starts_, row_indices_;
  VectorXT<Dual> y_, y_rate_, r_;
};

}  // namespace wishbone
