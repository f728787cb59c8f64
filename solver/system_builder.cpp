#include "solver/system_builder.h"

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace wishbone {
namespace {

int place_of(int value, const std::vector<int>& values) {
  return static_cast<int>(std::find(values.begin(), values.end(), value) - values.begin());
}

void add_once(int value, std::vector<int>& values) {
  if (place_of(value, values) == static_cast<int>(values.size())) values.push_back(value);
}

}  // namespace

int SystemBuilder::add_body(std::string name, double mass, const Matrix3& J_B, const Pose& X_WB) {
  BodyEntry entry;
  entry.name = std::move(name);
  entry.mass = mass;
  entry.J_B = J_B;
  entry.X_WB = X_WB;
  bodies_.push_back(std::move(entry));
  return static_cast<int>(bodies_.size()) - 1;
}

int SystemBuilder::add_flexible_body(std::string name, ShapeSet shapes, const Pose& X_WB,
                                     InertiaTerms terms) {
  const int body = add_body(std::move(name), shapes.node_mass.sum(),
                            point_mass_inertia(shapes.node_mass, shapes.node_position), X_WB);
  bodies_[body].shapes = std::move(shapes);
  bodies_[body].terms = terms;
  bodies_[body].flexible = true;
  return body;
}

int SystemBuilder::add_flexible_body(std::string name, const ModeSet& modes, const Pose& X_WB,
                                     InertiaTerms terms) {
  modes.validate();
  return add_flexible_body(std::move(name), shapes_of(modes), X_WB, terms);
}

void SystemBuilder::set_velocity(int body, const Vector3& v_WB, const Vector3& w_WB_B) {
  bodies_[body].v_WB = v_WB;
  bodies_[body].w_WB_B = w_WB_B;
}

void SystemBuilder::give(GivenSpeed speed) {
  given_.push_back(std::move(speed));
}

/// Whether the speeds of the body are its velocities in the inertial frame.
bool SystemBuilder::moves_freely(int body) const {
  const int j = bodies_[body].joint;
  return j < 0 || (std::holds_alternative<FreeJoint>(joints_[j].joint) && joints_[j].parent.body == kGround);
}

void SystemBuilder::give_velocity(int body, const std::optional<Vector3>& v_WB,
                                  const std::optional<Vector3>& w_WB_B, const std::string& where) {
  if (!v_WB && !w_WB_B) return;
  GivenSpeed given;
  given.where = where;
  given.body = body;
  if (!moves_freely(body)) {
    given.A = add_marker({kGround});
    given.B = add_marker({body});
  }
  const auto add = [&](const Vector3& value, bool turns) {
    for (int axis = 0; axis < 3; ++axis) {
      given.name = "body '" + bodies_[body].name + "' (" + (turns ? "angular_velocity " : "velocity ") +
                   "xyz"[axis] + ")";
      given.value = value[axis];
      given.is_angle = turns;
      given.axis = axis;
      given.index = axis + (turns ? 0 : 3);
      given.of = turns ? GivenSpeed::Of::turning : GivenSpeed::Of::travel;
      if (moves_freely(body)) given.of = GivenSpeed::Of::speed;
      give(given);
    }
  };
  if (v_WB) add(*v_WB, false);
  if (w_WB_B) add(*w_WB_B, true);
}

int SystemBuilder::add_frame(int body, InterfaceFrame frame) {
  BodyEntry& entry = bodies_[body];
  entry.frame_origins.push_back(frame_shapes(frame, entry.shapes).origin);
  entry.frames.push_back(std::move(frame));
  return static_cast<int>(entry.frames.size()) - 1;
}

/// Makes what is attached to an interface of the body.
void SystemBuilder::use(Attachment on) {
  if (on.body == kGround) return;
  if (on.frame >= 0)
    add_once(on.frame, bodies_[on.body].used_frames);
  else if (on.node_id != 0)
    add_once(on.node_id, bodies_[on.body].used_nodes);
}

/// In the order of ModalBody: nodes first.
int SystemBuilder::interface_index(Attachment on) const {
  if (on.body == kGround || (on.frame < 0 && on.node_id == 0)) return -1;
  const BodyEntry& body = bodies_[on.body];
  if (on.frame < 0) return place_of(on.node_id, body.used_nodes);
  return static_cast<int>(body.used_nodes.size()) + place_of(on.frame, body.used_frames);
}

ModalBody SystemBuilder::modal_body(const BodyEntry& entry) const {
  std::vector<InterfaceFrame> frames;
  for (const int frame : entry.used_frames) frames.push_back(entry.frames[frame]);
  return {entry.shapes, entry.used_nodes, frames, entry.terms};
}

std::vector<std::string> SystemBuilder::interface_names(const BodyEntry& entry) {
  std::vector<std::string> names;
  for (const int id : entry.used_nodes) names.push_back(std::to_string(id));
  for (const int frame : entry.used_frames) names.push_back(entry.frames[frame].name);
  return names;
}

Pose SystemBuilder::attachment_pose(Attachment on) const {
  if (on.body == kGround) return {};
  const BodyEntry& body = bodies_[on.body];
  if (on.frame >= 0) return {body.X_WB.R, body.X_WB * body.frame_origins[on.frame]};
  if (on.node_id == 0) return body.X_WB;
  const int column = body.shapes.node_index(on.node_id);
  return {body.X_WB.R, body.X_WB * Vector3(body.shapes.node_position.col(column))};
}

void SystemBuilder::add_joint(std::string name, Attachment parent, int child, const Vector3& p_W,
                              TreeJoint joint, InitialMotion initial, bool first_is_child) {
  BodyEntry& body = bodies_[child];
  if (body.joint >= 0)
    throw InputError(
        {"joint '" + name + "'",
         "body '" + body.name + "' already hangs on tree joint '" + joints_[body.joint].name + "'", "",
         "cut one of the two joints"});
  if (body.flexible && !std::holds_alternative<FreeJoint>(joint))
    throw InputError({"joint '" + name + "'", "a flexible body can only be carried by a free joint",
                      "body '" + body.name + "'",
                      "name the flexible body first (as the parent) or cut the joint"});
  body.joint = static_cast<int>(joints_.size());
  use(parent);
  joints_.push_back(
      {std::move(name), parent, child, p_W, std::move(joint), std::move(initial), first_is_child});
}

MarkerIndex SystemBuilder::add_marker(Attachment on, const Vector3& p_W, const Matrix3& R_WM) {
  use(on);
  markers_.push_back({on, attachment_pose(on).inverse() * Pose{R_WM, p_W}});
  return static_cast<MarkerIndex>(markers_.size()) - 1;
}

MarkerIndex SystemBuilder::add_marker(Attachment on) {
  const Pose X_WM = attachment_pose(on);
  return add_marker(on, X_WM.p, X_WM.R);
}

void SystemBuilder::add_closure(std::string name, std::vector<MarkerIndex> markers, CutJoint joint) {
  Closure closure;
  closure.name = std::move(name);
  closure.rows = row_count(joint);
  closure.joint = std::move(joint);
  closure.markers = std::move(markers);
  closures_.push_back(std::move(closure));
}

std::vector<int> SystemBuilder::topological_order() const {
  // parents first; among bodies that could come next, the order in which they were added
  std::vector<int> order;
  std::vector<bool> placed(bodies_.size(), false);
  while (order.size() < bodies_.size()) {
    const std::size_t before = order.size();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (placed[i]) continue;
      const int parent = bodies_[i].joint < 0 ? kGround : joints_[bodies_[i].joint].parent.body;
      if (parent != kGround && !placed[parent]) continue;
      placed[i] = true;
      order.push_back(static_cast<int>(i));
    }
    if (order.size() > before) continue;
    const auto stuck = std::find(placed.begin(), placed.end(), false) - placed.begin();
    throw InputError({"joint '" + joints_[bodies_[stuck].joint].name + "'",
                      "the tree joints form a closed loop through body '" + bodies_[stuck].name + "'", "",
                      "mark one joint of the loop as a cut joint"});
  }
  return order;
}

void SystemBuilder::add_tree_body(int entry, System& system, State& state) {
  const BodyEntry& source = bodies_[entry];
  TreeBody body;
  body.name = source.name;
  body.mass = source.mass;
  body.J_B = source.J_B;
  VectorX q, v;
  if (source.joint < 0) {
    body.joint_name = source.name + " (floating)";
    body.floating = true;
    body.joint = FreeJoint{};
  } else {
    const JointEntry& joint = joints_[source.joint];
    body.joint_name = joint.name;
    body.joint = joint.joint;
    body.parent = joint.parent.body == kGround ? -1 : order_of_[joint.parent.body];
    body.parent_interface = interface_index(joint.parent);
    body.on_frame = joint.parent.frame >= 0;
    body.first_is_child = joint.first_is_child;
  }
  body.nq = coordinate_count(body.joint);
  body.nv = speed_count(body.joint);
  q = VectorX::Zero(body.nq);
  v = VectorX::Zero(body.nv);
  std::visit([&](const auto& joint) { joint.set_neutral(q.data()); }, body.joint);

  if (std::holds_alternative<FreeJoint>(body.joint)) {
    // F is the frame of the parent or of its interface, M the body frame: the coordinates are the pose itself
    const Attachment parent = source.joint < 0 ? Attachment{} : joints_[source.joint].parent;
    const Pose X_WF = attachment_pose(parent);
    const Pose X_FB = X_WF.inverse() * source.X_WB;
    const Quaternion Q_FB(X_FB.R);
    q << Q_FB.w(), Q_FB.x(), Q_FB.y(), Q_FB.z(), X_FB.p;
    v << source.w_WB_B, X_WF.R.transpose() * source.v_WB;
  } else {
    // F and M stand at the joint with the second-named body's axes
    const JointEntry& joint = joints_[source.joint];
    const Pose X_WP = attachment_pose(joint.parent);
    const Pose X_WF{joint.first_is_child ? X_WP.R : source.X_WB.R, joint.p_W};
    body.X_PF = X_WP.inverse() * X_WF;
    body.X_MB = X_WF.inverse() * source.X_WB;
    // of two equal orientations only rounding is left
    (joint.first_is_child ? body.X_PF : body.X_MB).R.setIdentity();
    const InitialMotion& initial = joint.initial;
    if (body.nq == body.nv)
      for (std::size_t i = 0; i < initial.coordinates.size(); ++i) q[i] = initial.coordinates[i];
    for (std::size_t i = 0; i < initial.speeds.size(); ++i) v[i] = initial.speeds[i];
    weights_.resize(system.nv, 1.0);
    weights_.insert(weights_.end(), initial.weights.begin(), initial.weights.end());
  }

  body.turned_PF = !body.X_PF.R.isIdentity(0);
  body.turned_MB = !body.X_MB.R.isIdentity(0);

  body.q_start = system.nq;
  body.v_start = system.nv;
  system.nq += body.nq;
  system.nv += body.nv;
  if (source.flexible) {
    body.flexible = static_cast<int>(system.flexible.size());
    FlexibleBody flexible{
        modal_body(source),     static_cast<int>(system.bodies.size()), system.nq, system.nv, false,
        interface_names(source)};
    const int m = flexible.modal.mode_count();
    system.nq += m;
    system.nv += m;
    system.flexible.push_back(std::move(flexible));
  }
  if (body.parent_interface >= 0) system.flexible[system.bodies[body.parent].flexible].carries_joints = true;

  state.q.conservativeResizeLike(VectorX::Zero(system.nq));
  state.v.conservativeResizeLike(VectorX::Zero(system.nv));
  state.q.segment(body.q_start, body.nq) = q;
  state.v.segment(body.v_start, body.nv) = v;
  system.bodies.push_back(std::move(body));
}

void SystemBuilder::add_markers(System& system) const {
  for (const MarkerEntry& entry : markers_) {
    const int body = entry.on.body == kGround ? kGround : order_of_[entry.on.body];
    system.markers.push_back({body, interface_index(entry.on), entry.on.frame >= 0, entry.X_BM});
  }
}

void SystemBuilder::find_paths(System& system) const {
  for (Closure& closure : system.closures) {
    std::vector<bool> on_path(system.bodies.size(), false);
    for (const MarkerIndex marker : closure.markers)
      for (int i = system.markers[marker].body; i >= 0; i = system.bodies[i].parent) on_path[i] = true;
    for (int i = static_cast<int>(system.bodies.size()) - 1; i >= 0; --i)
      if (on_path[i]) closure.path.push_back(i);
  }
}

std::pair<System, State> SystemBuilder::build() && {
  const std::vector<int> order = topological_order();
  order_of_.assign(bodies_.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i) order_of_[order[i]] = static_cast<int>(i);

  System system;
  State state;
  system.gravity = gravity;
  for (const int entry : order) add_tree_body(entry, system, state);

  add_markers(system);

  system.closures = std::move(closures_);
  for (Closure& closure : system.closures) {
    closure.row_start = system.n_rows;
    closure.column_start = system.n_columns;
    closure.gauge_start = system.n_gauges;
    system.n_rows += closure.rows;
    system.n_columns += closure.rows * static_cast<int>(closure.markers.size());
    system.n_gauges += gauge_count(closure.joint);
  }
  find_paths(system);

  system.measured = std::move(measured_);
  for (GivenSpeed& given : given_) {
    if (given.of != GivenSpeed::Of::speed) continue;
    given.index += system.bodies[order_of_[given.body]].v_start;
    state.v[given.index] = given.value;
  }
  system.forces = std::move(forces_);
  system.signals = std::move(signals_);
  std::apply([&](const auto&... lists) { ((system.n_forces += static_cast<int>(lists.size())), ...); },
             system.forces);
  std::apply(
      [&](const auto&... lists) {
        (([&](const auto& list) {
           for (const auto& element : list) system.nx += element.state_count();
         }(lists)),
         ...);
      },
      system.forces);
  state.x = VectorX::Zero(system.nx);
  weights_.resize(system.nv, 1.0);
  if (std::any_of(weights_.begin(), weights_.end(), [](double w) { return w != 1.0; }))
    system.assembly_weights = Eigen::Map<VectorX>(weights_.data(), system.nv);
  return {std::move(system), std::move(state)};
}

}  // namespace wishbone
