#pragma once

#include <vector>

#include "core/spatial.h"
#include "identification/formats/uff_file.h"

namespace wishbone {

/// A coordinate system in global axes.
struct UffFrame {
  Vector3 origin = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();  ///< columns: its unit vectors

  Vector3 global(const Vector3& local) const { return origin + axes * local; }
};

/// Position of a coordinate system through those that it refers to. Number 0 is global, and so is 1 where the file does
/// not define it: finite-element programs name the global system so. Throws InputError (place: `file`) for a system
/// that is not defined, that is not Cartesian, or that refers to itself.
UffFrame uff_frame(const std::vector<UffCoordinateSystem>& systems, int number, const std::string& file);

/// Whether `number` is global because the file does not define it.
bool is_undefined_global(const std::vector<UffCoordinateSystem>& systems, int number);

}  // namespace wishbone
