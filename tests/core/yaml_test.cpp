#include "core/yaml.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "core/yaml_parser.h"
#include "text_files.h"

namespace wishbone {
namespace {

class Yaml : public testing::Test {
 protected:
  YamlNodePtr parse(std::string_view text) { return parse_yaml_file(files_.write("a.yaml", text)); }
  std::string refusal(std::string_view text) {
    return files_.relative(message_of<InputError>([&] { parse(text); }));
  }
  Value root(std::string_view text) {
    const YamlNodePtr node = parse(text);
    return Value(node, node->where);
  }
  /// The value of the key `x`, under the path "x".
  Value x(std::string_view text) { return Mapping(root(text), {"x"}).required("x"); }
  template <class Step>
  std::string complaint(Step step) {
    return files_.relative(message_of<InputError>(step));
  }
  TextFiles files_;
};

TEST_F(Yaml, KnowsWhereEverythingStands) {
  const YamlNodePtr node = parse("# comment\nbodies:\n  arm: {mass: 2 kg, list: [1, 2]}\n");
  const auto* arm = node->find("bodies")->value->find("arm");
  EXPECT_EQ(arm->where.line, 3);
  EXPECT_EQ(arm->where.column, 3);
  EXPECT_EQ(arm->value->find("mass")->value->where.column, 15);
  EXPECT_EQ(arm->value->find("list")->value->items[1]->where.column, 31);
}

TEST_F(Yaml, PathLeadsToTheValue) {
  const Value bodies = Mapping(root("bodies:\n  arm: {steps: [{time: 1}]}\n"), {"bodies"}).required("bodies");
  const Value arm = bodies.named().front().second;
  const Value step = Mapping(arm, {"steps"}).required("steps").list().front();
  EXPECT_EQ(files_.relative(Mapping(step, {"time"}).required("time").where().text()),
            "a.yaml:2:24: bodies.arm.steps[1].time");
}

TEST_F(Yaml, AliasesAreTheirAnchors) {
  const YamlNodePtr node = parse("a: &p [1, 2]\nb: *p\n");
  EXPECT_EQ(node->find("a")->value, node->find("b")->value);
}

TEST_F(Yaml, QuotedWordsAreTexts) {
  EXPECT_TRUE(x("x: true").boolean());
  EXPECT_FALSE(x("x: false").boolean());
  for (const char* word : {"yes", "on", "y", "True", "1", "'true'", "\"true\""}) {
    EXPECT_THROW(x(std::string("x: ") + word).boolean(), InputError) << word;
  }
}

TEST_F(Yaml, ReadsTypedValues) {
  EXPECT_DOUBLE_EQ(x("x: 47 kN/m").number(kStiffness), 47e3);
  EXPECT_EQ(x("x: 12").integer(1, 12), 12);
  EXPECT_EQ(x("x: \"a: b\"").text(), "a: b");
  EXPECT_EQ(x("x: [1, 2 mm, -3]").vector3(kLength), Vector3(1, 0.002, -3));
  EXPECT_DOUBLE_EQ(x("x: [0, 3, 4]").direction().z(), 0.8);
  EXPECT_DOUBLE_EQ(x("x: [0, 1e-200, 0]").direction().y(), 1);
  enum class Colour { kRed, kBlue };
  EXPECT_EQ(x("x: blue").choice<Colour>({{"red", Colour::kRed}, {"blue", Colour::kBlue}}, "the colours"),
            Colour::kBlue);
}

TEST_F(Yaml, WrongTypesAreToldWithPlaceAndRemedy) {
  EXPECT_EQ(complaint([&] { x("x: [1]").number(kLength); }),
            "a.yaml:1:1: x: error: a length [m] is wanted here, not a list\n  write one number");
  EXPECT_EQ(complaint([&] { x("x: heavy").number(kMass); }),
            "a.yaml:1:4: x: error: not a finite number (got 'heavy')\n"
            "  write a number such as 0.5 or 1e3, or a number and a unit such as 120 km/h");
  EXPECT_EQ(
      complaint([&] { x("x: 2.5").integer(1, 4); }),
      "a.yaml:1:4: x: error: a whole number from 1 to 4 is wanted here (got '2.5')\n  give one of them");
  EXPECT_EQ(
      complaint([&] { x("x: 1e99").integer(1, 4); }),
      "a.yaml:1:4: x: error: a whole number from 1 to 4 is wanted here (got '1e99')\n  give one of them");
  EXPECT_EQ(complaint([&] { x("x: [1, 2]").vector3(kLength); }),
            "a.yaml:1:1: x: error: a list of three numbers (length [m]) is wanted here, not of 2\n  write "
            "[x, y, z]");
  EXPECT_EQ(
      complaint([&] { x("x: [0, 0, 0]").direction(); }),
      "a.yaml:1:1: x: error: the direction has zero length\n  give at least one component that is not zero");
  EXPECT_EQ(
      complaint([&] { x("x: {a: 1}").text(); }),
      "a.yaml:1:1: x: error: a single value is wanted here, not a mapping\n  write one word, text or number");
  EXPECT_EQ(complaint([&] { x("x:\n  2nd: 1").named(); }),
            "a.yaml:2:8: x.2nd: error: not a name (got '2nd')\n"
            "  use up to 64 letters, digits, '_' and '-', beginning with a letter");
}

TEST_F(Yaml, UnknownAndMissingKeysAreNamed) {
  EXPECT_EQ(complaint([&] {
              Mapping(x("x: {stifness: 1}"), {"stiffness", "damping"});
            }),
            "a.yaml:1:5: x: error: unknown key 'stifness'\n  did you mean 'stiffness'?");
  EXPECT_EQ(complaint([&] {
              Mapping(x("x: {damping: 1}"), {"stiffness", "damping"}).required("stiffness");
            }),
            "a.yaml:1:1: x: error: the key 'stiffness' is missing\n  add 'stiffness: ...' here");
  EXPECT_EQ(complaint([&] { x("x:\n"); }),
            "a.yaml:1:1: x: error: the key has no value\n  write one after the ':' or remove the key");
  EXPECT_EQ(complaint([&] { Mapping(x("x: 5"), {"mass"}); }),
            "a.yaml:1:4: x: error: a mapping is wanted here (got '5')\n  write its keys: mass");
}

TEST_F(Yaml, DuplicateKeysAreToldWithBothLines) {
  EXPECT_EQ(refusal("a: 1\nb: 2\na: 3\n"),
            "a.yaml:3:1: error: the key 'a' is given twice, first in line 1\n  keep one of the two");
}

TEST_F(Yaml, LimitsActWhileParsing) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 30; ++i) {
    bomb += fmt::format(
        "a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i, i - 1);
  }
  EXPECT_EQ(refusal(bomb),
            "a.yaml:5:45: error: the document has more than 100000 values, aliases counted in full\n"
            "  use fewer aliases, or split the model");
  std::string aliases = "a: &a 1\nb: [";
  for (int i = 0; i < 1001; ++i) aliases += "*a, ";
  EXPECT_EQ(
      refusal(aliases + "]"),
      "a.yaml:2:4005: error: there are more than 1000 aliases\n  write the values out, or use parameters");
  std::string deep;
  for (int i = 0; i < 40; ++i) deep += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_EQ(refusal(deep), "a.yaml:33:33: error: the nesting is deeper than 32\n  flatten it");
  EXPECT_EQ(refusal("a: " + std::string(1 << 20, 'x')),
            "error: the file is larger than 1048576 bytes (got 'a.yaml')\n"
            "  split it into several files and include them");
}

struct Refusal {
  const char* name;
  std::string_view text;
  const char* message;
  friend std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }
};

class BrokenYaml : public Yaml, public testing::WithParamInterface<Refusal> {};

TEST_P(BrokenYaml, IsRefusedInPlainWords) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

using namespace std::string_view_literals;

INSTANTIATE_TEST_SUITE_P(
    Texts, BrokenYaml,
    testing::Values(
        Refusal{"Empty", "", "a.yaml: error: the file is empty\n  write a document into it"},
        Refusal{"CommentsOnly", "# nothing\n",
                "a.yaml: error: the file holds no data\n  write 'key: value' lines into it"},
        Refusal{"Binary", "a: 1\nb\0"sv,
                "a.yaml:2:2: error: the file is not text (got byte 0x00)\n  name a YAML text file"},
        Refusal{
            "Latin1", "a: caf\xe9\n",
            "a.yaml:1:7: error: the file is not UTF-8 text (got byte 0xe9)\n  save it in the encoding UTF-8"},
        Refusal{
            "OverlongUtf8", "a: \xc0\xaf\n",
            "a.yaml:1:4: error: the file is not UTF-8 text (got byte 0xc0)\n  save it in the encoding UTF-8"},
        Refusal{
            "Surrogate", "a: \xed\xa0\x80\n",
            "a.yaml:1:4: error: the file is not UTF-8 text (got byte 0xed)\n  save it in the encoding UTF-8"},
        Refusal{"Tab", "a:\n\tb: 1\n", "a.yaml:2:1: error: a tab in the indentation\n  indent with spaces"},
        Refusal{"UnclosedList", "a: [1, 2\n",
                "a.yaml:2:1: error: a '[' above is not closed\n  add the missing ']'"},
        Refusal{"UnclosedMapping", "a: {b: 1\n",
                "a.yaml:2:1: error: a '{' above is not closed\n  add the missing '}'"},
        Refusal{"TwoUnclosed", "a: [[1, 2\n",
                "a.yaml:1:5: error: a word is wanted here, as the key of a mapping\n  write 'key: value', "
                "and close the "
                "brackets that were opened at or above this place"},
        Refusal{"UnclosedQuote", "a: \"text\nb: 2\n",
                "a.yaml:1:4: error: the quote is not closed\n  add a \" at the end of the text"},
        Refusal{"UnclosedQuoteAfterByteOrderMark",
                "\xef\xbb\xbf"
                "a: 'text\nb: 2\n",
                "a.yaml:1:4: error: the quote is not closed\n  add a ' at the end of the text"},
        Refusal{
            "StrayBracket", "a: 1]\nb: ]\n",
            "a.yaml:2:4: error: a closing bracket without its opening one\n  check the brackets before it"},
        Refusal{"WrongIndentation", "a:\n  b: 1\n c: 2\n",
                "a.yaml:3:2: error: this line does not continue the mapping above\n  indent it like its "
                "neighbours"},
        Refusal{"TwoColons", "a: b: c\n",
                "a.yaml:1:5: error: a ':' out of place\n  write one 'key: value' per line; quote texts that "
                "hold ': '"},
        Refusal{"ReservedCharacter", "a: @b\n",
                "a.yaml:1:4: error: a character that begins no value\n  quote the text"},
        Refusal{
            "UnknownAnchor", "a: *b\n",
            "a.yaml:1:4: error: no anchor of this name stands before the alias\n  check the name after '*'"},
        Refusal{"AliasOfItself", "a: &b [*b]\n",
                "a.yaml:1:8: error: the alias stands within the node that it names\n  alias a node that is "
                "complete"},
        Refusal{"ListAsKey", "? [1]\n: 2\n",
                "a.yaml:1:3: error: a word is wanted here, as the key of a mapping\n  write 'key: value', "
                "and close the "
                "brackets that were opened at or above this place"},
        Refusal{"Tag", "a: !!str 5\n",
                "a.yaml:1:4: error: tags are not used here (got 'tag:yaml.org,2002:str')\n  remove the tag"},
        Refusal{"MergeKey", "<<: {a: 1}\n",
                "a.yaml:1:1: error: merge keys are not used here (got '<<')\n  use include, or write the "
                "values out"},
        Refusal{
            "TwoDocuments", "a: 1\n---\nb: 2\n",
            "a.yaml:2:1: error: a second document begins\n  keep one document in a file (remove the '---')"},
        Refusal{"ListAsDocument", "- 1\n",
                "a.yaml:1:1: error: the document must be a mapping\n  write 'key: value' lines"}),
    [](const auto& param_info) { return param_info.param.name; });

TEST_F(Yaml, FilesThatCannotBeReadAreToldApart) {
  EXPECT_EQ(complaint([&] { parse_yaml_file(files_ / "b.yaml"); }),
            "error: there is no such file (got 'b.yaml')\n"
            "  check the name; an included file is looked for relative to the including one");
  std::filesystem::create_directory(files_ / "folder");
  EXPECT_EQ(complaint([&] { parse_yaml_file(files_ / "folder"); }),
            "error: this is a directory, not a file (got 'folder')\n  name the file in it");
}

}  // namespace
}  // namespace wishbone
