#pragma once

#include <string>

#include "identification/elements/mesh.h"
#include "identification/modal_data.h"

namespace wishbone {

/// What CalculiX is given: hexahedra C3D8 of one material, held by a support whose directions lie along the
/// axes.
struct CalculixModel {
  Mesh mesh;
  IsotropicMaterial material;
  Support support;
};

/// Input deck (.inp) that asks for the `mode_count` lowest modes, shapes into the .frd file.
std::string modes_deck(const CalculixModel& model, int mode_count);

/// Input deck that asks for the matrices of the eigenproblem: .sti, .mas, and .dof naming their rows.
std::string matrices_deck(const CalculixModel& model);

}  // namespace wishbone
