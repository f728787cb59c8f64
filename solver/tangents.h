#pragma once

#include "core/dual.h"
#include "solver/workspace.h"

namespace wishbone {

/// Directions along which the motion is differentiated, a column each.
struct Directions {
  MatrixX q, v, x;  ///< nq, nv, nx rows

  Directions(const System& system, Eigen::Index count)
      : q(MatrixX::Zero(system.nq, count)),
        v(MatrixX::Zero(system.nv, count)),
        x(MatrixX::Zero(system.nx, count)) {}
  Eigen::Index count() const { return q.cols(); }
};

/// Derivatives along them.
struct MotionDerivatives {
  MatrixX q_rate, v_rate, x_rate, work_rate;  ///< of q', v', x', (loss', input')

  MotionDerivatives(const System& system, Eigen::Index count)
      : q_rate(MatrixX::Zero(system.nq, count)),
        v_rate(MatrixX::Zero(system.nv, count)),
        x_rate(MatrixX::Zero(system.nx, count)),
        work_rate(MatrixX::Zero(2, count)) {}
};

/// Exact derivatives of forward dynamics. Nothing is differenced and forward dynamics itself is not differentiated: with r
/// the residual of inverse dynamics, evaluated with dual numbers at the known v' and lambda,
///
///     [ M  -D^T ] [ dv'     ]     [ dr    ]
///     [ D   0   ] [ dlambda ]  = -[ dPhi'' ],
///
/// whose factors are those of the last evaluation.
class Tangents {
 public:
  explicit Tangents(const System& system);

  /// After calc_forward_dynamics at `state`. Leaves the motion of the workspace as it was, but not its A, e and v_rate.
  void calc(const State& state, const Directions& directions, Workspace& ws, MotionDerivatives& derivatives);

  /// dPhi' of all rows along the directions, after update_closures at `state`.
  void calc_closure_rate(const State& state, const Directions& directions, const Workspace& ws,
                         MatrixX& Phi_rate);

 private:
  void seed(const State& state, const Directions& directions, Eigen::Index first, Eigen::Index count);
  void solve(Eigen::Index direction, Workspace& ws, Eigen::Ref<VectorX> v_rate);

  const System& system_;
  Evaluation<Dual> ev_;
  VectorXT<Dual> q_, v_, x_, v_rate_, lambda_, r_, q_rate_;
  VectorX v_rate_found_, lambda_found_;  // of the last evaluation
  VectorX closure_rhs_, lambda_rate_, solved_;
};

}  // namespace wishbone
