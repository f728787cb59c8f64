#include <yaml-cpp/emitter.h>

#include <algorithm>

#include "core/yaml_node.h"

namespace wishbone {
namespace {

using Kind = YamlNode::Kind;

bool holds_only_scalars(const YamlNode& node) {
  return std::all_of(node.entries.begin(), node.entries.end(),
                     [](const auto& entry) { return entry.value->kind == Kind::kScalar; });
}

void emit(YAML::Emitter& out, const YamlNode& node, bool is_root) {
  switch (node.kind) {
    case Kind::kNull:
      out << YAML::Null;
      return;
    case Kind::kScalar:
      if (node.quoted) out << YAML::DoubleQuoted;
      out << node.text;
      return;
    case Kind::kSequence:
      out << YAML::Flow << YAML::BeginSeq;
      for (const auto& item : node.items) emit(out, *item, false);
      out << YAML::EndSeq;
      return;
    case Kind::kMapping:
      if (!is_root && holds_only_scalars(node)) out << YAML::Flow;
      out << YAML::BeginMap;
      for (const auto& entry : node.entries) {
        out << YAML::Key << entry.key << YAML::Value;
        emit(out, *entry.value, false);
      }
      out << YAML::EndMap;
      return;
  }
}

}  // namespace

std::string dump_yaml(const YamlNode& root) {
  YAML::Emitter out;
  emit(out, root, true);
  return std::string(out.c_str(), out.size()) + "\n";
}

}  // namespace wishbone
