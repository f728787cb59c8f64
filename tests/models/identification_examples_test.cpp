// Files for `wishbone identify` carried through, and the examples: they give the modes of their models.
#include "models/identification_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/formats/csv_modal_data.h"
#include "identification/judgement/mac.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

constexpr const char* kGood = R"(wishbone: 1
identification:
  model:
    block: {size: [2.4, 0.4, 0.4], elements: [4, 1, 1], element: mean_dilatation}
    material: {young: 210 MPa, poisson: 0.3, density: 2600}
  measured: {from: model}
)";

constexpr const char* kSupport = R"(  support:
    joints: [{node: 1, axes: xyz}, {node: 18, axes: y}, {nodes: [2, 17], axes: z}]
)";

class IdentificationExampleFiles : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& more) const {
    return files_.write("a.yaml", std::string(kGood) + more);
  }
  std::string refusal(const std::string& more) const {
    const auto file = write(more);
    return files_.relative(message_of<InputError>([&] { load_identification(file); }));
  }
  Identification identified(const std::string& more) const {
    return identify(load_identification(write(more)).task);
  }
  TextFiles files_;
};

TEST_F(IdentificationExampleFiles, RefuseAVirtualTestWhoseSupportHoldsNotEverything) {
  for (const char* stiffness : {"[0, 0, 4e4]", "[0, 0, 4e5]", "[3e3, 0, 7e4]"})
    EXPECT_THAT(refusal(std::string("  support: {springs: [{nodes: [1, 2, 17, 18], stiffness: ") + stiffness +
                        "}]}\n"),
                HasSubstr("the support leaves rigid-body motion of the model free"));
}

TEST_F(IdentificationExampleFiles, RefuseScatterThatNoModeSurvives) {
  EXPECT_THAT(refusal("  noise: {shapes: 10 %}\n"),
              HasSubstr("identification.noise.shapes: error: shapes that scatter"));
}

TEST_F(IdentificationExampleFiles, NeedNoRowsOfFreedomsThatJointsHold) {
  const IdentificationTask full = load_identification(write(kSupport)).task;
  ModalData short_of_rows = full.measured;
  std::vector<int> rows;
  for (int i = 0; i < full.measured.freedom_count(); ++i)
    if (full.measured.shapes.row(i).cwiseAbs().maxCoeff() > 1e-12) rows.push_back(i);
  ASSERT_EQ(rows.size(), 54u);
  short_of_rows.shapes = MatrixX(full.measured.shapes(rows, Eigen::all));
  short_of_rows.freedoms.clear();
  for (const int i : rows)
    short_of_rows.freedoms.push_back(full.measured.freedoms[static_cast<std::size_t>(i)]);
  write_csv_modal_data(csv_modal_files(files_ / "m.csv"), short_of_rows);

  const auto file = files_.write(
      "b.yaml", std::string("wishbone: 1\nidentification:\n  measured: {file: m.csv}\n") + kSupport);
  const IdentificationTask task = load_identification(file).task;
  EXPECT_EQ(task.measured.freedoms, full.measured.freedoms);
  EXPECT_LT((identify(task).modes.omega - identify(full).modes.omega).norm(), 1e-9);
}

TEST_F(IdentificationExampleFiles, ChangeNodesThatOnlyTheModelHas) {
  // a spring to the node that the test did not see is a change all the same
  const std::string change =
      "  find: changed\n  change: {springs: [{nodes: [9, 11], stiffness: 200 kN/m}], masses: [{node: 10, "
      "mass: 9 kg}]}\n";
  const Identification direct = identified(change);
  ModalData seen = load_identification(write("")).task.measured.with_modes({0, 1, 2, 3});
  std::vector<int> rows;
  for (int i = 0; i < seen.freedom_count(); ++i)
    if (const int node = seen.freedoms[static_cast<std::size_t>(i)].node; node != 9) rows.push_back(i);
  seen.shapes = MatrixX(seen.shapes(rows, Eigen::all));
  std::vector<Freedom> freedoms;
  for (const int i : rows) freedoms.push_back(seen.freedoms[static_cast<std::size_t>(i)]);
  seen.freedoms = freedoms;
  write_csv_modal_data(csv_modal_files(files_ / "m.csv"), seen);
  std::string text = std::string(kGood) + "  expansion: serep\n" + change;
  text.replace(text.find("from: model"), 11, "file: m.csv");
  const Identification expanded = identify(load_identification(files_.write("b.yaml", text)).task);
  // four modes cannot follow the change as all of them do: upper bounds, and near for so small a change
  for (int j = 0; j < 3; ++j) {
    EXPECT_GE(expanded.modes.omega[j], (1 - 1e-9) * direct.modes.omega[j]);
    EXPECT_NEAR(expanded.modes.omega[j], direct.modes.omega[j], 0.02 * direct.modes.omega[j]);
  }
}

TEST_F(IdentificationExampleFiles, GiveABodyItsNodesWhateverBlockStandsBeside) {
  const auto measured = std::filesystem::canonical(std::filesystem::path(WISHBONE_SCENES) / ".." /
                                                   "identification" / "examples");
  const auto file =
      files_.write("scene.yaml", R"(wishbone: 1
bodies:
  frame:
    form: modal
    position: [0, 0, 0]
    flexible:
      block: {size: [9, 0.4, 0.4], elements: [4, 1, 1], element: mean_dilatation}
      material: {young: 210 MPa, poisson: 0.3, density: 2600}
      modes: {measured: {file: )" + (measured / "chassis_test.unv").string() +
                                     "}, mass: {file: " + (measured / "chassis_masses.csv").string() +
                                     "}}\n");
  const Scene scene = load_scene(file);
  EXPECT_LT((scene.bodies[0].flexible->node_position.col(0) - Vector3(-1.2, -0.2, -0.2)).norm(), 1e-12);
}

/// Largest frequency error of the `count` lowest modes of an example against its model.
double worst_error(const std::string& example, int count, const std::vector<std::string>& set = {}) {
  const auto path = std::filesystem::path(WISHBONE_SCENES) / ".." / "identification" / example;
  IdentificationTask task = load_identification(path, set).task;
  task.noise.reset();  // 200 repetitions do not change the modes
  const Identification result = identify(task);
  EXPECT_TRUE(result.judgement.reference.has_value());
  return result.judgement.reference->frequency_error.head(count).cwiseAbs().maxCoeff();
}

TEST(IdentificationExamples, GiveAllFreeModesOfACompleteTest) {
  EXPECT_LT(worst_error("chassis_on_springs.yaml", 54), 1e-11);
  EXPECT_LT(worst_error("chassis_on_joints.yaml", 54), 1e-11);
}

TEST(IdentificationExamples, GiveTheFreeModesOfATestByUniversalFileToItsDigits) {
  // six digits of the file, and what the 30 modes of 60 leave out
  EXPECT_LT(worst_error("examples/chassis_test.yaml", 8), 1e-5);
  EXPECT_LT(worst_error("examples/chassis_test.yaml", 23), 2e-4);
}

TEST(IdentificationExamples, SayHowTheMeasuredFileWasMade) {
  const auto folder = std::filesystem::path(WISHBONE_SCENES) / ".." / "identification" / "examples";
  const Identification made = identify(load_identification(folder / "virtual_test.yaml").task);
  const ModalData read = load_identification(folder / "chassis_test.yaml").task.measured;
  ASSERT_EQ(read.mode_count(), made.modes.mode_count());
  EXPECT_LT((read.omega - made.modes.omega).cwiseQuotient(read.omega).cwiseAbs().maxCoeff(), 1e-5);
}

std::filesystem::path input(const std::string& name) {
  return std::filesystem::path(WISHBONE_TEST_DATA) / "identify" / name;
}

TEST(IdentificationInputs, OfAModelThatIsHeldNameItsNodes) {
  EXPECT_THAT(
      message_of<InputError>([] { load_identification(input("held_model.yaml")); }),
      HasSubstr(
          "its stiffness must not resist rigid-body motion: the model is that of the free structure (got "
          "nodes "));
}

TEST(IdentificationInputs, KeepElasticModesBesideARigidOneOfFiveDigits) {
  const IdentificationTask task = load_identification(input("near_rigid.yaml")).task;
  const Identification found = identify(task);
  ASSERT_EQ(found.modes.mode_count(), 2);
  const double kTwoPi = 2 * 3.141592653589793;
  EXPECT_NEAR(found.modes.omega[0] / kTwoPi, 31.367, 1e-6);
  EXPECT_NEAR(found.modes.omega[1] / kTwoPi, 39.723, 1e-6);
  const MatrixX mac = modal_assurance(found.modes.shapes, task.measured.shapes.rightCols(2));
  EXPECT_GE(mac.diagonal().minCoeff(), 1 - 1e-8);
}

/// Scatter of shapes whose exact ones are known up to their scales: root mean square over all modes.
double true_scatter(const MatrixX& shapes, const MatrixX& exact) {
  const MatrixX a = shapes.colwise().normalized(), b = exact.colwise().normalized();
  const VectorX cosine = a.cwiseProduct(b).colwise().sum().transpose();
  return std::sqrt((a - b * cosine.asDiagonal()).squaredNorm() / static_cast<double>(a.cols()));
}

TEST(IdentificationInputs, OfScatteredModesNeedNoNoiseToBeStated) {
  IdentificationTask task = load_identification(input("scattered.yaml")).task;
  const Identification found = identify(task);
  // the example has the same shapes as they were before scatter was added
  const auto example = std::filesystem::path(WISHBONE_SCENES) / ".." / "identification" / "examples";
  const ModalData exact = load_identification(example / "chassis_test.yaml").task.measured;
  ASSERT_EQ(exact.freedoms, task.measured.freedoms);
  const double scatter = true_scatter(task.measured.shapes, exact.shapes);
  EXPECT_NEAR(scatter, 0.01, 5e-4);
  EXPECT_NEAR(found.judgement.shape_scatter, scatter, 0.1 * scatter);
  const VectorX hz = found.modes.omega / (2 * 3.141592653589793);
  EXPECT_NEAR(hz[0], 17.353, 0.05);
  EXPECT_NEAR(hz[8], 57.41, 0.05);
  task.noise = MeasurementNoise{0, scatter, 2, 1};
  EXPECT_LE((identify(task).modes.omega - found.modes.omega).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace wishbone
