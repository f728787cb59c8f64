// `wishbone convert`, and `wishbone info` of modal data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/call.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/formats/mode_file.h"
#include "identification/formats/uff/uff_writer.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ModalCommands : public testing::Test {
 protected:
  ModalCommands() {
    data_.title = "Frame";
    data_.node_ids = {1, 2};
    data_.node_position = Matrix3X::Zero(3, 2);
    data_.node_position(0, 1) = 2.5;
    data_.node_mass = Eigen::Vector2d(3, 4);
    data_.freedoms = {{1, 2}, {2, 2}};
    data_.omega = 2 * std::numbers::pi * Eigen::Vector2d(17.25, 20.5);
    data_.damping_ratio = Eigen::Vector2d(0.015, 0);
    data_.modal_mass = Eigen::Vector2d(1, std::nan(""));
    data_.shapes = MatrixX::Identity(2, 2);
    data_.support.springs = {{2, Vector3::UnitZ(), 47e3}};
    data_.provenance = {"measured on a Monday"};
    write_mode_file(mode_file_, data_);
  }
  TextFiles files_;
  std::string mode_file_ = files_ / "frame.h5";
  ModalData data_;
};

TEST_F(ModalCommands, ConvertGoesToTablesAndBackWithoutLossOfABit) {
  const Answer there = call("convert " + mode_file_ + " " + (files_ / "t.csv").string());
  EXPECT_EQ(there.code, 0) << there.text;
  EXPECT_THAT(there.text,
              AllOf(HasSubstr("t.csv: 2 nodes, 2 freedoms, 2 modes from 17.25 Hz to 20.5 Hz, 1 spring"),
                    HasSubstr("left out, for the format has no place for it: title, support (1 spring), "
                              "provenance")));
  const Answer back = call("convert " + (files_ / "t.csv").string() + " " + (files_ / "back.h5").string());
  EXPECT_EQ(back.code, 0) << back.text;
  const ModalData read = read_mode_file(files_ / "back.h5");
  EXPECT_EQ(read.omega, data_.omega);
  EXPECT_EQ(read.node_position, data_.node_position);
  EXPECT_EQ(read.shapes, data_.shapes);
  EXPECT_THAT(read.provenance[0], HasSubstr("t_nodes.csv"));
}

TEST_F(ModalCommands, ConvertRefusesBeforeItWrites) {
  const auto convert = [&](const std::string& in, const std::string& out) {
    return call("convert " + in + " " + (files_ / out).string());
  };
  EXPECT_EQ(convert(mode_file_, "frame.txt").code, 2);
  EXPECT_THAT(convert(mode_file_, "frame.h5").text, HasSubstr("the output would replace an input"));
  EXPECT_EQ(convert(mode_file_, "absent/a.csv").code, 2);
  EXPECT_EQ(convert(files_ / "absent.h5", "a.csv").code, 2);
  EXPECT_FALSE(std::filesystem::exists(files_ / "a_nodes.csv"));
  EXPECT_EQ(read_mode_file(mode_file_).omega, data_.omega);
}

TEST_F(ModalCommands, ConvertMayReplaceNoneOfTheTablesThatItReads) {
  write_csv_modal_data(csv_modal_files(files_ / "t.csv"), data_);
  std::filesystem::create_symlink(files_ / "t_shapes.csv", files_ / "u_nodes.csv");
  const Answer answer = call("convert " + (files_ / "t.csv").string() + " " + (files_ / "u.csv").string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("the output would replace an input"));
}

TEST_F(ModalCommands, ConvertTellsWhereATableIsWrong) {
  write_csv_modal_data(csv_modal_files(files_ / "t.csv"), data_);
  files_.write("t_frequencies.csv", "mode,frequency_hz\n1,17.25\n2,20,5\n");
  const Answer answer = call("convert " + (files_ / "t.csv").string() + " " + (files_ / "a.h5").string());
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text,
              HasSubstr("t_frequencies.csv:3 (byte 31): error: the row has more than the 2 fields"));
}

TEST_F(ModalCommands, InfoTellsTheModesOfAnyFormat) {
  write_csv_modal_data(csv_modal_files(files_ / "t.csv"), data_);
  for (const std::string& file : {mode_file_, (files_ / "t.csv").string()}) {
    const Answer lines = call("info " + file);
    EXPECT_EQ(lines.code, 0) << lines.text;
    EXPECT_THAT(lines.text, AllOf(HasSubstr("2 nodes with 7 kg, 2 freedoms, 2 modes"), HasSubstr("17.25"),
                                  HasSubstr("1.5"), HasSubstr("unknown")));
    const auto json = nlohmann::json::parse(call("info --json " + file).text);
    EXPECT_EQ(json["modal_data"]["modes"][1]["frequency_hz"], 20.5);
    EXPECT_EQ(json["modal_data"]["modes"][1]["modal_mass"], "nan");
    EXPECT_EQ(json["modal_data"]["mass"], 7);
  }
  EXPECT_THAT(call("info " + mode_file_).text,
              AllOf(HasSubstr("title: Frame"), HasSubstr("spring at node 2 along (0, 0, 1): 47000 N/m"),
                    HasSubstr("measured on a Monday"), HasSubstr("/modes/shapes")));
  const auto json = nlohmann::json::parse(call("info --json " + mode_file_).text);
  EXPECT_EQ(json["modal_data"]["support"]["springs"][0]["stiffness"], 47e3);
}

TEST_F(ModalCommands, ConvertGoesToUniversalFilesAndBackWithinTheirDigits) {
  const Answer there = call("convert " + mode_file_ + " " + (files_ / "a.unv").string());
  EXPECT_EQ(there.code, 0) << there.text;
  EXPECT_THAT(there.text,
              HasSubstr("digits of the modes beyond the sixth, nodal masses, support (1 spring)"));
  const Answer back = call("convert " + (files_ / "a.unv").string() + " " + (files_ / "back.h5").string());
  EXPECT_EQ(back.code, 0) << back.text;
  const ModalData read = read_mode_file(files_ / "back.h5");
  EXPECT_LT((read.omega - data_.omega).norm(), 1e-5 * data_.omega.norm());
  EXPECT_EQ(read.node_position, data_.node_position);
  EXPECT_FALSE(read.has_masses());
}

/// Two nodes at the ends of a bar, and a mode of it.
UffFile bar_of(double length, int analysis) {
  UffFile file;
  file.nodes = {{1, 0, 0, 0, {0, 0, 0}}, {2, 0, 0, 0, {length, 0, 0}}};
  UffShape mode;
  mode.analysis = analysis;
  mode.nodes = {1, 2};
  mode.values = {1, 2, 3, 4, 5, 6};
  mode.frequency = 40;
  mode.eigenvalue = {-3, 300};
  file.shapes = {mode};
  return file;
}

TEST_F(ModalCommands, InfoTellsFrequencyAndDampingOfComplexModes) {
  const std::string file = files_ / "complex.unv";
  for (const int analysis : {3, 7})
    for (const int dataset : {55, 2414}) {
      UffFile bar = bar_of(1, analysis);
      bar.shapes[0].dataset = dataset;
      write_uff(file, bar);
      EXPECT_THAT(call("info " + file).text, testing::ContainsRegex("47[.]75 +1 +2 +3"));
      const auto json = nlohmann::json::parse(call("info --json " + file).text);
      const auto& mode = json["nodal_results"][0];
      EXPECT_NEAR(mode["frequency_hz"].get<double>(), std::hypot(3, 300) / (2 * std::numbers::pi), 1e-9);
      EXPECT_NEAR(mode["damping_ratio"].get<double>(), 3 / std::hypot(3, 300), 1e-12);
    }
}

TEST_F(ModalCommands, WhatWasAssumedAndUnderstoodIsTold) {
  const std::string file = files_ / "mm.unv";
  write_uff(file, bar_of(600, 2));
  const auto told =
      AllOf(HasSubstr("size 600 x 0 x 0 m; masses of nodes not known"),
            HasSubstr("units: the file says none (no dataset 164), m and N assumed"),
            HasSubstr("mm.unv: warning: a structure of this length has lower modes than these"));
  EXPECT_THAT(call("info " + file).text, told);
  const Answer converted = call("convert " + file + " " + (files_ / "mm.csv").string());
  EXPECT_EQ(converted.code, 0);
  EXPECT_THAT(converted.text, told);
  // what the remedy says
  UffFile stated = bar_of(600, 2);
  stated.units = {5, "mm", 1, 1000, 1000, 1, 273.15};
  write_uff(file, stated);
  EXPECT_THAT(call("convert " + file + " " + (files_ / "m.csv").string()).text,
              AllOf(HasSubstr("size 0.6 x 0 x 0 m"), HasSubstr("code 5 (mm, mN), length 0.001 m"),
                    Not(HasSubstr("warning"))));
  EXPECT_THAT(call("info " + mode_file_).text,
              AllOf(HasSubstr("size 2.5 x 0 x 0 m; mass 7 kg, mass centre (1.429, 0, 0) m"),
                    Not(HasSubstr("warning"))));
}

TEST_F(ModalCommands, InfoListsWhatAUniversalFileHolds) {
  const std::string data = std::string(WISHBONE_TEST_DATA) + "/uff/";
  const Answer functions = call("info " + data + "Sample_UFF58b_bin.uff");
  EXPECT_EQ(functions.code, 0) << functions.text;
  EXPECT_THAT(functions.text, HasSubstr("58b"));
  const auto json = nlohmann::json::parse(call("info --json " + data + "Sample_UFF58b_bin.uff").text);
  EXPECT_GT(json["functions"].size(), 0u);
  EXPECT_GT(json["functions"][0]["points"], 0);
  const Answer shapes = call("info " + data + "uff55_translation.uff");
  EXPECT_EQ(shapes.code, 0) << shapes.text;
  EXPECT_THAT(shapes.text, HasSubstr("nodal result"));
}

}  // namespace
}  // namespace wishbone
