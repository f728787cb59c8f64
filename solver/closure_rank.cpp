#include "solver/closure_rank.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/forward_dynamics.h"

namespace wishbone {
namespace {

/// Kept rows this close to dependent are compared with the best choice ...
constexpr double kWeakSine = 0.05;
/// ... and exchanged when that is so much better.
constexpr double kWorthwhile = 5;
/// A redundant row that opens faster than this has become independent [m/s, rad/s].
constexpr double kOpeningRate = 1e-6;

/// Lengths that the columns of U would have if the sides of a closure moved independently: what rounding is to be
/// measured by where both sides move alike and the column vanishes. Rows have the length 1/sqrt(inertia that a force along
/// them feels); where no side can move, the total mass is the scale.
VectorX calc_row_scales(const System& system, Workspace& ws) {
  const Matrix6X W = ws.W;
  VectorX squares = VectorX::Zero(system.n_rows);
  std::size_t participants = 0;
  for (const Closure& closure : system.closures)
    participants = std::max(participants, closure.markers.size());
  for (std::size_t p = 0; p < participants; ++p) {
    // wrenches of participant p alone
    ws.W.setZero();
    for (const Closure& closure : system.closures)
      if (p < closure.markers.size()) {
        const int start = closure.column_start + static_cast<int>(p) * closure.rows;
        ws.W.middleCols(start, closure.rows) = W.middleCols(start, closure.rows);
      }
    calc_closure_factor(system, ws);
    squares += ws.closure.U.colwise().squaredNorm().transpose();
  }
  ws.W = W;
  return squares.cwiseSqrt().cwiseMax(1 / std::sqrt(system.total_mass()));
}

/// As many rows as there are now, chosen by pivoting among all of them; empty when that gains nothing.
std::vector<int> find_better_rows(const System& system, Workspace& ws) {
  ++ws.work.rank_searches;
  const std::vector<int> kept = ws.closure.kept;
  const double sine = ws.closure.least_sine;
  keep_rows(all_rows(system), system, ws);
  calc_closure_factor(system, ws);
  const Eigen::ColPivHouseholderQR<MatrixX> qr(ws.closure.U * ws.closure.scales.cwiseInverse().asDiagonal());
  const auto n = static_cast<Eigen::Index>(kept.size());
  const double best = std::abs(qr.matrixQR()(n - 1, n - 1));
  keep_rows(kept, system, ws);
  if (best < kWorthwhile * sine) return {};
  std::vector<int> rows(qr.colsPermutation().indices().data(), qr.colsPermutation().indices().data() + n);
  std::sort(rows.begin(), rows.end());
  return rows;
}

bool redundant_row_opens(const System& system, const Workspace& ws) {
  const std::vector<int> redundant = redundant_rows(system, ws.closure.kept);
  return std::any_of(redundant.begin(), redundant.end(),
                     [&](int row) { return std::abs(ws.Phi_rate[row]) > kOpeningRate; });
}

}  // namespace

std::vector<int> find_independent_rows(const System& system, Workspace& ws) {
  if (system.n_rows == 0) return {};
  ++ws.work.rank_searches;
  // Gram-Schmidt (twice, for safety) in the order of the scene: a row that nothing is left of is redundant. Pivoting by
  // length would find the same rank but name a different row from scene to scene.
  ws.closure.scales = calc_row_scales(system, ws);
  const VectorX& scales = ws.closure.scales;
  calc_closure_factor(system, ws);
  std::vector<int> independent;
  MatrixX basis(system.nv, 0);
  for (int row = 0; row < system.n_rows; ++row) {
    VectorX u = ws.closure.U.col(row);
    for (int pass = 0; pass < 2; ++pass) u -= basis * (basis.transpose() * u);
    if (!(u.norm() > kRankTolerance * scales[row])) continue;
    independent.push_back(row);
    basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
    basis.rightCols<1>() = u.normalized();
  }
  return independent;
}

RowRevision revise_rows(const System& system, const State& state, Workspace& ws) {
  if (static_cast<int>(ws.closure.kept.size()) == system.n_rows) return RowRevision::unchanged;
  if (redundant_row_opens(system, ws)) {
    update_state(system, state, ws);
    factor_inertia(system, ws);
    const std::vector<int> kept = ws.closure.kept;
    keep_rows(all_rows(system), system, ws);
    const std::vector<int> independent = find_independent_rows(system, ws);
    const bool grown = independent.size() > kept.size();
    keep_rows(grown ? independent : kept, system, ws);
    ws.work.rank_revisions += grown ? 1 : 0;
    return grown ? RowRevision::grown : RowRevision::unchanged;
  }
  if (ws.closure.kept.empty() || ws.closure.least_sine > kWeakSine) return RowRevision::unchanged;
  update_state(system, state, ws);
  factor_inertia(system, ws);
  const std::vector<int> better = find_better_rows(system, ws);
  if (better.empty()) return RowRevision::unchanged;
  keep_rows(better, system, ws);
  ++ws.work.rank_revisions;
  return RowRevision::repivoted;
}

MatrixX closure_self_stresses(const System& system, Workspace& ws) {
  const std::vector<int> kept = ws.closure.kept;
  const auto n = static_cast<Eigen::Index>(kept.size());
  const std::vector<int> redundant = redundant_rows(system, kept);
  if (redundant.empty()) return MatrixX(system.n_rows, 0);
  // the tree alone holds the loops still: whatever a row pulls, the joints around it hold
  if (kept.empty()) return MatrixX::Identity(system.n_rows, system.n_rows);

  const VectorX lambda = ws.lambda;
  keep_rows(all_rows(system), system, ws);
  calc_closure_factor(system, ws);
  MatrixX U_kept(system.nv, n);
  for (Eigen::Index i = 0; i < n; ++i) U_kept.col(i) = ws.closure.U.col(kept[i]);
  const Eigen::ColPivHouseholderQR<MatrixX> qr(U_kept);
  MatrixX stresses = MatrixX::Zero(system.n_rows, static_cast<Eigen::Index>(redundant.size()));
  for (std::size_t k = 0; k < redundant.size(); ++k) {
    // u_redundant = U_kept c: unit multiplier of the redundant row, -c of the others
    const VectorX c = qr.solve(ws.closure.U.col(redundant[k]));
    stresses(redundant[k], static_cast<Eigen::Index>(k)) = 1;
    for (Eigen::Index i = 0; i < n; ++i) stresses(kept[i], static_cast<Eigen::Index>(k)) = -c[i];
  }
  keep_rows(kept, system, ws);
  ws.lambda = lambda;
  return stresses;
}

}  // namespace wishbone
