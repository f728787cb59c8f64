#pragma once

#include <string>

#include "identification/judgement/judgement.h"

namespace wishbone {

/// Holds identified modes against known ones over the freedoms that both show. Modes of one frequency are
/// any basis of the space that they span and are paired and judged as that (match_modes, matching.h).
/// Throws InputError if the two have no freedom in common.
ReferenceComparison compare_with_reference(const ModalData& modes, const ModalData& reference,
                                           const std::string& name);

}  // namespace wishbone
