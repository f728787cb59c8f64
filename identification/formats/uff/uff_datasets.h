#pragma once

#include <unordered_map>

#include "identification/formats/uff/uff_file.h"
#include "identification/formats/uff/uff_input.h"

/// One function for each kind of dataset: reads it from the line after its number to its delimiter. All throw
/// InputError at the place that is wrong.
namespace wishbone {

/// The contents so far, with what is needed to put more to it.
struct UffContents {
  UffFile file;
  std::unordered_map<int, std::size_t> node_at;    ///< number -> index in file.nodes
  std::unordered_map<int, std::size_t> system_at;  ///< number -> index in file.coordinate_systems
};

void read_uff_header(UffInput& in, UffContents& contents);               // 151
void read_uff_units(UffInput& in, UffContents& contents);                // 164
void read_uff_coordinate_systems(UffInput& in, UffContents& contents);   // 18
void read_uff_coordinate_matrices(UffInput& in, UffContents& contents);  // 2420
void read_uff_nodes(UffInput& in, UffContents& contents);                // 15
void read_uff_nodes_in_double(UffInput& in, UffContents& contents);      // 781
void read_uff_nodes_of_part(UffInput& in, UffContents& contents);        // 2411
void read_uff_trace_line(UffInput& in, UffContents& contents);           // 82
void read_uff_elements(UffInput& in, UffContents& contents);             // 2412
void read_uff_data_at_nodes(UffInput& in, UffContents& contents);        // 55
void read_uff_analysis_data(UffInput& in, UffContents& contents);        // 2414
void read_uff_function(UffInput& in, UffContents& contents);             // 58
void read_uff_binary_function(UffInput& in, UffContents& contents);      // 58b, from the line of its number

}  // namespace wishbone
