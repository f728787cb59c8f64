#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "core/utf8.h"
#include "identification/formats/uff/uff_reader.h"
#include "identification/formats/uff/uff_text.h"
#include "text_files.h"

/// Ways of writing one and the same contents that programs in the field have.
namespace wishbone {
namespace {

using testing::ElementsAre;
using testing::Optional;

UffFile read_text(const std::string& text) {
  const TextFiles files;
  return read_uff(files.write("file.unv", text));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TEST(UffNumbers, AreWhatFortranWrites) {
  EXPECT_THAT(real_in(" 1.5"), Optional(1.5));
  EXPECT_THAT(real_in("-1.5D-03"), Optional(-1.5e-3));
  EXPECT_THAT(real_in("+.5d2"), Optional(50.0));
  EXPECT_THAT(real_in("0.00000E+000"), Optional(0.0));
  EXPECT_THAT(real_in("5.E-005"), Optional(5e-5));
  EXPECT_THAT(real_in("1.25-101"), Optional(1.25e-101));
  EXPECT_THAT(real_in("1.25+101"), Optional(1.25e101));
  EXPECT_THAT(real_in("1.0E-400"), Optional(0.0));
  for (const char* text : {"", " ", ".", "-", "E5", "1.0E", "1.0E+", "NaN", "Inf", "-inf", "1e999", "0x10",
                           "1.0 2.0", "1.0-2.0", "1,5", "--1", "1.0EE5", "****"})
    EXPECT_EQ(real_in(text), std::nullopt) << text;
  EXPECT_THAT(integer_in(" 42 "), Optional(42));
  EXPECT_THAT(integer_in("+3."), Optional(3));
  for (const char* text : {"", "1.5", "3000000000", "99999999999999999999", "12a"})
    EXPECT_EQ(integer_in(text), std::nullopt) << text;
}

TEST(UffNumbers, MessagesAreValidText) {
  EXPECT_EQ(as_utf8("m/s\xB2"), "m/s\u00B2");
  EXPECT_EQ(as_utf8("m/s\u00B2"), "m/s\u00B2");
  EXPECT_EQ(shown("a\x01\xFF"), "'a?\u00FF'");
  EXPECT_EQ(shown(""), "");
}

// ---- lines and columns
// --------------------------------------------------------------------------------------

const std::string kNode =
    "    -1\n    15\n         4         0         2         8 -2.40000E+00 -9.50000E-01  1.00000E+02\n    "
    "-1\n";

void expect_node_4(const UffFile& file) {
  ASSERT_EQ(file.nodes.size(), 1u);
  EXPECT_EQ(file.nodes[0].number, 4);
  EXPECT_EQ(file.nodes[0].displacement_system, 2);
  EXPECT_EQ(file.nodes[0].color, 8);
  EXPECT_EQ(file.nodes[0].position, Vector3(-2.4, -0.95, 100));
}

TEST(UffDialects, LinesMayEndAsTheyLike) {
  expect_node_4(read_text(kNode));
  expect_node_4(read_text(replaced(kNode, "\n", "\r\n")));
  expect_node_4(read_text(replaced(kNode, "\n", "\r")));
  expect_node_4(read_text(replaced(kNode, "\n", "    \n")));
  expect_node_4(read_text("\n  \n" + kNode + "\n   \n"));
  expect_node_4(read_text(kNode.substr(0, kNode.size() - 1)));
}

TEST(UffDialects, NumbersMayLeaveTheirColumns) {
  const auto node = [](const std::string& line) { return "    -1\n    15\n" + line + "\n    -1\n"; };
  expect_node_4(read_text(node("4 0 2 8 -2.4 -.95 100.")));
  expect_node_4(read_text(node("  4\t0\t2\t8\t-2.4\t-0.95\t1.0D+002")));
  expect_node_4(
      read_text(node("         4         0         2         8-2.400000E+00-9.500000E-01 1.000000E+02")));
  expect_node_4(
      read_text(node("4         0         2         8         -2.40000D+00 -9.50000D-01 1.00000D+02")));
  expect_node_4(read_text(node("4 0 2 8 -2.4E+00-9.5E-01+1.0E+02")));
  expect_node_4(
      read_text(node("         4                   2         8 -2.40000E+00 -9.50000E-01  1.00000E+02")));
}

TEST(UffDialects, NumbersOfTenDigitsTouch) {
  const UffFile file = read_text(
      "    -1\n    82\n         1         3         1\nNONE\n123456789012345678912147483647\n    -1\n");
  EXPECT_THAT(file.trace_lines.at(0).nodes, ElementsAre(1234567890, 1234567891, 2147483647));
}

TEST(UffDialects, MinusOneInDataEndsNoDataset) {
  const UffFile file = read_text(
      "    -1\n    82\n         1         4         1\nNONE\n        -1         5        -1         6\n    "
      "-1\n"
      "    -1\n  2412\n         9        11        -1        -1         1         2\n        -1        -1    "
      "    -1\n"
      "         5         6\n    -1\n");
  EXPECT_THAT(file.trace_lines.at(0).nodes, ElementsAre(-1, 5, -1, 6));
  EXPECT_EQ(file.elements.at(0).physical_property, -1);
  EXPECT_THAT(file.elements.at(0).nodes, ElementsAre(5, 6));
}

TEST(UffDialects, DelimitersMayStandInOtherColumns) {
  for (const char* delimiter : {"-1", " -1", "  -1", "   -1", "     -1", "        -1", "\t-1", "-1   "})
    expect_node_4(read_text(replaced(kNode, "    -1", delimiter)));
  const std::string twice = "    -1\n   151\nmodel\n    -1\n" + kNode;
  expect_node_4(read_text(replaced(twice, "    -1", "-1")));
  for (std::size_t at = twice.find("    -1"); at != std::string::npos; at = twice.find("    -1", at + 1)) {
    std::string one_moved = twice;
    expect_node_4(read_text(one_moved.replace(at, 6, "-1")));
  }
}

TEST(UffDialects, ALoneMinusOneMayBeAValue) {
  const std::string head =
      "    -1\n    58\n\n\n\n\n\n 1 0 0 0 NONE 1 1 NONE 0 0\n 2 3 1 0.0 0.5 0.0\n 17 0 0 0 NONE NONE\n"
      " 12 0 0 0 NONE NONE\n 0 0 0 0 NONE NONE\n 0 0 0 0 NONE NONE\n";
  for (const std::string& tail : {std::string(), kNode}) {
    const UffFile file = read_text(head + "-1\n2.5\n-1\n    -1\n" + tail);
    ASSERT_EQ(file.functions.size(), 1u);
    EXPECT_THAT(std::get<std::vector<float>>(file.functions[0].values), ElementsAre(-1, 2.5, -1));
  }
}

TEST(UffDialects, ATraceLineMayBeFilledUpWithZeros) {
  const UffFile file = read_text(
      "    -1\n    82\n         1         2         1\nNONE\n         5         6         0         0        "
      " 0         0"
      "         0         0\n         0         0         0         0         0         0         0         "
      "0\n    -1\n");
  EXPECT_THAT(file.trace_lines.at(0).nodes, ElementsAre(5, 6));
}

TEST(UffDialects, UnitsMayTouchTheirCodeAndLeaveOutTemperature) {
  const UffFile file =
      read_text("    -1\n   164\n         5mm (milli-newton)            2\n 1.0D+03 1.0D+03\n    -1\n");
  EXPECT_EQ(file.units->code, 5);
  EXPECT_EQ(file.units->description, "mm (milli-newton)");
  EXPECT_EQ(file.units->temperature_mode, 2);
  EXPECT_EQ(file.units->length, 1000);
}

TEST(UffDialects, ComplexValuesOfAModeMayTouch) {
  const UffFile file = read_text(
      "    -1\n    55\nTEST\nNONE\nNONE\nNONE\n    999999         3\n         1         3         2         "
      "8         5"
      "         3\n         2         6         0         1\n"
      "-1.111111E-01 4.111111E+01 4.111111E+03-3.111111E+03-1.111110E+05-2.111110E+05\n    111111\n"
      " 0.000000E+00 0.000000E+00 1.111111E-01-9.111111E-02-7.111111E-03-4.111111E-03\n    -1\n");
  const UffShape& shape = file.shapes.at(0);
  EXPECT_EQ(shape.ids[4], "    999999         3");
  EXPECT_EQ(shape.eigenvalue, std::complex(-0.1111111, 41.11111));
  EXPECT_EQ(shape.modal_a, std::complex(4111.111, -3111.111));
  EXPECT_EQ(shape.number, 1);
  EXPECT_THAT(shape.nodes, ElementsAre(111111));
  EXPECT_THAT(shape.values, ElementsAre(0, 0, 0.1111111, -0.09111111, -0.007111111, -0.004111111));
}

TEST(UffDialects, MatricesOfCoordinateSystemsHaveTheirAxesInRows) {
  const UffFile file = read_text(
      "    -1\n  2420\n         1\nPart1\n         3         0         2\nCS3\n   0.0D+00   1.0D+00   "
      "0.0D+00\n"
      "  -1.0D+00   0.0D+00   0.0D+00\n   0.0D+00   0.0D+00   1.0D+00\n   5.0D+00   6.0D+00   7.0D+00\n    "
      "-1\n");
  const UffCoordinateSystem& system = file.coordinate_systems.at(0);
  EXPECT_EQ(system.number, 3);
  EXPECT_EQ(system.axes.col(0), Vector3::UnitY());
  EXPECT_EQ(system.axes.col(1), Vector3(-1, 0, 0));
  EXPECT_EQ(system.origin, Vector3(5, 6, 7));
}

TEST(UffDialects, TextMayStandBetweenDatasets) {
  const UffFile file =
      read_text(kNode + "Workpiece\nFile written 1 Jun 2016\n" + replaced(kNode, "    4 ", "    5 "));
  EXPECT_EQ(file.nodes.size(), 2u);
  ASSERT_EQ(file.unused.size(), 2u);
  EXPECT_EQ(file.unused[1].line, 6u);
  EXPECT_EQ(file.unused[1].why, "text between datasets");
}

TEST(UffDialects, AByteOrderMarkMayStandInFront) {
  expect_node_4(read_text("\xEF\xBB\xBF" + kNode));
}

// ---- functions
// ----------------------------------------------------------------------------------------------

/// Head of dataset 58 or 58b for a function of `form`, its seventh record.
std::string function_head(const std::string& first_line, const std::string& form) {
  std::string head = "    -1\n" + first_line + "\nNONE\nNONE\nNONE\nNONE\nNONE\n";
  head += "    4         0    0         0 NONE               3   1 NONE               5   3\n" + form + "\n";
  for (int axis = 0; axis < 4; ++axis) head += "         0    0    0    0 NONE                 NONE\n";
  return head;
}

template <class T>
std::string bytes_of(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

std::string binary_head(std::size_t bytes, const std::string& form) {
  return function_head("    58b     1     2          11" +
                           std::string(12 - std::to_string(bytes).size(), ' ') + std::to_string(bytes) +
                           "     0     0           0           0",
                       form);
}

const std::string kThreeComplexDoubles =
    "         6         3         1  0.00000E+00  1.00000E+00  0.00000E+00";
const std::vector<double> kSix = {1, -2, 3.5, 1e-300, 0, 10};

std::vector<double> six_values(const std::string& text) {
  return std::get<std::vector<double>>(read_text(text).functions.at(0).values);
}

TEST(UffDialects, ADelimiterMayFollowABinaryBlockAnyhow) {
  const std::string block = binary_head(48, kThreeComplexDoubles) + bytes_of(kSix);
  EXPECT_EQ(six_values(block + "    -1"), kSix);
  EXPECT_EQ(six_values(block + "    -1\n"), kSix);
  EXPECT_EQ(six_values(block + "\n    -1\n"), kSix);
  EXPECT_EQ(six_values(block + "\r\n    -1   \r\n"), kSix);
  EXPECT_EQ(six_values(block + "\n    -1\n" + kNode), kSix);
}

TEST(UffDialects, WrongByteCountsAreFoundOutByTheCountOfPoints) {
  for (const std::size_t announced : {0u, 24u, 47u, 49u, 96u, 4000000u})
    EXPECT_EQ(six_values(binary_head(announced, kThreeComplexDoubles) + bytes_of(kSix) + "\n    -1\n"), kSix);
}

TEST(UffDialects, LineEndsInABinaryBlockAreValues) {
  std::vector<double> values(6);
  std::string bytes = std::string(8, '\n') + std::string(8, '\r') + "\r\n\r\n\r\n\r\n" + "    -1\n " +
                      "\n    -1\n" + std::string(8, '\n');
  std::memcpy(values.data(), bytes.data(), 48);
  for (const char* end : {"\n", "\r\n", "\r"}) {
    const std::string head = replaced(binary_head(48, kThreeComplexDoubles), "\n", end);
    EXPECT_EQ(six_values(head + bytes + "    -1" + end), values);
  }
}

TEST(UffDialects, AbscissaOfABinaryBlockMayBeSingleBesideDoubleValues) {
  const std::string form = "         4         3         0  0.00000E+00  0.00000E+00  0.00000E+00";
  std::string block;
  for (const float x : {1.0f, 2.5f, 4.0f})
    block += bytes_of(std::vector{x}) + bytes_of(std::vector{10.0 * x});
  const UffFile file = read_text(binary_head(36, form) + block + "    -1\n");
  EXPECT_THAT(file.functions.at(0).abscissa, ElementsAre(1, 2.5, 4));
  EXPECT_THAT(std::get<std::vector<double>>(file.functions[0].values), ElementsAre(10, 25, 40));
}

TEST(UffDialects, NamesMayHaveBlanksOrBeTooLong) {
  const auto freedoms_of = [](const std::string& record) {
    std::string text =
        function_head("    58", "         2         0         1  0.00000E+00  1.00000E+00  0.00000E+00");
    text = replaced(text, "    4         0    0         0 NONE               3   1 NONE               5   3",
                    record);
    return read_text(text + "    -1\n").functions.at(0);
  };
  for (const auto& [record, response, reference] : std::vector<std::array<std::string, 3>>{
           {"    4         7    0         0  sine 5 Hz         3   1       NONE         5   3", "sine 5 Hz",
            "NONE"},
           {"    4         7    0         0                    3   1                    5   3", "", ""},
           {"    4         7    0         0 PF-I-0301-1         3   1       NONE         5   3",
            "PF-I-0301-1", "NONE"},
           {"4         7    0           0 AP                 3   1 NONE               5   3", "AP",
            "NONE"}}) {
    const UffFunction f = freedoms_of(record);
    EXPECT_EQ(f.type, 4) << record;
    EXPECT_EQ(f.number, 7) << record;
    EXPECT_EQ(f.response.entity, response);
    EXPECT_EQ(f.response.node, 3) << record;
    EXPECT_EQ(f.response.direction, 1) << record;
    EXPECT_EQ(f.reference.entity, reference);
    EXPECT_EQ(f.reference.node, 5) << record;
    EXPECT_EQ(f.reference.direction, 3) << record;
  }
}

TEST(UffDialects, TextValuesMayTouchAndSpreadOverLines) {
  const std::string head =
      function_head("    58", "         2         5         1  0.00000E+00  1.00000E+00  0.00000E+00");
  const std::vector<float> expected = {1, -2, 3, -4, 5};
  for (const char* rows :
       {" 1.00000E+00-2.00000E+00 3.00000E+00-4.00000E+00 5.00000E+00\n", "1.0 -2.0 3.0\n\n-4.0\n5.0\n",
        "1 -2 3 -4 5\n", "1.0E+00-2.0E+00+3.0D+000-4.0E0\n  5.\n"})
    EXPECT_EQ(std::get<std::vector<float>>(read_text(head + rows + "    -1\n").functions.at(0).values),
              expected)
        << rows;
}

}  // namespace
}  // namespace wishbone
