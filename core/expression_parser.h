#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/expression_program.h"

namespace wishbone {

/// What a name in an expression stands for.
struct NameMeaning {
  bool is_variable = false;
  int index = 0;     ///< of a variable
  double value = 0;  ///< of a constant
};

/// Asked for every name that is no call of a function and not `pi`; gives nothing when the name is unknown.
using NameReader = std::function<std::optional<NameMeaning>(const std::string& name)>;

/// Reads an expression (core/expression.h has the grammar) by recursive descent. Throws InputError without a
/// place that says at which character it went wrong. `known` are the names that an error may propose.
ExpressionProgram parse_expression(const std::string& text, const NameReader& read_name,
                                   const std::vector<std::string>& known);

/// Of the functions, in alphabetical order.
const std::vector<std::string>& expression_functions();

}  // namespace wishbone
