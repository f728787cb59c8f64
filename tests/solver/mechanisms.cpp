#include "solver/mechanisms.h"

#include <algorithm>
#include <cmath>

#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/closure_rank.h"
#include "solver/forward_dynamics.h"
#include "solver/kinematics.h"

namespace wishbone::testing {
namespace {

constexpr int kBlockModes = 6;

TreeJoint random_joint(int kind, Random& random) {
  const Vector3 axis = random.vector(1).normalized();
  switch (kind) {
    case 0:
      return FixedJoint{};
    case 1:
      return RevoluteJoint{axis};
    case 2:
      return PrismaticJoint{axis};
    case 3:
      return SphericalJoint{};
    case 4:
      return FreeJoint{};
    case 5:
      return PrescribedJoint{PrescribedJoint::Kind::revolute, axis, Motion("turn", 0.3, {{0, 2, 1.5}})};
    default:
      return PrescribedJoint{PrescribedJoint::Kind::prismatic, axis, Motion("push", -0.2, {{0, 2, 0.8}})};
  }
}

/// A rod between two points of the x-y plane, 1 kg/m.
int add_rod(SystemBuilder& b, const std::string& name, const Vector3& from, const Vector3& to) {
  const double length = (to - from).norm(), J = length * length * length / 12;
  const double angle = std::atan2(to.y() - from.y(), to.x() - from.x());
  return b.add_body(name, length, diagonal(1e-3, J, J),
                    {Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix(), (from + to) / 2});
}

struct RandomBuilder {
  SystemBuilder builder;
  std::vector<Attachment> attachments;  // bodies, nodes and the ground, where anything may take hold
};

/// Two frames of the block, and a body on each: on a joint with speeds, and on one whose motion is prescribed.
void add_frames(RandomBuilder& r, int block, Random& random) {
  SystemBuilder& b = r.builder;
  const int end = b.add_frame(block, {"end", {13, 14, 15, 16}, {1, 2, 3, 0.5}});
  const int middle = b.add_frame(block, {"middle", {5, 6, 11}, {}});
  for (const int frame : {end, middle}) {
    const int body = b.add_body("body on a frame", random.uniform(1, 20), random.inertia(3),
                                {random.rotation(), random.vector(2)});
    b.add_joint("joint on a frame", {block, 0, frame}, body, random.vector(2),
                random_joint(frame == end ? 1 : 5, random));
    r.attachments.push_back({body});
  }
  r.attachments.push_back({block, 0, end});
  r.attachments.push_back({block, 0, middle});
}

RandomBuilder random_bodies(Random& random) {
  RandomBuilder r;
  SystemBuilder& b = r.builder;
  b.gravity = random.vector(10);
  const int block =
      b.add_flexible_body("block", block_modes(kBlockModes), {random.rotation(), random.vector(2)});
  b.set_velocity(block, random.vector(2), random.vector(2));
  std::vector<int> bodies{SystemBuilder::kGround, block};
  r.attachments = {{SystemBuilder::kGround}, {block}, {block, 3}, {block, 10}, {block, 16}};
  for (int i = 0; i < 9; ++i) {
    const Pose X_WB{random.rotation(), random.vector(2)};
    const int body = b.add_body("body " + std::to_string(i), random.uniform(1, 20), random.inertia(3), X_WB);
    const std::string name = "joint " + std::to_string(i);
    if (i >= 7) {  // two hang on nodes of the block
      const Attachment node{block, i == 7 ? 3 : 13};
      b.add_joint(name, node, body, b.attachment_pose(node).p, SphericalJoint{});
    } else {
      const int parent = bodies[random.index(static_cast<int>(bodies.size()))];
      b.add_joint(name, {parent}, body, random.vector(2), random_joint(i, random));
    }
    bodies.push_back(body);
    r.attachments.push_back({body});
  }
  add_frames(r, block, random);
  return r;
}

/// On one of the `count` attachments from `first` on.
MarkerIndex random_marker(RandomBuilder& r, Random& random, int first, int count) {
  const Attachment on = r.attachments[first + random.index(count)];
  return on.node_id != 0 ? r.builder.add_marker(on)
                         : r.builder.add_marker(on, random.vector(2), random.rotation());
}

void add_random_forces(RandomBuilder& r, Random& random) {
  const int all = static_cast<int>(r.attachments.size()), half = all / 2;
  for (int i = 0; i < 6; ++i) {
    const MarkerIndex P = random_marker(r, random, 0, half), Q = random_marker(r, random, half, half);
    r.builder.add_force(SpringDamper("spring " + std::to_string(i), P, Q, random.uniform(0, 500),
                                     random.uniform(0, 50), random.uniform(0, 1)));
  }
  for (const LoadAxes axes : {LoadAxes::kWorld, LoadAxes::kMarker})
    r.builder.add_force(
        AppliedLoad("load", random_marker(r, random, 0, all), {random.vector(50), random.vector(50)}, axes));
}

void randomize(Built& m, Random& random) {
  m.state.t = random.uniform(0.5, 1.5);
  retract(m.system, random.numbers(m.system.nv, 1), m.state.q);
  m.state.v += random.numbers(m.system.nv, 1);
}

void add_four_bar(SystemBuilder& builder, const CutJoint& cut, double crank_rate) {
  const double a = 1, b = 3, c = 2.5, d = 3, th = M_PI / 3;
  const Vector3 A(0, 0, 0), D(d, 0, 0), B(a * std::cos(th), a * std::sin(th), 0);
  // C lies on the circles about B and D, above the line BD
  const Vector3 BD = D - B;
  const double s = BD.norm(), along = (b * b - c * c + s * s) / (2 * s);
  const Vector3 C = B + along * BD / s + std::sqrt(b * b - along * along) * Vector3(-BD.y(), BD.x(), 0) / s;

  const int crank = add_rod(builder, "crank", A, B);
  const int coupler = add_rod(builder, "coupler", B, C);
  const int rocker = add_rod(builder, "rocker", D, C);
  builder.add_joint("A", {}, crank, A, RevoluteJoint{}, 0, crank_rate);
  builder.add_joint("B", {crank}, coupler, B, RevoluteJoint{});
  builder.add_joint("D", {}, rocker, D, RevoluteJoint{});
  builder.add_closure("C", builder.add_marker({coupler}, C), builder.add_marker({rocker}, C), cut);
}

}  // namespace

Workspace assembled(Built& mechanism) {
  Workspace ws(mechanism.system);
  assemble(mechanism.system, mechanism.state, ws);
  return ws;
}

Workspace with_independent_rows(const Built& m) {
  Workspace ws(m.system);
  update_state(m.system, m.state, ws);
  factor_inertia(m.system, ws);
  keep_rows(find_independent_rows(m.system, ws), m.system, ws);
  return ws;
}

Trajectory simulate(const System& system, const State& initial, double duration, double interval,
                    double tolerance, Method method, Form form) {
  Workspace ws(system);
  TransientOptions options;
  options.duration = duration;
  options.interval = interval;
  options.integrator.form = form;
  options.integrator.method = method;
  options.integrator.rtol = options.integrator.atol = tolerance;
  Trajectory trajectory;
  trajectory.summary = run_transient(system, initial, options, ws, [&](const State& s, const Work& w) {
    trajectory.states.push_back(s);
    trajectory.work.push_back(w);
  });
  return trajectory;
}

double energy_balance(const System& system, const State& state, const Work& work) {
  Workspace ws(system);
  update_state(system, state, ws);
  const Energy e = calc_energy(system, state, ws);
  // what the springs store has been taken out of the bodies by the force elements too: it is part of work.loss
  return e.kinetic + e.gravity + e.elastic + work.loss - work.input;
}

double drift(const Built& m, const Trajectory& run) {
  const double E0 = energy_balance(m.system, run.states.front(), run.work.front());
  const Vector6 h0 = momentum(m.system, run.states.front());
  double largest = 0;
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    const Vector6 h = momentum(m.system, run.states[i]);
    largest = std::max({largest, std::abs(energy_balance(m.system, run.states[i], run.work[i]) / E0 - 1),
                        (h - h0).head<3>().norm() / h0.head<3>().norm(),
                        (h - h0).tail<3>().norm() / h0.tail<3>().norm()});
  }
  return largest;
}

double distance(const Built& a, const State& sa, const Built& b, const State& sb) {
  Workspace wa(a.system), wb(b.system);
  update_state(a.system, sa, wa);
  update_state(b.system, sb, wb);
  double largest = 0;
  for (std::size_t i = 0; i < a.system.bodies.size(); ++i)
    for (std::size_t j = 0; j < b.system.bodies.size(); ++j) {
      if (a.system.bodies[i].name != b.system.bodies[j].name) continue;
      const Pose &A = wa.bodies[i].X_WB, &B = wb.bodies[j].X_WB;
      largest = std::max({largest, (A.p - B.p).norm(), (A.R - B.R).norm()});
    }
  return largest;
}

Vector6 momentum(const System& system, const State& state) {
  Workspace ws(system);
  update_state(system, state, ws);
  Vector6 total = Vector6::Zero();
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& body = system.bodies[i];
    const BodyMotion& s = ws.bodies[i];
    const Vector3 w_B = s.X_WB.R.transpose() * angular(s.V);
    Vector3 p = body.mass * linear(s.V);
    Vector3 L_B = body.J_B * w_B;
    if (body.flexible >= 0) {
      const ModalBody& modal = system.flexible[body.flexible].modal;
      const ModalBodyState& state_B = ws.flexible[body.flexible].modal;
      const Vector3 v_B = s.X_WB.R.transpose() * linear(s.V);
      p = s.X_WB.R * modal.linear_momentum(v_B, state_B);
      L_B = modal.angular_momentum(v_B, state_B);
    }
    total += spatial(Vector3(s.X_WB.R * L_B + s.X_WB.p.cross(p)), p);
  }
  return total;
}

ModeSet block_modes(int modes, double youngs_modulus) {
  return free_free_modes(make_block({1.2, 0.4, 0.3}, {3, 1, 1}), {youngs_modulus, 0.3, 2000}).lowest(modes);
}

Built random_tree(unsigned seed) {
  Random random(seed);
  RandomBuilder r = random_bodies(random);
  add_random_forces(r, random);
  Built m = build(std::move(r.builder));
  randomize(m, random);
  return m;
}

Built random_loops(unsigned seed) {
  Random random(seed);
  RandomBuilder r = random_bodies(random);
  const auto nth = [&](int i) { return r.builder.add_marker(r.attachments[i]); };
  r.builder.add_closure("node to body", nth(2), nth(7), SphericalClosure{});
  r.builder.add_closure("body to body", nth(9), nth(11), RevoluteClosure{});
  r.builder.add_closure("node to node's body", nth(3), nth(12), SphericalClosure{});
  r.builder.add_closure("ground to body", nth(0), nth(13), SphericalClosure{});
  r.builder.add_closure("frame to body", nth(16), nth(10), FixedClosure{});
  r.builder.add_closure("ground to frame", nth(0), nth(17), UniversalClosure{});
  add_random_forces(r, random);
  Built m = build(std::move(r.builder));
  randomize(m, random);
  return m;
}

void excite(Built& m) {
  for (const FlexibleBody& body : m.system.flexible)
    for (int j = 0; j < body.modal.mode_count(); ++j)
      m.state.v[body.z_rate_start + j] = 20.0 * (j % 2 == 0 ? 1 : -1);
}

Built four_bars(int count, const CutJoint& cut, double crank_rate) {
  SystemBuilder builder;
  builder.gravity = {0, -9.81, 0};
  for (int k = 0; k < count; ++k) add_four_bar(builder, cut, crank_rate);
  return build(std::move(builder));
}

Built four_bar(const CutJoint& cut, double crank_rate) {
  return four_bars(1, cut, crank_rate);
}

}  // namespace wishbone::testing
