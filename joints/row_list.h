#pragma once

#include <algorithm>
#include <array>
#include <tuple>

#include "joints/closure.h"
#include "joints/motion.h"

namespace wishbone {

/// A cut joint between two markers that is a list of rows (joints/rows), known when compiled: every loop over it is
/// unrolled. It meets the contract of joints/closure.h but for kKind.
template <class... Rows>
class RowList {
 public:
  static constexpr int kRows = (Rows::kRows + ...);
  static constexpr int kAngles = (Rows::kAngles + ...);
  static constexpr int kGauges = (Rows::kGauges + ...);
  static_assert(kGauges <= 1, "one row at most counts turns");
  static constexpr std::array<const char*, kRows> kDirections = [] {
    std::array<const char*, kRows> all{};
    auto next = all.begin();
    ((next = std::copy(Rows::kDirections.begin(), Rows::kDirections.end(), next)), ...);
    return all;
  }();

  RowList() = default;
  explicit RowList(Rows... rows) : rows_(std::move(rows)...) {}

  bool row_is_angle(int row) const { return row >= kRows - kAngles; }
  int participant_count() const { return 2; }
  int gauge_count() const { return kGauges; }
  const Gauge& gauge(int /*index*/) const {
    static constexpr Gauge kNone;
    const Gauge* found = &kNone;
    for_each_row([&](const auto& row, int) {
      if constexpr (std::decay_t<decltype(row)>::kGauges > 0) found = &row.gauge();
    });
    return *found;
  }
  const Motion* drive() const { return nullptr; }

  template <class T>
  void residual(double t, Sides<T> sides, const double* near, T* Phi) const {
    for_each_row([&](const auto& row, int start) { row.residual(t, sides[0], sides[1], near, Phi + start); });
  }
  template <class T>
  void wrenches(Sides<T> sides, T* W) const {
    for_each_row([&](const auto& row, int start) {
      row.wrenches(sides[0], sides[1], W + 6 * start, W + 6 * (kRows + start));
    });
  }
  template <class T>
  void time_rate(double t, T* Phi_t) const {
    for_each_row([&](const auto& row, int start) { row.time_rate(t, Phi_t + start); });
  }
  template <class T>
  void acceleration(double t, Sides<T> sides, MarkerAccelerations<T> a, T* Phi_dd) const {
    for_each_row([&](const auto& row, int start) {
      row.acceleration(t, sides[0], sides[1], a[0], a[1], Phi_dd + start);
    });
  }

 protected:
  template <int i>
  const auto& row() const {
    return std::get<i>(rows_);
  }

 private:
  /// Calls f(row, number of its first row) for each.
  template <class F>
  void for_each_row(F f) const {
    int start = 0;
    std::apply([&](const Rows&... rows) { ((f(rows, start), start += Rows::kRows), ...); }, rows_);
  }

  std::tuple<Rows...> rows_;
};

}  // namespace wishbone
