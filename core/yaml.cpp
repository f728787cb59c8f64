#include "core/yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/ascii.h"
#include "core/did_you_mean.h"
#include "core/parameters.h"

namespace wishbone {
namespace {

using Kind = YamlNode::Kind;

std::string_view kind_of(const YamlNode& node) {
  switch (node.kind) {
    case Kind::kNull:
      return "nothing";
    case Kind::kScalar:
      return "a single value";
    case Kind::kSequence:
      return "a list";
    case Kind::kMapping:
      return "a mapping";
  }
  return "";
}

/// A mapping or list is where its key stands; a scalar where it stands itself.
Source place_of(const YamlNode::Entry& entry, std::string path) {
  Source where = entry.value->kind == Kind::kScalar ? entry.value->where : entry.where;
  where.path = std::move(path);
  return where;
}

bool is_name(std::string_view name, std::string_view extra) {
  constexpr std::size_t kLongest = 64;
  return !name.empty() && name.size() <= kLongest && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) {
           return is_letter(c) || is_digit(c) || extra.find(c) != std::string_view::npos;
         });
}

}  // namespace

Value::Value(const YamlNode::Entry& entry, std::string path)
    : node_(entry.value), where_(place_of(entry, std::move(path))) {}

std::string Value::shown() const {
  if (node_->kind != Kind::kScalar) return std::string();
  constexpr std::size_t kLongest = 80;
  std::string text = node_->text.substr(0, kLongest);
  if (node_->text.size() > kLongest) text += "...";
  return node_->origin.empty() ? fmt::format("'{}'", text)
                               : fmt::format("'{}' from '{}'", text, node_->origin);
}

void Value::refuse(const std::string& what, const std::string& remedy) const {
  throw InputError({where_.text(), what, shown(), remedy});
}

void Value::refuse_kind(std::string_view wanted, std::string_view remedy) const {
  refuse(fmt::format("{} is wanted here, not {}", wanted, kind_of(*node_)), std::string(remedy));
}

void Value::refuse_choice(const std::vector<std::string>& words, std::string_view kind) const {
  if (node_->kind != Kind::kScalar)
    refuse_kind("one word", fmt::format("{} are: {}", kind, fmt::join(words, ", ")));
  refuse(fmt::format("not one of {}", kind), did_you_mean(node_->text, words, kind));
}

double Value::number(const Dimension& dimension) const {
  if (node_->kind != Kind::kScalar) {
    refuse_kind(fmt::format("a {} [{}]", dimension.name, dimension.unit), "write one number");
  }
  try {
    return parse_quantity(node_->text, dimension);
  } catch (const InputError& e) {
    throw InputError({where_.text(), e.diagnostic().what, shown(), e.diagnostic().remedy});
  }
}

double Value::positive(const Dimension& dimension) const {
  const double x = number(dimension);
  if (!(x > 0)) refuse(fmt::format("the {} must be positive", dimension.name), "give a value above zero");
  return x;
}

double Value::non_negative(const Dimension& dimension) const {
  const double x = number(dimension);
  if (!(x >= 0))
    refuse(fmt::format("the {} must not be negative", dimension.name), "give zero or a value above it");
  return x;
}

int Value::integer(int lowest, int highest) const {
  if (node_->kind != Kind::kScalar) refuse_kind("a whole number", "write one number");
  const double x = number(kRatio);
  if (x != std::floor(x) || x < lowest || x > highest) {
    refuse(fmt::format("a whole number from {} to {} is wanted here", lowest, highest), "give one of them");
  }
  return static_cast<int>(x);
}

bool Value::boolean() const {
  if (node_->kind != Kind::kScalar || !is_boolean(*node_))
    refuse("true or false is wanted here", "write true or false");
  return node_->text == "true";
}

const std::string& Value::text() const {
  if (node_->kind != Kind::kScalar) refuse_kind("a single value", "write one word, text or number");
  return node_->text;
}

Vector3 Value::vector3(const Dimension& dimension) const {
  const auto wanted = fmt::format("a list of three numbers ({} [{}])", dimension.name, dimension.unit);
  if (!is_list()) refuse_kind(wanted, "write [x, y, z]");
  const std::vector<Value> items = list();
  if (items.size() != 3)
    refuse(fmt::format("{} is wanted here, not of {}", wanted, items.size()), "write [x, y, z]");
  return {items[0].number(dimension), items[1].number(dimension), items[2].number(dimension)};
}

Vector3 Value::direction() const {
  const Vector3 v = vector3(kRatio);
  if (v.isZero(0.0)) refuse("the direction has zero length", "give at least one component that is not zero");
  return v.stableNormalized();
}

std::vector<Value> Value::list() const {
  if (!is_list()) refuse_kind("a list", "write [a, b, ...], or one '- item' per line");
  std::vector<Value> values;
  for (const YamlNodePtr& item : node_->items) {
    Source where = item->where;
    where.path = fmt::format("{}[{}]", where_.path, values.size() + 1);
    values.emplace_back(item, where);
  }
  return values;
}

std::vector<std::pair<std::string, Value>> Value::named() const {
  if (!is_mapping()) refuse_kind("a mapping of names", "write one 'name: ...' per thing");
  std::vector<std::pair<std::string, Value>> values;
  for (const auto& entry : node_->entries) {
    const Value value(entry, where_.path.empty() ? entry.key : where_.path + "." + entry.key);
    if (!is_name(entry.key, "-")) {
      throw InputError({value.where().text(), "not a name", fmt::format("'{}'", entry.key),
                        "use up to 64 letters, digits, '_' and '-', beginning with a letter"});
    }
    values.emplace_back(entry.key, value);
  }
  return values;
}

Mapping::Mapping(const Value& value, const std::vector<std::string_view>& keys)
    : value_(value), keys_(keys.begin(), keys.end()) {
  if (!value.is_mapping()) {
    value.refuse("a mapping is wanted here", fmt::format("write its keys: {}", fmt::join(keys_, ", ")));
  }
  for (const auto& entry : value.node()->entries) {
    if (std::find(keys_.begin(), keys_.end(), entry.key) != keys_.end()) continue;
    Source where = entry.where;
    where.path = value.where().path;
    throw InputError({where.text(), fmt::format("unknown key '{}'", entry.key), "",
                      did_you_mean(entry.key, keys_, "the keys here")});
  }
}

std::optional<Value> Mapping::optional(std::string_view key) const {
  assert(std::find(keys_.begin(), keys_.end(), key) != keys_.end());
  const YamlNode::Entry* entry = value_.node()->find(key);
  if (!entry) return std::nullopt;
  const std::string& parent = where().path;
  const Value value(*entry, parent.empty() ? entry->key : parent + "." + entry->key);
  if (entry->value->kind == Kind::kNull)
    value.refuse("the key has no value", "write one after the ':' or remove the key");
  return value;
}

Value Mapping::required(std::string_view key) const {
  if (auto value = optional(key)) return *std::move(value);
  value_.refuse(fmt::format("the key '{}' is missing", key), fmt::format("add '{}: ...' here", key));
}

void check_identifier(std::string_view name, const Source& where, std::string_view kind) {
  if (is_name(name, "")) return;
  throw InputError({where.text(), fmt::format("not a name of a {}", kind), fmt::format("'{}'", name),
                    "use up to 64 letters, digits and '_', beginning with a letter"});
}

}  // namespace wishbone
