#pragma once

#include <string>

#include "identification/identify.h"

namespace wishbone {

/// Writes a mode file (mode_file.h) of the identified modes with what there is to know about their quality in the
/// group /judgement: residual, frequency_std, auto_mac, input_mac, input_frequency, reference_frequency,
/// reference_mac, and as attributes the errors, condition numbers, notes and warnings. Read it with read_mode_file,
/// which leaves the judgement aside. Throws InputError for modes that are not valid, NumericsError when writing fails.
void write_identification(const std::string& path, const Identification& identification);

}  // namespace wishbone
