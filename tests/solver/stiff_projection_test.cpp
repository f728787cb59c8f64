// Projection after implicit steps: in the metric M + h C + h^2 K of the step, against dense matrices, and what it is for, few
// steps where flexible bodies in loops are much stiffer than the motion is fast.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "bodies/nodal_shapes.h"
#include "identification/nodal_model.h"
#include "solver/assembly.h"
#include "solver/dense_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::block_modes;
using testing::build;
using testing::Built;
using testing::diagonal;

constexpr int kModes = 6, kAllModes = 42;

ModeSet damped_modes(int count) {
  ModeSet modes = block_modes(count);
  modes.damping_ratio.setConstant(0.3);
  return modes;
}

void join(SystemBuilder& b, int block, int node, int arm, bool hung) {
  const std::string name = "at node " + std::to_string(node);
  const Vector3 p_W = b.attachment_pose({block, node}).p;
  if (hung)
    b.add_joint(name, {block, node}, arm, p_W, SphericalJoint{});
  else
    b.add_closure(name, b.add_marker({block, node}), b.add_marker({arm}, p_W), SphericalClosure{});
}

/// A block with an arm across two of its nodes, which it stretches, and another arm that hangs.
Built braced_block(const ShapeSet& shapes, bool hung) {
  SystemBuilder b;
  const int block = b.add_flexible_body("block", shapes, {});
  const Vector3 a = b.attachment_pose({block, 3}).p, c = b.attachment_pose({block, 14}).p;
  const int brace = b.add_body("brace", 40, diagonal(2, 3, 2.5), {Matrix3::Identity(), (a + c) / 2});
  join(b, block, 3, brace, false);
  join(b, block, 14, brace, false);
  const Vector3 reach(0.1, 0.2, -0.3);
  const int arm = b.add_body("arm", 7, diagonal(0.4, 0.5, 0.3), {Matrix3::Identity(), a + reach});
  join(b, block, 3, arm, hung);
  return build(std::move(b));
}

/// A matrix, or its diagonal, as a matrix.
MatrixX full(const MatrixX& matrix) {
  return matrix.cols() == 1 ? MatrixX(matrix.col(0).asDiagonal()) : matrix;
}

/// M + h C + h^2 K
MatrixX metric(const Built& m, double h) {
  MatrixX W = testing::mass_matrix_from_energy(m.system, m.state);
  for (const FlexibleBody& body : m.system.flexible) {
    const ShapeSet& set = body.modal.set();
    const int n = body.modal.mode_count();
    W.block(body.z_rate_start, body.z_rate_start, n, n) +=
        h * full(set.damping) + h * h * full(set.stiffness);
  }
  return W;
}

void expect_nearest_in_the_metric(Built m, double h) {
  SCOPED_TRACE("h = " + std::to_string(h));
  Workspace ws = testing::assembled(m);
  State kicked = m.state;
  kicked.v += testing::Random(1).numbers(m.system.nv, 1.0);
  State projected = kicked;
  ASSERT_TRUE(project(m.system, kProjectionTolerance, projected, ws, h));
  const VectorX d = projected.v - kicked.v;
  ASSERT_GT(d.norm(), 1e-3);
  // d^T W n = 0 for every motion n that the closures leave
  const VectorX pull = metric(m, h) * d;
  const MatrixX motions = Eigen::FullPivLU<MatrixX>(testing::closure_jacobian(m.system, m.state)).kernel();
  for (const auto& n : motions.colwise()) EXPECT_LT(std::abs(n.dot(pull)), 1e-9 * n.norm() * pull.norm());
}

TEST(StiffProjection, IsTheNearestInTheMetricOfTheStep) {
  const ShapeSet modal = shapes_of(damped_modes(kModes));
  const ShapeSet nodal = mean_axis_shapes(nodal_model(damped_modes(kAllModes)));
  for (const ShapeSet* shapes : {&modal, &nodal})
    for (const bool hung : {false, true})
      for (const double h : {0.0, 1e-3, 1.0}) expect_nearest_in_the_metric(braced_block(*shapes, hung), h);
}

TEST(StiffProjection, LeavesStiffModesAlone) {
  // what rigid motion can close, it closes: modes take a share of 1 / (1 + h^2 omega^2)
  Built m = braced_block(shapes_of(block_modes(kModes)), true);
  Workspace ws = testing::assembled(m);
  const int z = m.system.flexible[0].z_rate_start;
  const auto share = [&](double h) {
    State state = m.state;
    state.v.head<3>() += Vector3(0.3, -0.2, 0.5);  // the block alone turns
    project(m.system, kProjectionTolerance, state, ws, h);
    return state.v.segment(z, kModes).norm();
  };
  EXPECT_GT(share(0), 1e-3);
  EXPECT_LT(share(10), 1e-4 * share(0));
}

/// Steps of BDF for a block on three cranks of which one is longer: were it rigid, they would lock. The difference is such that
/// the block takes the same energy whatever its stiffness.
double steps(double stiffness) {
  ModeSet modes = block_modes(kModes);
  modes.omega *= std::sqrt(stiffness);
  modes.damping_ratio.setConstant(2);
  SystemBuilder b;
  const int block = b.add_flexible_body("block", shapes_of(modes), {});
  const Vector3 reach(0.2, 0.1, 0), w(0, 0, 1);
  b.set_velocity(block, w.cross(reach), {});
  for (const auto& [node, length] : {std::pair(3, 1.0), {14, 1.0}, {8, 1 + 0.01 / std::sqrt(stiffness)}}) {
    const Vector3 p_W = b.attachment_pose({block, node}).p, foot_W = p_W - length * reach;
    const int crank = b.add_body("crank", 5, diagonal(0.1, 0.1, 0.1), {Matrix3::Identity(), foot_W});
    b.add_joint("foot", {}, crank, foot_W, RevoluteJoint{Vector3::UnitZ()}, {{}, {1}, {}});
    join(b, block, node, crank, false);
  }
  Built m = build(std::move(b));
  testing::assembled(m);
  const testing::Trajectory run = testing::simulate(m.system, m.state, 6, 1, 1e-6, Method::bdf, Form::index1);
  EXPECT_EQ(run.summary.status, TransientSummary::Status::complete) << run.summary.message;
  return run.summary.statistics.front().second;
}

TEST(StiffProjection, LetsStepsBeAsLongAsTheMotionAllows) {
  for (const double stiffness : {1e4, 1e6, 1e8}) EXPECT_LT(steps(stiffness), 5000) << stiffness;
}

}  // namespace
}  // namespace wishbone
