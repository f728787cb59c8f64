#include "models/compile_joints.h"

#include <optional>
#include <string>
#include <tuple>

#include "models/scene_attachment.h"
#include "models/scene_tree.h"

namespace wishbone {
namespace {

/// Whether the tree joint itself follows its motion, so that no unknown is left.
bool is_prescribed(const Scene::Joint& joint) {
  const bool can = joint.kind == JointKind::revolute || joint.kind == JointKind::prismatic;
  return can && !joint.motion.empty() && joint.motion.front() >= 0;
}

bool has_axes(JointKind kind) {
  return kind != JointKind::fixed && kind != JointKind::spherical && kind != JointKind::free;
}

std::string coordinate_path(const Scene::Joint& joint, std::size_t coordinate, const char* what) {
  const JointKindInfo& kind = info(joint.kind);
  std::string name = joint.name;
  if (kind.coordinates.size() > 1) name += "_" + std::string(kind.coordinates[coordinate].name);
  return name + "_" + what;
}

}  // namespace

JointCompiler::JointCompiler(const Scene& scene, SystemBuilder& builder)
    : scene_(scene), builder_(builder), tree_(scene_tree(scene)) {}

int JointCompiler::carried_body(int joint) const {
  const Scene::Joint& j = scene_.joints[joint];
  return tree_.roles[joint] == JointRole::carries_first ? j.first.body : j.second.body;
}

MarkerIndex JointCompiler::marker(const Scene::Point& point, const Matrix3& R_DM) {
  return builder_.add_marker(attachment_of(scene_, point), scene_.X_WD * point.p_DP, scene_.X_WD.R * R_DM);
}

/// Axes of the second-named body in D; those of D for the ground.
Matrix3 JointCompiler::second_axes(const Scene::Joint& joint) const {
  return joint.second.body == Scene::kGround ? Matrix3(scene_.X_WD.R.transpose())
                                             : scene_.bodies[joint.second.body].X_DB.R;
}

std::pair<MarkerIndex, MarkerIndex> JointCompiler::markers(int joint) {
  const auto known = markers_.find(joint);
  if (known != markers_.end()) return known->second;
  const Scene::Joint& j = scene_.joints[joint];
  Matrix3 R_DM = j.R_DJ;
  if (!has_axes(j.kind))
    R_DM = j.first.body == Scene::kGround ? Matrix3(Matrix3::Identity()) : scene_.bodies[j.first.body].X_DB.R;
  const MarkerIndex A = marker(j.first, R_DM);
  const MarkerIndex B = marker(j.second, R_DM);
  return markers_[joint] = {A, B};
}

Motion JointCompiler::motion(int index) const {
  const Scene::Motion& motion = scene_.motions[index];
  std::vector<MotionStep> steps;
  for (const Scene::MotionStep& s : motion.steps) steps.push_back({s.time, s.duration, s.change});
  std::optional<Ackermann> ackermann;
  if (motion.ackermann)
    ackermann = Ackermann{
        motion.ackermann->wheelbase, motion.ackermann->track,
        motion.ackermann->side == Scene::Side::kLeft ? Ackermann::Side::kLeft : Ackermann::Side::kRight};
  const std::string element = "motion '" + motion.name + "'";
  return motion.law ? Motion(element, *motion.law, ackermann)
                    : Motion(element, motion.start, std::move(steps), ackermann);
}

/// The joint from its first- to its second-named body, axes in those of the second.
TreeJoint JointCompiler::tree_joint(const Scene::Joint& joint) const {
  const Matrix3 R = second_axes(joint).transpose() * joint.R_DJ;
  const Vector3 x = R.col(0), y = R.col(1), z = R.col(2);
  if (is_prescribed(joint))
    return PrescribedJoint{joint.kind == JointKind::revolute ? PrescribedJoint::Kind::revolute
                                                             : PrescribedJoint::Kind::prismatic,
                           z, motion(joint.motion.front())};
  switch (joint.kind) {
    case JointKind::fixed:
      return FixedJoint{};
    case JointKind::revolute:
      return RevoluteJoint(z);
    case JointKind::prismatic:
      return PrismaticJoint(z);
    case JointKind::cylindrical:
      return CylindricalJoint(z);
    case JointKind::screw:
      return ScrewJoint(z, joint.pitch);
    case JointKind::universal:
      return UniversalJoint(x, y);
    case JointKind::constant_velocity:
      return ConstantVelocityJoint(x, y);
    case JointKind::spherical:
      return SphericalJoint{};
    case JointKind::planar:
      return PlanarJoint(x, y);
    case JointKind::free:
      break;
  }
  return FreeJoint{};
}

CutJoint JointCompiler::cut_joint(const Scene::Joint& joint) const {
  switch (joint.kind) {
    case JointKind::fixed:
      return FixedClosure{};
    case JointKind::revolute:
      return RevoluteClosure{};
    case JointKind::prismatic:
      return PrismaticClosure{};
    case JointKind::cylindrical:
      return CylindricalClosure{};
    case JointKind::screw:
      return ScrewClosure(joint.pitch);
    case JointKind::universal:
      return UniversalClosure{};
    case JointKind::constant_velocity:
      return ConstantVelocityClosure{};
    case JointKind::planar:
      return PlanarClosure{};
    case JointKind::spherical:
    case JointKind::free:
      break;
  }
  return SphericalClosure{};
}

void JointCompiler::add_to_tree(int index, bool forward) {
  const Scene::Joint& joint = scene_.joints[index];
  const Scene::Point& parent = forward ? joint.first : joint.second;
  const int child = forward ? joint.second.body : joint.first.body;
  const TreeJoint tree = tree_joint(joint);
  const auto weights = std::vector<double>(speed_count(tree), joint.weight);
  std::vector<double> coordinates;
  for (const std::optional<double>& u : joint.position) coordinates.push_back(u.value_or(0));
  builder_.add_joint(joint.name, attachment_of(scene_, parent), child, scene_.X_WD * parent.p_DP,
                     forward ? tree : reverse(tree), {coordinates, {}, weights}, !forward);
  if (is_prescribed(joint)) return;
  for (std::size_t i = 0; i < joint.motion.size(); ++i)
    if (joint.motion[i] >= 0) drive(index, i);
}

void JointCompiler::cut(int index) {
  const Scene::Joint& joint = scene_.joints[index];
  if (joint.kind == JointKind::free) return;  // binds nothing
  const auto [A, B] = markers(index);
  builder_.add_closure(joint.name, A, B, cut_joint(joint));
  const JointKindInfo& kind = info(joint.kind);
  for (std::size_t i = 0; i < kind.coordinates.size(); ++i) {
    if (!kind.coordinates[i].measurable) continue;
    const std::string name = kind.coordinates.size() == 1 ? "" : std::string(kind.coordinates[i].name);
    builder_.measure({joint.name, name, kind.coordinates[i].gauge, A, B});
    if (!joint.motion.empty() && joint.motion[i] >= 0) drive(index, i);
  }
}

/// A row that makes one coordinate follow its motion.
void JointCompiler::drive(int index, std::size_t coordinate) {
  const Scene::Joint& joint = scene_.joints[index];
  const std::string name = coordinate_path(joint, coordinate, "drive");
  const auto [A, B] = markers(index);
  builder_.add_closure(
      name, A, B,
      DrivenClosure("joint '" + joint.name + "'", info(joint.kind).coordinates[coordinate].gauge,
                    motion(joint.motion[coordinate])));
}

void JointCompiler::add_forces(int index) {
  const Scene::Joint& joint = scene_.joints[index];
  if (joint.springs.empty() && joint.frictions.empty() && joint.limits.empty()) return;
  const auto [A, B] = markers(index);
  const auto gauge = [&](int coordinate) { return info(joint.kind).coordinates[coordinate].gauge; };
  for (const Scene::CoordinateSpring& s : joint.springs)
    builder_.add_force(JointSpring(coordinate_path(joint, s.coordinate, "spring"), A, B, gauge(s.coordinate),
                                   s.stiffness, s.damping, s.free));
  for (const Scene::CoordinateFriction& f : joint.frictions) {
    std::optional<StribeckPeak> peak;
    if (f.peak) peak = StribeckPeak{*f.peak, f.peak_rate};
    builder_.add_force(JointFriction(coordinate_path(joint, f.coordinate, "friction"), A, B,
                                     gauge(f.coordinate), f.coulomb, f.smoothing, f.viscous, peak));
  }
  for (const Scene::CoordinateLimit& l : joint.limits)
    builder_.add_force(JointLimit(coordinate_path(joint, l.coordinate, "limit"), A, B, gauge(l.coordinate),
                                  l.lower, l.upper, {l.stiffness, l.exponent, l.damping}));
}

void JointCompiler::add_joints() {
  for (int j = 0; j < static_cast<int>(scene_.joints.size()); ++j) {
    if (tree_.roles[j] == JointRole::closes)
      cut(j);
    else
      add_to_tree(j, tree_.roles[j] == JointRole::carries_second);
    add_forces(j);
  }
}

void JointCompiler::give_speed(int index, std::size_t coordinate, double value) {
  const Scene::Joint& joint = scene_.joints[index];
  const JointCoordinateKind& kind = info(joint.kind).coordinates[coordinate];
  GivenSpeed given;
  given.name = "joint '" + joint.name + "'";
  if (info(joint.kind).coordinates.size() > 1) given.name += " (" + std::string(kind.name) + ")";
  given.where = joint.where.text();
  given.value = value;
  given.is_angle = kind.is_angle;
  if (tree_.roles[index] != JointRole::closes) {
    given.index = static_cast<int>(coordinate);
    given.body = carried_body(index);
  } else {
    if (!kind.measurable) return;  // of a flexible body, which starts as the rigid one
    given.of = GivenSpeed::Of::coordinate;
    given.gauge = kind.gauge;
    std::tie(given.A, given.B) = markers(index);
  }
  builder_.give(given);
}

/// Angular velocity of the second body against the first, axes of the second.
void JointCompiler::give_spin(int index) {
  const Scene::Joint& joint = scene_.joints[index];
  const bool carries = tree_.roles[index] != JointRole::closes;
  GivenSpeed given;
  given.where = joint.where.text();
  if (carries) {
    given.body = carried_body(index);
  } else {
    given.of = GivenSpeed::Of::turning;
    given.A = marker(joint.first);
    given.B = marker(joint.second, second_axes(joint));
  }
  for (int axis = 0; axis < 3; ++axis) {
    given.name = "joint '" + joint.name + "' (" + "xyz"[axis] + ")";
    given.value = (*joint.spin)[axis];
    given.axis = given.index = axis;
    builder_.give(given);
  }
}

void JointCompiler::give_speeds() {
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const Scene::Body& body = scene_.bodies[b];
    builder_.give_velocity(static_cast<int>(b), body.v_WBo, body.w_WB_B, body.where.text());
  }
  for (std::size_t j = 0; j < scene_.joints.size(); ++j) {
    const Scene::Joint& joint = scene_.joints[j];
    for (std::size_t i = 0; i < joint.speed.size(); ++i)
      if (joint.speed[i]) give_speed(static_cast<int>(j), i, *joint.speed[i]);
    if (joint.spin) give_spin(static_cast<int>(j));
  }
}

bool JointCompiler::guide_positions() {
  bool any = false;
  for (std::size_t j = 0; j < scene_.joints.size(); ++j) {
    const Scene::Joint& joint = scene_.joints[j];
    if (tree_.roles[j] != JointRole::closes) continue;
    for (std::size_t i = 0; i < joint.position.size(); ++i) {
      if (!joint.position[i]) continue;
      const auto [A, B] = markers(static_cast<int>(j));
      builder_.add_closure(coordinate_path(joint, i, "position"), A, B,
                           DrivenClosure("joint '" + joint.name + "'", info(joint.kind).coordinates[i].gauge,
                                         Motion("joint '" + joint.name + "'", *joint.position[i], {})));
      any = true;
    }
  }
  return any;
}

void JointCompiler::add_coupling(const Scene::Closure& closure) {
  std::vector<MarkerIndex> participants;
  std::vector<CouplingClosure::Term> terms;
  for (const Scene::Closure::Term& term : closure.terms) {
    const auto [A, B] = markers(term.of.joint);
    participants.push_back(A);
    participants.push_back(B);
    const JointKindInfo& kind = info(scene_.joints[term.of.joint].kind);
    terms.push_back({kind.coordinates[term.of.coordinate].gauge, term.factor});
  }
  builder_.add_closure(
      closure.name, std::move(participants),
      CouplingClosure("coupling '" + closure.name + "'", std::move(terms), closure.constant));
}

void JointCompiler::add_closures() {
  for (const Scene::Closure& closure : scene_.closures) {
    if (closure.type == Scene::ClosureType::kCoupling) {
      add_coupling(closure);
      continue;
    }
    const auto [x, y] = perpendiculars(closure.direction_D);
    Matrix3 R_DM;
    R_DM << x, y, closure.direction_D;
    const MarkerIndex A = marker(closure.from, R_DM), B = marker(closure.to, R_DM);
    const std::string element = "closure '" + closure.name + "'";
    if (closure.type == Scene::ClosureType::kPointOnLine)
      builder_.add_closure(closure.name, A, B, PointOnLineClosure{});
    else if (closure.type == Scene::ClosureType::kPointOnPlane)
      builder_.add_closure(closure.name, A, B, PointOnPlaneClosure{});
    else if (closure.motion >= 0)
      builder_.add_closure(closure.name, A, B, DistanceClosure(element, motion(closure.motion)));
    else
      builder_.add_closure(
          closure.name, A, B,
          DistanceClosure(element, closure.length.value_or((closure.to.p_DP - closure.from.p_DP).norm())));
  }
}

}  // namespace wishbone
