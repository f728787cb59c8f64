#include "solver/tangents.h"

#include <algorithm>

#include "core/dual.h"
#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/closures.h"
#include "solver/energy.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"

namespace wishbone {
namespace {

void set_values(const VectorX& values, VectorXT<Dual>& duals) {
  for (Eigen::Index i = 0; i < values.size(); ++i) duals[i] = values[i];
}

void set_seeds(const VectorX& values, const MatrixX& directions, Eigen::Index first, Eigen::Index count,
               VectorXT<Dual>& duals) {
  set_values(values, duals);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    for (Eigen::Index k = 0; k < count; ++k) duals[i].d[k] = directions(i, first + k);
}

}  // namespace

Tangents::Tangents(const System& system)
    : system_(system),
      ev_(system),
      q_(system.nq),
      v_(system.nv),
      x_(system.nx),
      v_rate_(system.nv),
      lambda_(system.n_rows),
      r_(system.nv),
      q_rate_(system.nq),
      v_rate_found_(VectorX::Zero(system.nv)),
      lambda_found_(VectorX::Zero(system.n_rows)),
      closure_rhs_(VectorX::Zero(system.n_rows)),
      lambda_rate_(VectorX::Zero(system.n_rows)),
      solved_(VectorX::Zero(system.nv)) {}

void Tangents::seed(const State& state, const Directions& directions, Eigen::Index first,
                    Eigen::Index count) {
  set_seeds(state.q, directions.q, first, count, q_);
  set_seeds(state.v, directions.v, first, count, v_);
  set_seeds(state.x, directions.x, first, count, x_);
}

/// dv' (and dlambda) of one direction from dr and dPhi''.
void Tangents::solve(Eigen::Index k, Workspace& ws, Eigen::Ref<VectorX> v_rate) {
  for (Eigen::Index i = 0; i < r_.size(); ++i) ws.hinge_force[i] = -r_[i].d[k];
  calc_bias(system_, Terms::hinge_forces, ws);
  ClosureFactor& f = ws.closure;
  if (!f.kept.empty()) {
    // D M^-1 D^T dlambda = -(dPhi'' + D M^-1 (-dr)),  D M^-1 tau = U^T e
    closure_rhs_.setZero();
    for (std::size_t i = 0; i < f.kept.size(); ++i)
      closure_rhs_[f.kept[i]] = ev_.Phi_dd[f.kept[i]].d[k] + f.U.col(static_cast<Eigen::Index>(i)).dot(ws.e);
    solve_multipliers(closure_rhs_, ws);
    lambda_rate_ = ws.lambda;
    ws.e.noalias() += f.U * f.solution;
  }
  calc_accelerations(system_, Terms::hinge_forces, ws, solved_);
  v_rate = solved_;
}

void Tangents::calc(const State& state, const Directions& directions, Workspace& ws,
                    MotionDerivatives& derivatives) {
  ++ws.work.tangents;
  v_rate_found_ = ws.v_rate;
  lambda_found_ = ws.lambda;
  ev_.memory = ws.memory;
  for (Eigen::Index first = 0; first < directions.count(); first += Dual::kDirections) {
    const Eigen::Index count = std::min<Eigen::Index>(Dual::kDirections, directions.count() - first);
    seed(state, directions, first, count);
    set_values(v_rate_found_, v_rate_);
    set_values(lambda_found_, lambda_);
    update_state<Dual>(system_, state.t, q_, v_, x_, ev_);
    calc_motion_residual<Dual>(system_, v_rate_, lambda_, ev_, r_.data());
    update_closure_accelerations<Dual>(system_, state.t, ev_);
    calc_q_rate<Dual>(system_, q_, v_, q_rate_.data());
    for (Eigen::Index k = 0; k < count; ++k) {
      solve(k, ws, derivatives.v_rate.col(first + k));
      for (Eigen::Index i = 0; i < v_rate_.size(); ++i) v_rate_[i].d[k] = derivatives.v_rate(i, first + k);
      for (Eigen::Index i = 0; i < lambda_.size(); ++i) lambda_[i].d[k] = lambda_rate_[i];
      for (Eigen::Index i = 0; i < q_rate_.size(); ++i) derivatives.q_rate(i, first + k) = q_rate_[i].d[k];
      for (Eigen::Index i = 0; i < ev_.x_rate.size(); ++i)
        derivatives.x_rate(i, first + k) = ev_.x_rate[i].d[k];
    }
    if (has_prescribed_motion(system_)) {
      // joint forces follow dv' and dlambda too
      update_state<Dual>(system_, state.t, q_, v_, x_, ev_);
      calc_motion_residual<Dual>(system_, v_rate_, lambda_, ev_, r_.data());
    }
    const WorkT<Dual> work = calc_work_rate<Dual>(system_, state.t, lambda_, ev_);
    for (Eigen::Index k = 0; k < count; ++k)
      derivatives.work_rate.col(first + k) << work.loss.d[k], work.input.d[k];
  }
  ws.v_rate = v_rate_found_;
  ws.lambda = lambda_found_;
}

void Tangents::calc_closure_rate(const State& state, const Directions& directions, const Workspace& ws,
                                 MatrixX& Phi_rate) {
  ev_.memory = ws.memory;
  for (Eigen::Index first = 0; first < directions.count(); first += Dual::kDirections) {
    const Eigen::Index count = std::min<Eigen::Index>(Dual::kDirections, directions.count() - first);
    seed(state, directions, first, count);
    update_positions<Dual>(system_, state.t, q_, ev_);
    update_velocities<Dual>(system_, state.t, q_, v_, ev_);
    update_markers<Dual>(system_, ev_);
    update_closures<Dual>(system_, state.t, ev_);
    for (Eigen::Index k = 0; k < count; ++k)
      for (Eigen::Index i = 0; i < ev_.Phi_rate.size(); ++i) Phi_rate(i, first + k) = ev_.Phi_rate[i].d[k];
  }
}

}  // namespace wishbone
