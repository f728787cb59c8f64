#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/expression_program.h"

namespace wishbone {

/// A formula of named variables such as `5*sin(2*pi*f*t) - 20*gap`, read once and then evaluated without
/// allocation, for double, Jet2 or Dual: derivatives are exact.
///
/// Operators, from the loosest: `a ? b : c`, `||`, `&&`, `< <= > >= == !=`, `+ -`, `* /`, signs, `^` (from
/// the right, so that -2^2 is -4). Functions: sin cos tan asin acos atan atan2(y, x) sinh cosh tanh exp ln
/// log10 sqrt abs sign, min and max of any number of values, and
///
///     step(x, x0, h0, x1, h1)   h0 up to x0, h1 from x1 on, between them h0 + (h1 - h0)(6 u^5 - 15 u^4 + 10 u^3),
///                               u = (x - x0)/(x1 - x0): twice continuously differentiable.
///
/// Angles are in radians; `pi` is known. A comparison gives 1 or 0. Of `a ? b : c` only the branch that is
/// taken is evaluated. Branches, abs, sign, min and max are differentiated on the side on which their values
/// are.
class Expression {
 public:
  /// @param variables names, in the order in which their values are given to the evaluation
  /// @param constants values of further names
  /// @throws InputError (without a place) that tells the character at which the text cannot be read, or the
  ///   name that is unknown or both a variable and a constant
  Expression(const std::string& text, const std::vector<std::string>& variables,
             const std::map<std::string, double>& constants = {});

  /// Its value; not finite where the formula is undefined.
  template <class T>
  T operator()(std::span<const T> values) const {
    return program_.run(values);
  }

  const std::string& text() const { return text_; }
  /// For messages: "'sqrt(gap - 1)' with gap = 0.2", the variables that it uses with their values.
  std::string shown(std::span<const double> values) const;
  /// Indices of the variables that it uses, ascending.
  std::vector<int> variables() const { return program_.variables(); }
  /// Where its steps along a variable begin and end: x0 and x1 of every step(x, x0, h0, x1, h1) whose x is
  /// that variable and whose edges are constant. In no order.
  std::vector<double> step_edges(int variable) const { return program_.step_edges(variable); }
  /// Where it may jump along a variable: the constants that it compares the variable with. In no order.
  std::vector<double> switches(int variable) const { return program_.switches(variable); }

 private:
  std::string text_;
  std::vector<std::string> variable_names_;
  ExpressionProgram program_;
};

/// The names that an expression such as `speed / (R - r/3)` uses, functions and `pi` apart, each once.
/// Throws InputError (without a place) when it is not an expression.
std::vector<std::string> names_in_expression(const std::string& expression);

/// The value of an expression of constants alone. Throws InputError (without a place) when a name is unknown
/// or the value is not finite.
double evaluate_expression(const std::string& expression, const std::map<std::string, double>& values);

/// Whether `name` has a meaning in every expression: a function, or `pi`.
bool is_expression_word(const std::string& name);

}  // namespace wishbone
