// Flexible bodies in mechanisms: conserved quantities, hung against cut joints, the rigid limit, damping.
#include <gtest/gtest.h>

#include "bodies/nodal_shapes.h"
#include "bodies/rayleigh_damping.h"
#include "identification/nodal_model.h"
#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::assembled;
using testing::block_modes;
using testing::build;
using testing::Built;
using testing::diagonal;
using testing::distance;
using testing::drift;
using testing::excite;
using testing::simulate;
using testing::Trajectory;

constexpr int kModes = 4;

void expect_conserved(const Built& m, const Trajectory& run, double tolerance) {
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  EXPECT_LT(drift(m, run), tolerance);
}

int add_block(SystemBuilder& b, ModeSet modes) {
  const int block = b.add_flexible_body("block", std::move(modes), {});
  b.set_velocity(block, {3, 1, -2}, {1.5, -0.8, 2.5});
  return block;
}

/// A heavy arm at a corner node of the block, hung there by a tree joint or closed to it by a cut one.
enum class Attach { hung, cut };
void add_arm(SystemBuilder& b, int block, int node, const Vector3& reach, Attach attach) {
  const Vector3 p_W = b.attachment_pose({block, node}).p;
  const std::string name = "arm at node " + std::to_string(node);
  const int arm = b.add_body(name, 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), p_W + reach});
  const Vector3 w(1.5, -0.8, 2.5), v(3, 1, -2);
  if (attach == Attach::hung) {
    b.add_joint(name, {block, node}, arm, p_W, SphericalJoint{});
  } else {
    b.set_velocity(arm, v + w.cross(p_W + reach), w);  // with the block, were it rigid
    b.add_closure(name, b.add_marker({block, node}), b.add_marker({arm}, p_W), SphericalClosure{});
  }
}

Built block_with_arms(Attach first, Attach second) {
  SystemBuilder b;
  const int block = add_block(b, block_modes(kModes));
  add_arm(b, block, 3, {-0.2, 0.3, 0.4}, first);
  add_arm(b, block, 14, {0.3, 0.1, -0.3}, second);
  return build(std::move(b));
}

TEST(FlexibleMechanisms, FreeBlockConservesEnergyAndBothMomenta) {
  SystemBuilder b;
  add_block(b, block_modes(kModes));
  Built m = build(std::move(b));
  excite(m);
  expect_conserved(m, simulate(m.system, m.state, 1.0, 0.1, 1e-12), 1e-9);
}

TEST(FlexibleMechanisms, BlockWithAHungAndAClosedArmConservesEnergyAndBothMomenta) {
  Built m = block_with_arms(Attach::hung, Attach::cut);
  excite(m);
  assembled(m);
  expect_conserved(m, simulate(m.system, m.state, 1.0, 0.1, 1e-11), 1e-8);
}

TEST(FlexibleMechanisms, HungAndClosedJointsAreTheSameMechanism) {
  // the modes are left at rest, so that both descriptions start in the same state
  Built hung = block_with_arms(Attach::hung, Attach::hung);
  hung.state.v.segment(6, kModes).setZero();
  // relative rates of the hung arms start at zero: they turn with the block
  const Trajectory reference = simulate(hung.system, hung.state, 1.0, 0.25, 1e-11);
  for (const auto& [first, second] : {std::pair(Attach::cut, Attach::hung), {Attach::cut, Attach::cut}}) {
    Built cut = block_with_arms(first, second);
    const Trajectory run = simulate(cut.system, cut.state, 1.0, 0.25, 1e-11);
    ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
    for (std::size_t i = 0; i < run.states.size(); ++i)
      EXPECT_LT(distance(hung, reference.states[i], cut, run.states[i]), 1e-8) << "t = " << run.states[i].t;
  }
}

/// The block as a rigid body of the same mass and inertia, with a pendulum at the place of a node.
Built pendulum_on(ModeSet modes, bool rigid) {
  SystemBuilder b;
  b.gravity = {0, 0, -9.81};
  const Vector3 node = modes.node_position.col(modes.node_index(3));
  const double mass = modes.mass();
  const Matrix3 J = modes.inertia();
  int block = 0;
  if (rigid) {
    block = b.add_body("block", mass, J, {});
    b.set_velocity(block, {3, 1, -2}, {1.5, -0.8, 2.5});
  } else {
    block = add_block(b, std::move(modes));
  }
  const int arm =
      b.add_body("arm", 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), node + Vector3(-0.2, 0.3, 0.4)});
  b.add_joint("ball", {block, rigid ? 0 : 3}, arm, node, SphericalJoint{});
  return build(std::move(b));
}

TEST(FlexibleMechanisms, AStiffBlockMovesLikeARigidBody) {
  // quasi-static deflections fall with 1/E; damping 1 keeps the starting jolt from ringing at omega = 1e6 rad/s
  const ModeSet soft = block_modes(kModes);
  const Built rigid = pendulum_on(soft, true);
  const Trajectory reference = simulate(rigid.system, rigid.state, 0.5, 0.25, 1e-10);
  ModeSet stiff = block_modes(kModes, 1e16);
  stiff.damping_ratio.setOnes();
  const Built flexible = pendulum_on(stiff, false);
  const Trajectory run = simulate(flexible.system, flexible.state, 0.5, 0.25, 1e-9, Method::bdf);
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  EXPECT_LT(distance(rigid, reference.last(), flexible, run.last()), 1e-6);
}

TEST(FlexibleMechanisms, ABlockWithoutModesIsARigidBody) {
  const ModeSet none = block_modes(0);
  const Built rigid = pendulum_on(none, true), modeless = pendulum_on(none, false);
  const Trajectory a = simulate(rigid.system, rigid.state, 0.5, 0.25, 1e-10);
  const Trajectory b = simulate(modeless.system, modeless.state, 0.5, 0.25, 1e-10);
  ASSERT_EQ(b.summary.status, TransientSummary::Status::complete) << b.summary.message;
  EXPECT_LT((a.last().q - b.last().q).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_LT((a.last().v - b.last().v).cwiseAbs().maxCoeff(), 1e-11);
}

// ---- damping in proportion to mass and stiffness

constexpr int kAllModes = 42;
constexpr RayleighDamping kDamping{20.0, 1e-4};

ModeSet damped_block() {
  ModeSet modes = block_modes(kAllModes);
  modes.damping_ratio = kDamping.ratios(modes.omega);
  return modes;
}

/// The damped block in modal and nodal form.
std::vector<ShapeSet> damped_forms() {
  const NodalModel model = nodal_model(damped_block());
  return {shapes_of(damped_block()), mean_axis_shapes(model), fixed_axis_shapes(model, {1, 13, 3})};
}

TEST(FlexibleMechanisms, AModeOfADampedBlockDecaysAtItsClosedFormRate) {
  // z'' + (alpha + beta omega^2) z' + omega^2 z = 0, z = 0 and z' = v at first
  const ModeSet modes = damped_block();
  constexpr double v = 2;
  for (const int j : {0, 2}) {
    const double omega = modes.omega[j], decay = (kDamping.mass + kDamping.stiffness * omega * omega) / 2;
    const double damped_omega = std::sqrt(omega * omega - decay * decay);
    for (const ShapeSet& set : damped_forms()) {
      if (!set.mean_axes) continue;  // fixed axes turn with the mode
      SystemBuilder b;
      b.add_flexible_body("block", set, {});
      Built m = build(std::move(b));
      const int first = m.system.flexible[0].z_rate_start;
      const MatrixX M_shapes = set.shapes.transpose() * mass_of_freedoms(set.node_mass).asDiagonal();
      m.state.v.segment(first, kAllModes) = M_shapes * (v * modes.shapes.col(j));
      const Trajectory run = simulate(m.system, m.state, 0.3, 0.05, 1e-11);
      ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
      for (const State& state : run.states) {
        const double z = v / damped_omega * std::exp(-decay * state.t) * std::sin(damped_omega * state.t);
        const VectorX delta = set.shapes * state.q.tail(kAllModes);
        EXPECT_LT((delta - z * modes.shapes.col(j)).norm(), 1e-7 * v / omega * modes.shapes.col(j).norm());
      }
      EXPECT_LT(std::exp(-decay * 0.3), 0.5);
    }
  }
}

TEST(FlexibleMechanisms, DampingOfDeflectionsLeavesBothMomentaOfAFlightAsTheyAre) {
  for (const ShapeSet& set : damped_forms()) {
    SystemBuilder b;
    const int block = b.add_flexible_body("block", set, {});
    b.set_velocity(block, {3, 1, -2}, {1.5, -0.8, 2.5});
    Built m = build(std::move(b));
    excite(m);
    const Trajectory run = simulate(m.system, m.state, 0.5, 0.25, 1e-10);
    expect_conserved(m, run, 1e-8);  // the energy with what damping has taken
    const auto vibration = [&](const State& state) { return state.v.tail(kAllModes).norm(); };
    EXPECT_LT(vibration(run.last()), 0.02 * vibration(m.state));
  }
}

}  // namespace
}  // namespace wishbone
