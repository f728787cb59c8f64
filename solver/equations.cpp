#include "solver/equations.h"

#include "solver/partition.h"

namespace wishbone {

std::unique_ptr<FirstOrderSystem> make_equations(const System& system, const IntegratorOptions& options,
                                                 Workspace& ws, ProgressGuard& guard) {
  if (options.form == Form::partition) return std::make_unique<PartitionedSystem>(system, ws, guard);
  return std::make_unique<FirstOrderSystem>(system, ws, guard);
}

}  // namespace wishbone
