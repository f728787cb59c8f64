// What scenes record of flexible bodies: where it stands in the file, and that it is what acts on them.
#include <gmock/gmock.h>

#include <cmath>

#include "core/error.h"
#include "identification/formats/matrix_market.h"
#include "models/broken_text.h"
#include "models/ran_scene.h"

namespace wishbone {
namespace {

Matrix3 rotation_from(const MatrixX& orientation, Eigen::Index row) {
  return Quaternion(orientation(row, 0), orientation(row, 1), orientation(row, 2), orientation(row, 3))
      .toRotationMatrix();
}

// A beam that swings on a ball joint at its node 1, pulled by a spring at node 12 and a load at node 7.
constexpr const char* kSwingingBeam = R"(
wishbone: 1
bodies:
  beam:
    form: modal
    position: [0, 0, 0]
    flexible: {block: {size: [1, 0.1, 0.1], elements: [2, 1, 1]}, material: {young: 100 MPa, poisson: 0.3, density: 1000}, modes: 12, damping: 5 %}
joints:
  hold: {type: spherical, bodies: [ground, {body: beam, node: 1}]}
springs:
  pull: {from: {body: beam, node: 12}, to: {ground: [1, 0.5, 1]}, stiffness: 200, free_length: 0.5}
loads:
  push: {body: beam, node: 7, force: [0, {expression: 20*sin(60*t)}, 5], moment: [0.5, 0, 0]}
analysis: {duration: 0.2 s, rtol: 1e-10, atol: 1e-11}
output:
  interval: 0.0001 s
  nodes: {beam: [12, 7]}
  flexible: {beam: [deflection_rates, modal_rates, modal_accelerations, energies, modal_energies, interface_forces]}
  points: {far: {body: beam, node: 12}, near: {body: beam, node: 1}}
)";

class SwingingBeam : public testing::Test {
 protected:
  static void SetUpTestSuite() { run_ = std::make_unique<RanScene>(kSwingingBeam); }
  static void TearDownTestSuite() { run_.reset(); }
  /// A vector of a signal of vectors, as a column for each row of the file.
  static Matrix3X vectors(const std::string& path, int index = 0) {
    return run_->read(path).middleCols<3>(3 * index).transpose();
  }
  static inline std::unique_ptr<RanScene> run_;
};

TEST_F(SwingingBeam, SignalsHaveTheirPlacesShapesUnitsAndFrames) {
  const auto expect = [&](const std::string& path, std::vector<int> shape, const char* units,
                          const char* frame) {
    const Signal* signal = run_->file().find(path);
    ASSERT_NE(signal, nullptr) << path;
    EXPECT_EQ(signal->shape, shape) << path;
    EXPECT_EQ(signal->units, units) << path;
    EXPECT_EQ(signal->frame, frame) << path;
    EXPECT_FALSE(signal->about.empty()) << path;
  };
  expect("/flexible/beam/modal_coordinates", {12}, "m kg^0.5", "");
  expect("/flexible/beam/modal_rates", {12}, "m kg^0.5 s-1", "");
  expect("/flexible/beam/modal_accelerations", {12}, "m kg^0.5 s-2", "");
  expect("/flexible/beam/deflection", {2, 3}, "m", "body");
  expect("/flexible/beam/deflection_rate", {2, 3}, "m/s", "body");
  expect("/flexible/beam/modal_strain_energy", {12}, "J", "");
  expect("/flexible/beam/modal_kinetic_energy", {12}, "J", "");
  expect("/flexible/beam/strain_energy", {}, "J", "");
  expect("/flexible/beam/kinetic_energy", {}, "J", "");
  expect("/flexible/beam/vibration_energy", {}, "J", "");
  expect("/flexible/beam/interface_force", {3, 3}, "N", "body");
  expect("/flexible/beam/interface_moment", {3, 3}, "N m", "body");
  const auto nodes = [&](const char* path) { return run_->file().find(path)->lists.at("nodes"); };
  EXPECT_THAT(nodes("/flexible/beam/deflection_rate"), testing::ElementsAre("12", "7"));
  EXPECT_THAT(nodes("/flexible/beam/interface_force"), testing::ElementsAre("1", "12", "7"));
  EXPECT_THAT(nodes("/flexible/beam/interface_moment"), testing::ElementsAre("1", "12", "7"));
}

TEST_F(SwingingBeam, InterfaceForcesAreThoseOfTheJointTheSpringAndTheLoad) {
  const MatrixX orientation = run_->read("/bodies/beam/orientation"), pull = run_->read("/forces/pull/force");
  const Matrix3X on_ground = vectors("/joints/hold/force"), end = vectors("/points/far/position"),
                 force = vectors("/loads/push/force"), moment = vectors("/loads/push/moment");
  const Matrix3X at_joint = vectors("/flexible/beam/interface_force", 0),
                 at_spring = vectors("/flexible/beam/interface_force", 1),
                 at_load = vectors("/flexible/beam/interface_force", 2),
                 moment_at_load = vectors("/flexible/beam/interface_moment", 2);
  for (Eigen::Index i = 0; i < orientation.rows(); i += 50) {
    const Matrix3 R_WB = rotation_from(orientation, i);
    const Vector3 along = (Vector3(1, 0.5, 1) - end.col(i)).normalized();
    EXPECT_LT((R_WB * at_joint.col(i) + on_ground.col(i)).norm(), 1e-9) << i;
    EXPECT_LT((R_WB * at_spring.col(i) - pull(i, 0) * along).norm(), 1e-9) << i;
    EXPECT_LT((R_WB * at_load.col(i) - force.col(i)).norm(), 1e-12) << i;
    EXPECT_LT((R_WB * moment_at_load.col(i) - moment.col(i)).norm(), 1e-13) << i;
  }
  EXPECT_GT(at_joint.colwise().norm().maxCoeff(), 50) << "the joint works [N]";
}

TEST_F(SwingingBeam, InterfaceForcesMoveTheMassCentre) {
  // m (v' - g), v' by central differences over 0.1 ms, whose error is h^2/6 of the second derivative of v'
  const double m = 1000 * 0.1 * 0.1, h = 1e-4;
  const MatrixX orientation = run_->read("/bodies/beam/orientation");
  const Matrix3X v = vectors("/bodies/beam/velocity");
  Matrix3X sum = vectors("/flexible/beam/interface_force", 0) + vectors("/flexible/beam/interface_force", 1) +
                 vectors("/flexible/beam/interface_force", 2);
  for (Eigen::Index i = 50; i + 1 < v.cols(); i += 50) {
    const Vector3 inertia = m * ((v.col(i + 1) - v.col(i - 1)) / (2 * h) + Vector3(0, 0, 9.81));
    EXPECT_LT((rotation_from(orientation, i) * sum.col(i) - inertia).norm(), 1e-3 * inertia.norm()) << i;
  }
}

TEST_F(SwingingBeam, RatesAreThoseOfWhatTheyBelongTo) {
  const double h = 1e-4;
  for (const auto& [path, rate_path] : {std::pair("modal_coordinates", "modal_rates"),
                                        {"modal_rates", "modal_accelerations"},
                                        {"deflection", "deflection_rate"}}) {
    const MatrixX u = run_->read(std::string("/flexible/beam/") + path),
                  rate = run_->read(std::string("/flexible/beam/") + rate_path);
    const double scale = rate.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 50; i + 1 < u.rows(); i += 100)
      EXPECT_LT((rate.row(i) - (u.row(i + 1) - u.row(i - 1)) / (2 * h)).cwiseAbs().maxCoeff(), 2e-2 * scale)
          << rate_path << " " << i;
  }
}

TEST_F(SwingingBeam, EnergiesOfTheModesSumToThoseOfTheScene) {
  const VectorX strain = run_->read("/flexible/beam/modal_strain_energy").rowwise().sum();
  EXPECT_LT((strain - run_->read("/energy/elastic")).norm(), 1e-12 * strain.norm());
  EXPECT_EQ(run_->read("/flexible/beam/kinetic_energy"), run_->read("/energy/kinetic"));
  EXPECT_GT(strain.maxCoeff(), 1e-3) << "it bends [J]";
}

// A bar under equal and opposite tractions at its ends, which its damping brings to rest: everywhere the strain F/(E A).
constexpr const char* kPulledBar = R"(
wishbone: 1
gravity: [0, 0, 0]
bodies:
  bar:
    form: modal
    position: [0, 0, 0]
    flexible: {block: {size: [1, 0.1, 0.2], elements: [4, 1, 1]}, material: {young: 100 MPa, poisson: 0.3, density: 1000}, modes: all, damping: 1}
loads:
  left_{i}: {repeat: {i: [1, 4]}, body: bar, node: = i, force: [-500 N, 0, 0]}
  right_{i}: {repeat: {i: [17, 20]}, body: bar, node: = i, force: [500 N, 0, 0]}
analysis: {duration: 0.1 s, rtol: 1e-9, atol: 1e-12}
output:
  interval: 0.1 s
  nodes: {bar: [20]}
)";

class PulledBar : public testing::Test {
 protected:
  /// Psi of the bar, 60 x 54.
  MatrixX shapes() const {
    const Scene scene = load_scene(files_.write("bar.yaml", kPulledBar));
    return compile(scene).system.flexible[0].modal.set().shapes;
  }
  RanScene run_with(const std::string& recovery) const {
    return RanScene(load_scene(files_.write("scene.yaml", std::string(kPulledBar) + recovery)));
  }
  const TextFiles files_;
};

/// Mean axial strain of each element [1]: four elements of 0.25 m between sections of four nodes.
MatrixX axial_strain(const MatrixX& shapes) {
  MatrixX R = MatrixX::Zero(4, shapes.cols());
  for (int element = 0; element < 4; ++element)
    for (int corner = 0; corner < 4; ++corner) {
      const int node = 4 * element + corner;
      R.row(element) += (shapes.row(3 * (node + 4)) - shapes.row(3 * node)) / (4 * 0.25);
    }
  return R;
}

TEST_F(PulledBar, RecoversTheStrainAndTheStressOfUniformTension) {
  const MatrixX R = axial_strain(shapes());
  write_matrix_market(files_ / "strain.mtx", R.sparseView(), false);
  write_matrix_market(files_ / "stress.mtx", (100 * R).eval().sparseView(), false);  // E = 100 MPa
  const RanScene run = run_with(R"(
  recovery:
    strain: {body: bar, file: strain.mtx, unit: 1}
    stress: {body: bar, file: stress.mtx, unit: MPa, rows: [4, 2]}
)");
  // F/(E A) = 2000 N/(100 MPa 0.02 m2)
  const MatrixX strain = run.read("/recovery/strain"), stress = run.read("/recovery/stress");
  EXPECT_EQ(strain.row(0), Eigen::RowVector4d::Zero());
  EXPECT_LT((strain.row(1).array() - 1e-3).abs().maxCoeff(), 1e-9);
  EXPECT_LT((stress.row(1).array() - 0.1).abs().maxCoeff(), 1e-7);
  EXPECT_EQ(run.file().find("/recovery/strain")->units, "1");
  EXPECT_EQ(run.file().find("/recovery/stress")->units, "MPa");
  EXPECT_THAT(run.file().find("/recovery/strain")->lists.at("rows"),
              testing::ElementsAre("1", "2", "3", "4"));
  EXPECT_THAT(run.file().find("/recovery/stress")->lists.at("rows"), testing::ElementsAre("4", "2"));
}

TEST_F(PulledBar, RecoversTheDeflectionByTheShapesOfANode) {
  const MatrixX Psi = shapes();
  std::string table = "row";
  for (Eigen::Index j = 0; j < Psi.cols(); ++j) table += fmt::format(",mode {}", j + 1);
  for (const int row : {0, 57, 58, 59}) {
    table += row == 0 ? "\nother" : "\nend " + std::string(1, "xyz"[row - 57]);
    for (Eigen::Index j = 0; j < Psi.cols(); ++j) table += fmt::format(",{:.17g}", Psi(row, j));
  }
  files_.write("shapes.csv", table + "\n");
  const RanScene run = run_with(R"(
  recovery: {end: {body: bar, file: shapes.csv, unit: m, rows: [end x, end y, end z]}}
)");
  const MatrixX u = run.read("/flexible/bar/deflection");
  EXPECT_NEAR(u(1, 0), 0.5e-3, 1e-9);
  EXPECT_LT((run.read("/recovery/end") - u).cwiseAbs().maxCoeff(), 1e-16);
  EXPECT_THAT(component_names(*run.file().find("/recovery/end")),
              testing::ElementsAre("end x", "end y", "end z"));
}

constexpr std::string_view kGoodOutput = R"(wishbone: 1
parameters: {form: modal}
bodies:
  arm: {mass: 2, inertia: [1, 1, 1], position: [3, 0, 0]}
  beam:
    form: = form
    mass: 1
    inertia: [1, 1, 1]
    position: [0, 0, 0]
    flexible:
      block: {size: [1, 0.1, 0.1], elements: [2, 1, 1]}
      material: {young: 210 MPa, poisson: 0.3, density: 2600}
      modes: 2
output:
  nodes: {beam: [1]}
  flexible: {beam: [deflection_rates, energies]}
  recovery:
    stress: {body: beam, file: stress.mtx, unit: Pa, rows: [1, 3]}
    strain: {body: beam, file: strain.csv, unit: 1, rows: [top, gauge 2]}
)";

class OutputFiles : public TextFiles {
 public:
  OutputFiles() {
    write("stress.mtx", "%%MatrixMarket matrix array real general\n3 2\n1\n2\n3\n4\n5\n6\n");
    write("wide.mtx", "%%MatrixMarket matrix coordinate real general\n3 8 1\n1 8 2.5\n");
    write("strain.csv", "row, mode 1, mode 2\ntop, 1, 2\ngauge 2, 3, 4\n");
  }
};

class BrokenOutputs : public testing::TestWithParam<Broken> {};

TEST_P(BrokenOutputs, AreRefusedWithPlaceValueAndRemedy) {
  std::string scene(kGoodOutput);
  const auto at = scene.find(GetParam().text);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(scene.find(GetParam().text, at + 1), std::string::npos);
  scene.replace(at, GetParam().text.size(), GetParam().replacement);
  const OutputFiles files;
  const auto file = files.write("scene.yaml", scene);
  EXPECT_EQ(files.relative(message_of<InputError>([&] { compile(load_scene(file)); })), GetParam().message);
}

constexpr Broken kCatalogue[] = {
    Broken{"UnknownSignal", "energies", "enrgies",
           "scene.yaml:16:39: output.flexible.beam[2]: error: not one of the signals of a flexible body (got "
           "'enrgies')\n"
           "  did you mean 'energies'?"},
    Broken{"SignalTwice", "energies", "energies, energies",
           "scene.yaml:16:49: output.flexible.beam[3]: error: the signal is in the list already (got "
           "'energies')\n"
           "  remove one of the two"},
    Broken{"SignalOfMissingBody", "{beam: [deflection_rates", "{bean: [deflection_rates",
           "scene.yaml:16:14: output.flexible.bean: error: there is no 'bean' among the bodies\n"
           "  did you mean 'beam'?"},
    Broken{"SignalOfBodyWithoutModes", "{beam: [deflection_rates", "{arm: [deflection_rates",
           "scene.yaml:16:14: output.flexible.arm: error: the body 'arm' has no modes\n"
           "  name a flexible body, or give this one the key 'flexible'"},
    Broken{"RatesOfNoNodes", "  nodes: {beam: [1]}\n", "",
           "scene.yaml:15:21: output.flexible.beam[1]: error: no nodes of 'beam' are recorded (got "
           "'deflection_rates')\n"
           "  name some under 'output.nodes'"},
    Broken{"RecoveryWithoutUnit", "unit: Pa, ", "",
           "scene.yaml:18:5: output.recovery.stress: error: the key 'unit' is missing\n"
           "  add 'unit: ...' here"},
    Broken{"RecoveryInAnUnknownUnit", "unit: Pa", "unit: Pascals per mode",
           "scene.yaml:18:50: output.recovery.stress.unit: error: this is no unit (got 'Pascals per mode')\n"
           "  write it as in MPa or N/mm2; 1 for strains and other pure numbers"},
    Broken{"RecoveryOfABodyWithoutModes", "{body: beam, file: stress.mtx", "{body: arm, file: stress.mtx",
           "scene.yaml:18:20: output.recovery.stress.body: error: the body 'arm' has no modes (got 'arm')\n"
           "  name a flexible body, or give this one the key 'flexible'"},
    Broken{"RecoveryFileMissing", "stress.mtx", "sterss.mtx",
           "scene.yaml:18:32: output.recovery.stress.file: error: there is no file sterss.mtx (got "
           "'sterss.mtx')\n"
           "  names are relative to the file that they stand in"},
    Broken{"RecoveryOfOtherModes", "stress.mtx", "wide.mtx",
           "scene.yaml:18:32: output.recovery.stress.file: error: the matrix has 8 columns, the body 'beam' "
           "has 2 modes\n"
           "  give one column for each elastic mode that the body keeps, in their order; rigid-body modes "
           "have none"},
    Broken{"RecoveryOfFewerModes", "modes: 2", "modes: 3",
           "scene.yaml:18:32: output.recovery.stress.file: error: the matrix has 2 columns, the body 'beam' "
           "has 3 modes\n"
           "  give one column for each elastic mode that the body keeps, in their order; rigid-body modes "
           "have none"},
    Broken{"RecoveryOfARowBeyond", "rows: [1, 3]", "rows: [1, 4]",
           "scene.yaml:18:64: output.recovery.stress.rows[2]: error: a whole number from 1 to 3 is wanted "
           "here (got '4')\n"
           "  give one of them"},
    Broken{"RecoveryOfAnUnknownRow", "gauge 2", "gauge 3",
           "scene.yaml:19:65: output.recovery.strain.rows[2]: error: there is no 'gauge 3' among the rows of "
           "the file\n"
           "  did you mean 'gauge 2'?"},
    Broken{"RecoveryOfNoRows", "rows: [1, 3]", "rows: []",
           "scene.yaml:18:54: output.recovery.stress.rows: error: there are no rows in the list\n"
           "  remove the key to record all of them"},
    Broken{"NamesOfRowsThatHaveNone", "strain.csv", "stress.mtx",
           "scene.yaml:19:60: output.recovery.strain.rows[1]: error: not a finite number (got 'top')\n"
           "  write a number such as 0.5 or 1e3, or a number and a unit such as 120 km/h"}};

INSTANTIATE_TEST_SUITE_P(Catalogue, BrokenOutputs, testing::ValuesIn(kCatalogue),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(GoodOutput, LoadsAndRunsInEitherForm) {
  const OutputFiles files;
  const auto file = files.write("scene.yaml", kGoodOutput);
  const Scene modal = load_scene(file);
  EXPECT_EQ(modal.data_files.size(), 2u);
  ASSERT_EQ(modal.output.recoveries.size(), 2u);
  EXPECT_EQ(modal.output.recoveries[0].matrix, (MatrixX(2, 2) << 1, 4, 3, 6).finished());
  EXPECT_EQ(modal.output.recoveries[1].matrix, (MatrixX(2, 2) << 1, 2, 3, 4).finished());
  const RanScene flexible(modal), rigid(load_scene(file, {"form=rigid"}));
  EXPECT_NE(flexible.file().find("/recovery/stress"), nullptr);
  EXPECT_EQ(rigid.file().find("/recovery/stress"), nullptr);
  EXPECT_EQ(rigid.file().find("/flexible/beam/strain_energy"), nullptr);
}

}  // namespace
}  // namespace wishbone
