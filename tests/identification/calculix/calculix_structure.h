#pragma once

#include <filesystem>
#include <string>

#include "identification/calculix/calculix_deck.h"
#include "identification/methods/modes.h"
#include "identification/modal_data.h"

namespace wishbone {

/// Whether the finite-element program is there: the command `ccx` of the package calculix-ccx.
bool calculix_is_installed();

/// A structure that CalculiX analysed on a support and free. All rows are all_freedoms(supported.node_ids).
struct CalculixStructure {
  ModalData supported;  ///< modes on the support, six digits, unit modal mass; node masses unknown
  SparseMatrix M, K;    ///< of the free structure, M consistent [kg], [N/m]
  Modes free;           ///< rigid-body modes first
};

/// An L-shaped frame of steel, twisted and tapered so that it has no symmetry: 1295 nodes, 3885 freedoms,
/// 718 kg.
CalculixModel calculix_frame();
/// Springs of stiffness k [N/m] in x, y and z at the tip of each leg and at the corner.
Support frame_springs(double k);
/// Six joints that just hold it, on the same nodes.
Support frame_joints();

/// Has CalculiX store the matrices of a model as `job` in a folder; gives the path of the files without extension.
std::string store_calculix_matrices(const CalculixModel& model, const std::filesystem::path& folder,
                                    const std::string& job);

/// Runs CalculiX three times in a folder of its own. Throws InputError saying what it said if it fails.
CalculixStructure analyse_with_calculix(const CalculixModel& model, int mode_count);

/// The frame on springs or joints with its `mode_count` lowest modes.
CalculixStructure calculix_supported_structure(const Support& support, int mode_count = 40);

}  // namespace wishbone
