#include "core/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/expression_parser.h"

namespace wishbone {
namespace {

std::vector<std::string> known_names(const std::vector<std::string>& variables,
                                     const std::map<std::string, double>& constants) {
  std::vector<std::string> names = variables;
  for (const auto& [name, _] : constants) names.push_back(name);
  names.emplace_back("pi");
  return names;
}

}  // namespace

Expression::Expression(const std::string& text, const std::vector<std::string>& variables,
                       const std::map<std::string, double>& constants)
    : text_(text), variable_names_(variables) {
  const auto read_name = [&](const std::string& name) -> std::optional<NameMeaning> {
    const auto variable = std::find(variables.begin(), variables.end(), name);
    const auto constant = constants.find(name);
    if (variable != variables.end() && constant != constants.end()) {
      throw InputError({"", fmt::format("'{}' is a variable of this expression and a parameter too", name),
                        fmt::format("'{}'", text), "rename the parameter"});
    }
    if (variable != variables.end())
      return NameMeaning{true, static_cast<int>(variable - variables.begin()), 0};
    if (constant != constants.end()) return NameMeaning{false, 0, constant->second};
    return std::nullopt;
  };
  program_ = parse_expression(text, read_name, known_names(variables, constants));
}

std::string Expression::shown(std::span<const double> values) const {
  std::string inputs;
  for (const int i : program_.variables())
    inputs += fmt::format("{}{} = {:.9g}", inputs.empty() ? " with " : ", ",
                          variable_names_[static_cast<std::size_t>(i)], values[static_cast<std::size_t>(i)]);
  return fmt::format("'{}'{}", text_, inputs);
}

std::vector<std::string> names_in_expression(const std::string& expression) {
  std::vector<std::string> names;
  const auto collect = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    return NameMeaning{true, 0, 0};
  };
  parse_expression(expression, collect, {});
  return names;
}

double evaluate_expression(const std::string& expression, const std::map<std::string, double>& values) {
  const double value = Expression(expression, {}, values)(std::span<const double>());
  if (!std::isfinite(value)) {
    throw InputError({"", "the value of the expression is not finite", fmt::format("'= {}'", expression),
                      "look for a division by zero or a root of a negative number"});
  }
  return value;
}

bool is_expression_word(const std::string& name) {
  const auto& functions = expression_functions();
  return name == "pi" || std::binary_search(functions.begin(), functions.end(), name);
}

}  // namespace wishbone
