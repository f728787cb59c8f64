// The car of models/scenes on both manoeuvres: everything that must hold whatever the numbers are.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "models/compile.h"
#include "models/run_scene.h"
#include "models/scene_loader.h"
#include "solver/result_file.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

struct Case {
  std::string scene;
  std::vector<std::string> set;
  double duration = 0.6;
  double tolerance = 1e-8;
  Form form = Form::automatic;
  Method method = Method::automatic;
};

/// All signals of one run, by path.
struct Result {
  TransientSummary summary;
  VectorX time;
  std::map<std::string, MatrixX> signals;
  const MatrixX& operator[](const std::string& path) const { return signals.at(path); }
};

Result run(const Case& c) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(std::string(WISHBONE_SCENES) + "/" + c.scene + ".yaml", c.set);
  CompiledScene compiled = compile(scene);
  compiled.transient.duration = c.duration;
  compiled.transient.integrator.rtol = c.tolerance;
  compiled.transient.integrator.atol = 0.1 * c.tolerance;
  compiled.transient.integrator.form = c.form;
  compiled.transient.integrator.method = c.method;
  Result result;
  result.summary = run_scene(scene, compiled, {c.scene, folder / "run.h5", c.set, {}}).summary;
  EXPECT_EQ(result.summary.status, TransientSummary::Status::complete) << result.summary.message;
  const ResultFile file(folder / "run.h5");
  result.time = file.time();
  for (const Signal& signal : file.signals()) result.signals[signal.path] = file.read(signal.path);
  return result;
}

/// Largest difference of a signal relative to its largest value.
double difference(const Result& a, const Result& b, const std::string& path) {
  return (a[path] - b[path]).cwiseAbs().maxCoeff() / std::max(b[path].cwiseAbs().maxCoeff(), 1e-300);
}

const std::vector<std::string> kVehicle = {
    "/bodies/chassis/position",  "/bodies/chassis/velocity",     "/vehicle/roll_rate",
    "/vehicle/yaw_rate",         "/vehicle/side_slip",           "/vehicle/lateral_velocity",
    "/vehicle/lateral_position", "/tires/front_left_tire/force", "/tires/rear_right_tire/deflection"};

double worst_vehicle_difference(const Result& a, const Result& b) {
  double worst = 0;
  for (const std::string& path : kVehicle) worst = std::max(worst, difference(a, b, path));
  return worst;
}

class Chassis : public ::testing::TestWithParam<const char*> {
 protected:
  std::vector<std::string> set(std::vector<std::string> more = {}) const {
    more.push_back(std::string("chassis=") + GetParam());
    return more;
  }
};

TEST_P(Chassis, LinksFloatingOrHungAreTheSameCar) {
  const Result floating = run({"impulse_steer", set({"suspension=floating"})});
  const Result hung = run({"impulse_steer", set({"suspension=hung"})});
  EXPECT_LT(worst_vehicle_difference(hung, floating), 1e-6);
}

TEST_P(Chassis, ProjectedAndGglFormsGiveTheSameMotion) {
  const Result index1 = run({"impulse_steer", set()});
  const Result ggl = run({"impulse_steer", set(), 0.6, 1e-8, Form::ggl});
  EXPECT_LT(worst_vehicle_difference(ggl, index1), 1e-6);
}

TEST_P(Chassis, TighterTolerancesConverge) {
  const Result reference = run({"impulse_steer", set(), 0.5, 1e-11});
  double previous = 1;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const double error = worst_vehicle_difference(run({"impulse_steer", set(), 0.5, tolerance}), reference);
    EXPECT_LT(error, 10 * tolerance);
    EXPECT_LT(error, 0.2 * previous) << "two decades of tolerance gain less than five times";
    previous = error;
  }
}

TEST_P(Chassis, EnergyBookCloses) {
  for (const char* scene : {"sine_depression", "impulse_steer"}) {
    const Result r = run({scene, set({"damping=5 %"}), 0.7, 1e-8});
    const MatrixX& balance = r["/energy/balance"];
    const double lost = r["/energy/dissipated"].cwiseAbs().maxCoeff();
    ASSERT_GT(lost, 100) << "the dampers and tires must have done something [J]";
    EXPECT_LT((balance.array() - balance(0, 0)).abs().maxCoeff(), 1e-5 * lost) << scene;
  }
}

TEST_P(Chassis, LoopsStayClosed) {
  const Result r = run({"sine_depression", set(), 0.7, 1e-5});
  EXPECT_LT(r["/constraints/position_residual"].maxCoeff(), 1e-11);
  EXPECT_LT(r["/constraints/velocity_residual"].maxCoeff(), 1e-11);
}

TEST_P(Chassis, RunsStraightOnALevelRoad) {
  // the mirror image of the car is the car: without bank nothing may turn it
  const Result r = run({"sine_depression", set({"bank=0 deg"}), 0.7, 1e-8});
  EXPECT_LT(r["/vehicle/lateral_position"].cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(r["/vehicle/yaw_rate"].cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((r["/tires/front_left_tire/force"].col(2) - r["/tires/front_right_tire/force"].col(2))
                .cwiseAbs()
                .maxCoeff(),
            1e-5);
}

TEST_P(Chassis, SteeringLeftTurnsLeft) {
  const Result r = run({"impulse_steer", set(), 0.55, 1e-6});
  EXPECT_GT(r["/vehicle/yaw_rate"].maxCoeff(), 0.1);
  EXPECT_GT(r["/vehicle/lateral_position"](r.time.size() - 1, 0), 0.01);
  // the outer (right) tires carry more
  const Eigen::Index last = r.time.size() - 1;
  EXPECT_GT(r["/tires/front_right_tire/force"](last, 2), r["/tires/front_left_tire/force"](last, 2));
}

TEST_P(Chassis, StaysOnTheRoad) {
  for (const char* scene : {"sine_depression", "impulse_steer"}) {
    const Result r = run({scene, set(), 1.0, 1e-5});
    for (const char* tire : {"front_left", "front_right", "rear_left", "rear_right"})
      EXPECT_GT(r[std::string("/tires/") + tire + "_tire/deflection"].minCoeff(), 0.005)
          << scene << " " << tire;
  }
}

TEST_P(Chassis, RepeatsBitForBit) {
  const Result a = run({"sine_depression", set(), 0.4, 1e-5});
  const Result b = run({"sine_depression", set(), 0.4, 1e-5});
  ASSERT_EQ(a.signals.size(), b.signals.size());
  for (const auto& [path, values] : a.signals) EXPECT_TRUE((values.array() == b[path].array()).all()) << path;
}

INSTANTIATE_TEST_SUITE_P(Car, Chassis, ::testing::Values("rigid", "modal"),
                         [](const auto& chassis) { return std::string(chassis.param); });

class IdentifiedChassis : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(IdentifiedChassis, DrivesAsTheModelDoes) {
  const auto [scene, chassis] = GetParam();
  const Result modal = run({scene, {"chassis=modal"}, 0.7, 1e-8});
  const Result identified = run({scene, {std::string("chassis=") + chassis}, 0.7, 1e-8});
  ASSERT_EQ(identified.time, modal.time);
  EXPECT_LT(worst_vehicle_difference(identified, modal), 1e-6);
  for (const auto& [path, values] : modal.signals) {
    if (!path.starts_with("/vehicle/")) continue;
    EXPECT_LT(difference(identified, modal, path), 1e-6) << path;
  }
  EXPECT_LT(difference(identified, modal, "/flexible/chassis/deflection"), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Car, IdentifiedChassis,
                         ::testing::Combine(::testing::Values("sine_depression", "impulse_steer"),
                                            ::testing::Values("springs", "joints")),
                         [](const auto& c) {
                           return std::string(std::get<0>(c.param)) + "_" + std::get<1>(c.param);
                         });

TEST(Car, RigidChassisHasOneRedundantRowALink) {
  const Result r = run({"impulse_steer", {"chassis=rigid"}, 0.01, 1e-5});
  EXPECT_EQ(r.summary.assembly.redundant_rows.size(), 4u);
  const Result flexible = run({"impulse_steer", {"chassis=modal"}, 0.01, 1e-5});
  EXPECT_TRUE(flexible.summary.assembly.redundant_rows.empty());
}

TEST(Car, ChassisSagsByThreeMillimetresWhenLetGo) {
  // source, chapter 7: 3.1 mm at nodes 19 and 20 (for tire data of its own: the size, not the digits)
  const Result r = run({"impulse_steer", {"chassis=modal"}, 0.2, 1e-6});
  const MatrixX& d = r["/flexible/chassis/deflection"];  // nodes 19 and 20, x y z each
  EXPECT_NEAR(d.col(2).cwiseAbs().maxCoeff(), 3e-3, 0.5e-3);
  EXPECT_NEAR(d.col(5).cwiseAbs().maxCoeff(), 3e-3, 0.5e-3);
}

TEST(Car, ChassisBendsByMillimetresInTheDepression) {
  // source, chapter 7: 4.5 mm vertical at node 20 for tire data and free lengths of its own: the size, not the digits
  const Result r = run({"sine_depression", {"chassis=modal"}, 0.7, 1e-5});
  const double node_20 = r["/flexible/chassis/deflection"].col(5).cwiseAbs().maxCoeff();
  EXPECT_GT(node_20, 2e-3);
  EXPECT_LT(node_20, 7e-3);
}

TEST(Car, RigidAndFlexibleChassisDifferVisibly) {
  const Result rigid = run({"impulse_steer", {"chassis=rigid"}, 1.2, 1e-5});
  const Result flexible = run({"impulse_steer", {"chassis=modal"}, 1.2, 1e-5});
  EXPECT_GT(difference(flexible, rigid, "/vehicle/roll_rate"), 0.1);
  EXPECT_GT(difference(flexible, rigid, "/vehicle/yaw_rate"), 0.1);
}

TEST(Car, ChassisOfAModalTestIsNearToItsModelWithAsManyModes) {
  // what the test adds is small beside what leaving out 30 of the 54 modes changes
  const Result test = run({"impulse_steer", {"chassis=test"}, 0.6, 1e-6});
  const Result as_many = run({"impulse_steer", {"chassis=modal", "modes=24"}, 0.6, 1e-6});
  const Result all = run({"impulse_steer", {"chassis=modal"}, 0.6, 1e-6});
  ASSERT_EQ(test["/flexible/chassis/modal_coordinates"].cols(), 24);
  for (const char* signal : {"/vehicle/lateral_position", "/vehicle/yaw_rate", "/vehicle/roll_rate",
                             "/vehicle/side_slip", "/flexible/chassis/deflection"})
    EXPECT_LT(difference(test, as_many, signal), 0.2 * difference(all, as_many, signal)) << signal;
}

TEST(Car, StructuralDampingCalmsTheChassis) {
  const auto late_swing = [](const Result& r) {
    // what is left besides ringing follows the bounce of the car, a tenth of the sag
    const MatrixX z = r["/flexible/chassis/modal_coordinates"].bottomRows(20);
    return (z.colwise().maxCoeff() - z.colwise().minCoeff()).sum();
  };
  const Result free = run({"impulse_steer", {"damping=0"}, 0.3, 1e-5});
  const Result damped = run({"impulse_steer", {"damping=5 %"}, 0.3, 1e-5});
  EXPECT_LT(late_swing(damped), 0.5 * late_swing(free));
}

/// Manoeuvre, bank and damping.
class FlexibleForms : public ::testing::TestWithParam<std::tuple<std::string, std::string, std::string>> {
 protected:
  Result run_as(const std::string& chassis, double tolerance, double duration = 0.4) const {
    const auto [scene, bank, damping] = GetParam();
    return run({scene, {"chassis=" + chassis, "bank=" + bank, "damping=" + damping}, duration, tolerance});
  }
};

TEST_P(FlexibleForms, NodalAndModalWithAllModesAreTheSameSystem) {
  const Result modal = run_as("modal", 1e-10), nodal = run_as("nodal", 1e-10);
  EXPECT_LT(difference(nodal, modal, "/flexible/chassis/deflection"), 1e-7);
  for (const std::string& path : kVehicle) {
    // on a level depression the car runs straight: what symmetry keeps at zero has no size to compare with
    const bool stays_zero = modal[path].cwiseAbs().maxCoeff() < 1e-8;
    if (stays_zero)
      EXPECT_LT(nodal[path].cwiseAbs().maxCoeff(), 1e-8) << path;
    else
      EXPECT_LT(difference(nodal, modal, path), 1e-7) << path;
  }
}

INSTANTIATE_TEST_SUITE_P(Car, FlexibleForms,
                         ::testing::Combine(::testing::Values("impulse_steer", "sine_depression"),
                                            ::testing::Values("0 deg", "6 deg"),
                                            ::testing::Values("0 %", "5 %")),
                         [](const auto& tested) {
                           return std::get<0>(tested.param) + "_bank_" + std::get<1>(tested.param).front() +
                                  "_damping_" + std::get<2>(tested.param).front();
                         });

}  // namespace
}  // namespace wishbone
