#include "core/table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dual.h"
#include "core/jet2.h"
#include "core/require.h"

namespace wishbone {
namespace {

void check_points(std::string_view element, const std::vector<double>& x, const std::vector<double>& y) {
  require(x.size() == y.size(), element, "a table needs as many values as points",
          static_cast<double>(y.size()), "give a pair for each point");
  require(x.size() >= 2, element, "a table needs at least two points", static_cast<double>(x.size()),
          "add points, or give a constant");
  for (std::size_t i = 0; i < x.size(); ++i) {
    require(std::isfinite(x[i]), element, "the points of a table must be finite", x[i], "give numbers");
    require(std::isfinite(y[i]), element, "the values of a table must be finite", y[i], "give numbers");
    require(i == 0 || x[i] > x[i - 1], element, "the points of a table must ascend strictly", x[i],
            "sort them, and give one value for each");
  }
}

/// Second derivatives of the not-a-knot cubic spline at its points; h are the steps and s the slopes between
/// them:
///     h_(i-1) M_(i-1) + 2 (h_(i-1) + h_i) M_i + h_i M_(i+1) = 6 (s_i - s_(i-1)),   i = 1 ... n - 2,
/// and (M_1 - M_0)/h_0 = (M_2 - M_1)/h_1, likewise at the end. Gaussian elimination of the three diagonals,
/// which dominate.
std::vector<double> second_derivatives(const std::vector<double>& h, const std::vector<double>& s) {
  const std::size_t n = h.size() + 1;
  std::vector<double> M(n, 0.0);
  if (n == 2) return M;
  if (n == 3) return std::vector<double>(n, 2 * (s[1] - s[0]) / (h[0] + h[1]));
  const double start = h[0] / h[1], end = h[n - 2] / h[n - 3];
  std::vector<double> diagonal(n), upper(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    double lower = h[i - 1];
    diagonal[i] = 2 * (h[i - 1] + h[i]);
    upper[i] = h[i];
    if (i == 1) {  // M_0 = (1 + start) M_1 - start M_2
      diagonal[i] += h[0] * (1 + start);
      upper[i] -= h[0] * start;
    }
    if (i == n - 2) {  // M_(n-1) = (1 + end) M_(n-2) - end M_(n-3)
      diagonal[i] += h[i] * (1 + end);
      lower -= h[i] * end;
    }
    M[i] = 6 * (s[i] - s[i - 1]);
    if (i == 1) continue;
    const double factor = lower / diagonal[i - 1];
    diagonal[i] -= factor * upper[i - 1];
    M[i] -= factor * M[i - 1];
  }
  M[n - 2] /= diagonal[n - 2];
  for (std::size_t i = n - 3; i >= 1; --i) M[i] = (M[i] - upper[i] * M[i + 1]) / diagonal[i];
  M[0] = (1 + start) * M[1] - start * M[2];
  M[n - 1] = (1 + end) * M[n - 2] - end * M[n - 3];
  return M;
}

}  // namespace

Table::Table(std::string_view element, std::vector<double> x, const std::vector<double>& y,
             Interpolation interpolation)
    : x_(std::move(x)), interpolation_(interpolation) {
  check_points(element, x_, y);
  y_last_ = y.back();
  if (interpolation == Interpolation::linear)
    join_lines(y);
  else
    join_cubics(y);
  for (const Piece& p : pieces_)
    require(std::isfinite(p.b) && std::isfinite(p.c) && std::isfinite(p.d), element,
            "the points of a table lie too close together", p.b, "leave some out");
}

void Table::join_lines(const std::vector<double>& y) {
  for (std::size_t i = 0; i + 1 < x_.size(); ++i)
    pieces_.push_back({y[i], (y[i + 1] - y[i]) / (x_[i + 1] - x_[i]), 0, 0});
}

void Table::join_cubics(const std::vector<double>& y) {
  std::vector<double> h, s;
  for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
    h.push_back(x_[i + 1] - x_[i]);
    s.push_back((y[i + 1] - y[i]) / h[i]);
  }
  const std::vector<double> M = second_derivatives(h, s);
  for (std::size_t i = 0; i < h.size(); ++i)
    pieces_.push_back(
        {y[i], s[i] - h[i] * (2 * M[i] + M[i + 1]) / 6, M[i] / 2, (M[i + 1] - M[i]) / (6 * h[i])});
}

template <class T>
T Table::operator()(const T& x) const {
  const double at = value_of(x);
  if (at < x_.front()) return T(pieces_.front().y);
  if (at > x_.back()) return T(y_last_);
  const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, at);
  const auto i = static_cast<std::size_t>(above - x_.begin()) - 1;
  const Piece& p = pieces_[i];
  const T u = x - x_[i];
  return p.y + u * (p.b + u * (p.c + u * p.d));
}

template double Table::operator()(const double&) const;
template Jet2 Table::operator()(const Jet2&) const;
template Dual Table::operator()(const Dual&) const;

std::vector<double> Table::kinks() const {
  std::vector<double> kinks{first()};
  if (interpolation_ == Interpolation::linear) {
    for (std::size_t i = 1; i < pieces_.size(); ++i)
      if (pieces_[i].b != pieces_[i - 1].b) kinks.push_back(x_[i]);
  }
  kinks.push_back(last());
  return kinks;
}

}  // namespace wishbone
