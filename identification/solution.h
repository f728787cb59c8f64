#pragma once

#include "identification/prepared_structure.h"

namespace wishbone {

/// What a task comes to on plain matrices, before it is judged.
struct Solution {
  Modes modes;             ///< identified, unit modal mass in M
  SparseMatrix M;          ///< of the structure that they belong to
  SparseMatrix D;          ///< joints that hold it
  VectorX residual;        ///< relative bound on the error of lambda; NaN: none
  double kept_lambda = 0;  ///< stiffest mode of the set that they were found in [rad2/s2]
  MatrixX coefficients;    ///< measured modes x identified ones; empty where a mode is no combination of them
  /// Stiffest support over stiffest kept mode, lambda(M^-1 K_s) / lambda_m; 0: complete set.
  double support_ratio = 0;
  int lost_modes = 0;
  std::optional<CorrectedModel> corrected;
};

/// Finds the modes of the task's goal from measured ones (as given, or disturbed by noise).
/// @throws InputError when they cannot give what is looked for
Solution solve(const IdentificationTask& task, const PreparedStructure& structure, const Modes& measured);

}  // namespace wishbone
