#include "core/yaml_parser.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/text_file.h"

namespace wishbone {
namespace {

using Kind = YamlNode::Kind;

/// Builds the tree from the parser's events, so that every limit acts before anything grows.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(std::shared_ptr<const std::string> file, const std::string& text)
      : file_(std::move(file)), text_(text) {}

  YamlNodePtr root() const { return root_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (root_)
      refuse(place(mark), "a second document begins", "", "keep one document in a file (remove the '---')");
  }
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark&, const std::string&) override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (awaits_key()) refuse_key(mark);
    add(new_node(Kind::kNull, mark), anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    check_tag(mark, tag);
    if (tag == "!") check_quote_closed(mark);
    if (awaits_key()) return take_key(mark, text);
    const auto node = new_node(Kind::kScalar, mark);
    node->text = text;
    node->quoted = tag == "!";
    add(node, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (awaits_key()) refuse_key(mark);
    if (++aliases_ > YamlLimits::kAliases) {
      refuse(place(mark), fmt::format("there are more than {} aliases", YamlLimits::kAliases), "",
             "write the values out, or use parameters");
    }
    const auto target = anchors_.find(anchor);
    if (target == anchors_.end()) {
      refuse(place(mark), "the alias stands within the node that it names", "",
             "alias a node that is complete");
    }
    count(target->second.size, mark);
    attach(target->second.node);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(Kind::kSequence, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(Kind::kMapping, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Level {
    std::shared_ptr<YamlNode> node;
    YAML::anchor_t anchor;
    std::size_t nodes_before;         // count when the node was opened
    std::string key;                  // of the entry that is being read
    Source key_where;                 // line 0: no key yet
    std::map<std::string, int> keys;  // seen so far, with their lines
  };
  struct Anchored {
    YamlNodePtr node;
    std::size_t size;  // nodes that it stands for
  };

  Source place(const YAML::Mark& mark) const { return {file_, mark.line + 1, mark.column + 1, ""}; }

  [[noreturn]] static void refuse(const Source& where, const std::string& what, const std::string& value,
                                  const std::string& remedy) {
    throw InputError({where.text(), what, value, remedy});
  }
  [[noreturn]] void refuse_key(const YAML::Mark& mark) const {
    refuse(place(mark), "a word is wanted here, as the key of a mapping", "",
           "write 'key: value', and close the brackets that were opened at or above this place");
  }

  /// yaml-cpp takes the end of the file for the closing quote.
  void check_quote_closed(const YAML::Mark& mark) const {
    const auto start = static_cast<std::size_t>(mark.pos);
    const char quote = start < text_.size() ? text_[start] : '\0';
    if (quote != '"' && quote != '\'') return;  // a block scalar
    for (std::size_t i = start + 1; i < text_.size(); ++i) {
      if (text_[i] == quote) return;
      if (quote == '"' && text_[i] == '\\') ++i;
    }
    refuse(place(mark), "the quote is not closed", "", fmt::format("add a {} at the end of the text", quote));
  }

  void check_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!") {
      refuse(place(mark), "tags are not used here", fmt::format("'{}'", tag), "remove the tag");
    }
  }

  void count(std::size_t nodes, const YAML::Mark& mark) {
    nodes_ += nodes;
    if (nodes_ > YamlLimits::kNodes) {
      refuse(place(mark),
             fmt::format("the document has more than {} values, aliases counted in full", YamlLimits::kNodes),
             "", "use fewer aliases, or split the model");
    }
  }

  std::shared_ptr<YamlNode> new_node(Kind kind, const YAML::Mark& mark) {
    count(1, mark);
    auto node = std::make_shared<YamlNode>();
    node->kind = kind;
    node->where = place(mark);
    return node;
  }

  bool awaits_key() const {
    return !levels_.empty() && levels_.back().node->kind == Kind::kMapping &&
           levels_.back().key_where.line == 0;
  }

  void take_key(const YAML::Mark& mark, const std::string& key) {
    Level& level = levels_.back();
    const Source where = place(mark);
    if (key == "<<")
      refuse(where, "merge keys are not used here", "'<<'", "use include, or write the values out");
    const auto [first, is_new] = level.keys.emplace(key, where.line);
    if (!is_new) {
      refuse(where, fmt::format("the key '{}' is given twice, first in line {}", key, first->second), "",
             "keep one of the two");
    }
    level.key = key;
    level.key_where = where;
  }

  void open(Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (awaits_key()) refuse_key(mark);
    check_tag(mark, tag);
    if (levels_.size() >= YamlLimits::kDepth) {
      refuse(place(mark), fmt::format("the nesting is deeper than {}", YamlLimits::kDepth), "", "flatten it");
    }
    const std::size_t nodes_before = nodes_;
    levels_.push_back({new_node(kind, mark), anchor, nodes_before, {}, {}, {}});
  }

  void close() {
    const Level level = std::move(levels_.back());
    levels_.pop_back();
    if (level.anchor != 0) anchors_[level.anchor] = {level.node, nodes_ - level.nodes_before};
    attach(level.node);
  }

  void add(const YamlNodePtr& node, YAML::anchor_t anchor) {
    if (anchor != 0) anchors_[anchor] = {node, 1};
    attach(node);
  }

  void attach(const YamlNodePtr& node) {
    if (levels_.empty()) {
      root_ = node;
      return;
    }
    Level& level = levels_.back();
    if (level.node->kind == Kind::kSequence) {
      level.node->items.push_back(node);
    } else {
      level.node->entries.push_back({level.key, std::exchange(level.key_where, {}), node});
    }
  }

  std::shared_ptr<const std::string> file_;
  const std::string& text_;
  std::vector<Level> levels_;
  std::map<YAML::anchor_t, Anchored> anchors_;
  std::size_t aliases_ = 0;
  std::size_t nodes_ = 0;
  YamlNodePtr root_;
};

/// yaml-cpp takes a tab in some places and not in others; in front of a line it is never meant.
void refuse_tab_indentation(const std::string& file, const std::string& text) {
  int line = 1;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t first = text.find_first_not_of(' ', start);
    if (first != std::string::npos && text[first] == '\t') {
      throw InputError({fmt::format("{}:{}:{}", file, line, first - start + 1), "a tab in the indentation",
                        "", "indent with spaces"});
    }
    const std::size_t end = text.find('\n', start);
    start = end == std::string::npos ? text.size() : end + 1;
  }
}

/// What the commonest messages of yaml-cpp mean to somebody who wrote a scene.
[[noreturn]] void refuse_syntax(const Source& where, const std::string& message) {
  struct Meaning {
    std::string_view what, remedy;
  };
  static const std::map<std::string_view, Meaning> kMeanings{
      {YAML::ErrorMsg::END_OF_SEQ_FLOW, {"a '[' above is not closed", "add the missing ']'"}},
      {YAML::ErrorMsg::END_OF_MAP_FLOW, {"a '{' above is not closed", "add the missing '}'"}},
      {YAML::ErrorMsg::FLOW_END,
       {"a closing bracket without its opening one", "check the brackets before it"}},
      {YAML::ErrorMsg::END_OF_MAP,
       {"this line does not continue the mapping above", "indent it like its neighbours"}},
      {YAML::ErrorMsg::END_OF_SEQ,
       {"this line does not continue the list above", "indent it like its neighbours"}},
      {YAML::ErrorMsg::MAP_VALUE,
       {"a ':' out of place", "write one 'key: value' per line; quote texts that hold ': '"}},
      {YAML::ErrorMsg::EOF_IN_SCALAR, {"the quote is not closed", "add it at the end of the text"}},
      {YAML::ErrorMsg::UNKNOWN_TOKEN, {"a character that begins no value", "quote the text"}},
      {YAML::ErrorMsg::UNKNOWN_ANCHOR,
       {"no anchor of this name stands before the alias", "check the name after '*'"}}};
  const auto known = kMeanings.find(message);
  if (known == kMeanings.end()) {
    throw InputError({where.text(), "not YAML: " + message, "", "check the text at and above this place"});
  }
  throw InputError({where.text(), std::string(known->second.what), "", std::string(known->second.remedy)});
}

}  // namespace

YamlNodePtr parse_yaml_file(const std::filesystem::path& path, const Source& included_from) {
  const auto file = std::make_shared<const std::string>(path.string());
  const std::string text = read_text_file(path, YamlLimits::kFileBytes, included_from);
  refuse_tab_indentation(*file, text);

  TreeBuilder builder(file, text);
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& e) {
    refuse_syntax({file, e.mark.line + 1, e.mark.column + 1, ""}, e.msg);
  }
  const YamlNodePtr root = builder.root();
  if (!root || root->kind == Kind::kNull) {
    throw InputError({*file, "the file holds no data", "", "write 'key: value' lines into it"});
  }
  if (root->kind != Kind::kMapping) {
    throw InputError({root->where.text(), "the document must be a mapping", "", "write 'key: value' lines"});
  }
  return root;
}

}  // namespace wishbone
