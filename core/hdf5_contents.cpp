#include "core/hdf5_contents.h"

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "core/packed_bytes.h"

namespace wishbone::hdf5 {
namespace {

enum class Kind : std::uint8_t { kNumber, kText, kTexts };

void put(PackedBytes& bytes, std::size_t count) {
  bytes.put(static_cast<std::uint64_t>(count));
}

std::size_t take_count(PackedReader& bytes) {
  return bytes.number<std::uint64_t>();
}

void put(PackedBytes& bytes, const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    bytes.put(Kind::kNumber);
    bytes.put(*number);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    bytes.put(Kind::kText);
    bytes.put(*text);
  } else {
    const auto& texts = std::get<std::vector<std::string>>(value);
    bytes.put(Kind::kTexts);
    put(bytes, texts.size());
    for (const std::string& t : texts) bytes.put(t);
  }
}

Value take_value(PackedReader& bytes) {
  switch (bytes.number<Kind>()) {
    case Kind::kNumber:
      return bytes.number<double>();
    case Kind::kText:
      return bytes.text();
    default:
      break;
  }
  std::vector<std::string> texts;
  for (std::size_t n = take_count(bytes); n > 0; --n) texts.push_back(bytes.text());
  return texts;
}

void put(PackedBytes& bytes, const ObjectFacts& facts) {
  bytes.put(facts.is_dataset);
  bytes.put(facts.is_numeric);
  put(bytes, facts.shape.size());
  for (const std::size_t length : facts.shape) put(bytes, length);
  put(bytes, facts.attributes.size());
  for (const auto& [name, value] : facts.attributes) {
    bytes.put(name);
    put(bytes, value);
  }
  put(bytes, facts.others.size());
  for (const std::string& name : facts.others) bytes.put(name);
}

ObjectFacts take_facts(PackedReader& bytes) {
  ObjectFacts facts;
  facts.is_dataset = bytes.number<bool>();
  facts.is_numeric = bytes.number<bool>();
  for (std::size_t n = take_count(bytes); n > 0; --n) facts.shape.push_back(take_count(bytes));
  for (std::size_t n = take_count(bytes); n > 0; --n) {
    std::string name = bytes.text();
    facts.attributes.emplace(std::move(name), take_value(bytes));
  }
  for (std::size_t n = take_count(bytes); n > 0; --n) facts.others.insert(bytes.text());
  return facts;
}

}  // namespace

std::string joined_path(const std::string& parent, const std::string& path) {
  if (path == "." || path.empty()) return parent;
  if (path.starts_with('/')) return path;
  return parent == "/" ? "/" + path : parent + "/" + path;
}

std::string packed(const Contents& contents) {
  PackedBytes bytes;
  for (const auto& [path, facts] : contents) {
    bytes.put(path);
    put(bytes, facts);
  }
  return bytes.text();
}

Contents unpacked_contents(std::string_view packed) {
  PackedReader bytes(packed);
  Contents contents;
  while (!bytes.at_end()) {
    std::string path = bytes.text();
    contents.emplace_hint(contents.end(), std::move(path), take_facts(bytes));
  }
  return contents;
}

}  // namespace wishbone::hdf5
