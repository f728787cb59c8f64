#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/source.h"

namespace wishbone {

struct YamlNode;
/// Nodes are immutable once parsed and shared: an alias is the same node twice.
using YamlNodePtr = std::shared_ptr<const YamlNode>;

/// One node of a document: null, a scalar (text, uninterpreted), a sequence or a mapping with unique keys.
struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMapping };
  struct Entry {
    std::string key;
    Source where;  ///< of the key
    YamlNodePtr value;
  };

  Kind kind = Kind::kNull;
  Source where;
  std::string text;     ///< of a scalar
  bool quoted = false;  ///< a quoted scalar is text, whatever it looks like
  std::string origin;   ///< the expression that `text` is the value of; empty when it was written so
  std::vector<YamlNodePtr> items;  ///< of a sequence
  std::vector<Entry> entries;      ///< of a mapping, in the order of the file

  const Entry* find(std::string_view key) const {
    for (const Entry& entry : entries) {
      if (entry.key == key) return &entry;
    }
    return nullptr;
  }
};

/// YAML text of a document that load_document reads back to the same nodes.
std::string dump_yaml(const YamlNode& root);

}  // namespace wishbone
