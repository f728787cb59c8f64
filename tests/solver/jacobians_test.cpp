// The exact Jacobians of the integrators against extrapolated differences of what they are Jacobians of, for every part that a
// system can be made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/dual.h"
#include "richardson.h"
#include "solver/energy.h"
#include "solver/every_part.h"
#include "solver/forward_dynamics.h"
#include "solver/ggl_jacobian.h"
#include "solver/kinematics.h"
#include "solver/sparsity.h"
#include "solver/tangents.h"

namespace wishbone {
namespace {

using testing::around_every_part;
using testing::Built;
using testing::every_part_at_once;
using testing::NamedMechanism;
using testing::random_loops;
using testing::richardson;
using testing::with_independent_rows;

/// How wide difference quotients may be to stay where everything is smooth, and how well they can then be trusted. A tire
/// gives way by centimetres only, and its stiffness magnifies what rounding leaves of the place of the wheel; a flexible body
/// is bent by less, too.
struct Differences {
  double step, exact;
};
Differences differences_of(const Built& m) {
  if (!std::get<std::vector<Tire>>(m.system.forces).empty()) return {2e-3, 1e-11};
  return {m.system.flexible.empty() ? 0.02 : 5e-3, 1e-12};
}

/// The rounding of f, which loops that are nearly singular magnify: how much it changes with the last bits of its argument.
template <class F>
double rounding(F&& f) {
  const VectorX at_rest = f(0);
  double largest = 0;
  for (const double h : {-2e-15, -1e-15, 1e-15, 2e-15})
    largest = std::max(largest, VectorX(f(h) - at_rest).cwiseAbs().maxCoeff());
  return largest;
}

/// Whether a column agrees with the difference quotients of f(h), but for the rounding of f: the smallest of the quotients'
/// steps is a sixteenth of the first.
template <class F>
void expect_derivative(const VectorX& exact, F&& f, const Differences& d, const std::string& where) {
  const VectorX numeric = richardson(f, d.step);
  const double scale = numeric.cwiseAbs().maxCoeff() + VectorX(f(0)).cwiseAbs().maxCoeff() / d.step;
  EXPECT_LT((exact - numeric).cwiseAbs().maxCoeff(), d.exact * scale + 20 * rounding(f) / d.step) << where;
}

// ---- the residual of the GGL form, that IDA solves

/// A residual of the GGL form with arguments anywhere.
struct GglPoint {
  const Built& m;
  Workspace ws;
  GglResidual<double> residual;
  VectorX y, y_rate;
  double c = 3;

  GglPoint(const Built& mechanism, unsigned seed)
      : m(mechanism), ws(with_independent_rows(m)), residual(m.system, ws.closure.kept) {
    testing::Random random(seed);
    y = random.numbers(residual.size(), 1);
    y_rate = random.numbers(residual.size(), 1);
    y.head(m.system.nq + m.system.nv + m.system.nx) << m.state.q, m.state.v, m.state.x;
    residual.evaluation().memory = ws.memory;
  }
  VectorX at(Eigen::Index column, double h) {
    VectorX moved = y, moved_rate = y_rate, r(y.size());
    moved[column] += h;
    moved_rate[column] += c * h;
    residual.calc(m.state.t, moved.data(), moved_rate.data(), r.data());
    return r;
  }
};

void expect_exact_ggl_jacobian(const NamedMechanism& around) {
  GglPoint point(around.mechanism, 5);
  GglJacobian jacobian(around.mechanism.system, point.ws.closure.kept);
  ASSERT_FALSE(jacobian.sparse());
  const Eigen::Index n = point.y.size();
  MatrixX J(n, n);
  jacobian.calc(around.mechanism.state.t, point.c, point.y.data(), point.y_rate.data(), point.ws.memory,
                J.data());
  for (Eigen::Index k = 0; k < n; ++k)
    expect_derivative(
        J.col(k), [&](double h) { return point.at(k, h); }, differences_of(around.mechanism),
        around.part + ", column " + std::to_string(k));
}

TEST(GglJacobian, IsTheDerivativeOfTheResidualForEveryJointAndForce) {
  for (const NamedMechanism& around : around_every_part()) expect_exact_ggl_jacobian(around);
}

TEST(GglJacobian, IsTheDerivativeOfTheResidualWithFlexibleBodies) {
  for (unsigned seed = 1; seed <= 3; ++seed) expect_exact_ggl_jacobian({"flexible", random_loops(seed)});
}

/// The whole Jacobian, its columns differentiated in the order in which they stand.
MatrixX whole_jacobian(const GglPoint& point) {
  const Eigen::Index n = point.y.size();
  GglResidual<Dual> residual(point.m.system, point.ws.closure.kept);
  residual.evaluation().memory = point.ws.memory;
  MatrixX J(n, n);
  for (Eigen::Index first = 0; first < n; first += Dual::kDirections) {
    const Eigen::Index count = std::min<Eigen::Index>(Dual::kDirections, n - first);
    VectorXT<Dual> y = point.y.cast<Dual>(), y_rate = point.y_rate.cast<Dual>(), r(n);
    for (Eigen::Index k = 0; k < count; ++k) {
      y[first + k].d[k] = 1;
      y_rate[first + k].d[k] = point.c;
    }
    residual.calc(point.m.state.t, y.data(), y_rate.data(), r.data());
    for (Eigen::Index k = 0; k < count; ++k)
      for (Eigen::Index i = 0; i < n; ++i) J(i, first + k) = r[i].d[k];
  }
  return J;
}

TEST(GglJacobian, HasInItsColoursEveryEntryOfTheWholeMatrixToTheLastBit) {
  const Built m = every_part_at_once();
  const GglPoint point(m, 6);
  GglJacobian jacobian(m.system, point.ws.closure.kept);
  ASSERT_TRUE(jacobian.sparse());
  VectorX values(jacobian.entries());
  jacobian.calc(m.state.t, point.c, point.y.data(), point.y_rate.data(), point.ws.memory, values.data());
  MatrixX whole = whole_jacobian(point);
  // the energies depend on everything and nothing on them: their rows keep the diagonal alone
  const Eigen::Index loss = m.system.nq + m.system.nv + m.system.nx;
  whole.middleRows<2>(loss).setZero();
  whole.block<2, 2>(loss, loss) = point.c * Eigen::Matrix2d::Identity();
  for (int k = 0; k < jacobian.size(); ++k) {
    VectorX column = VectorX::Zero(jacobian.size());
    for (int i = jacobian.column_starts()[k]; i < jacobian.column_starts()[k + 1]; ++i)
      column[jacobian.row_indices()[i]] = values[i];
    EXPECT_EQ((column - whole.col(k)).cwiseAbs().maxCoeff(), 0) << "column " << k;
  }
}

TEST(Sparsity, ColumnsOfOneColourShareNoRow) {
  const Built m = every_part_at_once();
  const Workspace ws = with_independent_rows(m);
  const SparsityPattern pattern = ggl_pattern(m.system, ws.closure.kept);
  const std::vector<int> colours = colour_columns(pattern, static_cast<int>(pattern.size()));
  for (const std::vector<int>& row : pattern) {
    std::set<int> seen;
    for (const int column : row) EXPECT_TRUE(seen.insert(colours[column]).second) << "column " << column;
  }
  const auto longest = std::max_element(pattern.begin(), pattern.end(),
                                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  EXPECT_LE(*std::max_element(colours.begin(), colours.end()) + 1, 2 * static_cast<int>(longest->size()));
}

// ---- forward dynamics, as CVODE's Newton iteration needs it

/// (q', v', x', loss', input') of a state.
VectorX motion(const Built& m, const State& state, Workspace& ws) {
  const System& s = m.system;
  calc_forward_dynamics(s, state, ws);
  const VectorX v_rate = ws.v_rate, x_rate = ws.x_rate;
  if (has_prescribed_motion(s)) calc_joint_forces(s, ws);
  const Work work = calc_work_rate<double>(s, state.t, ws.lambda, ws);
  VectorX rates(s.nq + s.nv + s.nx + 2);
  calc_q_rate<double>(s, state.q, state.v, rates.data());
  rates.tail(s.nv + s.nx + 2) << v_rate, x_rate, work.loss, work.input;
  return rates;
}

/// Directions along every entry of (q, v, x).
Directions every_direction(const System& system) {
  Directions d(system, system.nq + system.nv + system.nx);
  d.q.leftCols(system.nq).setIdentity();
  d.v.middleCols(system.nq, system.nv).setIdentity();
  d.x.rightCols(system.nx).setIdentity();
  return d;
}

void expect_exact_tangents(const NamedMechanism& around) {
  const Built& m = around.mechanism;
  const Directions along = every_direction(m.system);
  MotionDerivatives derivatives(m.system, along.count());
  Workspace ws = with_independent_rows(m);
  calc_forward_dynamics(m.system, m.state, ws);
  Tangents(m.system).calc(m.state, along, ws, derivatives);
  for (Eigen::Index k = 0; k < along.count(); ++k) {
    VectorX exact(m.system.nq + m.system.nv + m.system.nx + 2);
    exact << derivatives.q_rate.col(k), derivatives.v_rate.col(k), derivatives.x_rate.col(k),
        derivatives.work_rate.col(k);
    const auto moved = [&](double h) {
      State state = m.state;
      state.q += h * along.q.col(k);
      state.v += h * along.v.col(k);
      state.x += h * along.x.col(k);
      return motion(m, state, ws);
    };
    expect_derivative(exact, moved, differences_of(m), around.part + ", column " + std::to_string(k));
  }
}

TEST(Tangents, AreTheDerivativesOfForwardDynamicsForEveryJointAndForce) {
  for (const NamedMechanism& around : around_every_part()) expect_exact_tangents(around);
}

/// Loops that are nearly singular leave few digits of the accelerations, whose difference quotients cannot be trusted.
bool nearly_singular(const Built& m) {
  Workspace ws = with_independent_rows(m);
  const auto moved = [&](double h) {
    State state = m.state;
    state.q.array() += h;
    return motion(m, state, ws);
  };
  return rounding(moved) > 1e-12 * moved(0).cwiseAbs().maxCoeff();
}

TEST(Tangents, AreTheDerivativesOfForwardDynamicsWithFlexibleBodies) {
  int tried = 0;
  for (unsigned seed = 1; tried < 3; ++seed) {
    ASSERT_LE(seed, 20u) << "most mechanisms are far from singular";
    const Built m = random_loops(seed);
    if (nearly_singular(m)) continue;
    expect_exact_tangents({"seed " + std::to_string(seed), m});
    ++tried;
  }
}

// ---- that nothing was forgotten

TEST(EveryPart, IsThere) {
  const Built m = every_part_at_once();
  std::set<std::size_t> tree_joints, cut_joints;
  for (const TreeBody& body : m.system.bodies) tree_joints.insert(body.joint.index());
  for (const Closure& closure : m.system.closures) cut_joints.insert(closure.joint.index());
  EXPECT_EQ(tree_joints.size(), std::variant_size_v<TreeJoint>);
  EXPECT_EQ(cut_joints.size(), std::variant_size_v<CutJoint>);
  EXPECT_TRUE(std::apply([](const auto&... lists) { return (!lists.empty() && ...); }, m.system.forces));
}

}  // namespace
}  // namespace wishbone
