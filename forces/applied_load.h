#pragma once

#include <string>
#include <vector>

#include "forces/force_element.h"

namespace wishbone {

/// In which axes a load is constant.
enum class LoadAxes {
  kWorld,  ///< inertial: a dead load
  kMarker  ///< fixed to the marker: a follower load
};

/// Constant force and moment at one marker. It stores no energy: all its power counts as input.
class AppliedLoad {
 public:
  /// @param load t [N m] and f [N], components in `axes`
  /// @throws InputError naming the element when a component is not finite
  AppliedLoad(std::string name, MarkerIndex marker, Wrench load, LoadAxes axes = LoadAxes::kWorld);

  const std::string& name() const { return name_; }
  int state_count() const { return 0; }
  std::vector<MarkerIndex> markers() const;
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput&) const { return 0.0; }

 private:
  std::string name_;
  MarkerIndex marker_;
  Wrench load_;
  LoadAxes axes_;
};

}  // namespace wishbone
