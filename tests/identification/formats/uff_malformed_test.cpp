#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "identification/formats/uff/uff_reader.h"
#include "text_files.h"

namespace wishbone {
namespace {

/// A file that is refused: `~` marks the byte that the message must name.
struct Malformed {
  std::string name;
  std::string text;
  std::string message;  ///< part of it
};

void PrintTo(const Malformed& file, std::ostream* out) {
  *out << file.name;
}

std::string dataset(const std::string& number, const std::string& records) {
  return "    -1\n" + number + "\n" + records + "    -1\n";
}

const std::string kFivesNones = "NONE\nNONE\nNONE\nNONE\nNONE\n";

std::string shape(const std::string& rest) {
  return "    -1\n    55\n" + kFivesNones + rest;
}

const std::string kNormalMode =
    "         1         2         2         8         2         3\n         2         4         1         1\n"
    "  1.00000E+01  0.00000E+00  0.00000E+00  0.00000E+00\n";

std::string function(const std::string& first, const std::string& freedoms, const std::string& form,
                     const std::string& axis, const std::string& values) {
  const std::string plain = "         0    0    0    0 NONE                 NONE\n";
  return "    -1\n" + first + "\n" + kFivesNones + freedoms + "\n" + form + "\n" + plain + plain + axis +
         "\n" + (values.starts_with('~') ? "~" : "") + plain + values.substr(values.starts_with('~') ? 1 : 0);
}

const std::string kFreedoms =
    "    4         0    0         0 NONE               3   1 NONE               5   3";
const std::string kFourReals = "         2         4         1  0.00000E+00  1.00000E+00  0.00000E+00";
const std::string kAxis = "         0    0    0    0 NONE                 NONE";
const std::string kBinary = "    58b     1     2          11          16     0     0           0           0";

const std::vector<Malformed> kMalformed = {
    // the file
    {"empty", "~", "holds no dataset"},
    {"blank", "\n   \n~", "holds no dataset"},
    {"no_uff", "~Dear Sir,\nplease find\n", "expected the delimiter"},
    {"binary_junk",
     std::string("~\x7f"
                 "ELF\x02\x01\x01\x00\x00\xff\xfe",
                 13),
     "expected the delimiter"},
    {"no_number", "    -1\n  ~abc\n    -1\n", "expected the number of a dataset"},
    {"ends_at_opening", "    -1\n    -1\n    -1\n~", "the file ends where a dataset begins"},
    {"cut_off", "    -1\n    15\n         1         0         0         1  0.0          1.0          2.0\n~",
     "the file ends before the delimiter"},
    {"cut_off_unknown", "    -1\n  1858\nsomething\n~", "the file ends before the delimiter"},
    {"missing_delimiter", "    -1\n   151\nmodel\n    -1\n  ~2411\n    -1\n", "close the dataset before it"},
    {"long_line", "    -1\n    15\n~" + std::string(5000, '1') + "\n    -1\n", "longer than 4096 bytes"},
    // geometry
    {"node_word",
     dataset("    15", "         1         0         0         1  0.00000E+00  ~bad          0.00000E+00\n"),
     "expected a number (got 'bad')"},
    {"node_nan",
     dataset("    15", "         1         0         0         1  0.00000E+00          ~NaN  0.00000E+00\n"),
     "expected a number (got 'NaN')"},
    {"node_overflow",
     dataset("    15", "         1         0         0         1  0.00000E+00 ~1.00000E+999  0.00000E+00\n"),
     "a coordinate, a finite number"},
    {"node_short", dataset("    15", "         ~1         0         0         1  0.00000E+00\n"),
     "expected a node"},
    {"node_zero", dataset("    15", "         ~0         0         0         1  0.0  0.0  0.0\n"),
     "a node number must be positive"},
    {"node_huge", dataset("    15", " ~99999999999         0         0         1  0.0  0.0  0.0\n"),
     "the node number, a whole number"},
    {"node_twice",
     dataset("    15",
             "         1         0         0         1  0.0  0.0  0.0\n"
             "~         1         0         0         1  0.0  0.0  1.0\n"),
     "a node is defined twice, differently (got 'node 1')"},
    {"node_2411_half", "    -1\n  2411\n         1         1         1        11\n~    -1\n",
     "expected the coordinates of a node"},
    {"node_2411_two", dataset("  2411", "         1         1         1        11\n   ~1.0D+00   2.0D+00\n"),
     "the three coordinates of node 1"},
    {"system_line",
     dataset("    18",
             "         1         0         0         8         1\nCS\n"
             " 0.0 0.0 0.0 1.0 0.0 0.0\n~ 2.0 0.0 0.0\n"),
     "must not lie on one line"},
    {"system_short",
     dataset("    18", "         1         0         0         8         1\nCS\n 0.0 0.0 0.0\n~"),
     "expected the nine coordinates"},
    {"system_matrix",
     dataset("  2420",
             "         1\nPart\n         1         0         8\nCS\n 1.0 0.0 0.0\n 0.0 1.0 0.0\n"
             " 0.0 0.0 2.0\n~ 0.0 0.0 0.0\n"),
     "must be a rotation"},
    {"system_twice",
     dataset("    18",
             "         1         0         0         8         1\nCS\n 0 0 0 1 0 0\n 0 0 1\n"
             "         1         0         0         8         1\nCS\n 0 0 0 0 1 0\n~ 0 0 1\n"),
     "a coordinate system is defined twice"},
    {"trace_huge", dataset("    82", "         ~1  99999999         1\nNONE\n         1         2\n"),
     "does not fit into the rest of the file"},
    {"trace_negative", dataset("    82", "         ~1       -99         1\nNONE\n         1         2\n"),
     "does not fit into the rest of the file"},
    {"trace_short", dataset("    82", "         1         3         1\nNONE\n         1         2\n~"),
     "expected node numbers"},
    {"trace_long",
     dataset("    82", "         1         2         1\nNONE\n         ~1         2         3\n"),
     "more than the announced 2 node numbers"},
    {"element_count",
     dataset("  2412", "         ~1        94         1         1         7  99999999\n         1\n"),
     "must have 1 to 1000 nodes"},
    {"element_short",
     dataset("  2412",
             "         1        94         1         1         7         4\n         1         2\n~"),
     "expected node numbers"},
    {"element_word",
     dataset("  2412",
             "         1        94         1         1         7         2\n         1         ~x\n"),
     "expected a number (got 'x')"},
    // units
    {"units_code", dataset("   164", "        ~77mystery                         1\n 1.0 1.0 1.0\n 0.0\n"),
     "must be 1 to 10"},
    {"units_zero", dataset("   164", "         1SI                           1\n 0.0 1.0 1.0\n 0.0\n~"),
     "must be positive"},
    {"units_short", dataset("   164", "         1SI                           1\n 1.0\n~"),
     "got '1 numbers'"},
    {"units_twice",
     dataset("   164", "         1SI\n 1.0 1.0 1.0\n 0.0\n") +
         dataset("   164", "         5mm\n 1E3 1E3 1\n 0\n~"),
     "two units datasets that differ"},
    // nodal shapes
    {"shape_no_head", "    -1\n    55\nNONE\nNONE\n~    -1\n", "expected an identification line"},
    {"shape_values_per_node",
     shape("         ~1         2         2         8         2  99999999\n    -1\n"),
     "the count of values per node must be 1 to 1000"},
    {"shape_reals",
     shape("         1         2         2         8         2         3\n"
           "         ~2 999999999         1         1\n    -1\n"),
     "the counts of integers and reals"},
    {"shape_node_word", shape(kNormalMode + "         ~A\n 1.0 1.0 1.0\n    -1\n"),
     "expected a number (got 'A')"},
    {"shape_missing_values", shape(kNormalMode + "         1\n 1.0 1.0\n~    -1\n"),
     "expected 3 values of node 1"},
    {"shape_too_many", shape(kNormalMode + "         1\n ~1.0 1.0 1.0 1.0\n    -1\n"),
     "expected 3 values of node 1, found more"},
    {"shape_value_inf", shape(kNormalMode + "         1\n 1.0 ~Infinity 1.0\n    -1\n"),
     "expected a number (got 'Infinity')"},
    {"shape_node_twice", shape(kNormalMode + "         1\n 1.0 1.0 1.0\n         ~1\n 1.0 1.0 1.0\n    -1\n"),
     "a node occurs twice in one dataset"},
    {"shape_cut_off", shape(kNormalMode + "         1\n 1.0 1.0~"), "the file ends before the delimiter"},
    // functions
    {"function_freedoms", function("    58", "    ~4 what is this", kFourReals, kAxis, "1 2 3 4\n    -1\n"),
     "expected function type"},
    {"function_type",
     function("    58", kFreedoms, "         ~9         4         1  0.00000E+00  1.00000E+00  0.00000E+00",
              kAxis, "1 2 3 4\n    -1\n"),
     "the ordinate type must be 2, 4, 5 or 6"},
    {"function_points",
     function("    58", kFreedoms, "         2        ~-4         1  0.00000E+00  1.00000E+00  0.00000E+00",
              kAxis, "1 2 3 4\n    -1\n"),
     "must not be negative"},
    {"function_spacing",
     function("    58", kFreedoms, "         2         4         ~3  0.00000E+00  1.00000E+00  0.00000E+00",
              kAxis, "1 2 3 4\n    -1\n"),
     "the abscissa spacing must be 0 or 1"},
    {"function_axis",
     function("    58", kFreedoms, kFourReals, "         0    ~x    0    0 NONE                 NONE",
              "1 2 3 4\n    -1\n"),
     "a unit exponent, a whole number"},
    {"function_absurd",
     function("    58", kFreedoms, "         4         2147483647         1  0.0  1.0  0.0", kAxis,
              "~1 2 3 4\n    -1\n"),
     "do not fit into the rest of the file"},
    {"function_short", function("    58", kFreedoms, kFourReals, kAxis, "1.0 2.0 3.0\n~    -1\n"),
     "expected 4 values, found 3"},
    {"function_long", function("    58", kFreedoms, kFourReals, kAxis, "1.0 2.0 3.0\n ~4.0 5.0\n    -1\n"),
     "expected 4 values, found more"},
    {"function_float", function("    58", kFreedoms, kFourReals, kAxis, "1.0 ~1.0E+99 3.0 4.0\n    -1\n"),
     "does not fit single precision"},
    {"binary_order",
     function("    58b     ~7     2          11          16     0     0           0           0", kFreedoms,
              kFourReals, kAxis, std::string(16, '\0') + "\n    -1\n"),
     "the byte order must be 1 or 2"},
    {"binary_format",
     function("    58b     1     ~1          11          16     0     0           0           0", kFreedoms,
              kFourReals, kAxis, std::string(16, '\0') + "\n    -1\n"),
     "the floating-point format must be 2"},
    {"binary_short",
     function(kBinary, kFreedoms, kFourReals, kAxis, "~" + std::string(12, '\0') + "\n    -1\n"),
     "expected 16 bytes"},
    {"binary_open", function(kBinary, kFreedoms, kFourReals, kAxis, "~" + std::string(16, '\0')),
     "expected 16 bytes"},
    {"binary_absurd",
     function("    58b     1     2          11999999999999     0     0           0           0", kFreedoms,
              "         6         2147483647         0  0.0  1.0  0.0", kAxis,
              "~" + std::string(16, '\0') + "\n    -1\n"),
     "expected 51539607528 bytes"},
    {"binary_nan",
     function(kBinary, kFreedoms, kFourReals, kAxis,
              "~" + std::string(12, '\0') + "\xff\xff\xff\x7f\n    -1\n"),
     "number 4 of the binary block"},
};

class UffMalformed : public testing::TestWithParam<Malformed> {};

TEST_P(UffMalformed, IsRefusedAtItsPlace) {
  std::string text = GetParam().text;
  const std::size_t at = text.find('~');
  ASSERT_NE(at, std::string::npos);
  text.erase(at, 1);
  auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  if (at == text.size() && text.ends_with('\n')) --line;  // the end of the file belongs to its last line
  const TextFiles files;
  const auto file = files.write("bad.unv", text);
  try {
    read_uff(file);
    FAIL() << "it was read";
  } catch (const InputError& e) {
    EXPECT_EQ(files.relative(e.diagnostic().where),
              "bad.unv:" + std::to_string(line) + " (byte " + std::to_string(at) + ")")
        << e.what();
    EXPECT_THAT(e.what(), testing::HasSubstr(GetParam().message));
    EXPECT_FALSE(e.diagnostic().remedy.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Files, UffMalformed, testing::ValuesIn(kMalformed),
                         [](const auto& tested) { return tested.param.name; });

TEST(UffReader, SaysThatThereIsNoFile) {
  const TextFiles files;
  EXPECT_THAT(message_of<InputError>([&] { read_uff(files / "none.unv"); }),
              testing::HasSubstr("there is no such file"));
  EXPECT_THAT(message_of<InputError>([&] { read_uff(files / ""); }), testing::HasSubstr("not a file"));
}

}  // namespace
}  // namespace wishbone
