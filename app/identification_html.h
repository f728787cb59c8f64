#pragma once

#include <string>

#include "identification/identify.h"

namespace wishbone {

/// A page about an identification: what was found from what, warnings, the table of modes, pictures of the
/// lowest modes and of the modal assurance criterion, measures of quality, where the data come from. Complete
/// in itself: nothing is loaded, no program runs. What is not known is left out or shown as a dash. Throws
/// InputError when the modal data are not valid or the matrices of the judgement do not fit its modes.
std::string identification_html(const Identification& identification);

}  // namespace wishbone
