#pragma once

#include <filesystem>
#include <vector>

#include "identification/methods/modes.h"
#include "identification/modal_data.h"

namespace wishbone {

/// Matrices that CalculiX stores of an analysis `*FREQUENCY, SOLVER=MATRIXSTORAGE` of the job NAME, and the places of
/// the nodes that they belong to. Numbers are in the units of the deck; what wishbone takes for SI must be SI.
struct CalculixMatrices {
  std::vector<int> node_ids;  ///< n, ascending: those with freedoms
  Matrix3X node_position;     ///< 3 x n
  SparseMatrix K, M;          ///< 3n x 3n, node by node in x, y, z; M consistent
};

/// Reads NAME.dof (the rows), NAME.sti and NAME.mas, and the nodes from `nodes`: NAME.inp, or a result file .frd.
/// Throws InputError with file, line and byte for what is wrong with the text, and if x, y and z of a node are not all
/// among the rows, as on a support.
CalculixMatrices read_calculix_matrices(const std::filesystem::path& job, const std::filesystem::path& nodes);

/// Rows of stored matrices from a .dof file: lines "node.direction", directions 1 to 3.
std::vector<Freedom> read_calculix_freedoms(const std::filesystem::path& path);

/// Matrix of a .sti or .mas file, the upper triangle as lines "row column value" with rows from 1, with its rows and
/// columns moved from the order `rows` to the order `freedoms`.
SparseMatrix read_calculix_matrix(const std::filesystem::path& path, const std::vector<Freedom>& rows,
                                  const std::vector<Freedom>& freedoms);

/// Nodes of an input deck (.inp: the data lines of *NODE, "id, x, y, z") or of a result file (.frd: block 2C), by the
/// extension of the name; ascending. Throws InputError for decks whose nodes stand elsewhere (*INCLUDE, *NODE INPUT)
/// or whose freedoms have other axes (*TRANSFORM). Nodes that cards such as *NGEN make are not seen.
struct CalculixNodes {
  std::vector<int> ids;
  Matrix3X position;  ///< 3 x n
};
CalculixNodes read_calculix_nodes(const std::filesystem::path& path);

}  // namespace wishbone
