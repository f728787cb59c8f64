#pragma once

#include "identification/identify.h"

namespace wishbone {

/// Refuses a model that is not free: K must not resist rigid motion. What a freedom i does resist,
///     |sum_j K_ij psi_j| <= 1e-5 sum_j |K_ij psi_j|        for all rigid motions psi,
/// is measured by the terms that cancel in it: numbers of six digits, as files have them, are off by half of that at
/// most.
/// Throws InputError that names the nodes which are held; or, where K is free in rows that run through x of all nodes,
/// then y, then z, that order.
void check_is_free(const AnalyticalModel& model);

}  // namespace wishbone
