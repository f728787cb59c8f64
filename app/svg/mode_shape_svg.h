#pragma once

#include <string>

#include "identification/modal_data.h"

namespace wishbone {

struct ModeShapeOptions {
  double width = 640;       ///< of the picture [px]
  double amplitude = 0.15;  ///< largest displacement drawn, as a share of the structure's diagonal
};

/// A mode shape (mode counts from 0): the structure at rest in grey with its support, the displaced one coloured
/// by displacement, in the view that lets slender bodies fill the width. Nodes that were measured in some
/// directions only move in those. The picture is as high as the structure needs. Throws InputError when the
/// data are not valid or there is no such mode.
std::string mode_shape_svg(const ModalData& data, int mode, const ModeShapeOptions& options = {});

/// The lowest `count` modes (fewer when there are fewer) side by side in rows of up to three, all in the same
/// view and scale, with one legend. Throws InputError when the data are not valid.
std::string mode_sheet_svg(const ModalData& data, int count);

}  // namespace wishbone
