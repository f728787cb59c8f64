#include "solver/energy.h"

#include <algorithm>
#include <type_traits>

#include "core/dual.h"
#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/loads.h"

namespace wishbone {

Energy calc_energy(const System& system, const State& state, const Workspace& ws) {
  Energy energy;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotion& s = ws.bodies[i];
    if (body.flexible >= 0) {
      const ModalBody& modal = system.flexible[body.flexible].modal;
      const ModalBodyState& m = ws.flexible[body.flexible].modal;
      energy.kinetic += modal.kinetic_energy(s.X_WB.R.transpose() * linear(s.V), m);
      energy.elastic += modal.elastic_energy(m);
      energy.gravity -= system.gravity.dot(modal.mass() * s.X_WB.p + s.X_WB.R * m.c);
    } else {
      const Vector3 w_B = s.X_WB.R.transpose() * angular(s.V);
      energy.kinetic += 0.5 * (body.mass * linear(s.V).squaredNorm() + w_B.dot(body.J_B * w_B));
      energy.gravity -= body.mass * system.gravity.dot(s.X_WB.p);
    }
  }
  int x_start = 0;
  for_each_force(system, [&](const auto& element, int index) {
    energy.springs +=
        element.energy(force_input(state.t, state.x, x_start, element.state_count(), index, ws));
    x_start += element.state_count();
  });
  return energy;
}

bool has_prescribed_motion(const System& system) {
  return std::any_of(system.bodies.begin(), system.bodies.end(), [](const TreeBody& body) {
    return std::holds_alternative<PrescribedJoint>(body.joint);
  });
}

template <class T>
WorkT<T> calc_work_rate(const System& system, double t, const VectorXT<T>& lambda, const Evaluation<T>& ev) {
  WorkT<T> rate;
  for_each_force(system, [&](const auto& element, int index) {
    using Element = std::decay_t<decltype(element)>;
    if constexpr (std::is_same_v<Element, AppliedLoad> || std::is_same_v<Element, JointDrive>)
      rate.input += ev.element_powers[index];
    else
      rate.loss -= ev.element_powers[index];
  });
  for (std::size_t k = 0; k < system.flexible.size(); ++k)
    rate.loss += system.flexible[k].modal.damping_power(ev.flexible[k].modal);
  rate.input += calc_motion_power(system, t, ev) + calc_driven_power(system, t, lambda);
  return rate;
}

template WorkT<double> calc_work_rate(const System&, double, const VectorX&, const Evaluation<double>&);
template WorkT<Dual> calc_work_rate(const System&, double, const VectorXT<Dual>&, const Evaluation<Dual>&);

}  // namespace wishbone
