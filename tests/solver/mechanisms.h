#pragma once

#include <random>
#include <utility>
#include <vector>

#include "identification/free_free_modes.h"
#include "solver/system_builder.h"
#include "solver/transient.h"

/// Mechanisms, their states and their runs, as the tests of the solver need them.
namespace wishbone::testing {

inline Matrix3 diagonal(double x, double y, double z) {
  return Vector3(x, y, z).asDiagonal();
}

/// A compiled mechanism and its initial state.
struct Built {
  System system;
  State state;
};

inline Built build(SystemBuilder&& builder) {
  auto [system, state] = std::move(builder).build();
  return {std::move(system), std::move(state)};
}

/// Makes the state consistent in place and returns a workspace that knows the independent rows.
Workspace assembled(Built& mechanism);

/// A workspace that knows the rows that are independent in the state as it is, closed or not.
Workspace with_independent_rows(const Built& mechanism);

struct Trajectory {
  TransientSummary summary;
  std::vector<State> states;
  std::vector<Work> work;
  const State& last() const { return states.back(); }
};

Trajectory simulate(const System& system, const State& initial, double duration, double interval,
                    double tolerance, Method method = Method::automatic, Form form = Form::automatic);

/// Total energy with what has crossed the boundary; constant in every run.
double energy_balance(const System& system, const State& state, const Work& work);

/// Momentum of the whole mechanism: linear [kg m/s] below angular about the inertial origin [kg m^2/s].
Vector6 momentum(const System& system, const State& state);

/// Largest relative change of the energy, the linear and the angular momentum over a run of a free mechanism.
double drift(const Built& mechanism, const Trajectory& run);

/// Largest difference between the poses of all bodies named alike in two descriptions of one mechanism [m, 1].
double distance(const Built& a, const State& state_a, const Built& b, const State& state_b);

/// Reproducible random numbers.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  int index(int count) { return std::uniform_int_distribution<>(0, count - 1)(engine_); }
  Vector3 vector(double size) {
    return Vector3::NullaryExpr([&] { return uniform(-size, size); });
  }
  VectorX numbers(Eigen::Index n, double size) {
    return VectorX::NullaryExpr(n, [&] { return uniform(-size, size); });
  }
  Matrix3 rotation() {
    return Quaternion(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))
        .normalized()
        .toRotationMatrix();
  }
  /// Inertia that mass points with these second moments have: positive, and with the triangle inequality.
  Matrix3 inertia(double size) {
    const Vector3 s(uniform(0.1, size), uniform(0.1, size), uniform(0.1, size));
    const Matrix3 R = rotation();
    return R * diagonal(s.y() + s.z(), s.z() + s.x(), s.x() + s.y()) * R.transpose();
  }

 private:
  std::mt19937 engine_;
};

/// The lowest `modes` free-free modes of a steel-like soft block 1.2 x 0.4 x 0.3 m of 3 elements, mass 288 kg; its sections
/// hold the nodes 1-4 (x = -0.6 m), 5-8, 9-12 and 13-16 (x = 0.6 m).
ModeSet block_modes(int modes, double youngs_modulus = 1e8);

/// Strong vibration in every mode of every flexible body: deflections of centimetres.
void excite(Built& mechanism);

/// A seeded random tree with every tree joint and a motion: rigid bodies on each other, on the ground and on the nodes and
/// frames of a floating flexible block, with springs between them and loads on them. The state is far from the design pose and moving.
Built random_tree(unsigned seed);

/// The same with cut joints of several kinds between random bodies, nodes, frames and the ground, as they stand in the random state.
Built random_loops(unsigned seed);

/// Crank-rocker in the x-y plane under gravity -y: ground A (0,0) and D (3,0), crank AB 1 m, coupler BC 3 m, rocker DC 2.5 m,
/// uniform rods of 1 kg/m, crank at 60 degrees turning with `crank_rate`. Coupler and rocker are joined at C by a cut joint.
Built four_bar(const CutJoint& cut, double crank_rate);

/// `count` of them in one system, not tied to each other: the k-th has the coordinates 3 k, 3 k + 1 and 3 k + 2.
Built four_bars(int count, const CutJoint& cut, double crank_rate);

}  // namespace wishbone::testing
