#pragma once

#include <fmt/format.h>

#include <string_view>

#include "bodies/gauge.h"
#include "core/error.h"

namespace wishbone {

/// |v|; at zero, where it has no derivative, a plain zero.
template <class T>
T norm_or_zero(const Vector3T<T>& v) {
  return v.squaredNorm() > 0 ? T(v.norm()) : T(0);
}

/// A distance has no direction at zero: checks that `gauge` can be differentiated between A and B.
/// @throws NumericsError naming the element, the rule and the value unless it can
template <class T>
void require_defined(const Gauge& gauge, const MarkerStateT<T>& A, const MarkerStateT<T>& B,
                     std::string_view element) {
  if (gauge.kind != Gauge::Kind::distance) return;
  const double length = value_of(gauge.value(A, B, 0));
  if (length > 0) return;
  throw NumericsError(
      {std::string(element), "a distance must not shrink to zero, where it has no direction: length [m]",
       fmt::format("{:g}", length), "move one of its points, or model the connection by another joint"});
}

}  // namespace wishbone
