#include "app/tolerances.h"

#include <fmt/core.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "core/glob.h"

namespace wishbone {

namespace {

constexpr const char* kRuleRemedy = "write GLOB=RELATIVE[,ABSOLUTE], as in --tol '/tires/*=1e-5,1e-7'";

double number_in_rule(const std::string& text, const std::string& rule) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw InputError({"--tol", "this is not a tolerance", rule, kRuleRemedy});
  return value;
}

std::string place(const std::string& path, const YAML::Mark& mark) {
  return mark.is_null() ? path : fmt::format("{}:{}:{}", path, mark.line + 1, mark.column + 1);
}

Tolerance tolerance_from(const YAML::Node& node, const std::string& path) {
  const std::string remedy = "write {relative: 1e-6, absolute: 1e-9}";
  if (!node.IsMap()) throw InputError({place(path, node.Mark()), "a tolerance is a map", "", remedy});
  Tolerance tolerance{0, 0};
  for (const auto& item : node) {
    const std::string key = item.first.as<std::string>();
    double& value = key == "relative" ? tolerance.relative : tolerance.absolute;
    if (key != "relative" && key != "absolute")
      throw InputError({place(path, item.first.Mark()), "unknown key of a tolerance", key, remedy});
    if (!YAML::convert<double>::decode(item.second, value))
      throw InputError({place(path, item.second.Mark()), "not a number", YAML::Dump(item.second), remedy});
  }
  return tolerance;
}

}  // namespace

void Tolerances::add(const std::string& glob, const Tolerance& tolerance) {
  for (const double value : {tolerance.relative, tolerance.absolute})
    if (!(value >= 0 && std::isfinite(value)))
      throw InputError({glob, "a tolerance is a finite number, not negative", fmt::format("{}", value), ""});
  rules_.emplace_back(glob, tolerance);
}

std::string Tolerances::add(const std::string& rule) {
  const std::size_t equals = rule.rfind('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError({"--tol", "this is not a tolerance", rule, kRuleRemedy});
  const std::size_t comma = rule.find(',', equals);
  const std::string relative = rule.substr(equals + 1, comma - equals - 1);
  const double absolute = comma == std::string::npos ? 0 : number_in_rule(rule.substr(comma + 1), rule);
  const std::string glob = rule.substr(0, equals);
  add(glob, {number_in_rule(relative, rule), absolute});
  return glob;
}

void Tolerances::load(const std::string& yaml_path) {
  try {
    const YAML::Node file = YAML::LoadFile(yaml_path);
    if (!file.IsMap())
      throw InputError({yaml_path, "a file of tolerances is a map from signals to tolerances", "",
                        "write lines such as  \"/tires/*\": {relative: 1e-5, absolute: 1e-7}"});
    for (const auto& item : file) add(item.first.as<std::string>(), tolerance_from(item.second, yaml_path));
  } catch (const YAML::BadFile&) {
    throw InputError({yaml_path, "cannot read the file", "", "check the path"});
  } catch (const YAML::Exception& e) {
    throw InputError({place(yaml_path, e.mark), e.msg, "", ""});
  }
}

Tolerance Tolerances::of(const std::string& path) const {
  for (auto rule = rules_.rbegin(); rule != rules_.rend(); ++rule)
    if (matches(rule->first, path)) return rule->second;
  return {};
}

}  // namespace wishbone
