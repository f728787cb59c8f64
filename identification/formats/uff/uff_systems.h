#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "core/spatial.h"
#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// A coordinate system in global axes.
struct UffFrame {
  Vector3 origin = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();  ///< columns: its unit vectors

  Vector3 global(const Vector3& local) const { return origin + axes * local; }
};

/// The coordinate systems of a file, followed through those that they refer to. Number 0 is global, and so is
/// 1 where the file does not define it: finite-element programs name the global system so.
class UffSystems {
 public:
  /// `where` is the place that errors name.
  UffSystems(const std::vector<UffCoordinateSystem>& systems, std::string where);

  bool is_global(int number) const { return number == 0 || (number == 1 && !systems_.contains(1)); }

  /// Throws InputError for a system that is not defined, that is not Cartesian, or that refers to itself.
  const UffFrame& frame(int number);

 private:
  std::string where_;
  std::unordered_map<int, const UffCoordinateSystem*> systems_;
  std::unordered_map<int, UffFrame> frames_;  ///< of the numbers that were asked for
};

}  // namespace wishbone
