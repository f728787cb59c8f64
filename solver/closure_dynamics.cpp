#include "solver/closure_dynamics.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/error.h"
#include "solver/articulated_body.h"
#include "solver/kinematics.h"

namespace wishbone {
namespace {

constexpr int kColumns = 6;  // width of a body's block in Workspace::z, at least the rows of any cut joint

/// Wrenches or forces of the rows of one closure, at most; never on the heap.
template <int rows>
using RowBlock = Eigen::Matrix<double, rows, Eigen::Dynamic, 0, rows, kColumns>;

/// A row is redundant when what it has orthogonal to the rows before it is shorter than this part of its scale.
constexpr double kRankTolerance = 1e-7;

auto wrench_block(Workspace& ws, int body, int columns) {
  return ws.z.middleCols(body * kColumns, columns);
}

auto modal_block(const System& system, int k, int first, int columns, Workspace& ws) {
  const FlexibleBody& flexible = system.flexible[k];
  return ws.U.block(flexible.z_rate_start, first, flexible.modal.mode_count(), columns);
}

/// Puts the wrenches W (columns, at marker i, world axes) on the marker's body.
void start_sweep(const System& system, MarkerIndex i, const RowBlock<6>& W, int first, Workspace& ws) {
  const Marker& marker = system.markers[i];
  if (marker.body < 0) return;
  const BodyState& body = ws.bodies[marker.body];
  const Vector3 p_BM = ws.markers[i].p_WM - body.X_WB.p;
  auto z = wrench_block(ws, marker.body, static_cast<int>(W.cols()));
  z += W;
  z.topRows<3>().noalias() += skew(p_BM) * W.bottomRows<3>();
  if (marker.node >= 0) {
    const int k = system.bodies[marker.body].flexible;
    const RowBlock<3> f_B = body.X_WB.R.transpose() * W.bottomRows<3>();
    modal_block(system, k, first, static_cast<int>(W.cols()), ws).noalias() +=
        system.flexible[k].modal.interface_shape(marker.node).transpose() * f_B;
  }
}

/// One body of the sweep: its modes, its joint, then on to the parent.
void sweep_body(const System& system, int i, int first, int columns, Workspace& ws) {
  const TreeBody& body = system.bodies[i];
  const BodyState& s = ws.bodies[i];
  auto z = wrench_block(ws, i, columns);
  if (body.flexible >= 0) {
    auto u = modal_block(system, body.flexible, first, columns, ws);
    const FlexibleState& f = ws.flexible[body.flexible];
    if (system.flexible[body.flexible].carries_joints) f.M_zz.triangularView<Eigen::Lower>().solveInPlace(u);
    z.noalias() -= f.Y.transpose() * u;
  }
  pass_through_joint(body, s, z, ws.U.block(body.v_start, first, body.nv, columns));
  if (body.parent < 0) return;
  auto z_parent = wrench_block(ws, body.parent, columns);
  z_parent += z;
  z_parent.topRows<3>().noalias() += skew(s.p_PB) * z.bottomRows<3>();
  if (body.parent_node >= 0) {
    const int k = system.bodies[body.parent].flexible;
    const RowBlock<3> f_P = ws.bodies[body.parent].X_WB.R.transpose() * z.bottomRows<3>();
    modal_block(system, k, first, columns, ws).noalias() +=
        system.flexible[k].modal.interface_shape(body.parent_node).transpose() * f_P;
  }
}

void sweep_closure(const System& system, const Closure& closure, int first, const RowBlock<6>& W_A,
                   const RowBlock<6>& W_B, Workspace& ws) {
  const int columns = static_cast<int>(W_A.cols());
  for (const int i : closure.path) {
    wrench_block(ws, i, columns).setZero();
    if (const int k = system.bodies[i].flexible; k >= 0) modal_block(system, k, first, columns, ws).setZero();
  }
  start_sweep(system, closure.A, W_A, first, ws);
  start_sweep(system, closure.B, W_B, first, ws);
  for (const int i : closure.path) sweep_body(system, i, first, columns, ws);
}

/// U with the wrenches on the two sides of every closure weighted by a and b.
void calc_weighted_factor(const System& system, double a, double b, Workspace& ws) {
  std::size_t next = 0;
  for (const Closure& closure : system.closures) {
    // the kept rows of this closure, compacted
    const std::size_t first = next;
    while (next < ws.kept.size() && ws.kept[next] < closure.row_start + closure.rows) ++next;
    const auto columns = static_cast<Eigen::Index>(next - first);
    if (columns == 0) continue;
    RowBlock<6> W_A(6, columns), W_B(6, columns);
    for (Eigen::Index j = 0; j < columns; ++j) {
      W_A.col(j) = a * ws.W_A.col(ws.kept[first + j]);
      W_B.col(j) = b * ws.W_B.col(ws.kept[first + j]);
    }
    sweep_closure(system, closure, static_cast<int>(first), W_A, W_B, ws);
  }
}

/// Lengths that the columns of U would have if the two sides of a closure moved independently: what rounding is to be
/// measured by where both sides move alike and the column vanishes. Rows have the length 1/sqrt(inertia that a force along
/// them feels); where neither side can move, the total mass is the scale.
VectorX calc_row_scales(const System& system, Workspace& ws) {
  calc_weighted_factor(system, 1, 0, ws);
  const VectorX A = ws.U.colwise().squaredNorm();
  calc_weighted_factor(system, 0, 1, ws);
  const VectorX B = ws.U.colwise().squaredNorm();
  return (A + B).cwiseSqrt().cwiseMax(1 / std::sqrt(system.total_mass()));
}

}  // namespace

void keep_rows(const std::vector<int>& rows, const System& system, Workspace& ws) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  ws.kept = rows;
  ws.U = MatrixX::Zero(system.nv, n);
  ws.DMD = MatrixX::Zero(n, n);
  ws.rhs = VectorX::Zero(n);
  ws.lambda.setZero();
}

void update_closures(const System& system, Workspace& ws) {
  for (const Closure& closure : system.closures) {
    const MarkerState& A = ws.markers[closure.A];
    const MarkerState& B = ws.markers[closure.B];
    std::visit(
        [&](const auto& joint) {
          constexpr int n = std::decay_t<decltype(joint)>::kRows;
          joint.residual(A, B, ws.Phi.segment<n>(closure.row_start));
          auto W_A = ws.W_A.middleCols<n>(closure.row_start);
          auto W_B = ws.W_B.middleCols<n>(closure.row_start);
          joint.wrenches(A, B, W_A, W_B);
          // Phi' = W_A^T V_A + W_B^T V_B
          auto Phi_rate = ws.Phi_rate.segment<n>(closure.row_start);
          Phi_rate.noalias() = W_A.transpose() * spatial(A.w_WM, A.v_WM);
          Phi_rate.noalias() += W_B.transpose() * spatial(B.w_WM, B.v_WM);
        },
        closure.joint);
  }
}

void update_closure_accelerations(const System& system, Workspace& ws) {
  update_closure_marker_accelerations(system, ws);
  for (const Closure& closure : system.closures)
    std::visit(
        [&](const auto& joint) {
          constexpr int n = std::decay_t<decltype(joint)>::kRows;
          joint.acceleration(ws.markers[closure.A], ws.markers[closure.B], ws.marker_accelerations[closure.A],
                             ws.marker_accelerations[closure.B], ws.Phi_dd.segment<n>(closure.row_start));
        },
        closure.joint);
}

void calc_closure_factor(const System& system, Workspace& ws) {
  calc_weighted_factor(system, 1, 1, ws);
}

void factor_closures(const System& system, Workspace& ws) {
  ++ws.work.closure_factorizations;
  calc_closure_factor(system, ws);
  ws.DMD.setZero();
  ws.DMD.selfadjointView<Eigen::Lower>().rankUpdate(ws.U.transpose());
  const Eigen::LLT<Eigen::Ref<MatrixX>> llt(ws.DMD);  // in place
  if (llt.info() == Eigen::Success) return;
  Eigen::Index worst = 0;
  ws.DMD.diagonal().minCoeff(&worst);
  throw NumericsError(
      {"cut joint '" + system.row_name(ws.kept[worst]) + "'",
       "the closure has become dependent on the others: the mechanism is at a singular position", "",
       "start from another position, or remove the redundant joint"});
}

void solve_multipliers(const VectorX& r, Workspace& ws) {
  for (std::size_t i = 0; i < ws.kept.size(); ++i) ws.rhs[i] = -r[ws.kept[i]];
  ws.DMD.triangularView<Eigen::Lower>().solveInPlace(ws.rhs);
  ws.DMD.triangularView<Eigen::Lower>().transpose().solveInPlace(ws.rhs);
  ws.lambda.setZero();
  for (std::size_t i = 0; i < ws.kept.size(); ++i) ws.lambda[ws.kept[i]] = ws.rhs[i];
}

std::vector<int> find_independent_rows(const System& system, Workspace& ws) {
  if (system.n_rows == 0) return {};
  // Gram-Schmidt (twice, for safety) in the order of the scene: a row that nothing is left of is redundant. Pivoting by
  // length would find the same rank but name a different row from scene to scene.
  const VectorX scales = calc_row_scales(system, ws);
  calc_closure_factor(system, ws);
  std::vector<int> independent;
  MatrixX basis(system.nv, 0);
  for (int row = 0; row < system.n_rows; ++row) {
    VectorX u = ws.U.col(row);
    for (int pass = 0; pass < 2; ++pass) u -= basis * (basis.transpose() * u);
    if (!(u.norm() > kRankTolerance * scales[row])) continue;
    independent.push_back(row);
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols<1>() = u.normalized();
  }
  return independent;
}

}  // namespace wishbone
