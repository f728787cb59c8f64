#pragma once

#include <functional>
#include <string>

#include "core/parameters.h"
#include "core/yaml_node.h"

namespace wishbone {

/// The counters of `repeat: {i: [FIRST, LAST], j: [FIRST, LAST]}`: whole numbers, both bounds included, the
/// last one counting fastest; nothing is repeated when LAST < FIRST.
class Repetition {
 public:
  /// Gives the value of a node of the document: bounds may be expressions, also of the counters before them.
  using Resolve = std::function<YamlNodePtr(const YamlNodePtr&, const std::string& path)>;

  /// @param repeat the entry with the key `repeat`; `path` leads to it, for messages
  Repetition(const YamlNode::Entry& repeat, std::string path, Parameters& parameters, Resolve resolve);

  /// Calls `step` once for every set of counters, which are then known to the parameters, and `tick` for every
  /// value that a counter takes. Throws InputError when the counters are not as above.
  void run(const std::function<void()>& tick, const std::function<void()>& step) { run(0, tick, step); }

 private:
  void run(std::size_t counter, const std::function<void()>& tick, const std::function<void()>& step);

  YamlNode::Entry repeat_;
  std::string path_;
  Parameters& parameters_;
  Resolve resolve_;
};

/// `text` with every `{expression}` replaced by its value, a whole number: the names and texts of a repetition.
/// Throws InputError at `where` when a bracket is not closed or the value is no whole number.
std::string fill_in_counters(const std::string& text, const Source& where, Parameters& parameters);

/// Throws InputError when a text outside of any repetition looks like a name with a counter, `link_{i}` or
/// `link_{N - 1}`, which nothing would fill in.
void refuse_counters(const std::string& text, const Source& where);

}  // namespace wishbone
