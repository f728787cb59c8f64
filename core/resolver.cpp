#include "core/resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>

#include "core/did_you_mean.h"
#include "core/error.h"
#include "core/repetition.h"
#include "core/yaml.h"
#include "core/yaml_parser.h"

namespace wishbone {
namespace {

using Kind = YamlNode::Kind;
using Entry = YamlNode::Entry;

YamlNodePtr without(const YamlNode& node, const Entry& left_out) {
  auto rest = std::make_shared<YamlNode>(node);
  std::erase_if(rest->entries, [&](const Entry& entry) { return entry.key == left_out.key; });
  return rest;
}

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

[[noreturn]] void refuse_repeated_key(Source where, const std::string& path, const std::string& key) {
  where.path = joined(path, key);
  throw InputError({where.text(), fmt::format("the repetition gives the key '{}' twice", key), "",
                    fmt::format("put every counter into the key, as in '{}_{{i}}'", key)});
}

}  // namespace

YamlNodePtr Resolver::resolve(const YamlNodePtr& node, const std::string& path) {
  if (parameters_.has_counters()) count_repeated(node->where, path);
  switch (node->kind) {
    case Kind::kNull:
      return node;
    case Kind::kScalar:
      return resolve_scalar(node, path);
    case Kind::kSequence:
      return resolve_list(*node, path);
    case Kind::kMapping:
      break;
  }
  if (const Entry* select = node->find("select")) return resolve_selection(*node, *select, path);
  return resolve_mapping(*node, path);
}

/// Against repetitions within repetitions: what they make has the bounds of what could be written.
void Resolver::count_repeated(const Source& where, const std::string& path) {
  if (++repeated_ <= YamlLimits::kNodes) return;
  Source place = where;
  place.path = path;
  throw InputError({place.text(), fmt::format("the repetitions make more than {} values", YamlLimits::kNodes),
                    "", "lower the last number of a counter"});
}

template <class Add>
void Resolver::each_copy(const YamlNodePtr& node, const std::string& path, Add add) {
  const Entry* repeat = node->kind == Kind::kMapping ? node->find("repeat") : nullptr;
  if (!repeat) return add(node);
  const YamlNodePtr body = without(*node, *repeat);
  Repetition repetition(
      *repeat, path + ".repeat", parameters_,
      [this](const YamlNodePtr& bound, const std::string& at) { return resolve(bound, at); });
  repetition.run([&] { count_repeated(repeat->where, path); }, [&] { add(body); });
}

YamlNodePtr Resolver::resolve_scalar(const YamlNodePtr& node, const std::string& path) {
  if (node->text.starts_with('=') || node->text.find('{') == std::string::npos)
    return parameters_.evaluate(node, path);
  Source where = node->where;
  where.path = path;
  if (!parameters_.has_counters()) {
    if (path != "title") refuse_counters(node->text, where);  // a title may say what it likes
    return parameters_.evaluate(node, path);
  }
  auto filled = std::make_shared<YamlNode>(*node);
  filled->text = fill_in_counters(node->text, where, parameters_);
  filled->origin = node->text;
  return filled;
}

YamlNodePtr Resolver::resolve_mapping(const YamlNode& node, const std::string& path) {
  auto resolved = std::make_shared<YamlNode>(node);
  resolved->entries.clear();
  std::set<std::string> keys;
  for (const Entry& entry : node.entries) {
    each_copy(entry.value, joined(path, entry.key), [&](const YamlNodePtr& copy) {
      Source where = entry.where;
      where.path = path;
      if (!parameters_.has_counters()) refuse_counters(entry.key, where);
      const std::string key =
          parameters_.has_counters() ? fill_in_counters(entry.key, where, parameters_) : entry.key;
      const YamlNodePtr value = resolve(copy, joined(path, key));
      if (!value) return;
      if (!keys.insert(key).second) refuse_repeated_key(entry.where, path, key);
      resolved->entries.push_back({key, entry.where, value});
    });
  }
  return resolved;
}

YamlNodePtr Resolver::resolve_list(const YamlNode& node, const std::string& path) {
  auto resolved = std::make_shared<YamlNode>(node);
  resolved->items.clear();
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string item_path = fmt::format("{}[{}]", path, i + 1);
    each_copy(node.items[i], item_path, [&](const YamlNodePtr& copy) {
      if (const YamlNodePtr item = resolve(copy, item_path)) resolved->items.push_back(item);
    });
  }
  return resolved;
}

YamlNodePtr Resolver::resolve_selection(const YamlNode& node, const Entry& select, const std::string& path) {
  const Value selector(select, path + ".select");
  const std::string& parameter = selector.text();
  const YamlNodePtr chosen = parameters_.value(parameter, selector.where());
  const auto& choices = parameters_.choices(parameter);
  std::vector<std::string> branches;
  for (const Entry& entry : node.entries) {
    if (&entry == &select) continue;
    branches.push_back(entry.key);
    if (choices.empty() || std::find(choices.begin(), choices.end(), entry.key) != choices.end()) continue;
    Source where = entry.where;
    where.path = path;
    throw InputError({where.text(),
                      fmt::format("'{}' is not a choice of the parameter '{}'", entry.key, parameter), "",
                      did_you_mean(entry.key, choices, "its choices")});
  }
  const Entry* branch = chosen->text == "select" ? nullptr : node.find(chosen->text);
  if (!branch) {
    selector.refuse(
        fmt::format("there is no branch for '{}', the value of the parameter", chosen->text),
        fmt::format("the branches are: {}; add one for '{}'", fmt::join(branches, ", "), chosen->text));
  }
  return branch->value->kind == Kind::kNull ? nullptr : resolve(branch->value, path);
}

}  // namespace wishbone
