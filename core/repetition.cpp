#include "core/repetition.h"

#include <fmt/format.h>

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "core/ascii.h"
#include "core/error.h"
#include "core/yaml.h"

namespace wishbone {
namespace {

/// Makes a counter known for as long as it counts.
class CounterScope {
 public:
  CounterScope(Parameters& parameters, std::string name) : parameters_(parameters), name_(std::move(name)) {}
  CounterScope(const CounterScope&) = delete;
  CounterScope& operator=(const CounterScope&) = delete;
  ~CounterScope() { parameters_.remove_counter(name_); }

 private:
  Parameters& parameters_;
  std::string name_;
};

std::pair<int, int> bounds(const Value& range) {
  const std::vector<Value> items = range.list();
  if (items.size() != 2)
    range.refuse("a counter runs from a first to a last number", "write [first, last], such as [1, 4]");
  constexpr int kFarthest = 1'000'000;
  return {items[0].integer(-kFarthest, kFarthest), items[1].integer(-kFarthest, kFarthest)};
}

/// The value of an expression that stands within brackets in a text.
std::string whole_number(const std::string& expression, const Source& where, Parameters& parameters) {
  auto scalar = std::make_shared<YamlNode>();
  scalar->kind = YamlNode::Kind::kScalar;
  scalar->where = where;
  scalar->text = "= " + expression;
  const std::string value = parameters.evaluate(scalar, where.path)->text;
  const std::size_t sign = value.starts_with('-') ? 1 : 0;
  if (value.size() > sign && value.find_first_not_of("0123456789", sign) == std::string::npos) return value;
  throw InputError({where.text(), fmt::format("'{{{}}}' is no whole number", expression),
                    fmt::format("'{}'", value),
                    "write a counter within the brackets, such as {i} or {i + 1}"});
}

/// "{N - 1}" in "link_{N - 1}": what stands in brackets behind a letter and begins with one; else nothing.
std::string counter_of_name(const std::string& text) {
  constexpr std::string_view kOfExpressions =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789+-*/() ";
  for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
    const std::size_t close = text.find_first_not_of(kOfExpressions, open + 1);
    if (open == 0 || close == std::string::npos || text[close] != '}') continue;
    if (is_letter(text[open - 1]) && is_letter(text[text.find_first_not_of(' ', open + 1)]))
      return text.substr(open, close + 1 - open);
  }
  return "";
}

}  // namespace

Repetition::Repetition(const YamlNode::Entry& repeat, std::string path, Parameters& parameters,
                       Resolve resolve)
    : repeat_(repeat), path_(std::move(path)), parameters_(parameters), resolve_(std::move(resolve)) {
  const Value counters(repeat_, path_);
  if (!counters.is_mapping() || counters.node()->entries.empty())
    counters.refuse("a mapping of counters is wanted here", "write 'repeat: {i: [1, 4]}'");
}

void Repetition::run(std::size_t counter, const std::function<void()>& tick,
                     const std::function<void()>& step) {
  if (counter == repeat_.value->entries.size()) return step();
  const YamlNode::Entry& entry = repeat_.value->entries[counter];
  const std::string path = path_ + "." + entry.key;
  Source where = entry.where;
  where.path = path;
  if (parameters_.is_counter(entry.key))
    throw InputError({where.text(), fmt::format("'{}' is a counter already", entry.key), "",
                      "use another name for the inner one"});
  const auto [first, last] = bounds(Value({entry.key, entry.where, resolve_(entry.value, path)}, path));
  const CounterScope scope(parameters_, entry.key);
  for (int i = first; i <= last; ++i) {
    tick();
    parameters_.set_counter(entry.key, i, where);
    run(counter + 1, tick, step);
  }
}

std::string fill_in_counters(const std::string& text, const Source& where, Parameters& parameters) {
  std::string filled;
  std::size_t at = 0;
  for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', at)) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos)
      throw InputError({where.text(), "a '{' is not closed", fmt::format("'{}'", text),
                        "within a repetition, write {i} where the counter belongs"});
    filled += text.substr(at, open - at);
    filled += whole_number(text.substr(open + 1, close - open - 1), where, parameters);
    at = close + 1;
  }
  return filled + text.substr(at);
}

void refuse_counters(const std::string& text, const Source& where) {
  const std::string shown = counter_of_name(text);
  if (shown.empty()) return;
  throw InputError(
      {where.text(), fmt::format("'{}' is filled in within a repetition only, and this is none", shown),
       fmt::format("'{}'", text),
       fmt::format("write the number itself, or put this under 'repeat', such as 'repeat: {{i: [1, 1]}}', "
                   "where '{}' may name its counters and parameters",
                   shown)});
}

}  // namespace wishbone
