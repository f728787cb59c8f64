#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/yaml_node.h"

namespace wishbone {

/// The `parameters` of a document: named texts, booleans, numbers and quantities that its expressions refer
/// to.
///
///     parameters:
///       speed: 120 km/h
///       radius: = 2 * 0.15
///       chassis: {default: modal, choices: [rigid, modal], about: form of the chassis}
///
/// A later plain value for a known name (of an including file, or from outside) replaces its default and must
/// be of the same type, dimension and choice; parameters may refer to one another in any order.
class Parameters {
 public:
  /// Declarations in the order of the files (included ones first), then overrides "name=value" from outside.
  /// Throws InputError for bad declarations, unknown names, wrong types and cycles.
  Parameters(const std::vector<YamlNode::Entry>& declarations, const std::vector<std::string>& overrides);

  /// The scalar itself, or what it stands for when it is an expression (begins with `=`): a lone parameter
  /// name gives that parameter's value whatever its type, anything else a number in SI. `path` is for
  /// messages.
  YamlNodePtr evaluate(const YamlNodePtr& scalar, const std::string& path);

  /// Final value (a scalar without expression) of a parameter; throws InputError when it is unknown.
  YamlNodePtr value(const std::string& name, const Source& asked_from);

  /// Empty when any value is allowed.
  const std::vector<std::string>& choices(const std::string& name) const;

  /// Counters are whole numbers that expressions may use like parameters, from set_counter to remove_counter.
  /// Throws InputError when a new one has no good name or that of a parameter.
  void set_counter(const std::string& name, int value, const Source& where);
  void remove_counter(const std::string& name) { counters_.erase(name); }
  bool has_counters() const { return !counters_.empty(); }
  bool is_counter(const std::string& name) const { return counters_.contains(name); }

  const std::vector<std::string>& names() const { return names_; }

 private:
  struct Parameter {
    YamlNodePtr declared;  ///< default, as written
    YamlNodePtr setting;   ///< the value in force, as written
    YamlNodePtr value;     ///< evaluated; null until it is asked for
    std::vector<std::string> choices;
    std::string about;
  };

  void declare(const YamlNode::Entry& entry);
  void override_from_outside(const std::string& assignment);
  void check(const std::string& name, const Parameter& parameter) const;
  double number(const std::string& name, const Source& asked_from);
  [[noreturn]] void refuse_unknown(const std::string& name, const Source& where) const;

  std::map<std::string, Parameter> parameters_;
  std::map<std::string, YamlNodePtr> counters_;
  std::vector<std::string> names_;      ///< in the order of declaration
  std::vector<std::string> resolving_;  ///< chain of parameters being evaluated, to find cycles
};

/// True for the words true and false, unquoted.
bool is_boolean(const YamlNode& scalar);

}  // namespace wishbone
