#include "core/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/parameters.h"
#include "core/resolver.h"
#include "core/yaml.h"
#include "core/yaml_parser.h"

namespace wishbone {
namespace {

using Kind = YamlNode::Kind;
using Entry = YamlNode::Entry;

/// The same path for the same file, however it is named; the name itself when there is no such file.
std::filesystem::path identity_of(const std::filesystem::path& path) {
  std::error_code error;
  const auto identity = std::filesystem::weakly_canonical(path, error);
  return error ? path : identity;
}

/// Merges a file and its includes, included ones first.
class Merger {
 public:
  void add_file(const std::filesystem::path& path, const Source& included_from) {
    const auto identity = identity_of(path);
    if (std::find(open_.begin(), open_.end(), identity) != open_.end()) refuse_cycle(path, included_from);
    if (std::find(done_.begin(), done_.end(), identity) != done_.end()) return;
    const YamlNodePtr file = parse_yaml_file(path, included_from);
    open_.push_back(identity);
    if (const Entry* include = file->find("include")) add_includes(Value(*include, "include"), path);
    open_.pop_back();
    done_.push_back(identity);
    for (const Entry& entry : file->entries) add_section(entry);
  }

  const std::vector<Entry>& sections() const { return sections_; }
  const std::vector<Entry>& parameters() const { return parameters_; }

 private:
  void add_includes(const Value& include, const std::filesystem::path& includer) {
    const auto add = [&](const Value& name) {
      add_file((includer.parent_path() / name.text()).lexically_normal(), name.where());
    };
    if (!include.is_list()) return add(include);
    for (const Value& name : include.list()) add(name);
  }

  [[noreturn]] void refuse_cycle(const std::filesystem::path& path, const Source& included_from) const {
    std::vector<std::string> chain;
    for (auto it = std::find(open_.begin(), open_.end(), identity_of(path)); it != open_.end(); ++it) {
      chain.push_back(it->filename().string());
    }
    chain.push_back(path.filename().string());
    throw InputError({included_from.text(),
                      fmt::format("the files include one another: {}", fmt::join(chain, " -> ")),
                      fmt::format("'{}'", path.filename().string()), "remove one of the includes"});
  }

  void add_section(const Entry& entry) {
    if (entry.key == "include") return;
    if (entry.key == "parameters") {
      const Value section(entry, entry.key);
      if (!section.is_mapping())
        section.refuse("a mapping of names is wanted here", "write one 'name: value' per line");
      parameters_.insert(parameters_.end(), entry.value->entries.begin(), entry.value->entries.end());
      return;
    }
    const auto [known, is_new] = section_index_.emplace(entry.key, sections_.size());
    if (is_new) {
      sections_.push_back(entry);
    } else {
      Entry& section = sections_[known->second];
      section = merge(section, entry);
    }
  }

  static Entry merge(const Entry& first, const Entry& second) {
    const YamlNode& a = *first.value;
    const YamlNode& b = *second.value;
    if (a.kind == Kind::kScalar && b.kind == Kind::kScalar && a.text == b.text) return first;
    if (a.kind != Kind::kMapping || b.kind != Kind::kMapping || a.find("select") || b.find("select")) {
      refuse_twice(second.key, first.where, second);
    }
    std::map<std::string_view, const Entry*> known;
    for (const Entry& entry : a.entries) known.emplace(entry.key, &entry);
    auto merged = std::make_shared<YamlNode>(a);
    for (const Entry& entry : b.entries) {
      const auto other = known.find(entry.key);
      if (other != known.end()) refuse_twice(second.key + "." + entry.key, other->second->where, entry);
      merged->entries.push_back(entry);
    }
    return {second.key, second.where, merged};
  }

  [[noreturn]] static void refuse_twice(const std::string& path, const Source& first, const Entry& second) {
    Source where = second.where;
    where.path = path;
    throw InputError(
        {where.text(), fmt::format("'{}' is defined already, at {}", second.key, first.text()), "",
         "rename or remove one of the two, or make the difference a parameter of the included file"});
  }

  std::vector<std::filesystem::path> open_;  // chain of files being read
  std::vector<std::filesystem::path> done_;
  std::vector<Entry> sections_;
  std::map<std::string, std::size_t> section_index_;
  std::vector<Entry> parameters_;
};

Entry parameters_section(Parameters& parameters) {
  auto values = std::make_shared<YamlNode>();
  values->kind = Kind::kMapping;
  for (const std::string& name : parameters.names())
    values->entries.push_back({name, {}, parameters.value(name, {})});
  return {"parameters", {}, values};
}

}  // namespace

YamlNodePtr load_document(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  Merger merger;
  merger.add_file(path, {});
  Parameters parameters(merger.parameters(), overrides);

  auto root = std::make_shared<YamlNode>();
  root->kind = Kind::kMapping;
  root->where.file = std::make_shared<const std::string>(path.string());
  if (!parameters.names().empty()) root->entries.push_back(parameters_section(parameters));
  Resolver resolver(parameters);
  for (const Entry& section : merger.sections()) {
    const YamlNodePtr value = resolver.resolve(section.value, section.key);
    if (value) root->entries.push_back({section.key, section.where, value});
  }
  return root;
}

}  // namespace wishbone
