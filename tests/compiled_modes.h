#pragma once

#include "models/compile.h"

namespace wishbone {

/// The modes that a flexible body in modal form was made of.
inline ModeSet compiled_modes(const CompiledScene& compiled, std::size_t body = 0) {
  return as_modes(compiled.system.flexible.at(body).modal.set());
}

}  // namespace wishbone
