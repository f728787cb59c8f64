// Frames of flexible bodies in mechanisms: power, conserved quantities with every joint, agreement of descriptions and of
// integration forms, and statics of the finite element model.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "joints/every_joint.h"
#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"
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
using testing::every_cut_joint;
using testing::every_tree_joint;
using testing::excite;
using testing::Random;
using testing::simulate;
using testing::Trajectory;

constexpr int kBlockModes = 4;
const Vector3 kVelocity(3, 1, -2), kSpin(1.5, -0.8, 2.5);

InterfaceFrame first_end() {
  return {"first end", {1, 2, 3, 4}, {}};
}
InterfaceFrame last_end() {
  return {"last end", {13, 14, 15, 16}, {1, 2, 3, 0.5}};
}

/// Moves a body with the whole mechanism, as if it were rigid.
void move(SystemBuilder& b, int body) {
  b.set_velocity(body, kVelocity + kSpin.cross(b.design_pose(body).p),
                 b.design_pose(body).R.transpose() * kSpin);
}

int add_block(SystemBuilder& b, const std::string& name, const Pose& X_WB, int modes = kBlockModes) {
  const int block = b.add_flexible_body(name, block_modes(modes), X_WB);
  move(b, block);
  return block;
}

// ---- power

TEST(InterfaceFrames, ConstraintForcesDoTheWorkOfTheirRowsOnBodiesAndModes) {
  // lambda . D v, from the velocities of the markers, is (D^T lambda) . v, from the loads of hinges and modes
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Built m = testing::random_loops(seed);
    Workspace ws(m.system);
    const VectorX lambda = Random(seed).numbers(m.system.n_rows, 1);
    VectorX force(m.system.nv);
    update_state(m.system, m.state, ws);
    const VectorX Dv = ws.Phi_rate;  // no row depends on time
    calc_closure_force<double>(m.system, lambda, ws, force.data());
    // a prescribed joint moves by no speed of its own: there the motion takes the work
    const double taken = calc_motion_power<double>(m.system, m.state.t, ws);
    const double scale = lambda.cwiseAbs().dot(Dv.cwiseAbs());
    EXPECT_NEAR(force.dot(m.state.v) + taken, lambda.dot(Dv), 1e-12 * scale) << "seed " << seed;
  }
}

TEST(InterfaceFrames, LoadsDoTheirWorkOnBodyAndModesHoweverFarTheFrameHasTurned) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Wrench load{random.vector(1), random.vector(1)};
    const Vector3 p_W = random.vector(1);
    const Matrix3 R_WM = random.rotation();
    const auto flying = [&](bool loaded) {
      SystemBuilder b;
      const int block = b.add_flexible_body("block", block_modes(6), {});
      const MarkerIndex marker = b.add_marker({block, 0, b.add_frame(block, last_end())}, p_W, R_WM);
      if (loaded) b.add_force(AppliedLoad("load", marker, load, LoadAxes::kMarker));
      return build(std::move(b));
    };
    const Built with = flying(true), without = flying(false);
    State state = with.state;
    retract(with.system, random.numbers(with.system.nv, 1), state.q);
    state.v = random.numbers(with.system.nv, 1);
    const auto residual = [&](const Built& m, Workspace& ws) {
      VectorX r(m.system.nv);
      update_state(m.system, state, ws);
      calc_motion_residual<double>(m.system, VectorX::Zero(m.system.nv), VectorX::Zero(0), ws, r.data());
      return r;
    };
    Workspace ws(with.system), ws_without(without.system);
    const VectorX generalised = residual(without, ws_without) - residual(with, ws);
    EXPECT_GT(ws.flexible[0].modal.turns[0].phi.norm(), 0.01);
    const MarkerState& M = ws.markers[0];
    const double power = (M.R_WM * load.t).dot(M.w_WM) + (M.R_WM * load.f).dot(M.v_WM);
    // stiff elastic forces in the residual cost digits of the difference
    const double rounding = 1e-15 * residual(without, ws_without).cwiseAbs().dot(state.v.cwiseAbs());
    EXPECT_NEAR(generalised.dot(state.v), power, 1e-13 + rounding) << "seed " << seed;
    EXPECT_NEAR(ws.element_powers[0], power, 1e-13) << "seed " << seed;
  }
}

// ---- conserved quantities

/// Two blocks that fly as one, the second turned, joined end to end at frames; the joint stands off the nodes.
Built joined_blocks(const CutJoint& joint) {
  SystemBuilder b;
  const Matrix3 R = rotation_about(Vector3::UnitX(), 0.5);
  const int first = add_block(b, "first", {}), second = add_block(b, "second", {R, {1.4, 0.1, 0}});
  const Attachment end{first, 0, b.add_frame(first, last_end())};
  const Attachment start{second, 0, b.add_frame(second, first_end())};
  const Matrix3 R_WM = rotation_about(Vector3(1, 2, -1).normalized(), 0.8);
  const Vector3 p_W(0.7, 0.05, 0.02);
  // a distance needs points that stand apart
  const bool apart = std::holds_alternative<DistanceClosure>(joint);
  const Vector3 gap = apart ? Vector3(0.4, 0.4, std::sqrt(0.32)) : Vector3::Zero();
  b.add_closure("joint", b.add_marker(end, p_W, R_WM), b.add_marker(start, p_W + gap, R_WM), joint);
  return build(std::move(b));
}

TEST(InterfaceFrames, FlexibleBodiesOnEveryJointConserveEnergyAndBothMomenta) {
  for (const CutJoint& joint : every_cut_joint()) {
    if (is_driven(joint)) continue;
    SCOPED_TRACE(joint_kind(joint));
    Built m = joined_blocks(joint);
    excite(m);
    assembled(m);
    const Trajectory run = simulate(m.system, m.state, 0.15, 0.03, 1e-11);
    ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
    EXPECT_LT(drift(m, run), 1e-9);
  }
}

TEST(InterfaceFrames, BodiesHungOnEveryTreeJointConserveEnergyAndBothMomenta) {
  for (const TreeJoint& joint : every_tree_joint(Vector3(1, 2, -1).normalized(), Vector3::UnitY())) {
    if (std::holds_alternative<PrescribedJoint>(joint)) continue;
    SCOPED_TRACE(joint_kind(joint));
    SystemBuilder b;
    const int block = add_block(b, "block", {});
    const Attachment end{block, 0, b.add_frame(block, last_end())};
    const int arm = b.add_body("arm", 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), {0.9, 0.3, -0.2}});
    b.add_joint("joint", end, arm, {0.7, 0.05, 0.02}, joint);
    Built m = build(std::move(b));
    m.state.v.segment(m.system.bodies[1].v_start, m.system.bodies[1].nv).setConstant(0.5);
    excite(m);
    const Trajectory run = simulate(m.system, m.state, 0.15, 0.03, 1e-11);
    ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
    EXPECT_LT(drift(m, run), 1e-9);
  }
}

// ---- descriptions and forms

struct Kind {
  TreeJoint tree;
  CutJoint cut;
};
std::vector<Kind> every_kind() {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  return {{FixedJoint{}, FixedClosure{}},
          {RevoluteJoint(z), RevoluteClosure{}},
          {PrismaticJoint(z), PrismaticClosure{}},
          {CylindricalJoint(z), CylindricalClosure{}},
          {ScrewJoint(z, 0.13), ScrewClosure(0.13)},
          {UniversalJoint(x, y), UniversalClosure{}},
          {ConstantVelocityJoint(x, y), ConstantVelocityClosure{}},
          {SphericalJoint{}, SphericalClosure{}},
          {PlanarJoint(x, y), PlanarClosure{}}};
}

/// A heavy arm on the end of a spinning block, carried by the joint or closed to it.
Built block_with_arm(const Kind& kind, bool cut) {
  SystemBuilder b;
  const int block = add_block(b, "block", {});
  const Attachment end{block, 0, b.add_frame(block, last_end())};
  const Vector3 p_W(0.7, 0.05, 0.02);
  const int arm = b.add_body("arm", 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), {0.9, 0.3, -0.2}});
  if (cut) {
    move(b, arm);
    b.add_closure("joint", b.add_marker(end, p_W), b.add_marker({arm}, p_W), kind.cut);
  } else {
    b.add_joint("joint", end, arm, p_W, kind.tree);
  }
  return build(std::move(b));
}

TEST(InterfaceFrames, HungAndClosedJointsAreTheSameMechanismInEveryForm) {
  for (const Kind& kind : every_kind()) {
    SCOPED_TRACE(joint_kind(kind.tree));
    const Built hung = block_with_arm(kind, false), cut = block_with_arm(kind, true);
    const Trajectory ode = simulate(hung.system, hung.state, 0.25, 0.25, 1e-11);
    ASSERT_EQ(ode.summary.status, TransientSummary::Status::complete) << ode.summary.message;
    const Trajectory index1 = simulate(cut.system, cut.state, 0.25, 0.25, 1e-11);
    ASSERT_EQ(index1.summary.status, TransientSummary::Status::complete) << index1.summary.message;
    EXPECT_LT(distance(hung, ode.last(), cut, index1.last()), 1e-8);
    const Trajectory ggl = simulate(cut.system, cut.state, 0.25, 0.25, 1e-8, Method::automatic, Form::ggl);
    ASSERT_EQ(ggl.summary.status, TransientSummary::Status::complete) << ggl.summary.message;
    EXPECT_LT(distance(hung, ode.last(), cut, ggl.last()), 1e-5);
  }
}

/// A hinged arm on the end of a block, which is flexible or a rigid body with the same mass and inertia.
Built hinged_arm(ModeSet modes, bool rigid) {
  SystemBuilder b;
  b.gravity = {0, 0, -9.81};
  Attachment end;
  if (rigid) {
    end = {b.add_body("block", modes.mass(), modes.inertia(), {})};
  } else {
    end = {b.add_flexible_body("block", std::move(modes), {})};
    end.frame = b.add_frame(end.body, last_end());
  }
  move(b, end.body);
  const int arm = b.add_body("arm", 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), {0.9, 0.3, -0.2}});
  b.add_joint("hinge", end, arm, {0.7, 0.05, 0.02}, RevoluteJoint(Vector3(1, 2, -1).normalized()));
  return build(std::move(b));
}

TEST(InterfaceFrames, AFrameOfAStiffBlockIsFixedToARigidBody) {
  // quasi-static deflections fall with 1/E; damping 1 keeps the starting jolt from ringing at omega = 1e6 rad/s
  const Built rigid = hinged_arm(block_modes(kBlockModes), true);
  const Trajectory reference = simulate(rigid.system, rigid.state, 0.5, 0.25, 1e-10);
  ModeSet stiff = block_modes(kBlockModes, 1e16);
  stiff.damping_ratio.setOnes();
  const Built flexible = hinged_arm(std::move(stiff), false);
  const Trajectory run = simulate(flexible.system, flexible.state, 0.5, 0.25, 1e-9, Method::bdf);
  ASSERT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  EXPECT_LT(distance(rigid, reference.last(), flexible, run.last()), 1e-6);
}

TEST(InterfaceFrames, AWeldedArmTurnsWithTheEndOfTheBlock) {
  // at a node it would keep the axes of the body
  Built m = block_with_arm(every_kind().front(), false);
  excite(m);
  const Trajectory run = simulate(m.system, m.state, 0.02, 0.002, 1e-9);
  double largest = 0;
  Workspace ws(m.system);
  for (const State& s : run.states) {
    update_state(m.system, s, ws);
    const Matrix3 R = ws.bodies[0].X_WB.R.transpose() * ws.bodies[1].X_WB.R;
    const FrameTurn& turn = ws.flexible[0].modal.turns[0];
    EXPECT_LT((R - turn.R_BI).norm(), 1e-14);
    largest = std::max(largest, turn.phi.norm());
  }
  EXPECT_GT(largest, 0.05) << "it turns by degrees [rad]";
}

// ---- statics

constexpr IsotropicMaterial kMaterial{1e8, 0.3, 2000};
const Vector3 kForce(0.3, -1, 0.7), kMoment(0.2, 0.5, -0.4);
constexpr int kTipNode = 15;

/// Nodal deflections of the free finite element model under kForce at a node of the tip and kMoment on a frame over the tip,
/// held so that the mean motion of the four nodes of the first section vanishes: sum delta_i = 0, sum r_i x delta_i = 0.
Matrix3X finite_element_deflections(const Mesh& mesh) {
  const Eigen::Index n = 3 * mesh.nodes.cols();
  MatrixX A = MatrixX::Zero(n + 6, n + 6);
  A.topLeftCorner(n, n) = MatrixX(stiffness_matrix(mesh, kMaterial));
  const Vector3 root = mesh.nodes.leftCols<4>().rowwise().mean(),
                tip = mesh.nodes.rightCols<4>().rowwise().mean();
  Matrix3 I_tip = Matrix3::Zero();
  for (int i = 0; i < 4; ++i) {
    A.block<3, 3>(n, 3 * i).setIdentity();
    A.block<3, 3>(n + 3, 3 * i) = skew(mesh.nodes.col(i) - root);
    const Matrix3 r = skew(mesh.nodes.col(12 + i) - tip);
    I_tip -= r * r;
  }
  A.bottomRows(6) *= A.maxCoeff();  // for the sake of pivoting
  A.topRightCorner(n, 6) = A.bottomLeftCorner(6, n).transpose();
  VectorX b = VectorX::Zero(n + 6);
  const Vector3 turn = I_tip.inverse() * kMoment;
  for (int i = 12; i < 16; ++i) b.segment<3>(3 * i) = turn.cross(mesh.nodes.col(i) - tip);
  b.segment<3>(3 * (kTipNode - 1)) += kForce;
  return Eigen::FullPivLU<MatrixX>(A).solve(b).head(n).reshaped(3, mesh.nodes.cols());
}

/// The block with all its modes, welded to the ground at a frame over its first section, after it has come to rest.
struct Cantilever {
  Matrix3X deflection;
  Vector6 reaction;  // on the ground, about the middle of the first section
};
Cantilever loaded_cantilever(const Mesh& mesh, double factor) {
  ModeSet modes = free_free_modes(mesh, kMaterial);
  modes.damping_ratio.setOnes();
  SystemBuilder b;
  const int block = b.add_flexible_body("block", modes, {});
  const Attachment root{block, 0, b.add_frame(block, first_end())};
  const Attachment tip{block, 0, b.add_frame(block, {"tip", {13, 14, 15, 16}, {}})};
  b.add_closure("weld", b.add_marker({}, b.attachment_pose(root).p), b.add_marker(root), FixedClosure{});
  b.add_force(AppliedLoad("force", b.add_marker({block, kTipNode}), {Vector3::Zero(), factor * kForce}));
  b.add_force(AppliedLoad("moment", b.add_marker(tip), {factor * kMoment, Vector3::Zero()}));
  const Built m = build(std::move(b));
  const Trajectory run = simulate(m.system, m.state, 20, 20, 1e-12, Method::bdf);
  EXPECT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  Workspace ws = testing::with_independent_rows(m);
  calc_forward_dynamics(m.system, run.last(), ws);
  Cantilever out{mesh.nodes, closure_wrench(m.system.closures[0], 0, ws.lambda, ws)};
  const Pose& X_WB = ws.bodies[0].X_WB;
  for (Eigen::Index i = 0; i < out.deflection.cols(); ++i) {
    const Vector3 s = mesh.nodes.col(i);
    const Vector3 delta = m.system.flexible[0].modal.deflection(mesh.node_ids[i], ws.flexible[0].modal);
    out.deflection.col(i) = X_WB * Vector3(s + delta) - s;
  }
  return out;
}

TEST(InterfaceFrames, ABlockWeldedAtAFrameDeflectsAsTheFiniteElementModel) {
  const Mesh mesh = make_block({1.2, 0.4, 0.3}, {3, 1, 1});
  const Matrix3X expected = finite_element_deflections(mesh);
  // what is quadratic in the loads, the turning of the block, cancels in the difference of opposite ones
  const Cantilever plus = loaded_cantilever(mesh, 1), minus = loaded_cantilever(mesh, -1);
  const Matrix3X found = (plus.deflection - minus.deflection) / 2;
  EXPECT_LT((found - expected).norm(), 1e-7 * expected.norm());
  const Vector3 arm = mesh.nodes.col(kTipNode - 1) + Vector3(0.6, 0, 0);
  const Vector6 load = spatial(Vector3(kMoment + arm.cross(kForce)), kForce);
  EXPECT_LT(((plus.reaction - minus.reaction) / 2 - load).norm(), 1e-7 * load.norm());
}

}  // namespace
}  // namespace wishbone
