#include "app/difference.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace wishbone {

namespace {

constexpr double kSameInstant = 1e-12;  // [s]

}  // namespace

std::vector<Channel> channels(const Signal& signal) {
  std::vector<Channel> all;
  for (const std::string& name : component_names(signal))
    all.push_back({signal.path, static_cast<int>(all.size()), name});
  return all;
}

CommonTime::CommonTime(const ResultFile& a, const ResultFile& b) {
  const VectorX& t_a = a.time();
  const VectorX& t_b = b.time();
  Eigen::Index last = 0;
  if (t_a.size() > 0 && t_b.size() > 0) {
    const auto begin = t_a.begin();
    first_ = std::lower_bound(begin, t_a.end(), t_b[0] - kSameInstant) - begin;
    last = std::upper_bound(begin, t_a.end(), t_b[t_b.size() - 1] + kSameInstant) - begin;
  }
  if (last <= first_)
    throw InputError({a.path() + ", " + b.path(), "the two files have no time in common", "",
                      "compare runs that cover the same time span"});
  time_ = t_a.segment(first_, last - first_);

  // Two rows at one time are the two sides of a jump: equal grids are taken row by row, so that sides stay
  // apart.
  const auto same = [&](Eigen::Index i) { return std::abs(t_b[i] - t_a[i]) <= kSameInstant; };
  bool equal_grids = t_b.size() >= last;
  for (Eigen::Index i = first_; equal_grids && i < last; ++i) equal_grids = same(i);

  for (Eigen::Index i = first_; i < last; ++i) {
    const auto next = std::upper_bound(t_b.begin(), t_b.end(), t_a[i] + kSameInstant);
    const Eigen::Index row = equal_grids ? i : std::max<Eigen::Index>(0, next - t_b.begin() - 1);
    const bool recorded = std::abs(t_b[row] - t_a[i]) <= kSameInstant;
    const double weight = recorded ? 0 : (t_a[i] - t_b[row]) / (t_b[row + 1] - t_b[row]);
    interpolated_ |= !recorded;
    positions_.push_back({row, weight});
  }
}

MatrixX CommonTime::of_b(const MatrixX& values) const {
  MatrixX result(time_.size(), values.cols());
  for (Eigen::Index i = 0; i < time_.size(); ++i) {
    const auto [row, weight] = positions_[static_cast<std::size_t>(i)];
    result.row(i) = values.row(row);
    if (weight != 0) result.row(i) += weight * (values.row(row + 1) - values.row(row));
  }
  return result;
}

std::string CommonTime::text() const {
  return fmt::format("{} instants of A from {:.6g} s to {:.6g} s{}", time_.size(), time_[0],
                     time_[time_.size() - 1],
                     interpolated_ ? "; B has other instants and is interpolated linearly" : "");
}

Difference difference(const Channel& channel, const std::string& units, const VectorX& time,
                      const Eigen::Ref<const VectorX>& a, const Eigen::Ref<const VectorX>& b) {
  Difference result;
  result.channel = channel;
  result.units = units;
  result.max_a = a.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  result.max_b = b.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  const VectorX d = (a - b).cwiseAbs();
  result.rms_difference = std::sqrt(d.squaredNorm() / static_cast<double>(d.size()));
  Eigen::Index worst = 0;
  for (Eigen::Index i = 0; i < d.size() && !std::isnan(d[worst]); ++i)
    if (!(d[i] <= d[worst])) worst = i;
  result.max_difference = d[worst];
  result.time_of_maximum = time[worst];
  return result;
}

}  // namespace wishbone
