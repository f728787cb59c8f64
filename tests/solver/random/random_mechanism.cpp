#include "solver/random/random_mechanism.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "solver/articulated_body.h"
#include "solver/assembly.h"
#include "solver/closure_dynamics.h"
#include "solver/closure_rank.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"

namespace wishbone::testing {
namespace {

constexpr int kFewestFreedoms = 3;      // that closures leave
constexpr double kSmallestSine = 0.05;  // of closure rows

Matrix3 inertia_of(double mass, Random& random) {
  return mass * 0.1 * random.inertia(1);
}

Mechanism::Joint random_joint(int child, const Mechanism& mechanism, bool floating, Random& random) {
  constexpr auto kKinds =
      std::to_array({JointKind::fixed, JointKind::revolute, JointKind::revolute, JointKind::revolute,
                     JointKind::prismatic, JointKind::cylindrical, JointKind::screw, JointKind::universal,
                     JointKind::universal, JointKind::constant_velocity, JointKind::spherical,
                     JointKind::spherical, JointKind::planar, JointKind::free});
  Mechanism::Joint joint;
  if (floating && child == 0) {
    joint.kind = JointKind::free;
    return joint;
  }
  joint.kind = kKinds[random.index(kKinds.size())];
  joint.parent = random.index(floating ? child : child + 1) - (floating ? 0 : 1);
  joint.reversed = random.index(3) == 0;
  const Vector3 parent = joint.parent < 0 ? Vector3::Zero().eval() : mechanism.bodies[joint.parent].X_WB.p;
  joint.X_WJ = {random.rotation(), parent + random.vector(0.5)};
  joint.pitch = random.uniform(0.05, 0.3);
  return joint;
}

/// Two different ones of the bodies and, unless the mechanism floats, the ground.
std::pair<int, int> random_pair(int bodies, bool floating, Random& random) {
  const int first = floating ? 0 : -1, count = bodies - first;
  const int A = random.index(count), B = (A + 1 + random.index(count - 1)) % count;
  return {A + first, B + first};
}

/// A point near body i, or near any body where i is the ground.
Vector3 random_point(int i, const Mechanism& mechanism, Random& random) {
  const auto count = static_cast<int>(mechanism.bodies.size());
  return mechanism.bodies[i < 0 ? random.index(count) : i].X_WB.p + random.vector(0.4);
}

CutJoint random_cut(const std::string& name, double distance, bool common, Random& random) {
  switch (random.index(common ? 12 : 14)) {
    case 0:
      return FixedClosure{};
    case 1:
      return RevoluteClosure{};
    case 2:
      return PrismaticClosure{};
    case 3:
      return CylindricalClosure{};
    case 4:
      return UniversalClosure{};
    case 5:
      return PlanarClosure{};
    case 6:
      return PointOnLineClosure{};
    case 7:
    case 8:
      return PointOnPlaneClosure{};
    case 9:
      return SphericalClosure{};
    case 10:
    case 11:
      return DistanceClosure(name, distance);
    case 12:
      return ScrewClosure(random.uniform(0.05, 0.3));
    default:
      return ConstantVelocityClosure{};
  }
}

Mechanism::Closure random_closure(const Mechanism& mechanism, const Likeness& likeness, Random& random) {
  Mechanism::Closure closure;
  const auto bodies = static_cast<int>(mechanism.bodies.size());
  std::tie(closure.A, closure.B) = random_pair(bodies, likeness.floating, random);
  closure.X_WA = {random.rotation(), random_point(closure.A, mechanism, random)};
  const Vector3 far = random_point(closure.B, mechanism, random);
  const std::string name = "closure " + std::to_string(mechanism.closures.size());
  closure.joint = random_cut(name, (far - closure.X_WA.p).norm(), likeness.common_closures, random);
  closure.p_WB = std::holds_alternative<DistanceClosure>(closure.joint) ? far : closure.X_WA.p;
  return closure;
}

/// Whether the closures are independent and leave the mechanism enough freedom.
bool is_sound(const Mechanism& mechanism) {
  const Built built = build(mechanism);
  return built.system.nv - built.system.n_rows >= kFewestFreedoms && closure_sine(built) > kSmallestSine;
}

void add_closures(const Likeness& likeness, Mechanism& mechanism, Random& random) {
  const int count = likeness.closures;
  for (int trial = 0; trial < 4 * count; ++trial) {
    if (static_cast<int>(mechanism.closures.size()) == count) return;
    mechanism.closures.push_back(random_closure(mechanism, likeness, random));
    if (!is_sound(mechanism)) mechanism.closures.pop_back();
  }
}

Mechanism::Spring random_spring(const Mechanism& mechanism, bool floating, Random& random) {
  Mechanism::Spring spring;
  std::tie(spring.P, spring.Q) = random_pair(static_cast<int>(mechanism.bodies.size()), floating, random);
  spring.p_WP = random_point(spring.P, mechanism, random);
  spring.p_WQ = random_point(spring.Q, mechanism, random);
  spring.stiffness = random.uniform(0, 100);
  spring.damping = random.uniform(0, 5);
  spring.free_length = random.uniform(0, 1);
  return spring;
}

/// As far as possible along a displacement: closures may not reach all the way.
void displace(Built& m, const VectorX& displacement) {
  for (double share = 1; share > 1e-3; share /= 2) {
    State state = m.state;
    retract(m.system, share * displacement, state.q);
    try {
      Workspace ws(m.system);
      assemble(m.system, state, ws);
      Built moved{m.system, state};
      if (closure_sine(moved) < kSmallestSine) continue;
      m.state = state;
      return;
    } catch (const InputError&) {
    }
  }
}

}  // namespace

Mechanism random_mechanism(const Likeness& likeness, Random& random) {
  Mechanism mechanism;
  if (!likeness.floating) mechanism.gravity = 9.81 * random.vector(1).normalized();
  for (int i = 0; i < likeness.bodies; ++i) {
    const Mechanism::Joint joint = random_joint(i, mechanism, likeness.floating, random);
    const double mass = random.uniform(0.5, 5);
    mechanism.bodies.push_back(
        {mass, inertia_of(mass, random), {random.rotation(), joint.X_WJ.p + random.vector(0.5)}});
    mechanism.joints.push_back(joint);
  }
  if (likeness.bodies == 1 && likeness.floating) return mechanism;
  add_closures(likeness, mechanism, random);
  for (int i = 0; i < likeness.springs; ++i)
    mechanism.springs.push_back(random_spring(mechanism, likeness.floating, random));
  return mechanism;
}

Built in_random_state(Built m, Random& random) {
  displace(m, random.numbers(m.system.nv, 0.7));
  m.state.v = random.numbers(m.system.nv, 1);
  Workspace ws = with_independent_rows(m);
  project(m.system, kProjectionTolerance, m.state, ws);
  return m;
}

double closure_sine(const Built& m) {
  if (m.system.n_rows == 0) return 1;
  Workspace ws(m.system);
  update_state(m.system, m.state, ws);
  factor_inertia(m.system, ws);
  keep_rows(all_rows(m.system), m.system, ws);
  if (find_independent_rows(m.system, ws) != all_rows(m.system)) return 0;
  factor_closures(m.system, kDynamicsRankTolerance, ws);
  return ws.closure.least_sine;
}

}  // namespace wishbone::testing
