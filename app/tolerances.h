#pragma once

#include <string>
#include <utility>
#include <vector>

namespace wishbone {

/// How far a signal may be from its baseline: |new - base| <= absolute + relative * max |base|, where the
/// maximum is over all rows and all components of the signal. One scale for the whole signal: a component
/// that is small beside the others is not held to its own few digits. `absolute` is in the unit of the
/// signal.
struct Tolerance {
  double relative = 1e-6;
  double absolute = 1e-9;
};

/// Tolerances by signal path. The last pattern that matches decides; without one, the default does.
class Tolerances {
 public:
  /// Throws InputError when a tolerance is negative or not finite.
  void add(const std::string& glob, const Tolerance& tolerance);
  /// Adds the rule "GLOB=RELATIVE[,ABSOLUTE]"; ABSOLUTE is 0 when left out. Returns GLOB.
  std::string add(const std::string& rule);
  /// Adds the rules of a YAML file in its order: a map from patterns to {relative: R, absolute: A}, of which
  /// either may be left out (then it is 0). Throws InputError with the line for everything else.
  void load(const std::string& yaml_path);

  Tolerance of(const std::string& path) const;

 private:
  std::vector<std::pair<std::string, Tolerance>> rules_;
};

}  // namespace wishbone
