// Independent coordinates: the same motion as with multipliers, in coordinates that are chosen well.
#include "solver/partition.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <bit>
#include <cmath>

#include "richardson.h"
#include "solver/dense_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::assembled;
using testing::build;
using testing::Built;
using testing::diagonal;
using testing::four_bar;
using testing::richardson;
using testing::simulate;
using testing::Trajectory;

/// Two links on balls, one on the other, whose end slides in a plane; springs of different rates hold them. Of nine speeds,
/// eight are independent, all of them of joints with quaternions.
Built chain_on_a_plane() {
  SystemBuilder b;
  b.gravity = {0, 0, -9.81};
  const Vector3 knee(1, 0, 0.5), tip(2, 0, 0);
  const int upper =
      b.add_body("upper", 2, diagonal(0.05, 0.2, 0.22), {Matrix3::Identity(), {0.5, 0.05, 0.25}});
  const int lower =
      b.add_body("lower", 1, diagonal(0.03, 0.1, 0.12), {Matrix3::Identity(), {1.5, -0.05, 0.3}});
  b.add_joint("hip", {}, upper, {0, 0, 0}, SphericalJoint{});
  b.add_joint("knee", {upper}, lower, knee, SphericalJoint{});
  b.add_closure("sole", b.add_marker({}), b.add_marker({lower}, tip), PointOnPlaneClosure{});
  b.add_force(SpringDamper("tendon", b.add_marker({}, {0, 0, 2}),
                           b.add_marker({lower}, knee + Vector3(0.4, 0.1, 0)), 60, 2, 0.5));
  Built m = build(std::move(b));
  m.state.v = testing::Random(2).numbers(m.system.nv, 3);
  return m;
}

double distance(const State& a, const State& b) {
  return std::max((a.q - b.q).cwiseAbs().maxCoeff(), (a.v - b.v).cwiseAbs().maxCoeff());
}

/// A run in independent coordinates, compared with one with multipliers; returns how often the coordinates were chosen anew.
long expect_the_motion_of_index1(const Built& m, Method method, double bound) {
  const Trajectory with_multipliers = simulate(m.system, m.state, 2, 0.04, 1e-12, Method::erk, Form::index1);
  const Trajectory independent = simulate(m.system, m.state, 2, 0.04, 1e-12, method, Form::partition);
  EXPECT_EQ(independent.summary.status, TransientSummary::Status::complete) << independent.summary.message;
  double worst = 0;
  for (std::size_t i = 0; i < independent.states.size(); ++i)
    worst = std::max(worst, distance(independent.states[i], with_multipliers.states[i]));
  EXPECT_LT(worst, bound) << to_string(method);
  return independent.summary.restarts;
}

TEST(Partition, OfAFourBarTurnsAsWithMultipliers) {
  Built m = four_bar(RevoluteClosure{}, 6);
  assembled(m);
  for (const Method method : {Method::erk, Method::adams, Method::bdf})
    expect_the_motion_of_index1(m, method, 1e-7);
}

TEST(Partition, OfBallJointsTumblesAsWithMultipliersThroughManyChoices) {
  // next to where its dependent displacement no longer follows from the others, a choice must be given up in time
  Built m = chain_on_a_plane();
  assembled(m);
  for (const Method method : {Method::erk, Method::adams})
    EXPECT_GT(expect_the_motion_of_index1(m, method, 3e-7), 5) << to_string(method);
}

/// Least singular value of some columns.
double least_singular_value(const MatrixX& D, unsigned columns) {
  MatrixX chosen(D.rows(), std::popcount(columns));
  for (Eigen::Index j = 0, k = 0; j < D.cols(); ++j)
    if ((columns >> j & 1) != 0) chosen.col(k++) = D.col(j);
  return Eigen::JacobiSVD<MatrixX>(chosen).singularValues().minCoeff();
}

/// The dependent speeds of a partition that starts at a state, a bit each.
unsigned dependent_speeds(const Built& m, Workspace& ws) {
  ProgressGuard guard({}, {});
  PartitionedSystem equations(m.system, ws, guard);
  VectorX y(equations.size());
  equations.pack(m.state, {}, y);
  unsigned dependent = (1u << m.system.nv) - 1;
  const Eigen::Index independent = (equations.size() - m.system.nx - 2) / 2;
  for (Eigen::Index i = 0; i < independent; ++i)
    for (int j = 0; j < m.system.nv; ++j)
      if (equations.name(independent + i) == m.system.speed_name(j)) dependent &= ~(1u << j);
  return dependent;
}

/// Sine of the angle by which the dependent columns of D, in the metric of kinetic energy, come nearest to depending on each
/// other, as a share of what the best of all choices has.
double share_of_the_best(const Built& m, Workspace& ws) {
  const int nv = m.system.nv;
  const unsigned chosen = dependent_speeds(m, ws);
  const VectorX inertia = testing::mass_matrix_from_energy(m.system, m.state).diagonal();
  MatrixX D(static_cast<Eigen::Index>(ws.closure.kept.size()), nv);
  const MatrixX all = testing::closure_jacobian_from_differences(m.system, m.state);
  for (Eigen::Index i = 0; i < D.rows(); ++i) D.row(i) = all.row(ws.closure.kept[i]);
  D = D * inertia.cwiseSqrt().cwiseInverse().asDiagonal();
  double best = 0;
  for (unsigned columns = 0; columns < (1u << nv); ++columns)
    if (std::popcount(columns) == D.rows()) best = std::max(best, least_singular_value(D, columns));
  EXPECT_EQ(std::popcount(chosen), D.rows());
  return least_singular_value(D, chosen) / best;
}

TEST(Partition, ChoosesNearlyTheBestConditionedOfAllPartitions) {
  for (int i = 0; i < 24; ++i) {
    Built m = four_bar(RevoluteClosure{}, 6);
    assembled(m);
    m = {m.system, simulate(m.system, m.state, 0.05 * (i + 1), 0.05 * (i + 1), 1e-8).last()};
    Workspace ws = assembled(m);
    EXPECT_GT(share_of_the_best(m, ws), 0.5) << "pose " << i;
  }
}

/// J = df/dy away from the reference pose of the partition.
void expect_exact_jacobian(Built m, double bound) {
  Workspace ws = assembled(m);
  ProgressGuard guard({}, {});
  PartitionedSystem equations(m.system, ws, guard);
  const Eigen::Index n = equations.size();
  VectorX y(n);
  equations.pack(m.state, {}, y);
  y += testing::Random(4).numbers(n, 0.1);
  MatrixX J(n, n);
  equations.calc_jacobian(m.state.t, y, J);
  const double scale = J.cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto moved = [&](double h) {
      VectorX at = y, rate(n);
      at[k] += h;
      equations.calc_rate(m.state.t, at, rate);
      return rate;
    };
    EXPECT_LT((J.col(k) - richardson(moved, 0.05)).cwiseAbs().maxCoeff(), bound * scale) << "column " << k;
  }
}

TEST(Partition, JacobianIsTheDerivativeOfTheRate) {
  // the dependent coordinates are found to 1e-13, which a difference quotient divides by its step
  expect_exact_jacobian(four_bar(SphericalClosure{}, 6), 1e-11);
  expect_exact_jacobian(chain_on_a_plane(), 1e-11);
}

}  // namespace
}  // namespace wishbone
