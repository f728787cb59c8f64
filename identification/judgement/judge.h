#pragma once

#include "identification/solution.h"

namespace wishbone {

/// Holds a solution against what is certain, what was measured and what is known from elsewhere, and says in words
/// what should be doubted. `modes`: the solution as modal data.
Judgement judge(const IdentificationTask& task, const PreparedStructure& structure, const Solution& solution,
                const ModalData& modes);

}  // namespace wishbone
