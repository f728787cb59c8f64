#include "forces/road/road.h"

#include <cmath>
#include <limits>
#include <numbers>

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

RoadPoint Road::at(double x, double y, int segment) const {
  const Segment& s = segments_[segment];
  RoadPoint road;
  road.height = y * tan_bank_;
  road.slope_y = tan_bank_;
  if (s.depth != 0) {
    // H = y tan(bank) - h sin(k (x - x0)),  dH/dx = -h k cos(k (x - x0))
    const double phase = s.wave_number * (x - s.lower);
    road.height -= s.depth * std::sin(phase);
    road.slope_x = -s.depth * s.wave_number * std::cos(phase);
  }
  road.uz = Vector3(-road.slope_x, -road.slope_y, 1.0).normalized();
  return road;
}

}  // namespace wishbone
