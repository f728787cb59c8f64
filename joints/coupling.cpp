#include "joints/coupling.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bodies/gauge_domain.h"
#include "core/require.h"

namespace wishbone {

CouplingClosure::CouplingClosure(std::string name, std::vector<Term> terms, double constant)
    : name_(std::move(name)), terms_(std::move(terms)), constant_(constant) {
  require(!terms_.empty(), name_, "a coupling needs coordinates to couple", 0, "give at least one");
  for (const Term& term : terms_)
    require(std::isfinite(term.coefficient) && term.coefficient != 0, name_,
            "the coefficients of a coupling must be finite and not zero", term.coefficient,
            "leave out the coordinates that it does not couple");
  require(std::isfinite(constant), name_, "the constant of a coupling must be finite", constant,
          "give it in the unit of the sum");
}

bool CouplingClosure::row_is_angle(int /*row*/) const {
  return std::all_of(terms_.begin(), terms_.end(), [](const Term& term) { return term.gauge.is_angle(); });
}

template <class T>
void CouplingClosure::residual(double /*t*/, Sides<T> sides, const double* near, T* Phi) const {
  Phi[0] = T(-constant_);
  for (int i = 0; i < gauge_count(); ++i) {
    const auto& [gauge, c] = terms_[i];
    require_defined(gauge, sides[2 * i], sides[2 * i + 1], name_);
    Phi[0] += c * gauge.value(sides[2 * i], sides[2 * i + 1], near[i]);
  }
}

template <class T>
void CouplingClosure::wrenches(Sides<T> sides, T* W) const {
  Eigen::Map<Matrix6XT<T>> columns(W, 6, participant_count());
  for (int i = 0; i < gauge_count(); ++i) {
    const auto& [gauge, c] = terms_[i];
    require_defined(gauge, sides[2 * i], sides[2 * i + 1], name_);
    Vector6T<T> W_A, W_B;
    gauge.wrenches(sides[2 * i], sides[2 * i + 1], W_A, W_B);
    columns.col(2 * i) = W_A * c;
    columns.col(2 * i + 1) = W_B * c;
  }
}

template <class T>
void CouplingClosure::acceleration(double /*t*/, Sides<T> sides, MarkerAccelerations<T> a, T* Phi_dd) const {
  Phi_dd[0] = T(0);
  for (int i = 0; i < gauge_count(); ++i) {
    const auto& [gauge, c] = terms_[i];
    require_defined(gauge, sides[2 * i], sides[2 * i + 1], name_);
    Phi_dd[0] += c * gauge.acceleration(sides[2 * i], sides[2 * i + 1], a[2 * i], a[2 * i + 1]);
  }
}

template void CouplingClosure::residual(double, Sides<double>, const double*, double*) const;
template void CouplingClosure::residual(double, Sides<Dual>, const double*, Dual*) const;
template void CouplingClosure::wrenches(Sides<double>, double*) const;
template void CouplingClosure::wrenches(Sides<Dual>, Dual*) const;
template void CouplingClosure::acceleration(double, Sides<double>, MarkerAccelerations<double>,
                                            double*) const;
template void CouplingClosure::acceleration(double, Sides<Dual>, MarkerAccelerations<Dual>, Dual*) const;

}  // namespace wishbone
