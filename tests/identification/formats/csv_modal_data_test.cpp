#include "identification/formats/csv_modal_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "identification/formats/csv_frequencies.h"
#include "identification/formats/csv_table.h"
#include "identification/formats/modal_data_example.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(CsvModalData, GivesBackWhatWasWrittenToTheLastBit) {
  const TextFiles files;
  const CsvModalFiles tables = csv_modal_files(files / "a.csv");
  ModalData data = modal_data_example();
  write_csv_modal_data(tables, data);
  expect_same_tables(read_csv_modal_data(tables), data);
  data.node_mass.resize(0);
  write_csv_modal_data(tables, data);
  expect_same_tables(read_csv_modal_data(tables), data);
}

TEST(CsvModalData, SaysWhereItComesFrom) {
  const TextFiles files;
  const CsvModalFiles tables = csv_modal_files(files / "a.csv");
  write_csv_modal_data(tables, modal_data_example());
  const ModalData data = read_csv_modal_data(tables);
  ASSERT_EQ(data.provenance.size(), 1u);
  EXPECT_EQ(files.relative(data.provenance[0]), "read from a_nodes.csv, a_frequencies.csv and a_shapes.csv");
}

TEST(CsvModalData, HasThreeFilesOfOneName) {
  EXPECT_EQ(csv_modal_files("test.1/frame.csv").shapes, "test.1/frame_shapes.csv");
  EXPECT_EQ(csv_modal_files("frame").nodes, "frame_nodes.csv");
  EXPECT_EQ(csv_modal_files("frame.v2").frequencies, "frame.v2_frequencies.csv");
}

TEST(CsvNodes, AreInMetresAndKilograms) {
  const TextFiles files;
  const NodeTable plain = read_csv_nodes(files.write("a.csv", "node,x,y,z\n7,1,2,3\n-1,.5,-5.,+1e-3\n"));
  EXPECT_THAT(plain.ids, ElementsAre(7, -1));
  EXPECT_EQ(plain.position.col(1), Vector3(0.5, -5, 1e-3));
  EXPECT_EQ(plain.mass.size(), 0);
  // a foot is 0.3048 m by definition
  const std::string_view in_brackets = "Node,X[mm],y [ft],z,mass[g]\n7,250,10,1,500\n";
  const std::string_view in_a_row = "node,x,y,z,mass\n-,mm,ft,,g\n7,250,10,1,500\n";
  for (const std::string_view text : {in_brackets, in_a_row}) {
    const NodeTable nodes = read_csv_nodes(files.write("a.csv", text));
    EXPECT_LT((nodes.position.col(0) - Vector3(0.25, 3.048, 1)).norm(), 1e-15) << text;
    EXPECT_DOUBLE_EQ(nodes.mass[0], 0.5) << text;
  }
}

TEST(CsvFrequencies, OfTheSameModesAreTheSameInAnyUnit) {
  const TextFiles files;
  const double omega = 2 * std::numbers::pi * 17.5;
  for (const std::string_view text :
       {"mode,frequency_hz\n7,17.5\n", "mode,frequency\n7,17.5\n", "mode,frequency[Hz]\n7,17.5\n",
        "mode,frequency[kHz]\n7,0.0175\n", "mode,frequency[1/min]\n7,1050\n",
        "omega,mode\n109.95574287564276,7\n", "mode,omega[rad/s]\n7,109.95574287564276\n",
        "mode,omega,frequency\n7,109.95574287564276,17.5\n", "mode,omega[deg/s]\n7,6300\n"}) {
    const FrequencyTable table = read_csv_frequencies(files.write("a.csv", text));
    EXPECT_THAT(table.modes, ElementsAre(7)) << text;
    EXPECT_NEAR(table.omega[0], omega, 1e-13 * omega) << text;
    EXPECT_EQ(table.damping_ratio[0], 0);
    EXPECT_TRUE(std::isnan(table.modal_mass[0]));
  }
}

TEST(CsvFrequencies, HaveDampingAndModalMassWhereTheyAreKnown) {
  const TextFiles files;
  const FrequencyTable table = read_csv_frequencies(
      files.write("a.csv", "mode;frequency;damping[%];modal_mass[t]\n1;5;2;0.5\n3;5;0;\n4;9;1.5;2\n"));
  EXPECT_THAT(table.modes, ElementsAre(1, 3, 4));
  EXPECT_DOUBLE_EQ(table.damping_ratio[0], 0.02);
  EXPECT_DOUBLE_EQ(table.modal_mass[0], 500);
  EXPECT_TRUE(std::isnan(table.modal_mass[1]));
}

class CsvShapes : public testing::Test {
 protected:
  ModalData read(std::string_view shapes) const {
    return read_csv_modal_data({files_.write("n.csv", "node,x,y,z\n1,0,0,0\n2,1,0,0\n"),
                                files_.write("f.csv", "mode,frequency_hz\n7,1\n9,2\n"),
                                files_.write("s.csv", shapes)});
  }
  TextFiles files_;
};

TEST_F(CsvShapes, HaveAxesByLetterOrNumberAndMayPointBackwards) {
  const ModalData data =
      read("node,axis,mode_7,mode_9\n1,x,1,2\n1,-y,3,4\n1,3,5,6\n2,-1,7,-8\n2,+Z,9,10\n2,Y,11,12\n");
  EXPECT_EQ(data.freedoms, (std::vector<Freedom>{{1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 2}, {2, 1}}));
  EXPECT_EQ(data.shapes.col(0), (VectorX(6) << 1, -3, 5, -7, 9, 11).finished());
  EXPECT_EQ(data.shapes.col(1), (VectorX(6) << 2, -4, 6, 8, 10, 12).finished());
}

TEST_F(CsvShapes, ArePutInTheOrderOfTheFrequencies) {
  const ModalData data = read("mode_9,axis,node,7\n1,x,1,2\n");
  EXPECT_EQ(data.shapes, Eigen::RowVector2d(2, 1));
}

TEST(CsvTable, ReadsTheSameFromEverySpelling) {
  const TextFiles files;
  for (const std::string_view text :
       {"node,name\n5,front left\n", "node;name\n5;front left\n", "node\tname\n5\tfront left\n",
        "node,name\r\n5,front left\r\n", "\xef\xbb\xbfnode,name\n5,front left\n", "node,name\n5,front left",
        "# a comment, with commas\n\n  node , NAME  \n\n # another\n  5 ,\tfront left \n\n",
        "\"node\",\"name\"\n\"5\", \"front left\" \n", "node[-],name\n5,front left\n"}) {
    CsvTable table(files.write("a.csv", text));
    ASSERT_TRUE(table.next_row()) << text;
    EXPECT_EQ(table.integer(table.column("node")), 5) << text;
    EXPECT_EQ(table.text(table.column("name")), "front left") << text;
    EXPECT_FALSE(table.next_row()) << text;
    EXPECT_FALSE(table.next_row()) << text;
  }
}

TEST(CsvTable, QuotedTextsHoldSeparatorsAndQuotes) {
  const TextFiles files;
  CsvTable table(files.write("a.csv", "name,x\n\"a, \"\"b\"\"; # c\",1\n\"\",2\n,3\n"));
  ASSERT_TRUE(table.next_row());
  EXPECT_EQ(table.text(0), "a, \"b\"; # c");
  EXPECT_EQ(table.number(1), 1);
  for (const double x : {2.0, 3.0}) {
    ASSERT_TRUE(table.next_row());
    EXPECT_TRUE(table.is_empty(0));
    EXPECT_EQ(table.number(1), x);
  }
}

TEST(CsvTable, LongerThanAnyBufferIsReadRowByRow) {
  const TextFiles files;
  std::string text = "node,x\n";
  constexpr int kRows = 300'000;
  for (int i = 0; i < kRows; ++i) text += std::to_string(i) + "," + std::to_string(2 * i) + "\n";
  CsvTable table(files.write("a.csv", text));
  int rows = 0;
  for (; table.next_row(); ++rows) ASSERT_EQ(table.number(1), 2 * table.integer(0));
  EXPECT_EQ(rows, kRows);
}

}  // namespace
}  // namespace wishbone
