#include "solver/loads.h"

#include "core/dual.h"
#include "solver/closures.h"
#include "solver/interface.h"

namespace wishbone {
namespace {

/// Adds a wrench at a marker to its body: about Bo, and to the modes when the marker is on an interface.
template <class T>
void add_wrench(const System& system, MarkerIndex i, const Vector3T<T>& t, const Vector3T<T>& f,
                Evaluation<T>& ev) {
  const Marker& marker = system.markers[i];
  if (marker.body < 0) return;
  BodyMotionT<T>& body = ev.bodies[marker.body];
  const Vector3T<T> p_BM = ev.markers[i].p_WM - body.X_WB.p;
  body.F_applied.template head<3>() += t + p_BM.cross(f);
  body.F_applied.template tail<3>() += f;
  if (marker.interface < 0) return;
  const Interface<T> interface(system, marker.body, marker.interface, ev);
  interface.add_load(t, f, p_BM, ev.flexible[system.bodies[marker.body].flexible].load);
}

/// Gravity on a body: at Bo, and where that is not the mass centre with its moment, and on the modes.
template <class T>
void set_gravity(const System& system, const TreeBody& body, Evaluation<T>& ev, BodyMotionT<T>& s) {
  if (body.flexible < 0) {
    s.F_applied << Vector3T<T>::Zero(), (body.mass * system.gravity).template cast<T>();
    return;
  }
  const ModalBody& modal = system.flexible[body.flexible].modal;
  s.F_applied << Vector3T<T>::Zero(), (modal.mass() * system.gravity).template cast<T>();
  if (modal.mean_axes()) return;
  // N += c x g,  Q += P^T g
  FlexibleMotionT<T>& f = ev.flexible[body.flexible];
  const Vector3T<T> g_B = s.X_WB.R.transpose() * system.gravity;
  s.F_applied.template head<3>() += s.X_WB.R * f.modal.c.cross(g_B);
  f.load += modal.momentum_shape().transpose().lazyProduct(g_B);
}

/// The time and the signals, from the markers' states.
template <class T>
void update_variables(const System& system, double t, Evaluation<T>& ev) {
  ev.variables[0] = T(t);
  for (std::size_t i = 0; i < system.signals.size(); ++i)
    ev.variables[i + 1] = system.signals[i].value<T>(ev.markers, ev.memory.signal_values[i]);
}

}  // namespace

template <class T>
void clear_loads(Evaluation<T>& ev) {
  for (BodyMotionT<T>& s : ev.bodies) s.F_applied.setZero();
  for (FlexibleMotionT<T>& f : ev.flexible) f.load.setZero();
}

template <class T>
void apply_forces(const System& system, double t, const VectorXT<T>& x, Evaluation<T>& ev) {
  for (WrenchT<T>& w : ev.wrenches) w = WrenchT<T>{};
  for (FlexibleMotionT<T>& f : ev.flexible) f.load.setZero();

  update_variables(system, t, ev);
  int x_start = 0;
  for_each_force(system, [&](const auto& element, int index) {
    const int n = element.state_count();
    ForceOutputT<T> out{ev.wrenches, {ev.x_rate.data() + x_start, static_cast<std::size_t>(n)}, T(0)};
    element.apply(force_input(t, x, x_start, n, index, ev), out);
    ev.element_powers[index] = out.power;
    x_start += n;
  });

  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    set_gravity(system, system.bodies[i], ev, ev.bodies[i]);
  if (system.n_forces == 0) return;
  for (std::size_t i = 0; i < system.markers.size(); ++i)
    add_wrench(system, static_cast<MarkerIndex>(i), ev.wrenches[i].t, ev.wrenches[i].f, ev);
}

void count_forces(const System& system, WorkCounters& work) {
  ++work.forces;
  work.signals += static_cast<long>(system.signals.size());
  work.drives += static_cast<long>(std::get<std::vector<JointDrive>>(system.forces).size());
}

template <class T>
void add_closure_loads(const System& system, const VectorXT<T>& lambda, Evaluation<T>& ev) {
  for (const Closure& closure : system.closures)
    for (std::size_t p = 0; p < closure.markers.size(); ++p) {
      const Vector6T<T> F = closure_wrench(closure, static_cast<int>(p), lambda, ev);
      add_wrench<T>(system, closure.markers[p], angular(F), linear(F), ev);
    }
}

bool counts_turns(const System& system) {
  bool any = system.n_gauges > 0 || !system.measured.empty() || !system.signals.empty();
  for_each_force(system, [&](const auto& element, int) {
    if constexpr (requires(ForceInput input) { element.angle(input); }) any = true;
  });
  return any;
}

void remember_angles(const System& system, const State& state, Evaluation<double>& ev) {
  int x_start = 0;
  for_each_force(system, [&](const auto& element, int index) {
    if constexpr (requires(ForceInput input) { element.angle(input); })
      ev.memory.force_angles[index] =
          element.angle(force_input(state.t, state.x, x_start, element.state_count(), index, ev));
    x_start += element.state_count();
  });
  remember_closure_angles(system, ev);
  for (std::size_t i = 0; i < system.signals.size(); ++i) {
    double& value = ev.memory.signal_values[i];
    value = system.signals[i].value<double>(ev.markers, value);
  }
  for (std::size_t i = 0; i < system.measured.size(); ++i) {
    const MeasuredCoordinate& c = system.measured[i];
    double& angle = ev.memory.measured_angles[i];
    angle = c.gauge.value(ev.markers[c.A], ev.markers[c.B], angle);
  }
}

#define WISHBONE_INSTANTIATE(T)                                                          \
  template void clear_loads(Evaluation<T>&);                                             \
  template void apply_forces(const System&, double, const VectorXT<T>&, Evaluation<T>&); \
  template void add_closure_loads(const System&, const VectorXT<T>&, Evaluation<T>&);
WISHBONE_INSTANTIATE(double)
WISHBONE_INSTANTIATE(Dual)
#undef WISHBONE_INSTANTIATE

}  // namespace wishbone
