#pragma once

#include "models/compile.h"

namespace wishbone {

/// The modes that a flexible body in modal form was made of.
inline ModeSet compiled_modes(const CompiledScene& compiled, std::size_t body = 0) {
  const ShapeSet& set = compiled.system.flexible.at(body).modal.set();
  const VectorX omega = set.stiffness.col(0).cwiseSqrt();
  return {set.node_ids, set.node_mass, set.node_position,
          omega,        set.shapes,    set.damping.col(0).cwiseQuotient(2 * omega)};
}

}  // namespace wishbone
