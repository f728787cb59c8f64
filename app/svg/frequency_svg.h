#pragma once

#include <string>

#include "identification/judgement/judgement.h"

namespace wishbone {

/// Deviation of each identified frequency from that of its reference mode, in percent, with bars of one
/// standard deviation where that is known; modes without a reference mode are crosses on the lower edge.
/// Throws InputError when the judgement has no reference.
std::string frequency_svg(const Judgement& judgement);

}  // namespace wishbone
