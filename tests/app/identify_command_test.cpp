// `wishbone identify`, and what `plan` and `run` say of identified bodies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/call.h"
#include "identification/formats/matrix_market.h"
#include "identification/formats/modal_file.h"
#include "identification/formats/mode_file.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr std::string_view kFrame = R"(wishbone: 1
title: Frame on springs
parameters:
  modes: {default: 36}
  stiffness: {default: 47 kN/m}
identification:
  measured: {from: model, modes: = modes}
  model:
    block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}
    material: {young: 210 MPa, poisson: 0.3, density: 2600}
  support: {springs: [{nodes: [1, 2, 11, 12], stiffness: = stiffness}]}
  reference: {from: model}
)";

class IdentifyCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (files_ / name).string(); }
  Answer identify(const std::string& file, const std::string& options) const {
    Answer answer = call("identify " + path(file) + " " + options);
    answer.text = files_.relative(answer.text);
    return answer;
  }
  std::string contents(const std::string& name) const {
    std::ifstream in(files_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(files_ / ""))
      found.push_back(entry.path().filename());
    std::sort(found.begin(), found.end());
    return found;
  }

  TextFiles files_;
  std::string frame_ = files_.write("frame.yaml", kFrame);
};

TEST_F(IdentifyCommand, TellsWhatItFoundAndKeepsIt) {
  const Answer answer = identify("frame.yaml", "-o " + path("free.h5"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text,
              AllOf(HasSubstr("Frame on springs"), HasSubstr("30 free-free modes from 36 measured modes"),
                    HasSubstr("reference [Hz]"), HasSubstr("modes in free.h5"), Not(HasSubstr("warning"))));
  const ModalData modes = read_mode_file(path("free.h5"));
  EXPECT_EQ(modes.mode_count(), 30);
  EXPECT_EQ(modes.title, "Frame on springs");
  EXPECT_TRUE(modes.support.empty());
}

TEST_F(IdentifyCommand, PrintsJsonWithTheSameNumbers) {
  const Answer answer = identify("frame.yaml", "--json -o " + path("free.h5"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  const auto json = nlohmann::json::parse(answer.text);
  const ModalData modes = read_mode_file(path("free.h5"));
  ASSERT_EQ(json["frequency_hz"].size(), 30u);
  EXPECT_DOUBLE_EQ(json["frequency_hz"][7], modes.omega[7] / (2 * std::numbers::pi));
  EXPECT_EQ(json["input_frequency_hz"].size(), 36u);
  EXPECT_EQ(json["lost_modes"], 0);
  EXPECT_LT(std::abs(json["reference"]["frequency_error"][0].get<double>()), 1e-8);
  EXPECT_THAT(json["warnings"], IsEmpty());
}

TEST_F(IdentifyCommand, WritesOtherFormatsToo) {
  for (const std::string name : {"also.unv", "also.csv", "also.h5"}) {
    const Answer answer = identify("frame.yaml", "-o " + path("free.h5") + " --also " + path(name));
    EXPECT_EQ(answer.code, 0) << answer.text;
    const ModalData modes = read_modal_data(files_ / "free.h5"), also = read_modal_data(files_ / name);
    EXPECT_LE((also.omega - modes.omega).norm(), 1e-5 * modes.omega.norm()) << name;
    EXPECT_EQ(also.freedoms, modes.freedoms) << name;
  }
}

TEST_F(IdentifyCommand, WritesAPageAndPictures) {
  const Answer answer = identify("frame.yaml", "-o " + path("free.h5") + " --html " + path("page.html") +
                                                   " --pictures " + path("pictures"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(contents("page.html"), AllOf(HasSubstr("<!doctype html>"), HasSubstr("Frame on springs"),
                                           HasSubstr("</html>"), HasSubstr("<svg")));
  for (const std::string picture :
       {"modes", "input_modes", "mac_reference", "mac_input", "mac_auto", "frequencies"})
    EXPECT_THAT(contents("pictures/" + picture + ".svg"), HasSubstr("</svg>")) << picture;
}

TEST_F(IdentifyCommand, WritesMatrices) {
  std::string text(kFrame);
  text += "  find: corrected\n";
  files_.write("corrected.yaml", text);
  const Answer answer =
      identify("corrected.yaml", "-o " + path("free.h5") + " --matrices " + path("corrected"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  const SparseMatrix M = read_matrix_market(files_ / "corrected_M.mtx"),
                     K = read_matrix_market(files_ / "corrected_K.mtx");
  EXPECT_EQ(M.rows(), 36);
  const ModalData modes = read_mode_file(path("free.h5"));
  const MatrixX residual = K * modes.shapes - M * modes.shapes * modes.omega.cwiseAbs2().asDiagonal();
  EXPECT_LE(residual.norm(), 1e-8 * (K * modes.shapes).norm());

  // of other goals the matrices are what the modes stand for
  EXPECT_EQ(identify("frame.yaml", "-o " + path("x.h5") + " --matrices " + path("x")).code, 0);
  const ModalData free = read_mode_file(path("x.h5"));
  const MatrixX forces = read_matrix_market(files_ / "x_K.mtx") * free.shapes;
  const MatrixX inertia =
      read_matrix_market(files_ / "x_M.mtx") * free.shapes * free.omega.cwiseAbs2().asDiagonal();
  EXPECT_LE((forces - inertia).norm(), 1e-10 * inertia.norm());
}

TEST_F(IdentifyCommand, RefusesOutputsBeforeItComputes) {
  const std::string output = "-o " + path("free.h5");
  const auto expect_refused = [&](const std::string& options, const char* reason) {
    const Answer answer = identify("frame.yaml", options);
    EXPECT_EQ(answer.code, 2) << options << "\n" << answer.text;
    EXPECT_THAT(answer.text, HasSubstr(reason)) << options;
    EXPECT_THAT(names(), testing::ElementsAre("frame.yaml")) << options;
  };
  expect_refused("-o " + path("absent/free.h5"), "there is no such folder to write to");
  expect_refused(output + " --html " + path("absent/page.html"), "there is no such folder to write to");
  expect_refused(output + " --also " + path("absent/also.csv"), "there is no such folder to write to");
  expect_refused(output + " --matrices " + path("absent/m"), "there is no such folder to write to");
  expect_refused(output + " --pictures " + path("absent/pictures"), "there is no such folder to write to");
  expect_refused(output + " --pictures " + path("frame.yaml"), "a file has the name of the output folder");
  expect_refused(output + " --also " + path("also.txt"), "no format of modal data has this extension");
  expect_refused("-o " + path("frame.yaml"), "the output would replace an input");
  expect_refused(output + " --html " + path("frame.yaml"), "the output would replace an input");
  expect_refused(output + " --also " + path("free.h5"), "two outputs have the same name");
  expect_refused(output + " --html " + path("./free.h5"), "two outputs have the same name");
  EXPECT_EQ(contents("frame.yaml"), kFrame);
}

TEST_F(IdentifyCommand, MayReplaceNoTableThatItReads) {
  ASSERT_EQ(identify("frame.yaml", "-o " + path("free.h5") + " --also " + path("test.csv")).code, 0);
  files_.write("tables.yaml", "wishbone: 1\nidentification: {measured: {file: test.csv}}\n");
  const Answer answer = identify("tables.yaml", "-o " + path("x.h5") + " --also " + path("test.csv"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("test_nodes.csv: error: the output would replace an input"));
  EXPECT_EQ(identify("tables.yaml", "-o " + path("x.h5")).code, 0);
}

TEST_F(IdentifyCommand, LeavesNothingBehindOnBadInput) {
  files_.write("bad.yaml", "wishbone: 1\nidentification: {measured: {from: model}}\n");
  const Answer answer = identify("bad.yaml", "-o " + path("free.h5") + " --html " + path("page.html") +
                                                 " --pictures " + path("pictures"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text,
            "bad.yaml:2:35: identification.measured.from: error: there is no model to take modes from (got "
            "'model')\n  add the section 'model'\n");
  EXPECT_THAT(names(), testing::ElementsAre("bad.yaml", "frame.yaml"));
}

TEST_F(IdentifyCommand, TellsWhichFileAnIdentificationFailedFor) {
  const Answer answer = identify("frame.yaml", "--set modes=5 -o " + path("free.h5"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(
      answer.text,
      "frame.yaml:6:1: support: error: there must be more modes than rigid-body motions on springs (got "
      "5 modes, 6 such motions)\n  measure more modes\n");
  EXPECT_THAT(names(), testing::ElementsAre("frame.yaml"));
}

TEST_F(IdentifyCommand, TellsWhatToDoubt) {
  const Answer answer = identify("frame.yaml", "--set modes=12 --set stiffness=1e9 -o " + path("free.h5"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("warning: the kept modes cannot carry the support"));
}

TEST_F(IdentifyCommand, RefusesUniversalFilesWithoutModes) {
  for (const auto& [file, reason] : std::vector<std::pair<std::string, std::string>>{
           {"1858.uff",
            "the file holds no modes (got 2 datasets that are not read)\n  export mode shapes at nodes "
            "(dataset 55 or 2414, analysis type 2, 3 or 7)\n"},
           {"Sample_UFF58_ascii.uff",
            "the file holds no modes (got 1 function)\n  export mode shapes at nodes (dataset 55 or 2414, "
            "analysis type 2, 3 or 7)\n"},
           {"heat_engine_housing.uff",
            "the file holds no modes (got 10 nodes, 8 elements, 1 nodal result; left out 1 nodal results: "
            "analysis type 1 is no mode)\n  export mode shapes at nodes (dataset 55 or 2414, analysis type "
            "2, 3 or 7)\n"},
           {"mesh_Oros-modal_uff15_uff2412.uff",
            "the file holds no modes (got 96 nodes, 1 coordinate system, 72 elements)\n  export mode shapes "
            "at nodes (dataset 55 or 2414, analysis type 2, 3 or 7)\n"},
           {"uff55_translation.uff",
            "4 nodes of the mode shapes have no position (got node 1 and others; the file holds 3 nodal "
            "results)\n  export the geometry into the same file (dataset 15 or 2411)\n"}}) {
    std::filesystem::copy(std::string(WISHBONE_TEST_DATA) + "/uff/" + file, files_ / "test.uff",
                          std::filesystem::copy_options::overwrite_existing);
    files_.write("test.yaml", "wishbone: 1\nidentification: {measured: {file: test.uff}}\n");
    const Answer answer = identify("test.yaml", "-o " + path("free.h5"));
    EXPECT_EQ(answer.code, 2) << file;
    EXPECT_EQ(answer.text, "test.uff: error: " + reason) << file;
    EXPECT_FALSE(std::filesystem::exists(files_ / "free.h5"));
  }
}

/// A scene of one free body whose modes are identified.
constexpr std::string_view kScene = R"(wishbone: 1
parameters:
  kept: {default: 36}
  stiffness: {default: 47 kN/m}
bodies:
  frame:
    form: modal
    position: [0, 0, 0]
    flexible:
      block: {size: [1.2, 0.4, 0.3], elements: [2, 1, 1]}
      material: {young: 210 MPa, poisson: 0.3, density: 2600}
      modes:
        measured: {from: model, modes: = kept}
        support: {springs: [{nodes: [1, 2, 11, 12], stiffness: = stiffness}]}
joints:
  float: {type: free, bodies: [ground, frame]}
analysis: {duration: 1 ms}
)";

TEST_F(IdentifyCommand, PlanSaysWhatIsIdentified) {
  const std::string scene = files_.write("scene.yaml", kScene);
  const Answer lines = call("plan " + scene);
  EXPECT_EQ(lines.code, 0) << lines.text;
  EXPECT_THAT(lines.text, HasSubstr("frame: 30 modes identified from 36 measured ones on 12 springs"));
  EXPECT_THAT(lines.text, Not(HasSubstr("warning")));
  const auto json = nlohmann::json::parse(call("plan --json " + scene).text);
  EXPECT_EQ(json["identified"].size(), 1u);
}

TEST_F(IdentifyCommand, PlanAndRunWarnOnStandardError) {
  const std::string scene = files_.write("scene.yaml", kScene);
  const std::string run = "run " + scene + " --set kept=12 --set stiffness=1e9 -o " + path("run.h5");
  for (const std::string& arguments : {"plan " + scene + " --set kept=12 --set stiffness=1e9", run}) {
    const Answer both = call(arguments);
    EXPECT_EQ(both.code, 0) << both.text;
    EXPECT_THAT(both.text, HasSubstr("frame: warning: ")) << arguments;
    EXPECT_THAT(call(arguments + " 2>/dev/null #").text, Not(HasSubstr("warning:"))) << arguments;
  }
  const ModalData kept = read_mode_file(path("run.frame_modes.h5"));
  EXPECT_EQ(kept.mode_count(), 6);
}

TEST_F(IdentifyCommand, RunThatRecordsNothingIsRefusedBeforeItReplacesModes) {
  const std::string scene =
      files_.write("scene.yaml", std::string(kScene) + "output: {record: [/absent/*]}\n");
  std::ofstream(path("run.frame_modes.h5")) << "earlier";
  const Answer answer = call("run " + scene + " -o " + path("run.h5"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, AllOf(HasSubstr("scene.yaml:"), HasSubstr("no signal matches (got /absent/*)")));
  std::string kept;
  std::ifstream(path("run.frame_modes.h5")) >> kept;
  EXPECT_EQ(kept, "earlier");
}

}  // namespace
}  // namespace wishbone
