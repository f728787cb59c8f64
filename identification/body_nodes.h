#pragma once

#include <vector>

#include "identification/identify.h"

namespace wishbone {

/// Nodes of the body that an identification will give, known before it is carried out.
struct BodyNodes {
  std::vector<int> ids;
  Matrix3X position;  ///< 3 x n, body axes, from the mass centre [m]
};

/// @throws InputError if the masses that the mass centre follows from are not known
BodyNodes body_nodes(const IdentificationTask& task);

}  // namespace wishbone
