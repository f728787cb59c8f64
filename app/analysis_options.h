#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "solver/transient.h"

namespace wishbone {

/// What the command line may say instead of the scene's `analysis`.
struct AnalysisOptions {
  std::optional<Form> form;
  std::optional<Method> integrator;
  std::optional<double> rtol, atol, until;
};

/// Adds --form, --integrator, --rtol, --atol and --until to a sub-command.
void add_analysis_options(CLI::App& command, AnalysisOptions& options);

/// Replaces what was named on the command line.
void apply(const AnalysisOptions& options, TransientOptions& transient);

}  // namespace wishbone
