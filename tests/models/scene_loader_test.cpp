#include "models/scene_loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "models/scene_sections.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const Scene::Body& body_named(const Scene& scene, const std::string& name) {
  for (const auto& body : scene.bodies) {
    if (body.name == name) return body;
  }
  throw std::out_of_range(name);
}

const Scene::Joint& joint_named(const Scene& scene, const std::string& name) {
  for (const auto& joint : scene.joints) {
    if (joint.name == name) return joint;
  }
  throw std::out_of_range(name);
}

Scene depression(const std::vector<std::string>& overrides = {}) {
  return load_scene(WISHBONE_SCENES "/sine_depression.yaml", overrides);
}

Scene steer(const std::vector<std::string>& overrides = {}) {
  return load_scene(WISHBONE_SCENES "/impulse_steer.yaml", overrides);
}

class SceneText : public testing::Test {
 protected:
  Scene load(const std::string& text) {
    return load_scene(files_.write("scene.yaml", "wishbone: 1\n" + text));
  }
  TextFiles files_;
};

constexpr const char* kBall = "bodies:\n  ball: {mass: 1, inertia: [1, 1, 1], position: [0, 0, 2]}\n";

TEST_F(SceneText, MinimalSceneHasTheDocumentedDefaults) {
  const Scene scene = load(kBall);
  EXPECT_EQ(scene.gravity, Vector3(0, 0, -9.81));
  EXPECT_EQ(scene.X_WD.R, Matrix3::Identity());
  EXPECT_EQ(scene.bodies[0].X_DB.p, Vector3(0, 0, 2));
  EXPECT_EQ(scene.bodies[0].form, Scene::BodyForm::kRigid);
  EXPECT_TRUE(scene.joints.empty());
  EXPECT_FALSE(scene.road.has_value());
  EXPECT_EQ(scene.analysis.duration, 1);
  EXPECT_EQ(scene.analysis.rtol, 1e-6);
  EXPECT_EQ(scene.output.interval, 0.01);
  EXPECT_EQ(load(std::string(kBall) + "analysis: {duration: 1 ms}\n").output.interval, 0.001);
}

TEST_F(SceneText, InertiaIsGivenByTensorComponents) {
  const Scene scene =
      load("bodies:\n  a: {mass: 1, inertia: [1, 2, 2.5, 0.1, 0.2, 0.3], position: [0, 0, 0]}\n");
  Matrix3 J;
  J << 1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 2.5;
  EXPECT_EQ(scene.bodies[0].inertia, J);
}

TEST_F(SceneText, FlatBodyIsAllowed) {
  EXPECT_NO_THROW(load("bodies:\n  disc: {mass: 1, inertia: [0.1, 0.2, 0.3], position: [0, 0, 0]}\n"));
}

TEST_F(SceneText, PointMassAndThinRodAreAllowed) {
  const Scene scene = load(
      "bodies:\n  point: {mass: 1, inertia: [0, 0, 0], position: [0, 0, 0]}\n"
      "  rod: {mass: 1, inertia: [1, 1, 2, -1, 0, 0], position: [0, 0, 0]}\n");  // along [1, 1, 0]
  EXPECT_EQ(scene.bodies[0].inertia, Matrix3::Zero());
  EXPECT_EQ(scene.bodies[1].inertia(0, 1), -1);
}

TEST_F(SceneText, OrientationAndPlacementTurnAboutTheirAxes) {
  const Scene scene = load(
      "placement: {axis: [0, 0, 2], angle: 90 deg, origin: [1, 0, 0]}\n"
      "bodies:\n  a: {mass: 1, inertia: [1, 1, 1], position: [2, 0, 0], orientation: {axis: [1, 0, 0], "
      "angle: 90 deg}}\n");
  EXPECT_LT((scene.X_WD * scene.bodies[0].X_DB.p - Vector3(1, 1, 0)).norm(), 1e-15);
  EXPECT_LT((scene.bodies[0].X_DB.R * Vector3::UnitY() - Vector3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((scene.X_WD * Vector3(1, 0, 5) - Vector3(1, 0, 5)).norm(), 1e-15);  // the axis stays
}

TEST_F(SceneText, PrismaticMotionIsInMetres) {
  const Scene scene =
      load(std::string(kBall) +
           "joints: {lift: {type: prismatic, bodies: [ground, ball], at: [0, 0, 2], axis: [0, 0, 3], motion: "
           "up}}\n"
           "motions: {up: {start: 2 cm, steps: [{time: 1 s, duration: 100 ms, change: 3 mm}]}}\n");
  EXPECT_EQ(scene.joints[0].motion, std::vector<int>{0});
  EXPECT_EQ(scene.joints[0].R_DJ.col(2), Vector3::UnitZ());
  EXPECT_DOUBLE_EQ(scene.motions[0].start, 0.02);
  EXPECT_DOUBLE_EQ(scene.motions[0].steps[0].duration, 0.1);
  EXPECT_DOUBLE_EQ(scene.motions[0].steps[0].change, 0.003);
}

TEST_F(SceneText, JointTakesTheNodesPlaceInBothForms) {
  for (const char* form : {"rigid", "modal"}) {
    const Scene scene = load(
        std::string("bodies:\n  beam:\n    form: ") + form +
        "\n    mass: 1\n    inertia: [1, 1, 1]\n    position: [0, 0, 1]\n"
        "    orientation: {axis: [0, 0, 1], angle: 90 deg}\n"
        "    flexible: {block: {size: [2, 0.2, 0.4], elements: [2, 1, 1]}, "
        "material: {young: 1 GPa, poisson: 0.3, density: 1000}, modes: 3, damping: [1 %, 2 %, 0]}\n"
        "joints: {hold: {type: spherical, bodies: [ground, {body: beam, node: 1}], at: [0.1, -1, 0.8]}}\n");
    // Node 1 is at (-1, -0.1, -0.2) of the block, which is turned by 90 degrees about z.
    EXPECT_LT((scene.joints[0].second.p_DP - Vector3(0.1, -1, 0.8)).norm(), 1e-15);
    EXPECT_LT((scene.joints[0].first.p_DP - Vector3(0.1, -1, 0.8)).norm(), 1e-15);
    EXPECT_EQ(scene.joints[0].second.node, 1);
    EXPECT_THAT(scene.bodies[0].flexible->damping, testing::ElementsAre(0.01, 0.02, 0));
  }
}

TEST_F(SceneText, JointOnAFrameStandsAtItsCentreUnlessItSaysOtherwise) {
  for (const char* form : {"rigid", "modal"}) {
    const Scene scene =
        load(std::string("bodies:\n  beam:\n    form: ") + form +
             "\n    mass: 1\n    inertia: [1, 1, 1]\n    position: [0, 0, 1]\n"
             "    orientation: {axis: [0, 0, 1], angle: 90 deg}\n"
             "    flexible: {block: {size: [2, 0.2, 0.4], elements: [2, 1, 1]}, "
             "material: {young: 1 GPa, poisson: 0.3, density: 1000}, modes: 3, "
             "frames: {end: {nodes: [1, 2, 3, 4], weights: [1, 3, 3, 1]}}}\n"
             "joints:\n"
             "  centred: {type: fixed, bodies: [ground, {body: beam, frame: end}]}\n"
             "  carried: {type: fixed, bodies: [{body: beam, frame: end}, ground], at: [0.3, -1.2, 1]}\n"
             "springs: {pull: {from: {ground: [3, 3, 3]}, to: {body: beam, frame: end, at: [1, 0, 0]}, "
             "stiffness: 1, "
             "free_length: 1}}\n");
    // the end is at x = -1 of the block, its heavy side at y = +0.1, which are y = -1 and x = -0.1 in D
    EXPECT_LT((scene.joints[0].second.p_DP - Vector3(-0.05, -1, 1)).norm(), 1e-15);
    EXPECT_LT((scene.joints[0].first.p_DP - Vector3(-0.05, -1, 1)).norm(), 1e-15);
    EXPECT_EQ(scene.joints[0].second.frame, 0);
    EXPECT_EQ(scene.joints[1].first.p_DP, Vector3(0.3, -1.2, 1));
    EXPECT_EQ(scene.springs[0].to.frame, 0);
    EXPECT_EQ(scene.springs[0].to.p_DP, Vector3(1, 0, 0));
    EXPECT_EQ(scene.springs[0].from.frame, -1);
  }
}

TEST_F(SceneText, LongChainsLoad) {
  std::string text = "bodies:\n";
  for (int i = 0; i < 500; ++i) {
    text += "  b" + std::to_string(i) + ": {mass: 1, inertia: [1, 1, 1], position: [0, 0, 0]}\n";
  }
  text += "joints:\n";
  for (int i = 1; i < 500; ++i) {
    text += "  j" + std::to_string(i) + ": {type: fixed, bodies: [b" + std::to_string(i - 1) + ", b" +
            std::to_string(i) + "], at: [0, 0, 0]}\n";
  }
  EXPECT_EQ(load(text).joints.back().first.body, 498);
}

TEST(BlockNodes, FollowTheVehiclesTable) {
  const Scene scene = depression();
  const auto& flexible = *body_named(scene, "chassis").flexible;
  ASSERT_EQ(flexible.node_ids.size(), 20u);
  const std::array<Vector3, 4> section{Vector3(0, -0.2, -0.2), Vector3(0, 0.2, -0.2), Vector3(0, 0.2, 0.2),
                                       Vector3(0, -0.2, 0.2)};
  for (int s = 0; s < 5; ++s) {
    for (int i = 0; i < 4; ++i) {
      const Vector3 expected = section[static_cast<std::size_t>(i)] + Vector3(-1.2 + 0.6 * s, 0, 0.5);
      EXPECT_LT((scene_sections::node_place(body_named(scene, "chassis"), 4 * s + i + 1) - expected).norm(),
                1e-15);
    }
  }
}

TEST(Car, HasTheTabulatedMassesAndPlaces) {
  const Scene scene = depression({"chassis=rigid"});
  ASSERT_EQ(scene.bodies.size(), 11u);
  double mass = 0;
  for (const auto& body : scene.bodies) mass += body.mass;
  EXPECT_DOUBLE_EQ(mass, 998 + 4 * 20 + 2 * 20 + 4 * 30);
  const auto place = [&](const char* name) { return body_named(scene, name).X_DB.p; };
  EXPECT_EQ(place("chassis"), Vector3(0, 0, 0.5));
  EXPECT_EQ(place("front_left_link"), Vector3(1.2, 0.4, 0.3));
  EXPECT_EQ(place("rear_right_link"), Vector3(-1.2, -0.4, 0.3));
  EXPECT_EQ(place("front_right_knuckle"), Vector3(1.2, -0.6, 0.3));
  EXPECT_EQ(place("rear_left_wheel"), Vector3(-1.2, 0.6, 0.3));
  EXPECT_EQ(body_named(scene, "front_left_wheel").inertia.diagonal(), Vector3(1, 2, 1));
  EXPECT_EQ(body_named(scene, "chassis").inertia.diagonal(), Vector3(79.9, 579, 579));
}

TEST(Car, LinksHangOnTheTabulatedNodes) {
  const Scene scene = depression();
  struct Link {
    const char* corner;
    int hinge, stay;
    Vector3 p_hinge, p_stay;
  };
  const std::array<Link, 4> links{Link{"rear_right", 1, 5, {-1.2, -0.2, 0.3}, {-0.6, -0.2, 0.3}},
                                  Link{"rear_left", 2, 6, {-1.2, 0.2, 0.3}, {-0.6, 0.2, 0.3}},
                                  Link{"front_right", 17, 13, {1.2, -0.2, 0.3}, {0.6, -0.2, 0.3}},
                                  Link{"front_left", 18, 14, {1.2, 0.2, 0.3}, {0.6, 0.2, 0.3}}};
  for (const auto& [corner, hinge_node, stay_node, p_hinge, p_stay] : links) {
    const auto& hinge = joint_named(scene, corner + std::string("_hinge"));
    const auto& stay = joint_named(scene, corner + std::string("_stay"));
    EXPECT_EQ(hinge.first.node, hinge_node);
    EXPECT_EQ(stay.first.node, stay_node);
    EXPECT_EQ(scene.bodies[static_cast<std::size_t>(hinge.first.body)].name, "chassis");
    EXPECT_EQ(scene.bodies[static_cast<std::size_t>(stay.second.body)].name, corner + std::string("_link"));
    EXPECT_LT((hinge.second.p_DP - p_hinge).norm() + (stay.second.p_DP - p_stay).norm(), 1e-15);
  }
}

TEST(Car, SpringsCarryTheChassisAtDesignLength) {
  const Scene scene = depression();
  ASSERT_EQ(scene.springs.size(), 4u);
  for (const auto& spring : scene.springs) {
    EXPECT_NEAR((spring.to.p_DP - spring.from.p_DP).norm(), std::sqrt(0.2), 1e-15);
    EXPECT_DOUBLE_EQ(spring.stiffness, 47e3);
    EXPECT_DOUBLE_EQ(spring.damping, 4e3);
    EXPECT_NEAR(spring.stiffness * (spring.free_length - std::sqrt(0.2)), 5.69e3, 5);  // stated preload
    EXPECT_EQ(spring.to.p_DP.y() > 0, spring.from.p_DP.y() > 0);
    EXPECT_EQ(spring.to.p_DP.x(), spring.from.p_DP.x());
  }
}

TEST(Car, IsMirrorSymmetric) {
  const Scene scene = depression();
  const auto mirrored = [](Vector3 p) { return Vector3(p.x(), -p.y(), p.z()); };
  const auto other_side = [](std::string name) { return name.replace(name.find("left"), 4, "right"); };
  int pairs = 0;
  for (const auto& left : scene.bodies) {
    if (left.name.find("left") == std::string::npos) continue;
    EXPECT_EQ(body_named(scene, other_side(left.name)).X_DB.p, mirrored(left.X_DB.p));
    ++pairs;
  }
  for (const auto& left : scene.joints) {
    if (left.name.find("left") == std::string::npos) continue;
    const auto& right = joint_named(scene, other_side(left.name));
    EXPECT_LT((right.first.p_DP - mirrored(left.first.p_DP)).norm(), 1e-15);
    EXPECT_EQ(right.R_DJ.col(2), left.R_DJ.col(2));
    EXPECT_EQ(right.speed, left.speed);
    ++pairs;
  }
  EXPECT_EQ(pairs, 5 + 7);
}

TEST(Car, WheelsRollFreelyForward) {
  const Scene scene = depression();
  const double v = 120 / 3.6;
  for (const char* wheel : {"front_left", "front_right", "rear_left", "rear_right"}) {
    const auto& bearing = joint_named(scene, wheel + std::string("_bearing"));
    const double effective_radius = 0.315 - (0.315 - 0.3) / 3;
    const Vector3 w = bearing.speed.front().value() * bearing.R_DJ.col(2);
    const Vector3 v_contact = Vector3(v, 0, 0) + w.cross(Vector3(0, 0, -effective_radius));
    EXPECT_LT(v_contact.norm(), 1e-12) << wheel;
  }
}

TEST(Car, StandsSquareOnTheBankedRoad) {
  const Scene scene = depression();
  EXPECT_NEAR(scene.road->bank, 6 * kDegree, 1e-15);
  for (const auto& tire : scene.tires) {
    const Vector3 p_DC = scene.bodies[static_cast<std::size_t>(tire.wheel)].X_DB.p;
    const Vector3 p_WC = scene.X_WD * p_DC;
    const Vector3 normal(0, -std::sin(scene.road->bank), std::cos(scene.road->bank));
    EXPECT_NEAR(p_WC.dot(normal), 0.3, 1e-15);  // height of the wheel centre above the plane z = y tan(bank)
  }
}

TEST(Car, HungAndFloatingLinksAreTheSameCar) {
  const Scene floating = depression();
  const Scene hung = depression({"suspension=hung"});
  ASSERT_EQ(floating.joints.size(), hung.joints.size());
  int cut_floating = 0, cut_hung = 0;
  for (std::size_t j = 0; j < floating.joints.size(); ++j) {
    EXPECT_EQ(floating.joints[j].first.p_DP, hung.joints[j].first.p_DP);
    EXPECT_EQ(floating.joints[j].kind, hung.joints[j].kind);
    cut_floating += floating.joints[j].cut == true;
    cut_hung += hung.joints[j].cut == true;
  }
  EXPECT_EQ(cut_floating, 8);
  EXPECT_EQ(cut_hung, 4);
  EXPECT_NEAR(body_named(floating, "front_left_link").v_WBo.value().x(), 120 / 3.6, 1e-14);
  EXPECT_FALSE(body_named(hung, "front_left_link").v_WBo);  // follows from the joint
}

TEST(Car, RigidAndModalChassisAreHeldAtTheSamePlaces) {
  const Scene modal = depression();
  const Scene rigid = depression({"chassis=rigid"});
  EXPECT_EQ(body_named(modal, "chassis").form, Scene::BodyForm::kModal);
  EXPECT_EQ(body_named(rigid, "chassis").form, Scene::BodyForm::kRigid);
  for (std::size_t j = 0; j < modal.joints.size(); ++j) {
    EXPECT_EQ(modal.joints[j].first.p_DP, rigid.joints[j].first.p_DP);
  }
  const auto& flexible = *body_named(modal, "chassis").flexible;
  EXPECT_DOUBLE_EQ(flexible.block->size.prod() * flexible.block->density, 998.4);
  EXPECT_EQ(std::get<LowestModes>(flexible.modes).count, 54);
  EXPECT_EQ(depression({"modes=10", "damping=5 %"}).bodies[0].flexible->damping,
            std::vector<double>(10, 0.05));
}

TEST(Car, ManoeuvresAreAsDescribed) {
  const Scene straight = depression();
  EXPECT_EQ(straight.analysis.duration, 2);
  EXPECT_DOUBLE_EQ(straight.output.interval, 0.005);
  EXPECT_DOUBLE_EQ(straight.road->depression->start, 7.2);
  EXPECT_DOUBLE_EQ(straight.road->depression->length, 12);
  EXPECT_DOUBLE_EQ(straight.road->depression->depth, 0.03);
  EXPECT_TRUE(straight.motions[0].steps.empty());

  const Scene steered = steer();
  EXPECT_EQ(steered.analysis.duration, 3);
  EXPECT_EQ(steered.road->bank, 0);
  EXPECT_EQ(steered.X_WD.R, Matrix3::Identity());
  ASSERT_EQ(steered.motions.size(), 2u);
  for (const auto& motion : steered.motions) {
    ASSERT_EQ(motion.steps.size(), 2u);
    EXPECT_DOUBLE_EQ(motion.steps[0].change, kDegree);
    EXPECT_DOUBLE_EQ(motion.steps[0].change + motion.steps[1].change, 0);
    EXPECT_DOUBLE_EQ(motion.steps[1].time, 0.55);
  }
  const auto& left =
      steered.motions[static_cast<std::size_t>(joint_named(steered, "front_left_steering").motion.front())];
  EXPECT_EQ(left.ackermann->side, Scene::Side::kLeft);
  EXPECT_DOUBLE_EQ(left.ackermann->wheelbase, 2.4);
  EXPECT_THAT(steered.output.flexible.at(0).nodes, testing::ElementsAre(19, 20));
  EXPECT_EQ(steered.vehicle->steering.size(), 2u);
}

TEST(Car, TireHasTheTabulatedParameters) {
  const Scene::TireModel tire = steer({"tire_lag=true", "tire_form=classic"}).tire_models.at(0);
  EXPECT_EQ(tire.form, Scene::TireForm::kClassic);
  EXPECT_DOUBLE_EQ(tire.radius, 0.315);
  EXPECT_DOUBLE_EQ(tire.vertical_stiffness, 200e3);
  EXPECT_DOUBLE_EQ(tire.damping_ratio, 0.02);
  EXPECT_DOUBLE_EQ(tire.mass, 10);
  EXPECT_DOUBLE_EQ(tire.slip_stiffness, 80e3);
  EXPECT_DOUBLE_EQ(tire.cornering_stiffness, 73.6e3);
  EXPECT_DOUBLE_EQ(tire.camber_stiffness, 8094);
  EXPECT_DOUBLE_EQ(tire.rolling_resistance, 0.003);
  EXPECT_DOUBLE_EQ(tire.friction_max, 1.0);
  EXPECT_DOUBLE_EQ(tire.friction_min, 0.8);
  EXPECT_TRUE(tire.lag);
  EXPECT_DOUBLE_EQ(tire.relaxation_longitudinal, 0.3);
  EXPECT_DOUBLE_EQ(tire.relaxation_lateral, 0.5);
}

TEST(Car, ResolvedTextLoadsToTheSameScene) {
  const TextFiles files;
  for (const Scene& scene : {depression(), steer({"suspension=hung", "chassis=rigid", "speed=80 km/h"})}) {
    const Scene again = load_scene(files.write("again.yaml", scene.text));
    EXPECT_EQ(again.text, scene.text);
    EXPECT_EQ(again.X_WD.R, scene.X_WD.R);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      EXPECT_EQ(again.bodies[b].v_WBo, scene.bodies[b].v_WBo);
      EXPECT_EQ(again.bodies[b].inertia, scene.bodies[b].inertia);
    }
    for (std::size_t j = 0; j < scene.joints.size(); ++j)
      EXPECT_EQ(again.joints[j].speed, scene.joints[j].speed);
  }
}

TEST(Car, EveryThingKnowsItsPlaceInTheFiles) {
  const Scene scene = depression();
  EXPECT_THAT(body_named(scene, "chassis").where.text(), testing::EndsWith("car.yaml:32:3: bodies.chassis"));
  EXPECT_THAT(scene.motions[1].where.text(),
              testing::EndsWith("sine_depression.yaml:14:3: motions.front_right_steering"));
}

}  // namespace
}  // namespace wishbone
