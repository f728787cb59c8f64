#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "solver/energy.h"
#include "solver/flexible_signal.h"
#include "solver/point_motion.h"
#include "solver/signal.h"
#include "solver/workspace.h"

namespace wishbone {

/// What is observed beyond the plain motion of bodies, joints and forces.
struct ObserverOptions {
  struct Flexible {
    int body = -1;              ///< index into System::bodies; nothing is recorded of a rigid one
    std::vector<int> node_ids;  ///< whose deflections are recorded
    std::set<FlexibleSignal> signals;
  };
  /// What a matrix makes of the modal coordinates of a flexible body: R z, stresses or strains.
  struct Recovery {
    std::string name, units;
    int body = -1;                  ///< index into System::bodies; nothing is recorded of a rigid one
    std::vector<std::string> rows;  ///< their names
    MatrixX R;                      ///< rows x modes
  };
  struct Steering {
    std::string name;
    int body = -1;    ///< body whose inboard joint steers
    double sign = 1;  ///< of the coordinate, positive to the left
  };
  struct Point {
    std::string name;
    BodyPoint point;
  };
  struct NamedSignal {
    std::string name, units;
  };
  std::vector<Flexible> flexible;
  std::vector<Recovery> recoveries;
  std::vector<Point> points;
  std::vector<NamedSignal> signals;  ///< the first ones of System::signals, in their order
  int chassis = -1;                  ///< body of the derived vehicle signals; -1: none
  std::vector<Steering> steering;
};

/// Turns states into rows of signals for the Recorder. Each signal is defined in one place, together with its path, unit and
/// frame; its evaluation runs at output times only.
class Observer {
 public:
  Observer(const System& system, const ObserverOptions& options);

  const std::vector<Signal>& signals() const { return signals_; }
  /// Leaves out the signals whose path no pattern matches (core/glob.h); no pattern: keeps all. Returns the patterns that match
  /// nothing. @throws InputError when no signal is left
  std::vector<std::string> keep(const std::vector<std::string>& patterns);

  /// The row of one state, valid until the next call. Solves the equations of motion at the state for the reactions.
  std::span<const double> sample(const State& state, const Work& work, Workspace& ws);

  /// What the signals are computed from.
  struct Sample {
    const System& system;
    const State& state;
    const Workspace& ws;
    Energy energy;
    double dissipated = 0, input = 0;  // [J]
  };
  using Evaluate = std::function<void(const Sample&, double* out)>;

 private:
  void add(std::string path, std::vector<int> shape, std::string units, std::string frame, std::string about,
           Evaluate evaluate);
  void size_row();
  void add_bodies(const System& system);
  void add_flexible(const System& system, const ObserverOptions& options);
  // of System::flexible[k]
  void add_deflections(const System& system, int k, const std::vector<int>& node_ids, bool rates);
  void add_modal_motion(const System& system, int k, const std::set<FlexibleSignal>& chosen);
  void add_body_energies(const System& system, int k);
  void add_modal_energies(const System& system, int k);
  void add_interface_forces(const System& system, int k);
  void add_recovery(const System& system, const ObserverOptions::Recovery& recovery);
  void add_tree_joints(const System& system);
  void add_rotation(const std::string& path, const TreeBody& body);
  void add_translation(const std::string& path, const TreeBody& body);
  void add_measured(const System& system);
  void add_closures(const System& system);
  void add_forces(const System& system);
  void add_signals(const ObserverOptions& options);
  void add_points(const ObserverOptions& options);
  void add_vehicle(const ObserverOptions& options);
  void add_energy();
  void add_constraints(const System& system);

  const System& system_;
  std::vector<Signal> signals_;
  std::vector<Evaluate> evaluators_;
  std::vector<double> row_;
  bool started_ = false;
  double springs_at_start_ = 0;
};

}  // namespace wishbone
