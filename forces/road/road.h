#pragma once

#include <vector>

#include "core/spatial.h"

namespace wishbone {

/// One half sine wave cut into the road:
///     profile(x) = -depth sin(pi (x - start)/length),   start <= x <= start + length.
struct RoadDepression {
  double start = 0;   ///< [m]
  double length = 0;  ///< [m], positive
  double depth = 0;   ///< [m], positive downward; negative makes a bump
};

/// The road straight above or below one point of the plane.
template <class T>
struct RoadPointT {
  T height = T(0);   ///< H [m]
  T slope_x = T(0);  ///< dH/dx
  T slope_y = T(0);  ///< dH/dy
  /// Unit normal, world components, upward: (-dH/dx, -dH/dy, 1) normalised.
  Vector3T<T> uz = Vector3T<T>::UnitZ();
};
using RoadPoint = RoadPointT<double>;

/// Road surface z = H(x, y) = y tan(bank) + profile(x), world axes, z up; bank > 0 raises the left (+y) side.
///
/// The profile is flat but for its depressions, and so falls into *segments* along x. Its slope jumps between
/// them. Evaluation therefore takes the active segment and continues that segment's formula analytically
/// beyond its edges: an integrator that oversteps an edge sees a smooth road, locates the crossing as an
/// event, and then switches.
class Road {
 public:
  /// The level plane z = 0.
  Road() : Road(0.0, {}) {}

  /// @param bank [rad], |bank| < pi/2
  /// @param depressions ascending in x, not overlapping (they may touch)
  /// @throws InputError when the bank or a depression is out of range, or the depressions overlap
  Road(double bank, std::vector<RoadDepression> depressions);

  int segment_count() const { return static_cast<int>(segments_.size()); }
  /// Segment whose half-open interval [lower edge, upper edge) holds x.
  int segment_at(double x) const;
  double lower_edge(int segment) const { return segments_[segment].lower; }  ///< [m]; -infinity for the first
  double upper_edge(int segment) const { return segments_[segment].upper; }  ///< [m]; +infinity for the last

  /// The surface at (x, y) by the formula of `segment`, whether or not x lies within its edges.
  template <class T>
  RoadPointT<T> at(const T& x, const T& y, int segment) const;
  RoadPoint at(double x, double y, int segment) const { return at<double>(x, y, segment); }

 private:
  // profile = -depth sin(wave_number (x - lower)); a flat segment has depth and wave number zero
  struct Segment {
    double lower, upper;
    double depth, wave_number;
  };
  void add_flat(double lower, double upper);

  double tan_bank_;
  std::vector<Segment> segments_;
};

}  // namespace wishbone
