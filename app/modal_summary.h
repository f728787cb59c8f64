#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "identification/modal_data.h"

namespace wishbone {

/// "46 nodes, 138 freedoms, 12 modes from 17.35 Hz to 60.1 Hz, free".
std::string brief(const ModalData& data);

/// Tells what the format of a file has no place for, if there is anything (lost_in_modal_data).
void print_lost(const std::string& path, const ModalData& data);

/// Modal data for people: counts, table of modes, support, provenance.
void print_modal_data(const ModalData& data);

/// The same for programs.
nlohmann::ordered_json json_of(const ModalData& data);

}  // namespace wishbone
