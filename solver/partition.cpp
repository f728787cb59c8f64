#include "solver/partition.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "solver/articulated_body.h"
#include "solver/assembly.h"
#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"

namespace wishbone {
namespace {

constexpr int kMaxIterations = 20;
constexpr double kClosed = 1e-13;        // [m, rad]
constexpr double kFast = 1e-3;           // convergence for which the Jacobian is kept
constexpr double kDegraded = 0.2;        // of the sine at which the partition was chosen
constexpr double kLeastPart = 1.0 / 64;  // of the way between two poses
constexpr double kFarthestTurn = 2.0;    // from the reference orientation [rad]

}  // namespace

PartitionedSystem::PartitionedSystem(const System& system, Workspace& ws, ProgressGuard& guard)
    : FirstOrderSystem(system, ws, guard,
                       2 * (system.nv - static_cast<Eigen::Index>(ws.closure.kept.size())) + system.nx + 2),
      n_dependent_(static_cast<int>(ws.closure.kept.size())),
      n_independent_(system.nv - n_dependent_),
      q_reference_(VectorX::Zero(system.nq)),
      d_(VectorX::Zero(system.nv)),
      closed_(d_),
      wanted_(d_),
      D_(MatrixX::Zero(n_dependent_, system.nv)),
      D_J_(MatrixX::Zero(n_dependent_, n_dependent_)),
      lu_(n_dependent_),
      row_force_(VectorX::Zero(system.nv)),
      mu_(VectorX::Zero(system.n_rows)),
      residual_(VectorX::Zero(n_dependent_)),
      change_(VectorX::Zero(n_dependent_)),
      d_rate_(VectorX::Zero(system.nv)),
      speeds_(VectorX::Zero(system.nv)),
      directions_(system, 2 * n_independent_ + system.nx),
      derivatives_(system, directions_.count()),
      d_directions_(MatrixX::Zero(system.nv, n_independent_)),
      Phi_rate_(MatrixX::Zero(system.n_rows, directions_.count())) {
  for (const TreeBody& body : system.bodies)
    if (body.nq != body.nv) turning_.push_back(&body);
}

/// D of the kept rows at the state of the last update_closures, row by row D^T e_i.
void PartitionedSystem::calc_closure_jacobian() {
  for (int i = 0; i < n_dependent_; ++i) {
    mu_[ws_.closure.kept[i]] = 1;
    calc_closure_force<double>(system_, mu_, ws_, row_force_.data());
    mu_[ws_.closure.kept[i]] = 0;
    D_.row(i) = row_force_.transpose();
  }
}

/// d' = (tangent)^-1 v at the displacement d: rotation vectors instead of angular velocities.
void PartitionedSystem::calc_displacement_rate(const VectorX& v, VectorX& d_rate) const {
  d_rate = v;
  for (const TreeBody* body : turning_) {
    const Vector3 phi = d_.segment<3>(body->v_start);
    d_rate.segment<3>(body->v_start) = rotation_vector_rate_matrix<double>(phi) * v.segment<3>(body->v_start);
  }
}

void PartitionedSystem::calc_speeds(const VectorX& d_rate, VectorX& v) const {
  v = d_rate;
  for (const TreeBody* body : turning_) {
    const Vector3 phi = d_.segment<3>(body->v_start);
    v.segment<3>(body->v_start) =
        rotation_vector_rate_matrix<double>(phi).inverse() * d_rate.segment<3>(body->v_start);
  }
}

/// The dependent columns of D, those of the speeds or those of the displacements.
void PartitionedSystem::gather_dependent(Of what) {
  for (int j = 0; j < n_dependent_; ++j) D_J_.col(j) = D_.col(dependent_[j]);
  if (what == Of::speeds || turning_.empty()) return;
  for (int j = 0; j < n_dependent_; ++j) {
    d_rate_.setZero();
    d_rate_[dependent_[j]] = 1;
    calc_speeds(d_rate_, speeds_);
    D_J_.col(j).noalias() = D_ * speeds_;
  }
}

void PartitionedSystem::factor_dependent(Of what) {
  gather_dependent(what);
  lu_.compute(D_J_);
}

/// Smallest pivot of the dependent columns of D with unit rows.
double PartitionedSystem::dependent_sine(Of what) {
  if (n_dependent_ == 0) return 1;
  gather_dependent(what);
  D_J_ = D_.rowwise().norm().cwiseInverse().asDiagonal() * D_J_;
  const Eigen::ColPivHouseholderQR<MatrixX> qr(D_J_);
  return std::abs(qr.matrixQR()(n_dependent_ - 1, n_dependent_ - 1));
}

void PartitionedSystem::choose(const State& state) {
  ++ws_.work.partitions;
  update_state(system_, state, ws_);
  factor_inertia(system_, ws_);
  calc_closure_jacobian();
  // columns in the metric of kinetic energy: a speed counts by the inertia that moves with it
  VectorX scale = VectorX::Ones(system_.nv);
  for (const TreeBody& body : system_.bodies)
    for (int j = body.v_start; j < body.v_start + body.nv; ++j) {
      // D_jj = sum L_jk^2, L_jk = h_j^T g_k
      double D_jj = 0;
      for (int k = body.v_start; k <= j; ++k) D_jj += std::pow(ws_.H[j].dot(ws_.G[k]), 2);
      scale[j] = 1 / std::sqrt(D_jj);
    }
  const Eigen::ColPivHouseholderQR<MatrixX> qr(D_ * scale.asDiagonal());
  const auto& order = qr.colsPermutation().indices();
  dependent_.assign(order.data(), order.data() + n_dependent_);
  independent_.assign(order.data() + n_dependent_, order.data() + system_.nv);
  std::sort(dependent_.begin(), dependent_.end());
  std::sort(independent_.begin(), independent_.end());
  q_reference_ = state.q;
  d_.setZero();
  closed_ = d_;
  sine_ = dependent_sine(Of::speeds);
}

void PartitionedSystem::pack(const State& state, const Work& work, Eigen::Ref<VectorX> y) {
  choose(state);
  y.head(n_independent_).setZero();
  for (int i = 0; i < n_independent_; ++i) y[n_independent_ + i] = state.v[independent_[i]];
  y.segment(2 * n_independent_, system_.nx) = state.x;
  y.tail<2>() << work.loss, work.input;
}

/// Newton for d_J from where it is. @returns whether it converged
bool PartitionedSystem::find_dependent(State& state) {
  double last = 0;
  bool factored = false;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    state.q = q_reference_;
    retract(system_, d_, state.q);
    update_positions<double>(system_, state.t, state.q, ws_);
    update_velocities<double>(system_, state.t, state.q, state.v, ws_);
    update_markers<double>(system_, ws_);
    update_closures<double>(system_, state.t, ws_);
    ++ws_.work.position;
    ++ws_.work.velocity;
    for (int i = 0; i < n_dependent_; ++i) residual_[i] = ws_.Phi[ws_.closure.kept[i]];
    const double residual = n_dependent_ > 0 ? residual_.cwiseAbs().maxCoeff() : 0.0;
    // rounding ends the iteration where it stops to converge
    if (residual <= kClosed || (iteration > 2 && residual <= kProjectionTolerance && residual >= 0.5 * last))
      return true;
    if (!factored || residual > kFast * last) {
      calc_closure_jacobian();
      factor_dependent(Of::displacements);
      ++ws_.work.closure_factorizations;
    }
    factored = true;
    last = residual;
    change_.noalias() = lu_.solve(residual_);
    for (int j = 0; j < n_dependent_; ++j) d_[dependent_[j]] -= change_[j];
  }
  return false;
}

/// d_J of the independent displacements in d: from those closed last, and where that is too far for Newton, by way of poses
/// between, each at most half as far as failed before.
/// @throws StepsFailed when even small parts of the way are too far; d is then what was closed last
void PartitionedSystem::close_positions(State& state) {
  wanted_ = d_;
  for (const int j : dependent_) d_[j] = closed_[j];
  double done = 0, part = 1;
  while (done < 1) {
    const double share = part / (1 - done);  // of the way that is left
    for (const int i : independent_)
      d_[i] = share == 1 ? wanted_[i] : closed_[i] + share * (wanted_[i] - closed_[i]);
    if (find_dependent(state)) {
      closed_ = d_;
      done += part;
    } else {
      d_ = closed_;
      part /= 2;
      if (part < kLeastPart)
        throw StepsFailed({fmt::format("t = {:.9g} s", state.t),
                           "the dependent coordinates could not be found from the closures", "",
                           "tighten analysis.rtol, or use form index1 near singular positions"});
    }
  }
}

void PartitionedSystem::close_velocities(State& state) {
  for (const int j : dependent_) state.v[j] = 0;
  update_velocities<double>(system_, state.t, state.q, state.v, ws_);
  update_markers<double>(system_, ws_);
  update_closures<double>(system_, state.t, ws_);
  calc_closure_jacobian();
  factor_dependent(Of::speeds);
  for (int i = 0; i < n_dependent_; ++i) residual_[i] = ws_.Phi_rate[ws_.closure.kept[i]];
  change_.noalias() = lu_.solve(residual_);
  for (int j = 0; j < n_dependent_; ++j) state.v[dependent_[j]] = -change_[j];
}

void PartitionedSystem::unpack(double t, const Eigen::Ref<const VectorX>& y, State& state, Work& work) {
  state.t = t;
  for (int i = 0; i < n_independent_; ++i) {
    d_[independent_[i]] = y[i];
    state.v[independent_[i]] = y[n_independent_ + i];
  }
  state.x = y.segment(2 * n_independent_, system_.nx);
  work = {y[size_ - 2], y[size_ - 1]};
  close_positions(state);
  close_velocities(state);
}

void PartitionedSystem::calc_rate(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<VectorX> y_rate) {
  unpack(t, y, state_, work_);
  const Work rate = calc_motion(state_);
  calc_displacement_rate(state_.v, d_rate_);
  for (int i = 0; i < n_independent_; ++i) {
    y_rate[i] = d_rate_[independent_[i]];
    y_rate[n_independent_ + i] = ws_.v_rate[independent_[i]];
  }
  y_rate.segment(2 * n_independent_, system_.nx) = ws_.x_rate;
  y_rate.tail<2>() << rate.loss, rate.input;
}

/// Directions of (q, v, x) along every independent displacement, every independent speed and every state x.
void PartitionedSystem::set_directions(const State& state) {
  // the dependent entries that undo the residual of the kept rows
  const auto depend = [this](VectorX& along) {
    change_.noalias() = lu_.solve(residual_);
    for (int j = 0; j < n_dependent_; ++j) along[dependent_[j]] = -change_[j];
  };
  calc_closure_jacobian();
  factor_dependent(Of::displacements);
  directions_.v.setZero();
  for (int i = 0; i < n_independent_; ++i) {
    // (D T) d = 0; q' = N T d
    d_rate_.setZero();
    d_rate_[independent_[i]] = 1;
    calc_speeds(d_rate_, speeds_);
    residual_.noalias() = D_ * speeds_;
    depend(d_rate_);
    d_directions_.col(i) = d_rate_;
    calc_speeds(d_rate_, speeds_);
    calc_q_rate<double>(system_, state.q, speeds_, directions_.q.col(i).data());
  }
  directions_.x.rightCols(system_.nx).setIdentity();
  // D dv_J = -dPhi' at fixed speeds
  tangents().calc_closure_rate(state, directions_, ws_, Phi_rate_);
  factor_dependent(Of::speeds);
  for (int i = 0; i < n_independent_; ++i) {
    for (int j = 0; j < n_dependent_; ++j) residual_[j] = Phi_rate_(ws_.closure.kept[j], i);
    speeds_.setZero();
    depend(speeds_);
    directions_.v.col(i) = speeds_;
    speeds_.setZero();
    speeds_[independent_[i]] = 1;
    residual_ = D_.col(independent_[i]);
    depend(speeds_);
    directions_.v.col(n_independent_ + i) = speeds_;
  }
}

/// Rows of J for d' = T^-1(d) v.
void PartitionedSystem::differentiate_displacement_rate(const State& state, Eigen::Ref<MatrixX> J) {
  for (Eigen::Index k = 0; k < directions_.count(); ++k) {
    speeds_ = directions_.v.col(k);
    calc_displacement_rate(speeds_, d_rate_);
    if (k < n_independent_)
      for (const TreeBody* body : turning_) {
        Vector3T<Dual> phi;
        for (int a = 0; a < 3; ++a) {
          phi[a] = d_[body->v_start + a];
          phi[a].d[0] = d_directions_(body->v_start + a, k);
        }
        const Vector3T<Dual> d_rate =
            rotation_vector_rate_matrix<Dual>(phi) * state.v.segment<3>(body->v_start);
        for (int a = 0; a < 3; ++a) d_rate_[body->v_start + a] += d_rate[a].d[0];
      }
    for (int i = 0; i < n_independent_; ++i) J(i, k) = d_rate_[independent_[i]];
  }
}

void PartitionedSystem::calc_jacobian(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<MatrixX> J) {
  unpack(t, y, state_, work_);
  set_directions(state_);
  calc_motion(state_);
  tangents().calc(state_, directions_, ws_, derivatives_);
  const Eigen::Index n = directions_.count();
  J.setZero();
  differentiate_displacement_rate(state_, J.leftCols(n));
  for (int i = 0; i < n_independent_; ++i)
    J.row(n_independent_ + i).head(n) = derivatives_.v_rate.row(independent_[i]);
  J.block(2 * n_independent_, 0, system_.nx, n) = derivatives_.x_rate;
  J.block(n, 0, 2, n) = derivatives_.work_rate;
}

bool PartitionedSystem::project(double, double, Eigen::Ref<VectorX>, double) {
  return true;  // closed by construction
}

bool PartitionedSystem::outlived() {
  for (const TreeBody* body : turning_)
    if (d_.segment<3>(body->v_start).norm() > kFarthestTurn) return true;
  // far from the reference the displacements of a ball joint mix its speeds: their columns degrade on their own
  return std::min(dependent_sine(Of::speeds), dependent_sine(Of::displacements)) < kDegraded * sine_;
}

std::string PartitionedSystem::name(Eigen::Index i) const {
  if (i < 2 * n_independent_)
    return (i < n_independent_ ? "displacement of " : "") +
           system_.speed_name(independent_[i % n_independent_]);
  i -= 2 * n_independent_;
  if (i < system_.nx) return "state " + std::to_string(i + 1) + " of the force elements";
  return i - system_.nx == 0 ? "energy lost" : "energy input";
}

}  // namespace wishbone
