#include "solver/closures.h"

#include <variant>

#include "core/dual.h"
#include "solver/kinematics.h"

namespace wishbone {
namespace {

template <class T>
Sides<T> sides_of(const Closure& closure, const Evaluation<T>& ev) {
  return {ev.markers, closure.markers};
}

}  // namespace

template <class T>
void update_closures(const System& system, double t, Evaluation<T>& ev) {
  for (const Closure& closure : system.closures)
    std::visit(
        [&](const auto& joint) {
          constexpr int rows = std::decay_t<decltype(joint)>::kRows;
          const Sides<T> sides = sides_of(closure, ev);
          joint.residual(t, sides, ev.memory.closure_angles.data() + closure.gauge_start,
                         ev.Phi.data() + closure.row_start);
          joint.wrenches(sides, ev.W.data() + 6 * closure.column_start);
          // Phi' = sum W^T V + Phi_t
          joint.time_rate(t, ev.Phi_rate.data() + closure.row_start);
          auto Phi_rate = ev.Phi_rate.template segment<rows>(closure.row_start);
          for (std::size_t p = 0; p < closure.markers.size(); ++p) {
            const MarkerStateT<T>& s = ev.markers[closure.markers[p]];
            const auto W = ev.W.template middleCols<rows>(closure.column_start + static_cast<int>(p) * rows);
            Phi_rate += W.transpose() * spatial(s.w_WM, s.v_WM);
          }
        },
        closure.joint);
}

template <class T>
void update_closure_accelerations(const System& system, double t, Evaluation<T>& ev) {
  update_closure_marker_accelerations(system, ev);
  for (const Closure& closure : system.closures)
    std::visit(
        [&](const auto& joint) {
          joint.acceleration(t, sides_of(closure, ev),
                             MarkerAccelerations<T>(ev.marker_accelerations, closure.markers),
                             ev.Phi_dd.data() + closure.row_start);
        },
        closure.joint);
}

template <class T>
Vector6T<T> closure_wrench(const Closure& closure, int participant, const VectorXT<T>& lambda,
                           const Evaluation<T>& ev) {
  Vector6T<T> F = Vector6T<T>::Zero();
  for (int i = 0; i < closure.rows; ++i)
    F += ev.W.col(closure.column_start + participant * closure.rows + i) * lambda[closure.row_start + i];
  return F;
}

template <class T>
T calc_driven_power(const System& system, double t, const VectorXT<T>& lambda) {
  T power(0);
  for (const Closure& closure : system.closures) {
    if (!is_driven(closure.joint)) continue;
    std::array<double, 6> Phi_t{};
    std::visit([&](const auto& joint) { joint.time_rate(t, Phi_t.data()); }, closure.joint);
    for (int i = 0; i < closure.rows; ++i) power -= lambda[closure.row_start + i] * Phi_t[i];
  }
  return power;
}

void remember_closure_angles(const System& system, Evaluation<double>& ev) {
  for (const Closure& closure : system.closures)
    std::visit(
        [&](const auto& joint) {
          for (int g = 0; g < joint.gauge_count(); ++g) {
            const MarkerState& A = ev.markers[closure.markers[2 * g]];
            const MarkerState& B = ev.markers[closure.markers[2 * g + 1]];
            double& angle = ev.memory.closure_angles[closure.gauge_start + g];
            angle = joint.gauge(g).value(A, B, angle);
          }
        },
        closure.joint);
}

#define WISHBONE_INSTANTIATE(T)                                                                       \
  template void update_closures(const System&, double, Evaluation<T>&);                               \
  template void update_closure_accelerations(const System&, double, Evaluation<T>&);                  \
  template Vector6T<T> closure_wrench(const Closure&, int, const VectorXT<T>&, const Evaluation<T>&); \
  template T calc_driven_power(const System&, double, const VectorXT<T>&);
WISHBONE_INSTANTIATE(double)
WISHBONE_INSTANTIATE(Dual)
#undef WISHBONE_INSTANTIATE

}  // namespace wishbone
