#pragma once

#include <functional>
#include <string>
#include <vector>

#include "models/compile.h"

namespace wishbone {

/// How the results of a run are made and where they go.
struct RunRequest {
  std::string scene_path;
  std::string output_path;
  std::vector<std::string> overrides;      ///< "name=value" for the scene's parameters, kept with the results
  std::function<bool(double)> keep_going;  ///< asked with the time after every step; false interrupts the run
  /// What was said instead of the scene's analysis, as written; kept too.
  std::vector<std::string> command_line = {};
};

/// Where a run with these results keeps the modes that it identified for a body: OUT.BODY_modes.h5 beside OUT.h5.
std::string identified_modes_path(const std::string& output_path, const std::string& body);

/// A position where the closures lost rank, and the closure row that came closest to depending on the others.
struct NamedPassage {
  double t = 0;  ///< [s]
  std::string row;
};

/// What the run came to, for the terminal and for machines.
struct RunResult {
  TransientSummary summary;
  WorkCounters work;
  std::vector<std::string> redundant_rows;
  std::vector<NamedPassage> singular_passages;
  Warnings warnings;  ///< of the scene, of what was built from it, and of the run
  double wall_seconds = 0, cpu_seconds = 0;
};

/// The form and method that the scene, or the command line in its stead, means.
/// @throws InputError naming the place of `analysis` in the file when they do not fit
IntegratorOptions resolved_options(const Scene& scene, const CompiledScene& compiled);

/// Keeps the modes that were identified for its bodies, runs the compiled scene and records the signals that it chooses (all by
/// default) in the results file, which no other run writes meanwhile. A run that fails keeps what it computed; the file says so in
/// its status.
/// @throws InputError when form and integrator do not fit the scene, a prescribed motion jumps, two parts of the scene want one
///   path of the results, it cannot be assembled, another run writes to the file, or no signal is chosen: then no file is made and
///   one of that name stays as it is; NumericsError when the file cannot be written
RunResult run_scene(const Scene& scene, const CompiledScene& compiled, const RunRequest& request);

}  // namespace wishbone
