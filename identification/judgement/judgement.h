#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "identification/modal_data.h"

namespace wishbone {

/// Identified modes held against modes that are known from elsewhere.
struct ReferenceComparison {
  std::string name;      ///< of the reference
  VectorX reference_hz;  ///< k, frequencies of the reference
  MatrixX mac;           ///< m x k, identified modes against the reference over the freedoms of both
  /// m, reference mode of largest MAC with each identified mode; -1: none of at least 0.4.
  std::vector<int> partner;
  VectorX frequency_error;  ///< m, f / f_partner - 1; NaN without partner
};

/// What there is to know about the quality of an identification.
struct Judgement {
  VectorX input_hz;      ///< frequencies of the modes that it started from
  VectorX frequency_hz;  ///< m, identified
  /// m, bound on |lambda - lambda_true| / lambda by what the kept set leaves; NaN: no bound.
  VectorX residual;
  VectorX error_estimate;    ///< m, estimated relative error of the frequency by what was left out; NaN: none
  VectorX frequency_std_hz;  ///< m, standard deviation under the measurement noise; empty: none
  double shape_scatter =
      std::numeric_limits<double>::quiet_NaN();  ///< that the modes show; NaN: not known [-]
  MatrixX auto_mac;                              ///< m x m, identified modes among each other
  MatrixX input_mac;                             ///< m x (input modes), which measured mode became which
  double input_orthogonality_error = 0;  ///< largest off-diagonal of normalised Psi^T M_t Psi of the input
  double orthogonality_error = 0;        ///< largest element of |Psi^T M Psi - 1| of the result
  double rigid_body_error = 0;           ///< largest element of |Psi_0^T M Psi| of the result
  int lost_modes = 0;                    ///< elastic modes that this support hides from any measurement
  std::vector<std::pair<std::string, double>> condition_numbers;  ///< name of a matrix, its condition number
  std::optional<ReferenceComparison> reference;
  std::vector<std::string> notes;     ///< what was done, in words
  std::vector<std::string> warnings;  ///< what the user should doubt
};

}  // namespace wishbone
