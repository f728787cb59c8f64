#pragma once

#include "identification/judgement/judgement.h"
#include "identification/modal_data.h"

namespace wishbone {

/// Modes that were looked for, the modes that they were found from, and how good they are.
struct Identification {
  std::string title;
  ModalData input;  ///< as used: chosen modes, real, expanded or reduced
  ModalData modes;  ///< the identified ones, of unit modal mass
  Judgement judgement;
};

}  // namespace wishbone
