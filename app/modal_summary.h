#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "identification/modal_data.h"

namespace wishbone {

/// "46 nodes, 138 freedoms, 12 modes from 17.35 Hz to 60.1 Hz, free".
std::string brief(const ModalData& data);

/// Size, mass, mass centre and inertia, as they were understood, for people.
void print_extent(const ModalData& data);
/// Warns on standard error when lengths or masses of a file can hardly be in m and kg.
void warn_of_units(const std::string& file, const ModalData& data);

/// Writes modal data to a file, and tells what was written and what the format has no place for (lost_in_modal_data).
void write_and_tell(const std::string& path, const ModalData& data);

/// Modal data for people: counts, table of modes, support, provenance.
void print_modal_data(const ModalData& data);

/// The same for programs.
nlohmann::ordered_json json_of(const ModalData& data);

}  // namespace wishbone
