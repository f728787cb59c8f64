#include "solver/mechanisms.h"

#include "solver/forward_dynamics.h"

namespace wishbone::testing {

double energy_balance(const System& system, const State& state, const Work& work) {
  Workspace ws(system);
  update_state(system, state, ws);
  const Energy e = calc_energy(system, state, ws);
  // what the springs store has been taken out of the bodies by the force elements too: it is part of work.loss
  return e.kinetic + e.gravity + e.elastic + work.loss - work.input;
}

Vector6 momentum(const System& system, const State& state) {
  Workspace ws(system);
  update_state(system, state, ws);
  Vector6 total = Vector6::Zero();
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const BodyState& s = ws.bodies[i];
    const Vector3 w_B = s.X_WB.R.transpose() * angular(s.V);
    double mass = body.mass;
    Vector3 L_B = body.J_B * w_B;
    if (body.flexible >= 0) {
      const ModalBody& modal = system.flexible[body.flexible].modal;
      mass = modal.mass();
      L_B = modal.angular_momentum(ws.flexible[body.flexible].modal);
    }
    const Vector3 p = mass * linear(s.V);
    total += spatial(s.X_WB.R * L_B + s.X_WB.p.cross(p), p);
  }
  return total;
}

}  // namespace wishbone::testing
