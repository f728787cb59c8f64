#pragma once

#include <string>
#include <utility>

#include "core/require.h"
#include "joints/row_list.h"
#include "joints/rows/driven_gauge.h"

namespace wishbone {

/// A coordinate between two markers follows a motion, whatever else joins them: Phi = u - motion(t), 1 row. Its
/// multiplier is the driving force, and -lambda Phi_t the power that it brings.
struct DrivenClosure : RowList<DrivenGauge> {
  static constexpr const char* kKind = "driven";

  DrivenClosure(std::string name, Gauge gauge, Motion motion)
      : RowList(DrivenGauge{std::move(name), gauge, std::move(motion)}) {}

  bool row_is_angle(int /*row*/) const { return gauge(0).is_angle(); }
  const Motion* drive() const { return &row<0>().motion; }
};

/// Two points stay at a distance, as the ends of a massless rod with ball joints: Phi = |p_AB| - length, 1 row [m]; or the
/// distance follows a motion, as an actuator.
/// @throws NumericsError from its evaluations, naming the joint, where the points coincide
class DistanceClosure : public RowList<DrivenGauge> {
 public:
  static constexpr const char* kKind = "distance";
  static constexpr std::array<const char*, 1> kDirections{"length"};

  /// @throws InputError naming the joint unless length > 0 [m]
  DistanceClosure(const std::string& name, double length)
      : RowList(DrivenGauge{name, {Gauge::Kind::distance}, Motion(name, positive(name, length), {})}) {}
  DistanceClosure(std::string name, Motion motion)
      : RowList(DrivenGauge{std::move(name), {Gauge::Kind::distance}, std::move(motion)}), driven_(true) {}

  const Motion* drive() const { return driven_ ? &row<0>().motion : nullptr; }

 private:
  static double positive(const std::string& name, double length) {
    require(length > 0, name, "the length of a distance joint must be positive", length,
            "give it in m, or join coinciding points by a spherical joint");
    return length;
  }

  bool driven_ = false;
};

}  // namespace wishbone
