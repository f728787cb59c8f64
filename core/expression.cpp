#include "core/expression.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace wishbone {
namespace {

/// Runs `step` on a parser for `expression` and turns muParser's errors into ours.
template <class Step>
auto with_parser(const std::string& expression, Step step) {
  constexpr std::size_t kLongest = 1000;
  if (expression.size() > kLongest) {
    throw InputError({"", fmt::format("the expression is longer than {} characters", kLongest), "",
                      "divide it over several parameters"});
  }
  try {
    mu::Parser parser;
    parser.DefineConst("pi", std::numbers::pi);
    parser.SetExpr(expression);
    return step(parser);
  } catch (const mu::Parser::exception_type& e) {
    std::string message = e.GetMsg();
    if (message.ends_with('.')) message.pop_back();
    throw InputError({"", "the expression cannot be evaluated: " + message, fmt::format("'= {}'", expression),
                      "write a formula of parameters, such as = speed / radius"});
  }
}

}  // namespace

std::vector<std::string> names_in_expression(const std::string& expression) {
  return with_parser(expression, [](mu::Parser& parser) {
    std::vector<std::string> names;
    for (const auto& [name, _] : parser.GetUsedVar()) names.push_back(name);
    return names;
  });
}

double evaluate_expression(const std::string& expression, const std::map<std::string, double>& values) {
  return with_parser(expression, [&](mu::Parser& parser) {
    for (const auto& [name, value] : values) parser.DefineConst(name, value);
    int count = 0;
    const double* results = parser.Eval(count);
    if (count != 1) {
      throw InputError({"", fmt::format("the expression has {} values", count),
                        fmt::format("'= {}'", expression),
                        "write one formula, without commas outside functions"});
    }
    if (!std::isfinite(results[0])) {
      throw InputError({"", "the value of the expression is not finite", fmt::format("'= {}'", expression),
                        "look for a division by zero or a root of a negative number"});
    }
    return results[0];
  });
}

}  // namespace wishbone
