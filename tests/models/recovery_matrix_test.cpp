#include "models/recovery_matrix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "text_files.h"

namespace wishbone {
namespace {

RecoveryMatrix read(const std::string& name, std::string_view text) {
  const TextFiles files;
  return read_recovery_matrix(files.write(name, text));
}

std::string refusal(const std::string& name, std::string_view text) {
  const TextFiles files;
  const auto file = files.write(name, text);
  return files.relative(message_of<InputError>([&] { read_recovery_matrix(file); }));
}

const MatrixX kMatrix = (MatrixX(2, 3) << 1, 0, -2.5, 4, 5, 6).finished();

TEST(RecoveryMatrix, ComesFromMatrixMarketOfEitherKind) {
  const RecoveryMatrix array =
      read("R.mtx", "%%MatrixMarket matrix array real general\n2 3\n1\n4\n0\n5\n-2.5\n6\n");
  EXPECT_EQ(array.R, kMatrix);
  EXPECT_TRUE(array.row_names.empty());
  EXPECT_EQ(
      read("R.mtx",
           "%%MatrixMarket matrix coordinate real general\n2 3 5\n1 1 1\n2 1 4\n2 2 5\n1 3 -2.5\n2 3 6\n")
          .R,
      kMatrix);
}

TEST(RecoveryMatrix, ComesFromATableWithOrWithoutNamesOfItsRows) {
  const RecoveryMatrix plain = read("R.csv", "a, b, c\n1, 0, -2.5\n4, 5, 6\n");
  EXPECT_EQ(plain.R, kMatrix);
  EXPECT_TRUE(plain.row_names.empty());
  const RecoveryMatrix named =
      read("R.csv", "# of gauges\na; Row; b; c\n1; \"gauge; 3\"; 0; -2.5\n4; 17; 5; 6\n");
  EXPECT_EQ(named.R, kMatrix);
  EXPECT_THAT(named.row_names, testing::ElementsAre("gauge; 3", "17"));
}

TEST(RecoveryMatrix, FilesThatAreNoneAreRefused) {
  EXPECT_EQ(refusal("R.csv", "row, a, b\n"),
            "R.csv: error: the recovery matrix is empty (got 0 x 2)\n"
            "  give a row for each quantity and a column for each elastic mode of the body");
  EXPECT_EQ(refusal("R.csv", "row\nx\n"),
            "R.csv:1 (byte 0): error: the table has no column of a mode (got 'row')\n"
            "  give one for each elastic mode of the body");
  EXPECT_EQ(refusal("R.csv", "row, a\ntop, 1\ntop, 2\n"),
            "R.csv:3 (byte 14): error: two rows have the same name (got 'top')\n"
            "  rename or remove one");
  EXPECT_EQ(refusal("R.csv", "row, a\ntop, 1\n, 2\n"),
            "R.csv:3 (byte 14): error: the row has no name\n"
            "  name it");
  EXPECT_EQ(refusal("R.csv", "row, a[Pa]\ntop, 1\n"),
            "R.csv:1 (byte 5): error: columns of a recovery matrix have no units (got 'a')\n"
            "  remove the unit; the scene gives that of the recovered quantity");
  EXPECT_THAT(refusal("R.csv", "1, 2\n3, 4\n"), testing::HasSubstr("the first line must name the columns"));
  EXPECT_THAT(refusal("R.csv", "row, a\ntop, 1\nend, nan\n"),
              testing::StartsWith("R.csv:3 (byte 19): error: "));
  EXPECT_THAT(refusal("R.mtx", "1 2\n3 4\n"), testing::StartsWith("R.mtx:1 (byte 0): error: "));
}

}  // namespace
}  // namespace wishbone
