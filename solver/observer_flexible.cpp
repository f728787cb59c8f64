#include "solver/interface_wrenches.h"
#include "solver/observation.h"
#include "solver/observer.h"

namespace wishbone {

using namespace observation;

namespace {

constexpr const char* kBody = "body";

std::string path_of(const System& system, int k) {
  return "/flexible/" + system.bodies[system.flexible[k].body].name;
}

/// Psi of chosen nodes, one below the other.
MatrixX shapes_of(const ShapeSet& set, const std::vector<int>& node_ids) {
  MatrixX shapes(3 * static_cast<Eigen::Index>(node_ids.size()), set.shape_count());
  Eigen::Index row = 0;
  for (const int id : node_ids) {
    shapes.middleRows<3>(row) = set.shapes.middleRows<3>(3 * set.node_index(id));
    row += 3;
  }
  return shapes;
}

std::vector<std::string> texts(const std::vector<int>& ids) {
  std::vector<std::string> all;
  for (const int id : ids) all.push_back(std::to_string(id));
  return all;
}

/// Of flexible body k.
const ModalBodyState& state_of(const Observer::Sample& s, int k) {
  return s.ws.flexible[k].modal;
}

}  // namespace

void Observer::add_flexible(const System& system, const ObserverOptions& options) {
  for (std::size_t i = 0; i < system.flexible.size(); ++i) {
    const int k = static_cast<int>(i), m = system.flexible[i].modal.mode_count();
    if (m == 0) continue;
    add(path_of(system, k) + "/modal_coordinates", {m}, "m kg^0.5", "",
        "amplitudes of the mass-normalised elastic modes",
        [k, m](const Sample& s, double* out) { Eigen::Map<VectorX>(out, m) = state_of(s, k).z; });
  }
  for (const ObserverOptions::Flexible& chosen : options.flexible) {
    const int k = system.bodies[chosen.body].flexible;
    if (k < 0) continue;
    const bool rates = chosen.signals.contains(FlexibleSignal::deflection_rates);
    if (!chosen.node_ids.empty()) add_deflections(system, k, chosen.node_ids, rates);
    add_modal_motion(system, k, chosen.signals);
    if (chosen.signals.contains(FlexibleSignal::energies)) add_body_energies(system, k);
    if (chosen.signals.contains(FlexibleSignal::modal_energies)) add_modal_energies(system, k);
    if (chosen.signals.contains(FlexibleSignal::interface_forces)) add_interface_forces(system, k);
  }
  for (const ObserverOptions::Recovery& recovery : options.recoveries) add_recovery(system, recovery);
}

void Observer::add_deflections(const System& system, int k, const std::vector<int>& node_ids, bool rates) {
  const int n = static_cast<int>(node_ids.size());
  const MatrixX shapes = shapes_of(system.flexible[k].modal.set(), node_ids);
  add(path_of(system, k) + "/deflection", {n, 3}, "m", kBody,
      "deflection of nodes from the undeformed body, mean-axis frame",
      [k, shapes](const Sample& s, double* out) {
        Eigen::Map<VectorX>(out, shapes.rows()).noalias() = shapes * state_of(s, k).z;
      });
  signals_.back().lists["nodes"] = texts(node_ids);
  if (!rates) return;
  add(path_of(system, k) + "/deflection_rate", {n, 3}, "m/s", kBody,
      "velocity of nodes as seen from the body axes, the rate of the deflection",
      [k, shapes](const Sample& s, double* out) {
        Eigen::Map<VectorX>(out, shapes.rows()).noalias() = shapes * state_of(s, k).zdot;
      });
  signals_.back().lists["nodes"] = texts(node_ids);
}

void Observer::add_modal_motion(const System& system, int k, const std::set<FlexibleSignal>& chosen) {
  const int m = system.flexible[k].modal.mode_count();
  if (m == 0) return;
  if (chosen.contains(FlexibleSignal::modal_rates))
    add(path_of(system, k) + "/modal_rates", {m}, "m kg^0.5 s-1", "", "rates of the modal coordinates",
        [k, m](const Sample& s, double* out) { Eigen::Map<VectorX>(out, m) = state_of(s, k).zdot; });
  if (chosen.contains(FlexibleSignal::modal_accelerations))
    add(path_of(system, k) + "/modal_accelerations", {m}, "m kg^0.5 s-2", "",
        "second rates of the modal coordinates",
        [k, m](const Sample& s, double* out) { Eigen::Map<VectorX>(out, m) = s.ws.flexible[k].z_dd; });
}

void Observer::add_body_energies(const System& system, int k) {
  const std::string path = path_of(system, k);
  add(path + "/strain_energy", {}, "J", "", "strain energy, the sum over the modes",
      [k](const Sample& s, double* out) {
        *out = s.system.flexible[k].modal.elastic_energy(state_of(s, k));
      });
  add(path + "/kinetic_energy", {}, "J", "", "kinetic energy of the whole motion, vibration included",
      [k](const Sample& s, double* out) {
        const FlexibleBody& body = s.system.flexible[k];
        const BodyMotion& motion = s.ws.bodies[body.body];
        *out = body.modal.kinetic_energy(motion.X_WB.R.transpose() * linear(motion.V), state_of(s, k));
      });
  add(path + "/vibration_energy", {}, "J", "",
      "kinetic energy of the vibration as seen from the body axes, the sum over the modes",
      [k](const Sample& s, double* out) { *out = 0.5 * state_of(s, k).zdot.squaredNorm(); });
}

void Observer::add_modal_energies(const System& system, int k) {
  const int m = system.flexible[k].modal.mode_count();
  if (m == 0 || !system.flexible[k].modal.set().has_modes()) return;
  add(path_of(system, k) + "/modal_strain_energy", {m}, "J", "",
      "strain energy 1/2 omega^2 z^2 of each elastic mode", [k, m](const Sample& s, double* out) {
        const auto K = s.system.flexible[k].modal.set().stiffness.col(0);
        Eigen::Map<VectorX>(out, m) = 0.5 * K.cwiseProduct(state_of(s, k).z.cwiseAbs2());
      });
  add(path_of(system, k) + "/modal_kinetic_energy", {m}, "J", "",
      "kinetic energy 1/2 z'^2 of each elastic mode, as seen from the body axes",
      [k, m](const Sample& s, double* out) {
        Eigen::Map<VectorX>(out, m) = 0.5 * state_of(s, k).zdot.cwiseAbs2();
      });
}

void Observer::add_interface_forces(const System& system, int k) {
  const std::vector<std::string>& names = system.flexible[k].interface_names;
  const int n = static_cast<int>(names.size());
  if (n == 0) return;
  const auto part = [k, n](Eigen::Index first_row) {
    return [k, n, first_row, F = Matrix6X(6, n + 1)](const Sample& s, double* out) mutable {
      calc_interface_wrenches(s.system, k, s.ws, F);
      Eigen::Map<Matrix3X>(out, 3, n) = F.block(first_row, 0, 3, n);
    };
  };
  const std::string path = path_of(system, k);
  add(path + "/interface_force", {n, 3}, "N", kBody,
      "force of all joints, springs and loads together on each interface", part(3));
  signals_.back().lists["nodes"] = names;
  add(path + "/interface_moment", {n, 3}, "N m", kBody,
      "moment of all joints, springs and loads together on each interface, about it", part(0));
  signals_.back().lists["nodes"] = names;
}

void Observer::add_recovery(const System& system, const ObserverOptions::Recovery& recovery) {
  const int k = system.bodies[recovery.body].flexible;
  if (k < 0) return;
  add("/recovery/" + recovery.name, {static_cast<int>(recovery.R.rows())}, recovery.units, "",
      "recovered from the modal coordinates of the body '" + system.bodies[recovery.body].name + "'",
      [k, R = recovery.R](const Sample& s, double* out) {
        Eigen::Map<VectorX>(out, R.rows()).noalias() = R * state_of(s, k).z;
      });
  signals_.back().lists["rows"] = recovery.rows;
}

}  // namespace wishbone
