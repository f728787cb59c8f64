#include "solver/ggl_jacobian.h"

#include <algorithm>
#include <numeric>

#include "solver/sparsity.h"

namespace wishbone {
namespace {

/// A matrix is held sparse from this size on, if no more than this share of it may have entries.
constexpr int kSparseSize = 150;
constexpr double kSparseShare = 0.25;

long count_entries(const SparsityPattern& pattern) {
  long count = 0;
  for (const std::vector<int>& row : pattern) count += static_cast<long>(row.size());
  return count;
}

}  // namespace

GglJacobian::GglJacobian(const System& system, const std::vector<int>& kept)
    : size_(system.nq + system.nv + system.nx + 2 + 2 * static_cast<int>(kept.size())),
      n_(system.nq + system.nv + system.nx + 2),
      sparse_(false),
      residual_(system, kept),
      colours_(size_),
      y_(size_),
      y_rate_(size_),
      r_(size_) {
  std::iota(colours_.begin(), colours_.end(), 0);
  colour_count_ = size_;
  if (size_ < kSparseSize) return;
  const SparsityPattern pattern = ggl_pattern(system, kept);
  sparse_ = static_cast<double>(count_entries(pattern)) < kSparseShare * size_ * size_;
  if (!sparse_) return;
  colours_ = colour_columns(pattern, size_);
  colour_count_ = 1 + *std::max_element(colours_.begin(), colours_.end());
  std::vector<std::vector<int>> rows_of(size_);
  for (int row = 0; row < size_; ++row)
    for (const int column : pattern[row]) rows_of[column].push_back(row);
  column_starts_.push_back(0);
  for (const std::vector<int>& rows : rows_of) {
    row_indices_.insert(row_indices_.end(), rows.begin(), rows.end());
    column_starts_.push_back(static_cast<int>(row_indices_.size()));
  }
}

/// Column k is differentiated along direction colour - first_colour of this pass.
void GglJacobian::set_seeds(const double* y, const double* y_rate, int first_colour, double c) {
  for (int k = 0; k < size_; ++k) {
    y_[k] = y[k];
    y_rate_[k] = y_rate[k];
    const int direction = colours_[k] - first_colour;
    if (direction < 0 || direction >= Dual::kDirections) continue;
    y_[k].d[direction] = 1;
    y_rate_[k].d[direction] = c;
  }
}

void GglJacobian::store(int first_colour, double* values) const {
  for (int k = 0; k < size_; ++k) {
    const int direction = colours_[k] - first_colour;
    if (direction < 0 || direction >= Dual::kDirections) continue;
    if (sparse_)
      for (int i = column_starts_[k]; i < column_starts_[k + 1]; ++i)
        values[i] = r_[row_indices_[i]].d[direction];
    else
      for (int i = 0; i < size_; ++i) values[static_cast<long>(k) * size_ + i] = r_[i].d[direction];
  }
}

void GglJacobian::calc(double t, double c, const double* y, const double* y_rate, const Memory& memory,
                       double* values) {
  residual_.evaluation().memory = memory;
  for (int first = 0; first < colour_count_; first += Dual::kDirections) {
    set_seeds(y, y_rate, first, c);
    residual_.calc(t, y_.data(), y_rate_.data(), r_.data());
    store(first, values);
  }
  if (!sparse_) return;
  for (int k = n_ - 2; k < n_; ++k) values[column_starts_[k]] = c;  // work' - P: columns of one entry
}

}  // namespace wishbone
