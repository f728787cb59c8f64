#include "models/compile_recoveries.h"

#include <fmt/format.h>

#include "core/error.h"

namespace wishbone {

void check_recoveries(const Scene& scene, const SystemBuilder& builder, const System& system) {
  for (const Scene::RecoveryOutput& output : scene.output.recoveries) {
    const TreeBody& body = system.bodies[builder.built_index(output.body)];
    if (body.flexible < 0) continue;
    const int modes = system.flexible[body.flexible].modal.mode_count();
    if (output.matrix.cols() == modes) continue;
    throw InputError(
        {output.where.text(),
         fmt::format("the matrix has {} column{}, the body '{}' has {} mode{}", output.matrix.cols(),
                     output.matrix.cols() == 1 ? "" : "s", body.name, modes, modes == 1 ? "" : "s"),
         "",
         "give one column for each elastic mode that the body keeps, in their order; rigid-body "
         "modes have none"});
  }
}

}  // namespace wishbone
