#pragma once

#include <map>
#include <string>
#include <vector>

namespace wishbone {

/// The names that an expression such as `speed / (R - r/3)` uses, functions and `pi` apart.
/// Throws InputError (without a place) when it is not an expression.
std::vector<std::string> names_in_expression(const std::string& expression);

/// Its value: operators + - * / ^ and comparisons, `a ? b : c`, sin cos tan asin acos atan atan2 exp ln log10
/// sqrt abs min max, and `pi`; angles in radians. Throws InputError (without a place) when a name is unknown
/// or the value is not finite.
double evaluate_expression(const std::string& expression, const std::map<std::string, double>& values);

}  // namespace wishbone
