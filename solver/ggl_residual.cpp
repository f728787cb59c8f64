#include "solver/ggl_residual.h"

#include "core/dual.h"
#include "solver/energy.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"

namespace wishbone {

template <class T>
GglResidual<T>::GglResidual(const System& system, const std::vector<int>& kept)
    : system_(system),
      kept_(kept),
      size_(system.nq + system.nv + system.nx + 2 + 2 * static_cast<Eigen::Index>(kept.size())),
      ev_(system),
      q_(system.nq),
      v_(system.nv),
      x_(system.nx),
      v_rate_(system.nv),
      lambda_(VectorXT<T>::Zero(system.n_rows)),
      gamma_(VectorXT<T>::Zero(system.n_rows)),
      q_rate_(system.nq),
      speed_(system.nv),
      force_(VectorXT<T>::Zero(system.nv)) {}

template <class T>
void GglResidual<T>::calc(double t, const T* y, const T* y_rate, T* r) {
  const Eigen::Index nq = system_.nq, nv = system_.nv, nx = system_.nx, n = nq + nv + nx + 2;
  const auto m = static_cast<Eigen::Index>(kept_.size());
  q_ = Eigen::Map<const VectorXT<T>>(y, nq);
  v_ = Eigen::Map<const VectorXT<T>>(y + nq, nv);
  x_ = Eigen::Map<const VectorXT<T>>(y + nq + nv, nx);
  v_rate_ = Eigen::Map<const VectorXT<T>>(y_rate + nq, nv);
  for (Eigen::Index i = 0; i < m; ++i) {
    lambda_[kept_[i]] = y_rate[n + i];
    gamma_[kept_[i]] = y_rate[n + m + i];
  }

  update_state<T>(system_, t, q_, v_, x_, ev_);
  calc_motion_residual<T>(system_, v_rate_, lambda_, ev_, r + nq);
  for (Eigen::Index i = 0; i < nx; ++i) r[nq + nv + i] = y_rate[nq + nv + i] - ev_.x_rate[i];
  const WorkT<T> rate = calc_work_rate<T>(system_, t, lambda_, ev_);
  r[n - 2] = y_rate[n - 2] - rate.loss;
  r[n - 1] = y_rate[n - 1] - rate.input;

  speed_ = v_;
  if (m > 0) {
    calc_closure_force<T>(system_, gamma_, ev_, force_.data());
    speed_ -= force_;
  }
  calc_q_rate<T>(system_, q_, speed_, q_rate_.data());
  for (Eigen::Index i = 0; i < nq; ++i) r[i] = y_rate[i] - q_rate_[i];
  for (Eigen::Index i = 0; i < m; ++i) {
    r[n + i] = ev_.Phi[kept_[i]];
    r[n + m + i] = ev_.Phi_rate[kept_[i]];
  }
}

template class GglResidual<double>;
template class GglResidual<Dual>;

}  // namespace wishbone
