#include "solver/closure_dynamics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "solver/articulated_body.h"
#include "solver/interface.h"

namespace wishbone {
namespace {

constexpr int kColumns = 6;  // width of a body's block in Workspace::z, the rows of any cut joint at most

/// Wrenches or forces of the rows of one closure, at most; never on the heap.
template <int rows>
using RowBlock = Eigen::Matrix<double, rows, Eigen::Dynamic, 0, rows, kColumns>;

/// Below this sine Cholesky of U^T U keeps less than half of the digits.
constexpr double kCholeskySine = 1e-3;

auto wrench_block(Workspace& ws, int body, int columns) {
  return ws.z.middleCols(body * kColumns, columns);
}

auto modal_block(const System& system, int k, int first, int columns, Workspace& ws) {
  const FlexibleBody& flexible = system.flexible[k];
  return ws.closure.U.block(flexible.z_rate_start, first, flexible.modal.mode_count(), columns);
}

/// Adds Theta^T W of wrenches W (columns, about a point Q) to the modes of the flexible body P.
void load_modes(const System& system, int body, int interface_index, const Vector3& p_PQ,
                const RowBlock<6>& W, int first, Workspace& ws) {
  const Interface<double> interface(system, body, interface_index, ws);
  auto modes = modal_block(system, system.bodies[body].flexible, first, static_cast<int>(W.cols()), ws);
  const RowBlock<3> f = ws.bodies[body].X_WB.R.transpose() * W.bottomRows<3>();
  modes.noalias() += interface.translation().transpose() * f;
  if (!interface.turns()) return;
  RowBlock<3> t = W.topRows<3>();
  t.noalias() += skew(p_PQ - interface.p_PI()) * W.bottomRows<3>();
  const RowBlock<3> t_phi = interface.R_WJ().transpose() * t;
  modes.noalias() += interface.rotation().transpose() * t_phi;
}

/// Puts the wrenches W (columns, at marker i, world axes) on the marker's body.
void start_sweep(const System& system, MarkerIndex i, const RowBlock<6>& W, int first, Workspace& ws) {
  const Marker& marker = system.markers[i];
  if (marker.body < 0) return;
  const BodyMotion& body = ws.bodies[marker.body];
  const Vector3 p_BM = ws.markers[i].p_WM - body.X_WB.p;
  auto z = wrench_block(ws, marker.body, static_cast<int>(W.cols()));
  z += W;
  z.topRows<3>().noalias() += skew(p_BM) * W.bottomRows<3>();
  if (marker.interface >= 0) load_modes(system, marker.body, marker.interface, p_BM, W, first, ws);
}

/// One body of the sweep: its modes, its joint, then on to the parent.
void sweep_body(const System& system, int i, int first, int columns, Workspace& ws) {
  const TreeBody& body = system.bodies[i];
  const BodyMotion& s = ws.bodies[i];
  auto z = wrench_block(ws, i, columns);
  if (body.flexible >= 0) {
    auto u = modal_block(system, body.flexible, first, columns, ws);
    const CondensedModes& f = ws.condensed[body.flexible];
    f.solve(u);
    z.noalias() -= f.Y.transpose() * u;
  }
  pass_through_joint(body, ws, z, ws.closure.U.block(body.v_start, first, body.nv, columns));
  if (body.parent < 0) return;
  auto z_parent = wrench_block(ws, body.parent, columns);
  z_parent += z;
  z_parent.topRows<3>().noalias() += skew(s.p_PB) * z.bottomRows<3>();
  if (body.parent_interface >= 0)
    load_modes(system, body.parent, body.parent_interface, s.p_PB, z, first, ws);
}

/// Columns `first`, ... of U for the kept rows `rows` of one closure.
void sweep_closure(const System& system, const Closure& closure, const int* rows, int columns, int first,
                   Workspace& ws) {
  for (const int i : closure.path) {
    wrench_block(ws, i, columns).setZero();
    if (const int k = system.bodies[i].flexible; k >= 0) modal_block(system, k, first, columns, ws).setZero();
  }
  RowBlock<6> W(6, columns);
  for (std::size_t p = 0; p < closure.markers.size(); ++p) {
    const int start = closure.column_start + static_cast<int>(p) * closure.rows - closure.row_start;
    for (int j = 0; j < columns; ++j) W.col(j) = ws.W.col(start + rows[j]);
    start_sweep(system, closure.markers[p], W, first, ws);
  }
  for (const int i : closure.path) sweep_body(system, i, first, columns, ws);
}

/// Smallest sine of a row's angle to those before it, from the Cholesky factor L of S and the rows' lengths.
void find_least_sine(ClosureFactor& f) {
  f.least_sine = 1;
  f.least_row = -1;
  for (Eigen::Index i = 0; i < f.S.rows(); ++i) {
    const double sine = f.S(i, i) / f.lengths[i];
    if (sine >= f.least_sine) continue;
    f.least_sine = sine;
    f.least_row = f.kept[i];
  }
}

/// QR of U with scaled columns and pivoted.
void factor_orthogonally(double rank_tolerance, ClosureFactor& f) {
  f.scaled = f.U * f.lengths.cwiseInverse().asDiagonal();
  f.qr.compute(f.scaled);
  const auto pivots = f.qr.matrixQR().diagonal().cwiseAbs();
  f.rank = 0;
  while (f.rank < f.qr.cols() && pivots[f.rank] > rank_tolerance) ++f.rank;
  const Eigen::Index last = f.qr.cols() - 1;
  f.least_sine = pivots[last];
  f.least_row = f.kept[f.qr.colsPermutation().indices()[last]];
}

}  // namespace

void calc_closure_factor(const System& system, Workspace& ws) {
  const std::vector<int>& kept = ws.closure.kept;
  std::size_t next = 0;
  for (const Closure& closure : system.closures) {
    const std::size_t first = next;
    while (next < kept.size() && kept[next] < closure.row_start + closure.rows) ++next;
    if (next > first)
      sweep_closure(system, closure, kept.data() + first, static_cast<int>(next - first),
                    static_cast<int>(first), ws);
  }
}

void factor_closures(const System& system, double rank_tolerance, Workspace& ws) {
  ++ws.work.closure_factorizations;
  ClosureFactor& f = ws.closure;
  calc_closure_factor(system, ws);
  f.S.setZero();
  f.S.selfadjointView<Eigen::Lower>().rankUpdate(f.U.transpose());
  if (f.scales.size() == 0)
    f.lengths = f.S.diagonal().cwiseSqrt();
  else
    for (std::size_t i = 0; i < f.kept.size(); ++i)
      f.lengths[static_cast<Eigen::Index>(i)] = f.scales[f.kept[i]];
  const Eigen::LLT<Eigen::Ref<MatrixX>> llt(f.S);  // in place
  f.rank = static_cast<int>(f.kept.size());
  f.orthogonal = llt.info() != Eigen::Success;
  if (!f.orthogonal) {
    find_least_sine(f);
    f.orthogonal = f.least_sine < kCholeskySine;
  }
  if (!f.orthogonal) return;
  ++ws.work.orthogonal_factorizations;
  factor_orthogonally(rank_tolerance, f);
}

bool takes_part(const ClosureFactor& f, int i) {
  if (!f.orthogonal) return true;
  const auto& order = f.qr.colsPermutation().indices();
  return std::find(order.data(), order.data() + f.rank, i) != order.data() + f.rank;
}

void solve_multipliers(const VectorX& r, Workspace& ws) {
  ClosureFactor& f = ws.closure;
  const auto n = static_cast<Eigen::Index>(f.kept.size());
  if (!f.orthogonal) {
    // L L^T lambda = -r
    for (Eigen::Index i = 0; i < n; ++i) f.solution[i] = -r[f.kept[i]];
    f.S.triangularView<Eigen::Lower>().solveInPlace(f.solution);
    f.S.triangularView<Eigen::Lower>().transpose().solveInPlace(f.solution);
  } else {
    // R^T R (P^T W lambda) = -P^T W^-1 r with U W^-1 P = Q R, W the lengths of the rows
    const auto& order = f.qr.colsPermutation().indices();
    auto x = f.scratch.head(f.rank);
    for (int i = 0; i < f.rank; ++i) x[i] = -r[f.kept[order[i]]] / f.lengths[order[i]];
    const auto R = f.qr.matrixQR().topLeftCorner(f.rank, f.rank).triangularView<Eigen::Upper>();
    R.transpose().solveInPlace(x);
    R.solveInPlace(x);
    f.solution.setZero();
    for (int i = 0; i < f.rank; ++i) f.solution[order[i]] = x[i] / f.lengths[order[i]];
  }
  ws.lambda.setZero();
  for (Eigen::Index i = 0; i < n; ++i) ws.lambda[f.kept[i]] = f.solution[i];
}

}  // namespace wishbone
