#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "identification/identify.h"
#include "identification/methods/released_modes.h"

namespace wishbone {

/// A task's measurement on the freedoms that are worked with, and the matrices over them.
struct PreparedStructure {
  ModalData data;                         ///< expanded or reduced, with masses where they are lumped
  SparseMatrix M;                         ///< of the free structure [kg]
  SupportMatrices support;                ///< that it was measured on
  MatrixX rigid;                          ///< rigid-body modes from geometry, M-orthonormal
  std::optional<MeasurementNoise> noise;  ///< given, or that which the modes show
  double shape_scatter = std::numeric_limits<double>::quiet_NaN();  ///< that the modes show; NaN: not known
  std::vector<std::string> notes, warnings;

  /// The measured modes as plain matrices.
  Modes measured() const { return {data.omega.cwiseAbs2(), data.shapes}; }
};

/// Expands or reduces the measurement, finds the masses where they are not given, sets up the matrices, leaves out modes
/// that are rigid motion (unheld_modes.h) and finds the noise (measurement_noise.h).
/// @throws InputError naming what is missing: masses, a model, measured freedoms
PreparedStructure prepare(const IdentificationTask& task);

/// A change as matrices dM, dK over freedoms.
/// @throws InputError when it acts on a freedom that is not there
struct ChangeMatrices {
  SparseMatrix dM, dK;
};
ChangeMatrices change_matrices(const StructureChange& change, const std::vector<Freedom>& freedoms);

}  // namespace wishbone
