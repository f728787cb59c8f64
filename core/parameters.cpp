#include "core/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "core/did_you_mean.h"
#include "core/error.h"
#include "core/expression.h"
#include "core/units.h"
#include "core/yaml.h"

namespace wishbone {
namespace {

using Kind = YamlNode::Kind;

std::string expression_of(const YamlNode& scalar) {
  const auto start = scalar.text.find_first_not_of(' ', 1);
  return start == std::string::npos ? "" : scalar.text.substr(start);
}

bool is_expression(const YamlNode& scalar) {
  return scalar.text.starts_with('=');
}

bool is_number(const YamlNode& scalar) {
  return !scalar.quoted && looks_like_number(scalar.text);
}

std::string type_of(const YamlNode& scalar) {
  if (is_boolean(scalar)) return "true or false";
  return is_number(scalar) ? "a number" : "a text";
}

[[noreturn]] void refuse(const Source& where, const std::string& what, const std::string& value,
                         const std::string& remedy) {
  throw InputError({where.text(), what, value, remedy});
}

}  // namespace

bool is_boolean(const YamlNode& scalar) {
  return !scalar.quoted && (scalar.text == "true" || scalar.text == "false");
}

Parameters::Parameters(const std::vector<YamlNode::Entry>& declarations,
                       const std::vector<std::string>& overrides) {
  for (const auto& entry : declarations) declare(entry);
  for (const auto& assignment : overrides) override_from_outside(assignment);
  for (const auto& name : names_) value(name, {});
}

void Parameters::declare(const YamlNode::Entry& entry) {
  const Value declaration(entry, "parameters." + entry.key);
  check_identifier(entry.key, declaration.where(), "parameter");
  if (entry.key == "pi")
    refuse(declaration.where(), "'pi' is a constant, not a parameter", "", "use another name");

  const auto known = parameters_.find(entry.key);
  if (!declaration.is_mapping()) {
    declaration.text();  // a scalar, or an error that says so
    if (known != parameters_.end()) {
      known->second.setting = entry.value;
    } else {
      names_.push_back(entry.key);
      parameters_[entry.key] = {entry.value, entry.value, nullptr, {}, ""};
    }
    return;
  }
  const Mapping keys(declaration, {"default", "choices", "about"});
  Parameter parameter;
  const Value fallback = keys.required("default");
  fallback.text();
  parameter.declared = parameter.setting = fallback.node();
  if (const auto choices = keys.optional("choices")) {
    for (const Value& choice : choices->list()) parameter.choices.push_back(choice.text());
  }
  if (const auto about = keys.optional("about")) parameter.about = about->text();
  if (known == parameters_.end()) names_.push_back(entry.key);
  parameters_[entry.key] = std::move(parameter);
}

void Parameters::override_from_outside(const std::string& assignment) {
  const Source where{std::make_shared<const std::string>("--set " + assignment), 0, 0, ""};
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    refuse(where, "an override has the form name=value", fmt::format("'{}'", assignment),
           "write --set speed='80 km/h'");
  }
  const std::string name = assignment.substr(0, equals);
  const auto known = parameters_.find(name);
  if (known == parameters_.end()) refuse_unknown(name, where);
  auto setting = std::make_shared<YamlNode>();
  setting->kind = Kind::kScalar;
  setting->where = where;
  setting->text = assignment.substr(equals + 1);
  known->second.setting = setting;
}

void Parameters::refuse_unknown(const std::string& name, const Source& where) const {
  std::vector<std::string> names = names_;
  for (const auto& [counter, _] : counters_) names.push_back(counter);
  refuse(where, fmt::format("there is no parameter '{}'", name), "",
         did_you_mean(name, names, "the parameters"));
}

void Parameters::set_counter(const std::string& name, int value, const Source& where) {
  check_identifier(name, where, "counter");
  if (name == "pi") refuse(where, "'pi' is a constant, not a counter", "", "use another name");
  if (parameters_.contains(name))
    refuse(where, fmt::format("'{}' is a parameter already", name), "", "use another name for the counter");
  auto scalar = std::make_shared<YamlNode>();
  scalar->kind = Kind::kScalar;
  scalar->where = where;
  scalar->text = std::to_string(value);
  counters_[name] = scalar;
}

const std::vector<std::string>& Parameters::choices(const std::string& name) const {
  static const std::vector<std::string> kAny;
  const auto parameter = parameters_.find(name);
  return parameter == parameters_.end() ? kAny : parameter->second.choices;
}

YamlNodePtr Parameters::value(const std::string& name, const Source& asked_from) {
  if (const auto counter = counters_.find(name); counter != counters_.end()) return counter->second;
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) refuse_unknown(name, asked_from);
  Parameter& parameter = found->second;
  if (parameter.value) return parameter.value;

  Source where = parameter.setting->where;
  where.path = "parameters." + name;
  const bool is_cycle = std::find(resolving_.begin(), resolving_.end(), name) != resolving_.end();
  resolving_.push_back(name);
  if (is_cycle) {
    const std::vector<std::string> cycle(std::find(resolving_.begin(), resolving_.end(), name),
                                         resolving_.end());
    refuse(where, fmt::format("the parameters refer to one another: {}", fmt::join(cycle, " -> ")), "",
           "give one of them a value");
  }
  constexpr std::size_t kLongestChain = 100;
  if (resolving_.size() > kLongestChain) {
    refuse(where, fmt::format("more than {} parameters refer to one another in a row", kLongestChain), "",
           "give one of them a value");
  }
  parameter.value = evaluate(parameter.setting, where.path);
  resolving_.pop_back();
  check(name, parameter);
  return parameter.value;
}

void Parameters::check(const std::string& name, const Parameter& parameter) const {
  const YamlNode& value = *parameter.value;
  Source where = parameter.setting->where;
  where.path = "parameters." + name;
  const std::string shown = fmt::format("'{}'", value.text);
  const std::string about = parameter.about.empty() ? "" : fmt::format(" ({})", parameter.about);

  if (!parameter.choices.empty() &&
      std::find(parameter.choices.begin(), parameter.choices.end(), value.text) == parameter.choices.end()) {
    refuse(where, fmt::format("not a choice of the parameter '{}'{}", name, about), shown,
           did_you_mean(value.text, parameter.choices, "its choices"));
  }
  if (is_number(value)) located(where, [&] { return parse_quantity(value.text); });
  if (parameter.setting == parameter.declared || is_expression(*parameter.declared)) return;

  const YamlNode& declared = *parameter.declared;
  const std::string like = fmt::format("its default is {}", declared.text);
  if (type_of(declared) == "a text") return;
  if (type_of(value) != type_of(declared)) {
    refuse(where, fmt::format("the parameter '{}'{} must be {}", name, about, type_of(declared)), shown,
           like);
  }
  if (!is_number(value)) return;
  const std::string given = parse_quantity(value.text).base;
  const std::string wanted = parse_quantity(declared.text).base;
  if (!given.empty() && !wanted.empty() && given != wanted) {
    refuse(where,
           fmt::format("wrong dimension: the parameter '{}'{} is {}, this is {}", name, about,
                       describe_dimension(wanted), describe_dimension(given)),
           shown, like);
  }
}

double Parameters::number(const std::string& name, const Source& asked_from) {
  const YamlNodePtr scalar = value(name, asked_from);
  if (is_boolean(*scalar)) return scalar->text == "true" ? 1.0 : 0.0;
  if (!is_number(*scalar)) {
    refuse(asked_from, fmt::format("the parameter '{}' is a text and cannot be calculated with", name),
           fmt::format("'{}'", scalar->text), "use it alone, as = " + name);
  }
  return parse_quantity(scalar->text).value;
}

YamlNodePtr Parameters::evaluate(const YamlNodePtr& scalar, const std::string& path) {
  if (!is_expression(*scalar)) return scalar;
  Source where = scalar->where;
  where.path = path;
  const std::string expression = expression_of(*scalar);
  const std::vector<std::string> names = located(where, [&] { return names_in_expression(expression); });

  auto result = std::make_shared<YamlNode>();
  result->kind = Kind::kScalar;
  if (names.size() == 1 && names.front() == expression) {
    const YamlNodePtr value_of_name = value(names.front(), where);
    result->text = value_of_name->text;
    result->quoted = value_of_name->quoted;
  } else {
    std::map<std::string, double> values;
    for (const std::string& name : names) values[name] = number(name, where);
    result->text = fmt::format("{}", located(where, [&] { return evaluate_expression(expression, values); }));
  }
  result->where = scalar->where;
  result->origin = scalar->text;
  return result;
}

}  // namespace wishbone
