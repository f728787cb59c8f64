#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/parameters.h"
#include "core/yaml_node.h"

namespace wishbone {

/// Replaces expressions, selections and repetitions of a document by what they stand for (core/document.h).
class Resolver {
 public:
  explicit Resolver(Parameters& parameters) : parameters_(parameters) {}

  /// Nothing when a selection chose an empty branch. `path` leads to the node, for messages.
  YamlNodePtr resolve(const YamlNodePtr& node, const std::string& path);

 private:
  YamlNodePtr resolve_scalar(const YamlNodePtr& node, const std::string& path);
  YamlNodePtr resolve_list(const YamlNode& node, const std::string& path);
  YamlNodePtr resolve_mapping(const YamlNode& node, const std::string& path);
  YamlNodePtr resolve_selection(const YamlNode& node, const YamlNode::Entry& select, const std::string& path);
  void count_repeated(const Source& where, const std::string& path);

  /// Calls `add` with the node, or with every copy that it stands for when it is a repetition.
  template <class Add>
  void each_copy(const YamlNodePtr& node, const std::string& path, Add add);

  Parameters& parameters_;
  std::size_t repeated_ = 0;  ///< values made by repetitions so far
};

}  // namespace wishbone
