#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/function.h"
#include "forces/force_element.h"

namespace wishbone {

/// In which axes the components of a load are given.
enum class LoadAxes {
  kWorld,  ///< inertial: a dead load
  kMarker  ///< fixed to the marker: a follower load
};

/// Components of a load, each a function of time and signals: t [N m] about the marker's origin, f [N].
struct LoadComponents {
  std::array<Function, 3> t, f;
};

/// Force and moment at one marker. It stores no energy: all its power counts as input.
class AppliedLoad {
 public:
  /// A constant load: t [N m] and f [N], components in `axes`.
  /// @throws InputError naming the element when a component is not finite
  AppliedLoad(std::string name, MarkerIndex marker, const Wrench& load, LoadAxes axes = LoadAxes::kWorld);

  /// @throws InputError naming the element when a constant component is not finite
  AppliedLoad(std::string name, MarkerIndex marker, LoadComponents load, LoadAxes axes = LoadAxes::kWorld);

  const std::string& name() const { return name_; }
  int state_count() const { return 0; }
  std::vector<MarkerIndex> markers() const { return {marker_}; }
  std::vector<int> variables() const;
  std::vector<double> stop_times() const;

  /// This and output throw NumericsError naming the element and the time when a component is not finite.
  template <class T>
  void apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const;
  double energy(const ForceInput&) const { return 0.0; }
  /// What it exerts at its marker, world axes.
  Wrench output(const ForceInput& input) const { return wrench(input); }

 private:
  template <class T>
  WrenchT<T> wrench(const ForceInputT<T>& input) const;
  template <class Use>
  void for_each_component(Use use) const;

  std::string name_;
  MarkerIndex marker_;
  LoadComponents load_;
  LoadAxes axes_;
};

}  // namespace wishbone
