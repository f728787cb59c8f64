#include "core/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "core/yaml.h"
#include "text_files.h"

namespace wishbone {
namespace {

class Document : public testing::Test {
 protected:
  void file(const std::string& name, std::string_view text) { files_.write(name, text); }
  YamlNodePtr load(const std::vector<std::string>& overrides = {}) {
    return load_document(files_ / "main.yaml", overrides);
  }
  YamlNodePtr load(std::string_view text, const std::vector<std::string>& overrides = {}) {
    file("main.yaml", text);
    return load(overrides);
  }
  /// The scalar of a top-level key, as text.
  std::string value(std::string_view text, const std::string& key,
                    const std::vector<std::string>& overrides = {}) {
    return load(text, overrides)->find(key)->value->text;
  }
  std::string refusal(std::string_view text, const std::vector<std::string>& overrides = {}) {
    return files_.relative(message_of<InputError>([&] { load(text, overrides); }));
  }
  TextFiles files_;
};

TEST_F(Document, LoneParameterKeepsItsUnitAndType) {
  constexpr auto kText = "parameters: {v: 36 km/h, on: true, kind: hung}\na: = v\nb: = on\nc: =kind\n";
  EXPECT_EQ(value(kText, "a"), "36 km/h");
  EXPECT_EQ(value(kText, "b"), "true");
  EXPECT_EQ(value(kText, "c"), "hung");
}

TEST_F(Document, ExpressionsAreInSi) {
  EXPECT_EQ(value("parameters: {v: 36 km/h, on: true}\na: = v/2 + on\n", "a"), "6");
  EXPECT_EQ(value("a: \"= max(1, 2)\"\n", "a"), "2");
}

TEST_F(Document, ParametersMayReferToLaterOnes) {
  EXPECT_EQ(value("parameters: {a: = b + 1, b: = c * 2, c: 3}\nx: = a\n", "x"), "7");
}

TEST_F(Document, ParameterCycleIsShown) {
  EXPECT_EQ(refusal("parameters: {a: = b + 1, b: = c * 2, c: = b}\n"),
            "main.yaml:1:29: parameters.b: error: the parameters refer to one another: b -> c -> b\n  give "
            "one of them a value");
}

TEST_F(Document, OverridesComeLast) {
  constexpr auto kText =
      "parameters: {v: 10 m/s, kind: {default: a, choices: [a, b]}, on: false}\nx: = v\ny: = kind\nz: = on\n";
  EXPECT_EQ(value(kText, "x", {"v=72 km/h"}), "72 km/h");
  EXPECT_EQ(value(kText, "x", {"v=20"}), "20");
  EXPECT_EQ(value(kText, "y", {"kind=b"}), "b");
  EXPECT_EQ(value(kText, "z", {"on=true"}), "true");
  EXPECT_EQ(value(kText, "x", {"v=1", "v== 2*3"}), "6");
}

TEST_F(Document, OverridesMustFitTheDefault) {
  constexpr auto kText =
      "parameters:\n  speed: 10 m/s\n  kind: {default: a1, choices: [a1, b1], about: form of it}\n  on: "
      "false\n";
  EXPECT_EQ(refusal(kText, {"sped=1"}),
            "--set sped=1: error: there is no parameter 'sped'\n  did you mean 'speed'?");
  EXPECT_EQ(refusal(kText, {"mass=1"}),
            "--set mass=1: error: there is no parameter 'mass'\n  the parameters are: speed, kind, on");
  EXPECT_EQ(refusal(kText, {"speed=3 kg"}),
            "--set speed=3 kg: parameters.speed: error: wrong dimension: the parameter 'speed' is velocity "
            "[m/s], this is "
            "mass [kg] (got '3 kg')\n  its default is 10 m/s");
  EXPECT_EQ(refusal(kText, {"speed=fast"}),
            "--set speed=fast: parameters.speed: error: the parameter 'speed' must be a number (got 'fast')\n"
            "  its default is 10 m/s");
  EXPECT_EQ(refusal(kText, {"speed=3 knotts"}),
            "--set speed=3 knotts: parameters.speed: error: unknown unit 'knotts' (got '3 knotts')\n"
            "  write units as in 120 km/h, 47 kN/m, 4 kN s/m, 2 kg m2, 6 deg, 5 ms or 5 %; a plain number is "
            "in SI units");
  EXPECT_EQ(
      refusal(kText, {"kind=c"}),
      "--set kind=c: parameters.kind: error: not a choice of the parameter 'kind' (form of it) (got 'c')\n"
      "  its choices are: a1, b1");
  EXPECT_EQ(refusal(kText, {"on=yes"}),
            "--set on=yes: parameters.on: error: the parameter 'on' must be true or false (got 'yes')\n  its "
            "default is false");
  EXPECT_EQ(
      refusal(kText, {"speed"}),
      "--set speed: error: an override has the form name=value (got 'speed')\n  write --set speed='80 km/h'");
}

TEST_F(Document, DefaultMustBeAChoice) {
  EXPECT_EQ(refusal("parameters:\n  kind: {default: c, choices: [floating, hung]}\n"),
            "main.yaml:2:19: parameters.kind: error: not a choice of the parameter 'kind' (got 'c')\n"
            "  its choices are: floating, hung");
}

TEST_F(Document, UnknownNamesInExpressionsAreTold) {
  EXPECT_EQ(refusal("parameters: {speed: 1}\na:\n  b: = 2 * sped\n"),
            "main.yaml:3:6: a.b: error: there is no parameter 'sped'\n  did you mean 'speed'?");
  EXPECT_EQ(
      refusal("parameters: {kind: hung}\na: = 2 * kind\n"),
      "main.yaml:2:4: a: error: the parameter 'kind' is a text and cannot be calculated with (got 'hung')\n"
      "  use it alone, as = kind");
  EXPECT_EQ(refusal("parameters: {r: 1}\na: = 1 / (r - 1)\n"),
            "main.yaml:2:4: a: error: the value of the expression is not finite (got '= 1 / (r - 1)')\n"
            "  look for a division by zero or a root of a negative number");
}

TEST_F(Document, SelectionTakesTheBranchOfTheParameter) {
  constexpr auto kText =
      "parameters: {kind: {default: hung, choices: [hung, floating]}}\n"
      "x: {select: kind, hung: 1, floating: {select: kind, floating: 2, hung: 3}}\n"
      "y: {a: {select: kind, hung: , floating: 5}, b: 6}\n";
  EXPECT_EQ(value(kText, "x"), "1");
  EXPECT_EQ(value(kText, "x", {"kind=floating"}), "2");
  EXPECT_EQ(load(kText)->find("y")->value->entries.size(), 1u);  // an empty branch leaves the entry out
  EXPECT_EQ(load(kText, {"kind=floating"})->find("y")->value->entries.size(), 2u);
}

TEST_F(Document, BadSelectionsAreTold) {
  EXPECT_EQ(refusal("parameters: {kind: hung}\nx: {select: kind, a: 1, b: 2}\n"),
            "main.yaml:2:13: x.select: error: there is no branch for 'hung', the value of the parameter (got "
            "'kind')\n"
            "  the branches are: a, b; add one for 'hung'");
  EXPECT_EQ(refusal("parameters: {kind: {default: hung, choices: [hung, floating]}}\nx: {select: kind, hung: "
                    "1, flaoting: 2}\n"),
            "main.yaml:2:28: x: error: 'flaoting' is not a choice of the parameter 'kind'\n  did you mean "
            "'floating'?");
  EXPECT_EQ(refusal("x: {select: kind, a: 1}\n"),
            "main.yaml:1:13: x.select: error: there is no parameter 'kind'\n  there are none");
}

TEST_F(Document, IncludesMergeSectionsNameByName) {
  file("parts/a.yaml", "include: b.yaml\nbodies: {one: 1}\ntitle: same\n");
  file("parts/b.yaml", "bodies: {two: 2}\nroad: {bank: 0}\n");
  const YamlNodePtr root =
      load("include: [parts/a.yaml, parts/b.yaml]\nbodies: {three: 3}\nroad: {x: 1}\ntitle: same\n");
  EXPECT_EQ(dump_yaml(*root), "bodies: {two: 2, one: 1, three: 3}\nroad: {bank: 0, x: 1}\ntitle: same\n");
}

TEST_F(Document, IncludingFileOverridesParameters) {
  file("car.yaml", "parameters: {bank: {default: 0 deg, about: of the road}, r: 1}\nx: = bank\n");
  EXPECT_EQ(value("include: car.yaml\nparameters: {bank: 6 deg}\n", "x"), "6 deg");
  EXPECT_EQ(value("include: car.yaml\nparameters: {bank: 6 deg}\n", "x", {"bank=7 deg"}), "7 deg");
  EXPECT_EQ(refusal("include: car.yaml\nparameters: {bank: 6 m}\n"),
            "main.yaml:2:20: parameters.bank: error: wrong dimension: the parameter 'bank' (of the road) is "
            "angle [rad], "
            "this is length [m] (got '6 m')\n  its default is 0 deg");
}

TEST_F(Document, NameInTwoFilesIsToldWithBothPlaces) {
  file("a.yaml", "bodies:\n  one: 1\ntitle: A\n");
  EXPECT_EQ(refusal("include: a.yaml\nbodies:\n\n  one: 2\n"),
            "main.yaml:4:3: bodies.one: error: 'one' is defined already, at a.yaml:2:3\n"
            "  rename or remove one of the two, or make the difference a parameter of the included file");
  EXPECT_EQ(refusal("include: a.yaml\ntitle: B\n"),
            "main.yaml:2:1: title: error: 'title' is defined already, at a.yaml:3:1\n"
            "  rename or remove one of the two, or make the difference a parameter of the included file");
}

TEST_F(Document, IncludeCycleShowsTheChain) {
  file("a.yaml", "include: b.yaml\n");
  file("b.yaml", "include: main.yaml\n");
  EXPECT_EQ(refusal("include: a.yaml\n"),
            "b.yaml:1:10: include: error: the files include one another: main.yaml -> a.yaml -> b.yaml -> "
            "main.yaml (got "
            "'main.yaml')\n  remove one of the includes");
}

TEST_F(Document, MissingIncludeIsToldWhereItIsAskedFor) {
  EXPECT_EQ(refusal("a: 1\ninclude:\n  - other.yaml\n"),
            "main.yaml:3:5: include[1]: error: there is no such file (got 'other.yaml')\n"
            "  check the name; an included file is looked for relative to the including one");
}

TEST_F(Document, IncludeWithAnImpossibleNameIsRefused) {
  EXPECT_THAT(refusal("include: " + std::string(5000, 'x') + "\n"),
              testing::StartsWith("main.yaml:1:10: include: error: there is no such file"));
}

TEST_F(Document, RepetitionWritesAnEntryForEveryNumber) {
  const YamlNodePtr root = load(
      "parameters: {N: 2}\n"
      "bodies:\n"
      "  crank_{i}: {repeat: {i: [0, = N]}, at: [= i / 2, 0], next: \"rod_{i + 1}\", number: = i}\n"
      "  last: {at: [9, 0]}\n");
  YamlNode sections = *root;
  sections.entries.erase(sections.entries.begin());  // the parameters
  EXPECT_EQ(dump_yaml(sections),
            "bodies:\n"
            "  crank_0:\n    at: [0, 0]\n    next: \"rod_1\"\n    number: 0\n"
            "  crank_1:\n    at: [0.5, 0]\n    next: \"rod_2\"\n    number: 1\n"
            "  crank_2:\n    at: [1, 0]\n    next: \"rod_3\"\n    number: 2\n"
            "  last:\n    at: [9, 0]\n");
}

TEST_F(Document, RepetitionsCountInEachOther) {
  const YamlNodePtr root = load(
      "grid:\n  p_{i}_{j}: {repeat: {i: [1, 3], j: [1, = i - 1]}, x: = 10*i + j}\n"
      "nested:\n  a_{i}: {repeat: {i: [1, 2]}, \"b_{j}\": {repeat: {j: [-1, 0]}, x: \"{i}{j}\"}}\n"
      "none:\n  a_{i}: {repeat: {i: [1, 0]}, x: 1}\n"
      "list: [{repeat: {i: [1, 2]}, x: = i}, {x: 7}]\n");
  EXPECT_EQ(dump_yaml(*root),
            "grid:\n  p_2_1: {x: 21}\n  p_3_1: {x: 31}\n  p_3_2: {x: 32}\n"
            "nested:\n  a_1:\n    b_-1: {x: \"1-1\"}\n    b_0: {x: \"10\"}\n"
            "  a_2:\n    b_-1: {x: \"2-1\"}\n    b_0: {x: \"20\"}\n"
            "none: {}\nlist: [{x: 1}, {x: 2}, {x: 7}]\n");
}

TEST_F(Document, RepetitionMaySelect) {
  const YamlNodePtr root = load(
      "parameters: {kind: {default: a, choices: [a, b]}}\n"
      "s:\n  x_{i}: {repeat: {i: [0, 2]}, select: i, 0: 5, 1: , 2: {select: kind, a: {v: = i}, b: 1}}\n");
  EXPECT_EQ(dump_yaml(*root->find("s")->value), "x_0: 5\nx_2: {v: 2}\n");
}

TEST_F(Document, BracketsOutsideRepetitionsAreText) {
  EXPECT_EQ(value("t: a {b} c\n", "t"), "a {b} c");
  EXPECT_EQ(value("title: K_{eff}\n", "title"), "K_{eff}");
  for (const char* text : {"{i}", "a_{1}", "a_{}", "a_{ }", "a_{i", "a_{i; j}"})
    EXPECT_EQ(value(std::string("t: \"") + text + "\"\n", "t"), text);
}

TEST_F(Document, CountersOfNamesOutsideRepetitionsAreTold) {
  EXPECT_EQ(
      refusal("parameters: {N: 3}\ns: {bodies: [ground, \"link_{N - 1}\"]}\n"),
      "main.yaml:2:22: s.bodies[2]: error: '{N - 1}' is filled in within a repetition only, and this is none "
      "(got 'link_{N - 1}')\n"
      "  write the number itself, or put this under 'repeat', such as 'repeat: {i: [1, 1]}', where '{N - 1}' "
      "may "
      "name its counters and parameters");
  EXPECT_THAT(refusal("s:\n  a_{i}: {x: 1}\n"), testing::HasSubstr("within a repetition only"));
  EXPECT_EQ(load("parameters: {N: 3}\ns:\n  last: {repeat: {i: [1, 1]}, body: \"link_{N - 1}\"}\n")
                ->find("s")
                ->value->find("last")
                ->value->find("body")
                ->value->text,
            "link_2");
}

TEST_F(Document, BadRepetitionsAreTold) {
  EXPECT_EQ(refusal("s:\n  a_{i}: {repeat: 3, x: 1}\n"),
            "main.yaml:2:19: s.a_{i}.repeat: error: a mapping of counters is wanted here (got '3')\n"
            "  write 'repeat: {i: [1, 4]}'");
  EXPECT_EQ(refusal("s:\n  a_{i}: {repeat: {i: [1, 2, 3]}, x: 1}\n"),
            "main.yaml:2:20: s.a_{i}.repeat.i: error: a counter runs from a first to a last number\n"
            "  write [first, last], such as [1, 4]");
  EXPECT_EQ(refusal("parameters: {N: 1.5}\ns:\n  a_{i}: {repeat: {i: [1, = N]}, x: 1}\n"),
            "main.yaml:3:27: s.a_{i}.repeat.i[2]: error: a whole number from -1000000 to 1000000 is wanted "
            "here (got '1.5' from '= N')\n  give one of them");
  EXPECT_EQ(refusal("s:\n  a: {repeat: {i: [1, 2]}, x: 1}\n"),
            "main.yaml:2:3: s.a: error: the repetition gives the key 'a' twice\n"
            "  put every counter into the key, as in 'a_{i}'");
  EXPECT_EQ(refusal("s:\n  a_{i}: {repeat: {i: [1, 2]}, x: \"{i / 2}\"}\n"),
            "main.yaml:2:35: s.a_1.x: error: '{i / 2}' is no whole number (got '0.5')\n"
            "  write a counter within the brackets, such as {i} or {i + 1}");
  EXPECT_EQ(refusal("s:\n  a_{i}: {repeat: {i: [1, 2]}, x: \"b_{i\"}\n"),
            "main.yaml:2:35: s.a_1.x: error: a '{' is not closed (got 'b_{i')\n"
            "  within a repetition, write {i} where the counter belongs");
  EXPECT_EQ(refusal("s:\n  a_{i}: {repeat: {i: [1, 2]}, x: = j}\n"),
            "main.yaml:2:35: s.a_1.x: error: there is no parameter 'j'\n  the parameters are: i");
  EXPECT_EQ(refusal("parameters: {i: 1}\ns:\n  a_{i}: {repeat: {i: [1, 2]}, x: 1}\n"),
            "main.yaml:3:20: s.a_{i}.repeat.i: error: 'i' is a parameter already\n"
            "  use another name for the counter");
  EXPECT_EQ(refusal("s:\n  a_{i}: {repeat: {i: [1, 2]}, \"b_{i}\": {repeat: {i: [1, 2]}}}\n"),
            "main.yaml:2:51: s.a_1.b_{i}.repeat.i: error: 'i' is a counter already\n"
            "  use another name for the inner one");
  EXPECT_EQ(refusal("s:\n  a_{1}: {repeat: {1: [1, 2]}, x: 1}\n"),
            "main.yaml:2:20: s.a_{1}.repeat.1: error: not a name of a counter (got '1')\n"
            "  use up to 64 letters, digits and '_', beginning with a letter");
}

TEST_F(Document, RepetitionsCannotRunAway) {
  constexpr auto kRefusal =
      "the repetitions make more than 100000 values\n  lower the last number of a counter";
  EXPECT_THAT(refusal("s:\n  a_{i}: {repeat: {i: [1, 1000000]}, x: 1}\n"), testing::HasSubstr(kRefusal));
  EXPECT_THAT(refusal("s:\n  a_{i}: {repeat: {i: [1, 1000000], j: [1, 0]}, x: 1}\n"),
              testing::HasSubstr(kRefusal));
  EXPECT_THAT(refusal("s:\n  a_{i}_{j}: {repeat: {i: [1, 1000], j: [1, 1000]}, x: 1}\n"),
              testing::HasSubstr(kRefusal));
}

TEST_F(Document, DumpReadsBackToItself) {
  const YamlNodePtr root = load(
      "parameters: {v: 36 km/h, kind: hung}\n"
      "a: {b: [= v, 'true', \"x: y\", 0.1], c: {d: = v / 3, e: {f: = kind, g: '12'}}, h: [], i: {}}\n"
      "t: \"line\\nline \\u00e9 #\"\n");
  const std::string text = dump_yaml(*root);
  EXPECT_EQ(dump_yaml(*load(text)), text);
  EXPECT_EQ(load(text)->find("a")->value->find("b")->value->items[1]->quoted, true);
}

}  // namespace
}  // namespace wishbone
