#include "solver/every_part.h"

#include <functional>

#include "joints/every_joint.h"
#include "solver/kinematics.h"

namespace wishbone::testing {
namespace {

/// A mechanism as it grows: its builder, and what random numbers make of its state in the end.
struct Assembly {
  SystemBuilder b;
  Random random;
  std::vector<int> on_the_road;  // bodies whose tires would lose the road, were they moved at random

  explicit Assembly(unsigned seed) : random(seed) { b.gravity = random.vector(10); }
};

/// A floating body, and markers A on it and B on another body, not far from each other in place or orientation.
struct Pair {
  int base, other;
  MarkerIndex A, B;
};

Matrix3 turned_a_little(const Matrix3& R, Random& random) {
  return R * rotation_about(random.vector(1).normalized(), 0.4);
}

int add_floating_body(Assembly& a, const std::string& name, const Pose& X_WB) {
  const int body = a.b.add_body(name, a.random.uniform(1, 3), a.random.inertia(1), X_WB);
  a.b.set_velocity(body, a.random.vector(1), a.random.vector(1));
  return body;
}

Pair add_pair(Assembly& a, const std::string& name) {
  const Pose at_base{a.random.rotation(), a.random.vector(0.5)};
  const Vector3 p_W = at_base.p + a.random.vector(0.5);
  const Matrix3 R_WM = a.random.rotation();
  Pair pair;
  pair.base = add_floating_body(a, name + " base", at_base);
  pair.other = add_floating_body(a, name + " other", {a.random.rotation(), p_W + a.random.vector(0.5)});
  pair.A = a.b.add_marker({pair.base}, p_W, R_WM);
  pair.B =
      a.b.add_marker({pair.other}, p_W + R_WM * Vector3(0.3, -0.6, 0.5), turned_a_little(R_WM, a.random));
  return pair;
}

/// A floating flexible block with the frame "end" over its last section; the frame is given as its attachment.
Attachment add_block(Assembly& a, const std::string& name, const Pose& X_WB) {
  static const ModeSet modes = block_modes(2);
  const int block = a.b.add_flexible_body(name, modes, X_WB);
  a.b.set_velocity(block, a.random.vector(1), a.random.vector(1));
  return {block, 0, a.b.add_frame(block, {"end", {13, 14, 15, 16}, {1, 2, 3, 0.5}})};
}

/// The same on frames of two flexible blocks.
Pair add_pair_of_frames(Assembly& a, const std::string& name) {
  const Attachment base = add_block(a, name + " base", {a.random.rotation(), a.random.vector(0.5)});
  const Vector3 p_W = a.b.attachment_pose(base).p + a.random.vector(0.3);
  const Matrix3 R_WM = a.random.rotation();
  const Matrix3 R_WB = a.random.rotation();
  const Attachment other = add_block(a, name + " other", {R_WB, p_W - R_WB * Vector3(0.6, 0, 0)});
  return {base.body, other.body, a.b.add_marker(base, p_W, R_WM),
          a.b.add_marker(other, p_W + R_WM * Vector3(0.3, -0.6, 0.5), turned_a_little(R_WM, a.random))};
}

using Part = std::function<void(Assembly&, const std::string& name)>;
struct NamedPart {
  std::string name;
  Part add;
};

std::vector<NamedPart> tree_joint_parts() {
  Random random(101);
  const Vector3 axis = random.vector(1).normalized(), normal = random.vector(1).normalized();
  std::vector<NamedPart> parts;
  for (const TreeJoint& joint : every_tree_joint(axis, normal))
    parts.push_back({std::string("tree joint ") + joint_kind(joint), [joint](Assembly& a, const auto& name) {
                       const Pose at_base{a.random.rotation(), a.random.vector(0.5)};
                       const int base = add_floating_body(a, name + " base", at_base);
                       const int child =
                           a.b.add_body(name + " child", a.random.uniform(1, 3), a.random.inertia(1),
                                        {a.random.rotation(), a.random.vector(1)});
                       a.b.add_joint(name, {base}, child, a.random.vector(1), joint);
                     }});
  for (const TreeJoint& joint : every_tree_joint(axis, normal))
    parts.push_back(
        {std::string("tree joint on a frame, ") + joint_kind(joint), [joint](Assembly& a, const auto& name) {
           const Attachment end = add_block(a, name + " base", {a.random.rotation(), a.random.vector(0.5)});
           const int child = a.b.add_body(name + " child", a.random.uniform(1, 3), a.random.inertia(1),
                                          {a.random.rotation(), a.random.vector(1)});
           a.b.add_joint(name, end, child, a.random.vector(1), joint);
         }});
  return parts;
}

std::vector<NamedPart> cut_joint_parts() {
  std::vector<NamedPart> parts;
  for (const CutJoint& joint : every_cut_joint())
    parts.push_back({std::string("cut joint ") + joint_kind(joint), [joint](Assembly& a, const auto& name) {
                       const Pair pair = add_pair(a, name);
                       a.b.add_closure(name, pair.A, pair.B, joint);
                     }});
  for (const CutJoint& joint : every_cut_joint())
    parts.push_back(
        {std::string("cut joint on frames, ") + joint_kind(joint), [joint](Assembly& a, const auto& name) {
           const Pair pair = add_pair_of_frames(a, name);
           a.b.add_closure(name, pair.A, pair.B, joint);
         }});
  parts.push_back({"coupling", [](Assembly& a, const auto& name) {
                     const CutJoint coupling = coupling_of_every_gauge();
                     std::vector<MarkerIndex> markers;
                     for (int i = 0; i < gauge_count(coupling); ++i) {
                       const Pair pair = add_pair(a, name + " " + std::to_string(i));
                       markers.insert(markers.end(), {pair.A, pair.B});
                     }
                     a.b.add_closure(name, markers, coupling);
                   }});
  return parts;
}

template <class Make>
NamedPart between(const std::string& name, Make make) {
  return {name, [make](Assembly& a, const std::string& element) {
            const Pair pair = add_pair(a, element);
            a.b.add_force(make(element, pair.A, pair.B));
          }};
}

const std::vector<std::pair<std::string, Gauge>>& every_gauge() {
  using enum Gauge::Kind;
  static const std::vector<std::pair<std::string, Gauge>> gauges{{"rotation", {rotation}},
                                                                 {"translation", {translation, 1}},
                                                                 {"universal first", {universal_first}},
                                                                 {"universal second", {universal_second}},
                                                                 {"distance", {distance}}};
  return gauges;
}

void add_joint_force_parts(std::vector<NamedPart>& parts) {
  for (const auto& [name, gauge] : every_gauge()) {
    parts.push_back(between("joint spring, " + name, [gauge](const auto& n, auto A, auto B) {
      return JointSpring(n, A, B, gauge, 20, 3, 0.5);
    }));
    parts.push_back(between("joint friction, " + name, [gauge](const auto& n, auto A, auto B) {
      return JointFriction(n, A, B, gauge, 3, 1.5, 0.5, StribeckPeak{5, 2});
    }));
    // far within the stop, whose force has a corner where contact begins
    parts.push_back(between("lower joint limit, " + name, [gauge](const auto& n, auto A, auto B) {
      return JointLimit(n, A, B, gauge, 5.0, std::nullopt, {10, 1.5, 0.02});
    }));
    parts.push_back(between("upper joint limit, " + name, [gauge](const auto& n, auto A, auto B) {
      return JointLimit(n, A, B, gauge, std::nullopt, -5.0, {10, 1.5, 0.02});
    }));
  }
}

/// A formula of the time t and of signals, whose places among the variables are written as {0}, {1} in the text.
Function formula(std::string text, const std::vector<int>& signals) {
  std::vector<std::string> variables{"t"};
  for (int i = 1; i <= signals.back(); ++i) variables.push_back("s" + std::to_string(i));
  for (std::size_t k = 0; k < signals.size(); ++k) {
    const std::string place = "{" + std::to_string(k) + "}";
    for (std::size_t at; (at = text.find(place)) != std::string::npos;)
      text.replace(at, place.size(), "s" + std::to_string(signals[k]));
  }
  return Function(Expression(text, variables));
}

/// Signals of every gauge between two markers, then a component of the position and of the velocity of one.
std::vector<int> add_signals(Assembly& a, const std::string& name, const Pair& pair) {
  using enum MotionSignal::Quantity;
  std::vector<int> signals;
  for (const auto& [of, gauge] : every_gauge())
    for (const MotionSignal::Quantity quantity : {position, speed})
      signals.push_back(a.b.add_signal({name + " " + of, pair.A, pair.B, gauge, quantity}));
  signals.push_back(a.b.add_signal({name + " place", pair.A, 1, position}));
  signals.push_back(a.b.add_signal({name + " velocity", pair.B, 2, speed}));
  return signals;
}

void add_function_parts(std::vector<NamedPart>& parts) {
  parts.push_back({"joint drive of signals", [](Assembly& a, const auto& name) {
                     const Pair pair = add_pair(a, name), far = add_pair(a, name + " far");
                     const std::vector<int> s = add_signals(a, name, far);
                     a.b.add_force(JointDrive(name, pair.A, pair.B, {Gauge::Kind::rotation},
                                              formula("3*sin({0} + t) - {1}*{2} + tanh({3}) + {4}^2", s)));
                   }});
  parts.push_back({"load of signals in marker axes", [](Assembly& a, const auto& name) {
                     const Pair pair = add_pair(a, name), far = add_pair(a, name + " far");
                     const std::vector<int> s = add_signals(a, name, far);
                     const Function spline(
                         Table(name, {-20, -6, 7, 20}, {1, -2, 3, 5}, Table::Interpolation::spline), s[8]);
                     const Function line(Table(name, {-50, 50}, {-2, 7}, Table::Interpolation::linear), s[9]);
                     a.b.add_force(AppliedLoad(
                         name, pair.A,
                         {{formula("{5}*{6}", s), spline, line},
                          {formula("{7}/(2 + {8})", s), formula("atan2({10}, 3)", s), formula("-{11}^3", s)}},
                         LoadAxes::kMarker));
                   }});
}

/// A wheel that rolls over the road with some slip, nowhere near where its tire's law bends.
NamedPart tire_part(const std::string& name, UaForm form, bool lag) {
  return {
      name, [form, lag](Assembly& a, const std::string& element) {
        UaTireParameters t;
        t.radius = 0.315;
        t.radial_stiffness = 2e5;
        t.radial_damping_ratio = 0.02;
        t.mass = 10;
        t.slip_stiffness = 8e4;
        t.cornering_stiffness = 7e4;
        t.camber_stiffness = 8e3;
        t.rolling_resistance = 0.003;
        t.friction_max = 1.0;
        t.friction_min = 0.8;
        t.relaxation_x = 0.3;
        t.relaxation_y = 0.5;
        const Matrix3 R = rotation_about(Vector3::UnitZ(), 0.1) * rotation_about(Vector3::UnitX(), 0.05);
        const int wheel = a.b.add_body(element + " wheel", 30, diagonal(1, 2, 1), {R, {11, 0.2, 0.265}});
        a.b.set_velocity(wheel, {20, 1.5, 0.05}, {0.2, 68, 0.1});
        a.b.add_force(Tire(element, a.b.add_marker({wheel}), t, Road(0.02, {{7.2, 12, 0.03}}), form, lag));
        a.on_the_road.push_back(wheel);
      }};
}

std::vector<NamedPart> force_parts() {
  std::vector<NamedPart> parts{
      between("spring-damper",
              [](const auto& n, auto A, auto B) { return SpringDamper(n, A, B, 80, 5, 0.4); }),
      between("constant load",
              [](const auto& n, auto A, auto) {
                return AppliedLoad(n, A, {Vector3(1, -2, 3), Vector3(5, 4, -3)}, LoadAxes::kWorld);
              }),
      between("follower load", [](const auto& n, auto A, auto) {
        return AppliedLoad(n, A, {Vector3(1, -2, 3), Vector3(5, 4, -3)}, LoadAxes::kMarker);
      })};
  parts.push_back({"joint spring on frames", [](Assembly& a, const auto& name) {
                     const Pair pair = add_pair_of_frames(a, name);
                     a.b.add_force(JointSpring(name, pair.A, pair.B, {Gauge::Kind::rotation}, 20, 3, 0.5));
                   }});
  parts.push_back(
      {"follower load on a frame", [](Assembly& a, const auto& name) {
         const MarkerIndex marker = add_pair_of_frames(a, name).A;
         a.b.add_force(AppliedLoad(name, marker, {Vector3(1, -2, 3), Vector3(5, 4, -3)}, LoadAxes::kMarker));
       }});
  add_joint_force_parts(parts);
  add_function_parts(parts);
  parts.push_back(tire_part("smooth tire", UaForm::kSmooth, false));
  parts.push_back(tire_part("smooth tire with lag", UaForm::kSmooth, true));
  parts.push_back(tire_part("classic tire", UaForm::kClassic, false));
  return parts;
}

/// The system, and a state far from its design pose, moving; wheels stay close to where they stand.
Built finish(Assembly&& a) {
  std::vector<int> wheels;
  auto [system, state] = std::move(a.b).build();
  for (const int wheel : a.on_the_road) wheels.push_back(a.b.built_index(wheel));
  VectorX amplitude = VectorX::Constant(system.nv, 0.4);
  for (const int wheel : wheels) amplitude.segment(system.bodies[wheel].v_start, 6).setConstant(1e-3);
  state.t = 0.7;
  const auto amplified = [&](const VectorX& numbers) -> VectorX { return numbers.cwiseProduct(amplitude); };
  retract(system, amplified(a.random.numbers(system.nv, 1)), state.q);
  state.v += amplified(a.random.numbers(system.nv, 1));
  state.x = a.random.numbers(system.nx, 0.01);
  return {std::move(system), std::move(state)};
}

std::vector<NamedMechanism> mechanisms(const std::vector<NamedPart>& parts) {
  std::vector<NamedMechanism> all;
  for (const NamedPart& part : parts) {
    Assembly a(static_cast<unsigned>(all.size()) + 1);
    part.add(a, part.name);
    all.push_back({part.name, finish(std::move(a))});
  }
  return all;
}

std::vector<NamedPart> every_part() {
  std::vector<NamedPart> all;
  for (const auto& parts : {tree_joint_parts(), cut_joint_parts(), force_parts()})
    all.insert(all.end(), parts.begin(), parts.end());
  return all;
}

}  // namespace

std::vector<NamedMechanism> around_every_tree_joint() {
  return mechanisms(tree_joint_parts());
}
std::vector<NamedMechanism> around_every_cut_joint() {
  return mechanisms(cut_joint_parts());
}
std::vector<NamedMechanism> around_every_force() {
  return mechanisms(force_parts());
}
std::vector<NamedMechanism> around_every_part() {
  return mechanisms(every_part());
}

Built every_part_at_once() {
  Assembly a(7);
  for (const NamedPart& part : every_part()) part.add(a, part.name);
  return finish(std::move(a));
}

}  // namespace wishbone::testing
