#pragma once

#include <string>
#include <vector>

#include "models/compile_modes.h"
#include "models/scene.h"
#include "solver/observer.h"
#include "solver/system.h"
#include "solver/transient.h"

namespace wishbone {

/// A scene made ready to run.
struct CompiledScene {
  System system;
  State initial;  ///< before assembly
  ObserverOptions observer;
  TransientOptions transient;
  std::vector<IdentifiedBody> identified;
  std::vector<BodyModes> modes;  ///< of flexible bodies
  Warnings warnings;             ///< of the scene and of what was built from it
};

/// Builds the System of a scene: places the design pose, prepares the modes of flexible bodies, keeps what this scene needs and
/// nothing else.
/// @throws InputError naming the place in the scene file
CompiledScene compile(const Scene& scene);

}  // namespace wishbone
