// What the builder is given in the design pose is what the kinematics return.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::block_modes;
using testing::build;
using testing::Built;
using ::testing::HasSubstr;

TEST(SystemBuilder, StartsInTheDesignPoseWhateverTheJoints) {
  testing::Random random(5);
  SystemBuilder b;
  const int block = b.add_flexible_body("block", block_modes(3), {random.rotation(), random.vector(3)});
  const Attachment node{block, 7};
  std::vector<Pose> poses{b.design_pose(block)};
  const auto add = [&](Attachment parent, TreeJoint joint) {
    poses.push_back({random.rotation(), random.vector(3)});
    const std::string name = "body " + std::to_string(poses.size());
    const int body = b.add_body(name, 1, random.inertia(1), poses.back());
    const Vector3 p_W = parent.node_id != 0 ? b.attachment_pose(parent).p : random.vector(3);
    b.add_joint(name, parent, body, p_W, std::move(joint));
    return body;
  };
  const int hung = add(node, SphericalJoint{});
  add(node, FreeJoint{});
  const int revolute = add({hung}, RevoluteJoint{Vector3(1, 2, 2) / 3});
  add({revolute}, PrismaticJoint{Vector3::UnitY()});
  add({revolute}, FreeJoint{});
  add({}, FixedJoint{});
  const Built m = build(std::move(b));
  Workspace ws(m.system);
  update_state(m.system, m.state, ws);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose& X_WB = ws.bodies[i].X_WB;  // added parents first, so in the order of the system
    EXPECT_LT((X_WB.p - poses[i].p).norm(), 1e-14) << m.system.bodies[i].name;
    EXPECT_LT((X_WB.R - poses[i].R).norm(), 1e-14) << m.system.bodies[i].name;
  }
}

TEST(SystemBuilder, RefusesTwoTreeJointsOnABodyAndCyclesOfThem) {
  const auto message = [](auto action) -> std::string {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  SystemBuilder b;
  const int first = b.add_body("first", 1, Matrix3::Identity(), {});
  const int second = b.add_body("second", 1, Matrix3::Identity(), {});
  b.add_joint("one", {second}, first, {0, 0, 0}, RevoluteJoint{});
  EXPECT_THAT(message([&] {
                b.add_joint("other", {}, first, {0, 0, 0}, RevoluteJoint{});
              }),
              HasSubstr("'one'"));
  b.add_joint("back", {first}, second, {0, 0, 0}, RevoluteJoint{});
  EXPECT_THAT(message([&] { std::move(b).build(); }), HasSubstr("closed loop"));
}

}  // namespace
}  // namespace wishbone
