#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "solver/transient.h"

namespace wishbone {

/// What the command line may say instead of the scene's `analysis`.
struct AnalysisOptions {
  std::optional<Form> form;
  std::optional<Method> integrator;
  std::optional<double> rtol, atol;
  std::optional<double> until;          ///< [s]
  std::vector<std::string> as_written;  ///< "--rtol 1e-4", for the record
};

/// Adds --form, --integrator, --rtol, --atol and --until to a sub-command. Parsing them throws InputError under the rules that
/// the scene has for the same keys.
void add_analysis_options(CLI::App& command, AnalysisOptions& options);

/// Replaces what was named on the command line. A run shorter than the interval of outputs has its end as the only one after
/// the start.
/// @throws InputError when there would be more outputs than a scene may ask for
void apply(const AnalysisOptions& options, TransientOptions& transient);

/// Adds the argument SCENE and the option --set, which overrides parameters of the scene.
void add_scene_arguments(CLI::App& command, std::string& scene, std::vector<std::string>& set);

}  // namespace wishbone
