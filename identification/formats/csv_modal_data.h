#pragma once

#include <filesystem>
#include <vector>

#include "identification/modal_data.h"

namespace wishbone {

/// Modal data as three CSV tables (csv_table.h). Rows keep their order; columns of other names are refused.
///
///     nodes         node, x [m], y [m], z [m], mass [kg] (may be missing), all of which may have other units
///     frequencies   see csv_frequencies.h
///     shapes        node, axis, and for each mode of the frequencies a column `mode_7` (or `7`), in any order
///
/// An axis is x, y, z or 1, 2, 3. With a minus (`-x`) the freedom was measured against the axis, and the
/// amplitudes of the row change sign. Amplitudes have no unit: the modal mass goes with their scale.
struct CsvModalFiles {
  std::filesystem::path nodes, frequencies, shapes;
};

/// NAME_nodes.csv, NAME_frequencies.csv and NAME_shapes.csv for NAME or NAME.csv.
CsvModalFiles csv_modal_files(std::filesystem::path name);

/// What a table of nodes says.
struct NodeTable {
  std::vector<int> ids;  ///< n, each once
  Matrix3X position;     ///< 3 x n [m]
  VectorX mass;          ///< n [kg]; empty: no such column
};
NodeTable read_csv_nodes(const std::filesystem::path& path);

/// Throws InputError with file, line and byte of what is wrong.
ModalData read_csv_modal_data(const CsvModalFiles& files);

/// Writes the numbers so that reading gives the same bits, in SI. Support, lines, title and provenance have no
/// place in the tables. Throws InputError for data that are not valid, NumericsError when writing fails.
void write_csv_modal_data(const CsvModalFiles& files, const ModalData& data);

}  // namespace wishbone
