#pragma once

#include <string>

#include "identification/judgement/judgement.h"

namespace wishbone {

/// Holds identified modes against known ones over the freedoms that both show. Modes of one frequency (within 0.01 %)
/// are any basis of the space that they span: before the MAC is taken, those of the reference are turned within it to
/// lie nearest to their identified partners (orthogonal Procrustes problem [Schoenemann 1966]).
/// Throws InputError if the two have no freedom in common.
ReferenceComparison compare_with_reference(const ModalData& modes, const ModalData& reference,
                                           const std::string& name);

}  // namespace wishbone
