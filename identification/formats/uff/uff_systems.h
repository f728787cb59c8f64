#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "core/spatial.h"
#include "identification/formats/uff/uff_file.h"

namespace wishbone {

/// A coordinate system in global axes. Coordinates of one that is not Cartesian are r, theta, z (cylindrical) or
/// r, theta, phi (spherical: theta from the z axis, phi about it from x), angles in degrees.
struct UffFrame {
  Vector3 origin = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();  ///< columns: unit vectors of its Cartesian axes
  int type = 0;                        ///< as UffCoordinateSystem::type

  /// Position of a point from its coordinates.
  Vector3 global(const Vector3& coordinates) const;
  /// Columns: unit vectors along which the coordinates grow at a point in global axes; on the z axis, where r does not
  /// tell a direction, those of angles of zero.
  Matrix3 directions_at(const Vector3& point) const;
};

/// The coordinate systems of a file, followed through those that they refer to. Number 0 is global, and so is
/// 1 where the file does not define it: finite-element programs name the global system so.
class UffSystems {
 public:
  /// `where` is the place that errors name.
  UffSystems(const std::vector<UffCoordinateSystem>& systems, std::string where);

  bool is_global(int number) const { return number == 0 || (number == 1 && !systems_.contains(1)); }

  /// Throws InputError for a system that is not defined, of a type that there is none of, that refers to one that is
  /// not Cartesian, or to itself.
  const UffFrame& frame(int number);
  /// Of a node, in global axes.
  Vector3 position(const UffNode& node);

 private:
  std::string where_;
  std::unordered_map<int, const UffCoordinateSystem*> systems_;
  std::unordered_map<int, UffFrame> frames_;  ///< of the numbers that were asked for
};

}  // namespace wishbone
