#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "core/dual.h"
#include "core/error.h"
#include "core/function.h"
#include "forces/force_element.h"

namespace wishbone {

inline bool is_finite(double a) {
  return std::isfinite(a);
}
inline bool is_finite(const Dual& a) {
  double sum = a.value;
  for (const double d : a.d) sum += d;
  return std::isfinite(sum);
}

/// Value of a function of time and signals in a force element.
/// @throws NumericsError naming the element and the time where the value, or one of its derivatives, is not
///   finite
template <class T>
T load_value(const Function& function, const ForceInputT<T>& input, std::string_view element) {
  const T f = function(input.variables);
  if (is_finite(f)) return f;
  std::vector<double> values;
  for (const T& variable : input.variables) values.push_back(value_of(variable));
  throw NumericsError(
      {fmt::format("{} at t = {:.9g} s", element, input.time), "the load has no value or no derivative",
       fmt::format("{:g} of {}", value_of(f), function.shown(values)),
       "look for a division by zero, an overflow, or the root or logarithm of a negative number in it"});
}

}  // namespace wishbone
