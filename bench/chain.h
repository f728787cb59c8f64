#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace wishbone::bench {

/// A serial chain of rods of 1 m and 1 kg that hangs along -z, revolute joints about y and x in turn, out of line and moving.
/// Every engine gets these numbers.
struct ChainRod {
  static constexpr double kLength = 1, kMass = 1;
  static constexpr double kAcross = 1.0 / 12,
                          kAlong = 1e-3;  ///< principal moments of inertia about the middle [kg m2]
  static constexpr double kGravity = 9.81;
  static bool turns_about_y(int i) { return i % 2 == 0; }
  static double angle(int i) { return 0.3 * std::sin(i + 1.0); }
  static double speed(int i) { return 0.5 * std::cos(3.0 * i); }
};

/// Forward dynamics of the chain with one engine.
class Chain {
 public:
  virtual ~Chain() = default;
  /// One evaluation from scratch: positions, velocities and accelerations.
  virtual void evaluate() = 0;
  /// Second derivatives of all joint angles after evaluate() [rad/s2].
  virtual std::vector<double> accelerations() const = 0;
};

/// Defined where the engine is installed.
std::unique_ptr<Chain> make_simbody_chain(int rods);
/// Defined where the engine is installed. Nothing when it cannot load a chain of this length.
std::unique_ptr<Chain> make_mujoco_chain(int rods);

}  // namespace wishbone::bench
