#include "core/function.h"

#include <fmt/format.h>

namespace wishbone {

std::optional<double> Function::constant() const {
  const double* constant = std::get_if<double>(&law_);
  return constant ? std::optional(*constant) : std::nullopt;
}

const Table* Function::table_of_time() const {
  const TableOf* of = std::get_if<TableOf>(&law_);
  return of && of->variable == kTime ? &of->table : nullptr;
}

std::vector<int> Function::variables() const {
  if (const TableOf* of = std::get_if<TableOf>(&law_)) return {of->variable};
  if (const Expression* expression = std::get_if<Expression>(&law_)) return expression->variables();
  return {};
}

std::vector<double> Function::stop_times() const {
  if (const Expression* expression = std::get_if<Expression>(&law_)) return expression->step_edges(kTime);
  const Table* table = table_of_time();
  if (!table) return {};
  std::vector<double> kinks = table->kinks();
  if (kinks.size() > kMostStops) return {};
  return kinks;
}

std::string Function::shown(std::span<const double> variables) const {
  if (const double* constant = std::get_if<double>(&law_)) return fmt::format("{:g}", *constant);
  if (const Expression* expression = std::get_if<Expression>(&law_)) return expression->shown(variables);
  return fmt::format("a table at {:.9g}",
                     variables[static_cast<std::size_t>(std::get<TableOf>(law_).variable)]);
}

}  // namespace wishbone
