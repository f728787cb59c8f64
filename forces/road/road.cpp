#include "forces/road/road.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/dual.h"
#include "core/require.h"

namespace wishbone {

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}

Road::Road(double bank, std::vector<RoadDepression> depressions) : tan_bank_(std::tan(bank)) {
  require(std::abs(bank) < 0.5 * std::numbers::pi, "road", "the bank angle must lie within a quarter turn",
          bank, "give the bank in radians, or with its unit");
  double end = -kInfinity;
  for (const RoadDepression& d : depressions) {
    require(d.length > 0 && std::isfinite(d.length), "road", "a depression needs a positive length", d.length,
            "give the length in the direction of travel");
    require(std::isfinite(d.depth), "road", "the depth of a depression must be finite", d.depth,
            "give it in metres");
    require(d.start >= end && std::isfinite(d.start), "road", "depressions must ascend in x without overlap",
            d.start, "sort them by start and end each one before the next begins");
    if (d.start > end) add_flat(end, d.start);
    end = d.start + d.length;
    segments_.push_back({d.start, end, d.depth, std::numbers::pi / d.length});
  }
  add_flat(end, kInfinity);
}

void Road::add_flat(double lower, double upper) {
  segments_.push_back({lower, upper, 0.0, 0.0});
}

int Road::segment_at(double x) const {
  int segment = 0;
  while (segment + 1 < segment_count() && x >= segments_[segment].upper) ++segment;
  return segment;
}

template <class T>
RoadPointT<T> Road::at(const T& x, const T& y, int segment) const {
  using std::cos;
  using std::sin;
  const Segment& s = segments_[segment];
  RoadPointT<T> road;
  road.height = y * tan_bank_;
  road.slope_y = tan_bank_;
  if (s.depth != 0) {
    // H = y tan(bank) - h sin(k (x - x0)),  dH/dx = -h k cos(k (x - x0))
    const T phase = s.wave_number * (x - s.lower);
    road.height -= s.depth * sin(phase);
    road.slope_x = -s.depth * s.wave_number * cos(phase);
  }
  road.uz = Vector3T<T>(-road.slope_x, -road.slope_y, T(1)).normalized();
  return road;
}

template RoadPointT<double> Road::at(const double&, const double&, int) const;
template RoadPointT<Dual> Road::at(const Dual&, const Dual&, int) const;

}  // namespace wishbone
