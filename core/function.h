#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/expression.h"
#include "core/table.h"

namespace wishbone {

/// A function of time and of further variables: a constant, a table of one of them, or an expression. Its
/// values are for double, Jet2 and Dual, without allocation. Variable 0 is the time [s].
class Function {
 public:
  static constexpr int kTime = 0;
  /// Linear tables of time with more bends than this have no stop times: no integrator should halt at every
  /// sample of a long measurement.
  static constexpr std::size_t kMostStops = 1000;

  Function(double constant = 0) : law_(constant) {}  // implicit: a number is a constant function
  explicit Function(Table table, int variable = kTime) : law_(TableOf{std::move(table), variable}) {}
  explicit Function(Expression expression) : law_(std::move(expression)) {}

  /// @param variables the time and the further ones; those that the function uses are read
  template <class T>
  T operator()(std::span<const T> variables) const {
    if (const double* constant = std::get_if<double>(&law_)) return T(*constant);
    if (const TableOf* of = std::get_if<TableOf>(&law_))
      return of->table(variables[static_cast<std::size_t>(of->variable)]);
    return std::get<Expression>(law_)(variables);
  }

  std::optional<double> constant() const;
  /// The table, when it is one of time.
  const Table* table_of_time() const;
  /// Indices of the variables that it uses, ascending.
  std::vector<int> variables() const;
  /// Times, in no order, at which a table bends, or a step(t, ...) of an expression begins or ends. Other
  /// kinks of expressions are not known.
  std::vector<double> stop_times() const;
  /// The expression, when it is one.
  const Expression* expression() const { return std::get_if<Expression>(&law_); }
  /// For messages: what it is and the values of the variables that it uses.
  std::string shown(std::span<const double> variables) const;

 private:
  struct TableOf {
    Table table;
    int variable;
  };
  std::variant<double, TableOf, Expression> law_;
};

}  // namespace wishbone
