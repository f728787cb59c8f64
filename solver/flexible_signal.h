#pragma once

namespace wishbone {

/// What is recorded of a flexible body where it is asked for, beside its modal coordinates (docs/results.md).
enum class FlexibleSignal {
  deflection_rates,     ///< of the nodes whose deflections are recorded
  modal_rates,          ///< z'
  modal_accelerations,  ///< z''
  energies,             ///< of the body
  modal_energies,       ///< of each mode
  interface_forces      ///< what acts on its interfaces, nodes and frames: forces and moments
};

}  // namespace wishbone
