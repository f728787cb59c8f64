// What acts on the interface nodes of a flexible body balances its weight and its inertia, in all its freedoms.
#include "solver/interface_wrenches.h"

#include <gtest/gtest.h>

#include "bodies/nodal_shapes.h"
#include "identification/nodal_model.h"
#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"
#include "solver/reactions.h"

namespace wishbone {
namespace {

using testing::block_modes;
using testing::build;
using testing::Built;
using testing::diagonal;
using testing::with_independent_rows;

/// Reactions and inertia at a state of any kind.
Workspace solved(const Built& m) {
  Workspace ws = with_independent_rows(m);
  calc_forward_dynamics(m.system, m.state, ws);
  calc_reactions(m.system, ws);
  return ws;
}

Matrix6X interface_wrenches(const Built& m, int k, const Workspace& ws) {
  Matrix6X F(6, m.system.flexible[k].modal.interface_count() + 1);
  calc_interface_wrenches(m.system, k, ws, F);
  return F;
}

/// With a without gravity: sum f = m a + alpha x c + P z'' + f_bias,  sum (b x f + t) = c x a + J alpha + S z'' + t_bias,
/// sum (Psi^T f + rotation^T J^T t) = P^T a + S^T alpha + z'' + h_bias
void expect_balance(const Built& m) {
  const Workspace ws = solved(m);
  for (std::size_t k = 0; k < m.system.flexible.size(); ++k) {
    const FlexibleBody& flexible = m.system.flexible[k];
    const BodyMotion& body = ws.bodies[flexible.body];
    const FlexibleMotionT<double>& f = ws.flexible[k];
    const Matrix6X F = interface_wrenches(m, static_cast<int>(k), ws);
    const int n = flexible.modal.interface_count();
    Vector3 force = F.col(n).tail<3>(), moment = F.col(n).head<3>();
    VectorX load = VectorX::Zero(flexible.modal.mode_count());
    for (int i = 0; i < n; ++i) {
      const Vector3 f_i = F.col(i).tail<3>(), b_i = f.modal.interface_b.col(i);
      force += f_i;
      moment += b_i.cross(f_i) + Vector3(F.col(i).head<3>());
      load += flexible.modal.interface_shape(i).transpose() * f_i;
      if (flexible.modal.interface_turns(i)) {
        const Vector3 t_i = F.col(i).head<3>();
        const Matrix3& J = flexible.modal.interface_turn(i, f.modal).J;
        load += flexible.modal.interface_rotation(i).transpose() * (J.transpose() * t_i);
      }
    }
    const bool fixed = !flexible.modal.mean_axes();
    const Matrix3X P = fixed ? flexible.modal.momentum_shape() : Matrix3X(Matrix3X::Zero(3, load.size()));
    const Matrix3 R_BW = body.X_WB.R.transpose();
    const Vector3 alpha = R_BW * angular(body.A), a = R_BW * (linear(body.A) - m.system.gravity);
    const double scale = F.cwiseAbs().maxCoeff();
    ASSERT_GT(scale, 1) << "something acts on the body [N]";
    const Vector3 momentum_rate =
        flexible.modal.mass() * a + alpha.cross(f.modal.c) + P * f.z_dd + f.modal.f_bias;
    const Vector3 spin_rate = f.modal.c.cross(a) + f.modal.J * alpha + f.modal.S * f.z_dd + f.modal.t_bias;
    EXPECT_LT((force - momentum_rate).norm(), 1e-10 * scale);
    EXPECT_LT((moment - spin_rate).norm(), 1e-10 * scale);
    EXPECT_LT((load - P.transpose() * a - f.modal.S.transpose() * alpha - f.z_dd - f.modal.h_bias).norm(),
              1e-10 * scale);
  }
}

TEST(InterfaceWrenches, BalanceWeightAndInertiaInRandomTrees) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    expect_balance(testing::random_tree(seed));
  }
}

TEST(InterfaceWrenches, BalanceWeightAndInertiaInRandomLoops) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    expect_balance(testing::random_loops(seed));
  }
}

// Bo is not the mass centre of a body with fixed axes.
TEST(InterfaceWrenches, BalanceWeightAndInertiaOfABodyWithFixedAxes) {
  SystemBuilder b;
  b.gravity = {0.5, 0, -9.81};
  const ShapeSet shapes = fixed_axis_shapes(nodal_model(block_modes(42)), {1, 13, 3});
  const Pose X_WB{Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix(), {1, 2, 3}};
  const int block = b.add_flexible_body("block", shapes, X_WB);
  b.set_velocity(block, {1, -2, 3}, {2, 1, -3});
  const Vector3 pin = b.attachment_pose({block, 5}).p;
  b.add_closure("pin", b.add_marker({}, pin), b.add_marker({block, 5}), SphericalClosure{});
  const Attachment end{block, 0, b.add_frame(block, {"end", {13, 14, 15, 16}, {}})};
  const Vector3 p_W = b.attachment_pose(end).p;
  const int arm = b.add_body("arm", 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), p_W + Vector3(0.3, 0, 0)});
  b.add_joint("weld", end, arm, p_W, FixedJoint{});
  Built m = build(std::move(b));
  testing::excite(m);
  ASSERT_FALSE(m.system.flexible[0].modal.mean_axes());
  expect_balance(m);
}

/// A block that hangs from the ground at three of its nodes, one of them held twice.
Built block_held_twice() {
  SystemBuilder b;
  b.gravity = {0.5, 0, -9.81};
  const int block = b.add_flexible_body("block", block_modes(6), {});
  const auto hold = [&](const char* name, int node) {
    const Pose X = b.attachment_pose({block, node});
    b.add_closure(name, b.add_marker({}, X.p), b.add_marker({block, node}), SphericalClosure{});
  };
  hold("first", 3);
  hold("second", 7);
  hold("third", 14);
  hold("third again", 14);
  return build(std::move(b));
}

TEST(InterfaceWrenches, BalanceWeightAndInertiaWhereReactionsAreRedundant) {
  const Built m = block_held_twice();
  ASSERT_EQ(with_independent_rows(m).closure.kept.size(), 9u);
  ASSERT_EQ(m.system.n_rows, 12);
  expect_balance(m);
}

TEST(InterfaceWrenches, OfASpringALoadAndAJointAreTheirForces) {
  SystemBuilder b;
  const Pose X_WB{Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix(), {1, 2, 3}};
  const int block = b.add_flexible_body("block", block_modes(6), X_WB);
  const Vector3 end = b.attachment_pose({block, 16}).p + Vector3(0, 0, 2);
  b.add_force(SpringDamper("spring", b.add_marker({}, end), b.add_marker({block, 16}), 100, 0, 1.5));
  const Wrench load{Vector3(3, -1, 2), Vector3(7, 5, -4)};
  b.add_force(AppliedLoad("load", b.add_marker({block, 3}), load));
  const Vector3 pin = b.attachment_pose({block, 5}).p;
  const int arm = b.add_body("arm", 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), pin + Vector3(0.1, 0, 0)});
  b.add_joint("pin", {block, 5}, arm, pin, SphericalJoint{});
  const Built m = build(std::move(b));
  const Workspace ws = solved(m);
  const Matrix6X F = interface_wrenches(m, 0, ws);

  ASSERT_EQ(m.system.flexible[0].interface_names, (std::vector<std::string>{"16", "3", "5"}));
  const Matrix3 R_BW = X_WB.R.transpose();
  EXPECT_LT((F.col(0) - spatial(Vector3::Zero(), R_BW * Vector3(0, 0, 100 * 0.5))).norm(), 1e-11);
  EXPECT_LT((F.col(1) - spatial(R_BW * load.t, R_BW * load.f)).norm(), 1e-13);
  const Vector3 reaction = linear(tree_joint_reaction(m.system, ws, 1));  // on the block, named first
  EXPECT_GT(reaction.norm(), 1);
  EXPECT_LT((F.col(2) - spatial(Vector3::Zero(), R_BW * reaction)).norm(), 1e-11);
  EXPECT_EQ(F.col(3).norm(), 0) << "nothing holds the body without a node";
}

}  // namespace
}  // namespace wishbone
