#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/spatial.h"
#include "core/units.h"
#include "core/yaml_node.h"

/// Reading a document key by key. Whatever is wrong is told with file, line, column and the path of keys.
namespace wishbone {

/// A value of the document and the path that leads to it. All readers throw InputError.
class Value {
 public:
  Value(const YamlNode::Entry& entry, std::string path);
  Value(YamlNodePtr node, Source where) : node_(std::move(node)), where_(std::move(where)) {}

  const Source& where() const { return where_; }
  const YamlNodePtr& node() const { return node_; }
  bool is_mapping() const { return node_->kind == YamlNode::Kind::kMapping; }
  bool is_list() const { return node_->kind == YamlNode::Kind::kSequence; }
  bool is_word(std::string_view word) const {
    return node_->kind == YamlNode::Kind::kScalar && node_->text == word;
  }

  /// A number in SI: a plain one or a quantity of that dimension.
  double number(const Dimension& dimension) const;
  double positive(const Dimension& dimension) const;      ///< number > 0
  double non_negative(const Dimension& dimension) const;  ///< number >= 0
  /// A whole number within the bounds.
  int integer(int lowest, int highest) const;
  /// The word true or false.
  bool boolean() const;
  /// Any scalar, as written.
  const std::string& text() const;
  /// Three numbers of one dimension.
  Vector3 vector3(const Dimension& dimension) const;
  /// Three numbers, not all zero, scaled to unit length.
  Vector3 direction() const;
  /// The items of a list.
  std::vector<Value> list() const;
  /// The items of a mapping from names (letters, digits, `_`, `-`, not beginning with a digit or `-`) to
  /// things.
  std::vector<std::pair<std::string, Value>> named() const;

  /// One of a few words. `kind` names the choice in the message ("the joint types").
  template <class Enum>
  Enum choice(std::initializer_list<std::pair<std::string_view, Enum>> choices, std::string_view kind) const {
    for (const auto& [word, meaning] : choices) {
      if (is_word(word)) return meaning;
    }
    std::vector<std::string> words;
    for (const auto& choice : choices) words.emplace_back(choice.first);
    refuse_choice(words, kind);
  }

  /// Throws InputError at this place; the value is shown when it is a scalar.
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const;
  [[noreturn]] void refuse_choice(const std::vector<std::string>& words, std::string_view kind) const;

 private:
  std::string shown() const;
  [[noreturn]] void refuse_kind(std::string_view wanted, std::string_view remedy) const;

  YamlNodePtr node_;
  Source where_;
};

/// A mapping with a fixed set of keys. Unknown keys are refused on construction, with "did you mean".
class Mapping {
 public:
  Mapping(const Value& value, std::initializer_list<std::string_view> keys)
      : Mapping(value, std::vector<std::string_view>(keys)) {}
  Mapping(const Value& value, const std::vector<std::string_view>& keys);

  const Source& where() const { return value_.where(); }
  /// The value of a key; throws InputError when it is missing.
  Value required(std::string_view key) const;
  /// The value of a key, if it is there.
  std::optional<Value> optional(std::string_view key) const;
  bool has(std::string_view key) const { return optional(key).has_value(); }

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    value_.refuse(what, remedy);
  }

 private:
  Value value_;
  std::vector<std::string> keys_;
};

/// Throws InputError unless `name` is a letter or `_` followed by letters, digits and `_`.
void check_identifier(std::string_view name, const Source& where, std::string_view kind);

/// Runs `step` and gives a place to the error that it throws without one.
template <class Step>
auto located(const Source& where, Step step) {
  try {
    return step();
  } catch (const InputError& e) {
    if (!e.diagnostic().where.empty()) throw;
    Diagnostic diagnostic = e.diagnostic();
    diagnostic.where = where.text();
    throw InputError(diagnostic);
  }
}

/// Runs `step` and puts this place before the one of the error that it throws, if there is any.
template <class Step>
auto within(const Source& where, Step step) {
  try {
    return step();
  } catch (const InputError& e) {
    Diagnostic diagnostic = e.diagnostic();
    diagnostic.where = where.text() + (diagnostic.where.empty() ? "" : ": " + diagnostic.where);
    throw InputError(diagnostic);
  }
}

}  // namespace wishbone
