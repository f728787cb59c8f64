// What is wrong with a text file is said with file, line and byte. In the texts below `^` marks the place, and is
// not part of the file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/error.h"
#include "identification/formats/csv_frequencies.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/formats/matrix_market.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

using Read = void (*)(const TextFiles&, const std::filesystem::path&);

void nodes(const TextFiles&, const std::filesystem::path& file) {
  read_csv_nodes(file);
}
void frequencies(const TextFiles&, const std::filesystem::path& file) {
  read_csv_frequencies(file);
}
void shapes(const TextFiles& files, const std::filesystem::path& file) {
  read_csv_modal_data({files.write("n.csv", "node,x,y,z\n1,0,0,0\n2,1,0,0\n"),
                       files.write("f.csv", "mode,frequency_hz\n7,1\n9,2\n"), file});
}
void matrix(const TextFiles&, const std::filesystem::path& file) {
  read_matrix_market(file);
}

struct Broken {
  std::string text;
  std::string message;
  friend std::ostream& operator<<(std::ostream& out, const Broken& broken) { return out << broken.text; }
};

void expect_refusal(Read read, const Broken& broken) {
  const std::size_t byte = broken.text.find('^');
  ASSERT_NE(byte, std::string::npos) << broken.text;
  std::string text = broken.text;
  text.erase(byte, 1);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
  const TextFiles files;
  const auto file = files.write("a", text);
  const std::string message = files.relative(message_of<InputError>([&] { read(files, file); }));
  EXPECT_THAT(message, StartsWith(fmt::format("a:{} (byte {}): error: ", line, byte))) << broken.text;
  EXPECT_THAT(message, HasSubstr(broken.message)) << broken.text;
}

TEST(BrokenNodes, AreRefusedAtTheirPlace) {
  const std::string header = "node,x,y,z\n";
  for (const Broken& broken : {
           Broken{"^", "the table is empty"},
           {"# only a comment\n^", "the table is empty"},
           {"^1,0,0,0\n", "the first line must name the columns"},
           {"^nodes,x,y,z\n", "there is no column 'node'"},
           {"^node,x,y\n1,0,0\n", "there is no column 'z'"},
           {"node,x,y,z,^mas\n", "did you mean 'mass'?"},
           {"node,x,^x,z\n", "two columns have the same name"},
           {"node,x,y,z,^\n", "a column has no name"},
           {"node,x,y,^[m]\n", "a column has no name"},
           {"node,^x[kg],y,z\n1,0,0,0\n", "wrong dimension: length [m] is wanted, this is mass [kg]"},
           {"node,^x[furlongish],y,z\n", "unknown unit 'furlongish'"},
           {"node,x,y,z\n-,m,^s,m\n1,0,0,0\n", "wrong dimension: length [m] is wanted, this is time [s]"},
           {header + "1,0,0^\n", "the row has 3 fields, the header has 4"},
           {header + "1,0,0,0,^0\n", "more than the 4 fields"},
           {header + "1,0,0,0,^\n", "more than the 4 fields"},
           {header + "1,0,0,^0.5.5\n", "not a finite number (got '0.5.5')"},
           {header + "1,^,0,0\n", "a number is missing"},
           {header + "1,0,^nan,0\n", "not a finite number"},
           {header + "1,0,0,^-inf\n", "not a finite number"},
           {header + "1,0,0,^1e999\n", "does not fit a double"},
           {header + "1,0,0,^0x10\n", "not a finite number"},
           {header + "1,0,^1 2,0\n", "not a finite number"},
           {"node;x;y;z\n1;0;^0,5;0\n", "decimal point"},
           {header + "^1.5,0,0,0\n", "not an integer"},
           {header + "^3000000000,0,0,0\n", "the integer is too large"},
           {header + "^99999999999999999999,0,0,0\n", "the integer is too large"},
           {header + "1,0,0,0\n# again\n^1,1,0,0\n", "this node has a row already"},
           {header + "1,0,0,^\"0\n", "a quoted field does not end on its line"},
           {header + "1,0,\"0\"^5,0\n", "text follows a quoted field"},
           {header + "1,0,0^\"0,0\n", "a quote inside a field"},
           {"node,x,y,z,mass\n1,0,0,0,^-1\n", "the mass of a node must not be negative"},
           {"node,x,y,z,mass\n1,0,0,0,^\n", "a number is missing"},
           {"^node,x,y,z\n", "the table has no rows"},
           {"node,x[km],y,z\n1,^1e306,0,0\n", "does not fit a double in SI units"},
           {"\xef\xbb\xbfnode,x,y,z\r\n1,0,0,^a\r\n", "not a finite number (got 'a')"},
       })
    expect_refusal(nodes, broken);
}

TEST(BrokenFrequencies, AreRefusedAtTheirPlace) {
  for (const Broken& broken : {
           Broken{"^mode,damping\n1,0\n", "there is no column 'frequency'"},
           {"^frequency\n1\n", "there is no column 'mode'"},
           {"mode,frequency,^frequency_hz\n1,1,1\n", "this means the same as the column 'frequency'"},
           {"mode,frequency,damping,^damping_ratio\n1,1,0,0\n",
            "this means the same as the column 'damping'"},
           {"mode,^frequency_hz[kHz]\n1,1\n", "the name tells the unit already"},
           {"mode,^frequency[m]\n1,1\n", "wrong dimension: frequency [Hz] is wanted"},
           {"mode,^frequency[rad/s]\n1,1\n", "wrong dimension: frequency [Hz] is wanted"},
           {"mode,^omega[Hz]\n1,1\n", "wrong dimension: angular velocity [rad/s] is wanted"},
           {"mode,frequency\n1,^0\n", "the frequency must be positive"},
           {"mode,omega\n1,^-3\n", "the frequency must be positive"},
           {"mode,frequency\n1,5\n2,^4.9\n", "frequencies must ascend"},
           {"mode,frequency\n2,5\n^2,6\n", "the numbers of the modes must ascend"},
           {"mode,omega,frequency\n1,6.2831853,^1.001\n", "this is not omega / (2 pi) = 0.999999999 Hz"},
           {"mode,frequency,damping\n1,5,^-0.1\n", "the damping must not be negative"},
           {"mode,frequency,damping\n1,5,^\n", "a number is missing"},
           {"mode,frequency,modal_mass\n1,5,^0\n", "the modal mass must be positive"},
           {"^mode,frequency\n", "the table has no rows"},
       })
    expect_refusal(frequencies, broken);
}

TEST(BrokenShapes, AreRefusedAtTheirPlace) {
  for (const Broken& broken : {
           Broken{"^node,axis,mode_7\n1,x,1\n", "there is no column 'mode_9'"},
           {"node,axis,7,9,^mode_8\n1,x,1,1,1\n", "no mode of the table of frequencies has this number"},
           {"node,axis,7,9,^comment\n1,x,1,1,1\n", "no mode of the table of frequencies has this number"},
           {"node,axis,7,9,^mode_7\n1,x,1,1,1\n", "this mode has two columns"},
           {"node,axis,^mode_7[mm],mode_9\n1,x,1,1\n", "amplitudes have no unit"},
           {"node,axis,7,9\n1,^u,1,1\n", "the axis must be x, y or z"},
           {"node,axis,7,9\n1,^4,1,1\n", "the axis must be x, y or z"},
           {"node,axis,7,9\n1,^--x,1,1\n", "the axis must be x, y or z"},
           {"node,axis,7,9\n1,^,1,1\n", "the axis must be x, y or z"},
           {"node,axis,7,9\n1,x,1,1\n^3,x,1,1\n", "the table of nodes has no such node (got '3')"},
           {"node,axis,7,9\n1,x,1,1\n1,^-1,1,1\n", "the freedom 1 x has a row already"},
           {"node,axis,7,9\n1,x,1,^1d0\n", "not a finite number"},
       })
    expect_refusal(shapes, broken);
}

TEST(BrokenMatrices, AreRefusedAtTheirPlace) {
  const std::string general = "%%MatrixMarket matrix coordinate real general\n";
  const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  const std::string skew = "%%MatrixMarket matrix coordinate real skew-symmetric\n";
  const std::string array = "%%MatrixMarket matrix array real general\n";
  for (const Broken& broken : {
           Broken{"^", "this is not a MatrixMarket file"},
           {"^1 1 1\n", "this is not a MatrixMarket file"},
           {"^%%MatrixMarketing matrix coordinate real general\n", "this is not a MatrixMarket file"},
           {"%%MatrixMarket ^vector coordinate real general\n", "only a 'matrix' can be read"},
           {"%%MatrixMarket matrix ^elemental real general\n", "the layout must be"},
           {"%%MatrixMarket matrix coordinate ^complex general\n", "complex matrix is neither"},
           {"%%MatrixMarket matrix coordinate ^pattern general\n", "a pattern has no values"},
           {"%%MatrixMarket matrix coordinate ^double general\n", "the field must be 'real' or 'integer'"},
           {"%%MatrixMarket matrix coordinate real ^hermitian\n", "a hermitian matrix is complex"},
           {"%%MatrixMarket matrix coordinate real ^upper\n", "the symmetry must be"},
           {"%%MatrixMarket matrix coordinate real^\n", "the first line must have 5 words"},
           {"%%MatrixMarket matrix coordinate real general ^1\n", "the first line must have 5 words"},
           {general + "^", "the file ends before the line of sizes"},
           {general + "% comment\n\n^", "the file ends before the line of sizes"},
           {general + "2 2^\n1 1 1\n", "(rows, columns, entries) must have 3 words"},
           {array + "2 2 ^4\n", "(rows, columns) must have 2 words"},
           {general + "^-1 1 1\n1 1 1\n", "sizes are from 0 to 2147483647"},
           {general + "2 ^2147483648 1\n1 1 1\n", "sizes are from 0 to 2147483647"},
           {general + "2 2 ^1.0\n1 1 1\n", "not an integer"},
           {general + "^2 2 1000000000\n1 1 1\n", "too short for 1000000000 entries"},
           {array + "^2000000000 2000000000\n1\n", "too short for 4000000000000000000 entries"},
           {general + "^2000000000 2 1\n1 1 1\n", "nearly all rows or columns"},
           {general + "^2 2000000000 0\n", "nearly all rows or columns"},
           {symmetric + "^2 3 1\n1 1 1\n", "as many columns as rows"},
           {general + "2 2 2\n1 1 1.000000\n^", "the file ends after 1 of 2 entries"},
           {array + "2 1\n1.000\n^", "the file ends after 1 of 2 entries"},
           {general + "2 2 1\n1 1 1\n^2 2 1\n", "there are more than 1 entries"},
           {array + "1 1\n1\n^2\n", "there are more than 1 entries"},
           {general + "2 2 1\n^0 1 1\n", "the row must be from 1 to 2"},
           {general + "2 2 1\n^3 1 1\n", "the row must be from 1 to 2"},
           {general + "2 2 1\n1 ^3 1\n", "the column must be from 1 to 2"},
           {general + "2 2 1\n1 ^-1 1\n", "the column must be from 1 to 2"},
           {general + "2 2 1\n^1.0 1 1\n", "not an integer"},
           {general + "2 2 1\n1 1^\n%%%%%%%\n", "an entry (row, column, value) must have 3 words"},
           {general + "2 2 1\n1 1 1 ^1\n", "an entry (row, column, value) must have 3 words"},
           {array + "2 1\n1 ^2\n", "an element of an array must have 1 words"},
           {general + "2 2 1\n1 1 ^nan\n", "not a finite number"},
           {general + "2 2 1\n1 1 ^1e400\n", "does not fit a double"},
           {general + "2 2 1\n1 1 ^1,5\n", "not a finite number"},
           {"%%MatrixMarket matrix coordinate integer general\n2 2 1\n1 1 ^1.5\n", "not an integer"},
           {"%%MatrixMarket matrix coordinate integer general\n2 2 1\n1 1 ^9007199254740993\n", "exactly"},
           {skew + "2 2 1\n^2 2 1\n", "no entries on its diagonal"},
           {general + "2 2 3\n1 2 1\n2 2 1\n^1 2 5\n", "has an entry already (got '1 2 5')"},
           {symmetric + "2 2 2\n2 1 1\n^1 2 1\n", "has an entry already"},
           {symmetric + "2 2 2\r\n1 1 1\r\n^1 1 1\r\n", "has an entry already"},
       })
    expect_refusal(matrix, broken);
}

TEST(TextFormats, RefuseWhatIsNoTextFile) {
  const TextFiles files;
  EXPECT_THAT(message_of<InputError>([&] { read_matrix_market(files / "absent"); }),
              HasSubstr("no such file"));
  EXPECT_THAT(message_of<InputError>([&] { read_csv_nodes(files / "."); }), HasSubstr("not a file"));
  EXPECT_THAT(message_of<InputError>([&] { read_csv_nodes("/dev/zero"); }), HasSubstr("not a file"));
  const auto binary = files.write("a", std::string("node,x,y,z\n1,0,\0,0\n", 20));
  EXPECT_THAT(files.relative(message_of<InputError>([&] { read_csv_nodes(binary); })),
              StartsWith("a:2 (byte 15): error: the file is not text (got '\\x00')"));
  const auto endless = files.write("b", "node,x,y,z\n" + std::string(3 << 20, '1'));
  EXPECT_THAT(files.relative(message_of<InputError>([&] { read_csv_nodes(endless); })),
              StartsWith("b:2 (byte 11): error: a line has more than 1048576 bytes"));
}

}  // namespace
}  // namespace wishbone
