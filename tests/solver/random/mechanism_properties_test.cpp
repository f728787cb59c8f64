// What must hold of every mechanism, tried on those that chance makes: momentum, energy, and the work of reactions.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "solver/assembly.h"
#include "solver/closures.h"
#include "solver/energy.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"
#include "solver/random/random_mechanism.h"
#include "solver/reactions.h"

namespace wishbone {
namespace {

using testing::Built;
using testing::Likeness;
using testing::Mechanism;
using testing::Random;
using testing::Trajectory;

constexpr double kTolerance = 1e-8;
constexpr double kDuration = 0.5;  // [s]

/// What rapidcheck draws and shrinks; everything continuous follows from the seed.
struct Draw {
  Random random;
  Mechanism mechanism;
};

Draw some_mechanism(int most_bodies, bool floating = false) {
  Likeness likeness;
  likeness.bodies = *rc::gen::inRange(1, most_bodies + 1);
  likeness.closures = *rc::gen::inRange(0, likeness.bodies / 2 + 1);
  likeness.springs = *rc::gen::inRange(0, 5);
  likeness.floating = floating;
  Draw draw{Random(*rc::gen::inRange(0u, 1u << 30)), {}};
  draw.mechanism = random_mechanism(likeness, draw.random);
  return draw;
}

Trajectory run(const Built& m) {
  Trajectory run = testing::simulate(m.system, m.state, kDuration, kDuration / 4, kTolerance);
  RC_ASSERT(run.summary.status == TransientSummary::Status::complete);
  return run;
}

Energy energy_of(const System& system, const State& state) {
  Workspace ws(system);
  update_state(system, state, ws);
  return calc_energy(system, state, ws);
}

/// What the tolerance comes to in energy: a share of the largest that was in motion, and the weight along it.
double energy_tolerance(const System& system, const Trajectory& run) {
  double size = 0;
  for (const State& state : run.states) {
    const Energy e = energy_of(system, state);
    size = std::max(size, e.kinetic + e.springs);
  }
  return kTolerance * (size + 9.81 * system.total_mass());
}

/// What a momentum is small against: the sums of the bodies' own, however they point.
Vector6 size_of_momentum(const System& system, const State& state) {
  Workspace ws(system);
  update_state(system, state, ws);
  double linear_size = 0, angular_size = 0;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotion& s = ws.bodies[i];
    const double p = body.mass * linear(s.V).norm();
    linear_size += p;
    angular_size += s.X_WB.p.norm() * p + body.J_B.norm() * angular(s.V).norm();
  }
  return spatial(Vector3::Constant(angular_size), Vector3::Constant(linear_size));
}

RC_GTEST_PROP(AnyPose, IsEitherClosedOrRefused, ()) {
  auto [random, mechanism] = some_mechanism(20);
  // closing far loops may bend a constant-velocity joint by a whole turn, where its coordinates end
  for (Mechanism::Joint& joint : mechanism.joints)
    if (joint.kind == JointKind::constant_velocity) joint.kind = JointKind::universal;
  Built m = testing::build(mechanism);
  retract(m.system, random.numbers(m.system.nv, 1.5), m.state.q);
  try {
    Workspace ws = testing::assembled(m);  // which knows the turns of screws
    update_state(m.system, m.state, ws);
    RC_ASSERT(ws.Phi.lpNorm<Eigen::Infinity>() <= 1e-8);  // what the assembly counts as closed
  } catch (const InputError&) {
  }
}

RC_GTEST_PROP(AnyFloatingMechanism, KeepsItsMomentum, ()) {
  auto [random, mechanism] = some_mechanism(20, true);
  const Built m = in_random_state(mechanism, random);
  const Vector6 start = testing::momentum(m.system, m.state);
  for (const State& state : run(m).states) {
    const Vector6 change = testing::momentum(m.system, state) - start;
    RC_ASSERT((change.array().abs() <= 10 * kTolerance * size_of_momentum(m.system, state).array()).all());
  }
}

RC_GTEST_PROP(AnyMechanism, KeepsItsEnergyWithoutDampers, ()) {
  auto [random, mechanism] = some_mechanism(20);
  for (Mechanism::Spring& spring : mechanism.springs) spring.damping = 0;
  const Built m = in_random_state(mechanism, random);
  const auto total = [&](const State& state) {
    const Energy e = energy_of(m.system, state);
    return e.kinetic + e.gravity + e.springs;
  };
  const Trajectory r = run(m);
  const double tolerance = energy_tolerance(m.system, r);
  for (const State& state : r.states) RC_ASSERT(std::abs(total(state) - total(m.state)) <= 10 * tolerance);
}

/// Adds a motor on some body that swings a bar, and a load that turns with another body.
Built driven(const Mechanism& mechanism, Random& random) {
  SystemBuilder builder = builder_of(mechanism);
  const auto bodies = static_cast<int>(mechanism.bodies.size());
  const int stator = random.index(bodies), loaded = random.index(bodies);
  const Pose X_WB{random.rotation(), mechanism.bodies[stator].X_WB.p + random.vector(0.5)};
  const int bar = builder.add_body("bar", 1, 0.1 * random.inertia(1), X_WB);
  builder.add_joint("motor", {stator}, bar, X_WB.p + random.vector(0.3),
                    PrescribedJoint{PrescribedJoint::Kind::revolute, random.vector(1).normalized(),
                                    Motion("swing", 0.2, {{0, kDuration, 0.5}})});
  builder.add_force(AppliedLoad("load", builder.add_marker({loaded}), {random.vector(2), random.vector(5)},
                                LoadAxes::kMarker));
  return testing::build(std::move(builder));
}

RC_GTEST_PROP(AnyMechanism, BalancesItsEnergyWithDampersLoadsAndMotors, ()) {
  auto [random, mechanism] = some_mechanism(20);
  const Built m = in_random_state(driven(mechanism, random), random);
  const double total = testing::energy_balance(m.system, m.state, {});
  const double stored = energy_of(m.system, m.state).springs;
  const Trajectory r = run(m);
  const double tolerance = energy_tolerance(m.system, r);
  for (std::size_t i = 0; i < r.states.size(); ++i) {
    const double now = testing::energy_balance(m.system, r.states[i], r.work[i]);
    RC_ASSERT(std::abs(now - total) <= 10 * tolerance);
    const double dissipated = r.work[i].loss - (energy_of(m.system, r.states[i]).springs - stored);
    RC_ASSERT(dissipated >= -10 * tolerance);
  }
}

/// Velocities that the joints admit, other than those of the motion.
Workspace moving_otherwise(const Built& m, Random& random) {
  State state = m.state;
  state.v = random.numbers(m.system.nv, 1);
  Workspace ws = testing::with_independent_rows(m);
  project(m.system, kProjectionTolerance, state, ws);
  update_state(m.system, state, ws);
  return ws;
}

/// Power of a wrench about the point p, at the velocity V of a body with its origin at p_WB.
double power(const Vector6& F, const Vector3& p, const Vector6& V, const Vector3& p_WB) {
  return F.dot(shift_velocity(V, p - p_WB));
}

RC_GTEST_PROP(AnyReaction, DoesNoWorkOnVelocitiesThatTheJointsAdmit, ()) {
  auto [random, mechanism] = some_mechanism(20);
  const Built m = in_random_state(mechanism, random);
  Workspace ws = testing::with_independent_rows(m);
  calc_forward_dynamics(m.system, m.state, ws);
  calc_reactions(m.system, ws);
  const Workspace other = moving_otherwise(m, random);

  double size = 0;  // of a power
  for (std::size_t i = 0; i < ws.bodies.size(); ++i) {
    const BodyMotion& body = ws.bodies[i];
    size = std::max(size, (body.F_joint.norm() + body.F_applied.norm()) * other.bodies[i].V.norm());
  }
  for (int i = 0; i < static_cast<int>(ws.bodies.size()); ++i) {
    const Vector3 p = tree_joint_point(m.system, ws, i);
    const int parent = m.system.bodies[i].parent;
    const Vector6 F = tree_joint_reaction(m.system, ws, i);
    double work = power(F, p, other.bodies[i].V, other.bodies[i].X_WB.p);
    if (parent >= 0) work -= power(F, p, other.bodies[parent].V, other.bodies[parent].X_WB.p);
    RC_ASSERT(std::abs(work) <= 1e-11 * size);
  }
  for (const Closure& closure : m.system.closures) {
    double work = 0;
    for (const int side : {0, 1}) {
      const MarkerState& marker = other.markers[closure.markers[static_cast<std::size_t>(side)]];
      work += closure_wrench(closure, side, ws.lambda, ws).dot(spatial(marker.w_WM, marker.v_WM));
    }
    RC_ASSERT(std::abs(work) <= 1e-11 * size);
  }
}

}  // namespace
}  // namespace wishbone
