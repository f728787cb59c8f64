#include "solver/reactions.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>
#include <variant>

#include "solver/closure_rank.h"
#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/interface.h"
#include "solver/inverse_dynamics.h"

namespace wishbone {
namespace {

/// All that the joint and its motion put on the first-named body, about that point.
Vector6 joint_wrench(const System& system, const Evaluation<double>& ev, int i) {
  const BodyMotion& s = ev.bodies[i];
  const Vector6 on_child = shift_wrench<double>(s.F_joint, s.X_WB.p - tree_joint_point(system, ev, i));
  return system.bodies[i].first_is_child ? on_child : Vector6(-on_child);
}

/// Along which, or about which, the coordinate of a prescribed joint grows.
Vector3 drive_axis(const System& system, const PrescribedJoint& joint, const Evaluation<double>& ev, int i) {
  const TreeBody& body = system.bodies[i];
  return (body.first_is_child ? -1.0 : 1.0) * (inboard_axes<double>(system, body, ev) * joint.axis_F);
}

bool is_prescribed(const System& system, int i) {
  return std::holds_alternative<PrescribedJoint>(system.bodies[i].joint);
}

/// Bodies whose inboard joints lie in loops and carry reactions.
std::vector<int> joints_of_loops(const System& system) {
  std::set<int> bodies;
  for (const Closure& closure : system.closures)
    for (const int i : closure.path)
      if (system.bodies[i].nv < 6) bodies.insert(i);
  return {bodies.begin(), bodies.end()};
}

/// A motion counts once more, as one that a row drives does.
std::vector<Vector3> joint_points(const System& system, const std::vector<int>& bodies, const Workspace& ws) {
  std::vector<Vector3> points;
  for (const int i : bodies)
    points.insert(points.end(), is_prescribed(system, i) ? 2 : 1, tree_joint_point(system, ws, i));
  for (const Closure& closure : system.closures) points.push_back(ws.markers[closure.markers.front()].p_WM);
  return points;
}

double spread(const std::vector<Vector3>& points) {
  const auto n = static_cast<double>(points.size());
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : points) mean += p / n;
  double square = 0;
  for (const Vector3& p : points) square += (p - mean).squaredNorm() / n;
  return square > 0 ? std::sqrt(square) : 1.0;
}

/// All reactions and drives of the loops' joints, moments divided by the length l.
VectorX stack_reactions(const System& system, const std::vector<int>& bodies, const VectorX& lambda, double l,
                        const Workspace& ws) {
  const auto motions = std::ranges::count_if(bodies, [&](int i) { return is_prescribed(system, i); });
  VectorX all(6 * (static_cast<Eigen::Index>(bodies.size() + system.closures.size()) + motions));
  Eigen::Index start = 0;
  const auto put = [&](const Vector6& F) {
    all.segment<6>(start) << angular(F) / l, linear(F);
    start += 6;
  };
  for (const int i : bodies) {
    put(tree_joint_reaction(system, ws, i));
    if (is_prescribed(system, i)) put(tree_joint_drive(system, ws, i));
  }
  for (const Closure& closure : system.closures) put(closure_wrench(closure, 0, lambda, ws));
  return all;
}

/// What multipliers alone leave in the tree joints: D^T n at rest.
void set_joint_forces_of(const System& system, const VectorX& n, Workspace& ws) {
  calc_closure_force<double>(system, n, ws, ws.hinge_force.data());
  for (BodyMotion& s : ws.bodies) s.F_joint = -s.F_joint;  // the joint holds what the closures pull at
}

}  // namespace

void calc_reactions(const System& system, Workspace& ws) {
  calc_joint_forces(system, ws);
  if (static_cast<int>(ws.closure.kept.size()) == system.n_rows) return;
  const MatrixX stresses = closure_self_stresses(system, ws);
  if (stresses.cols() == 0) return;

  const std::vector<int> bodies = joints_of_loops(system);
  const double l = spread(joint_points(system, bodies, ws));
  const VectorX found = stack_reactions(system, bodies, ws.lambda, l, ws);
  std::vector<Vector6> F_joint;
  for (const BodyMotion& s : ws.bodies) F_joint.push_back(s.F_joint);

  MatrixX A(found.size(), stresses.cols());
  for (Eigen::Index k = 0; k < stresses.cols(); ++k) {
    set_joint_forces_of(system, stresses.col(k), ws);
    A.col(k) = stack_reactions(system, bodies, stresses.col(k), l, ws);
  }
  // min |found + A c|
  const VectorX c = -A.completeOrthogonalDecomposition().solve(found);
  const VectorX n = stresses * c;
  set_joint_forces_of(system, n, ws);
  for (std::size_t i = 0; i < F_joint.size(); ++i) ws.bodies[i].F_joint += F_joint[i];
  ws.lambda += n;
}

Vector3 tree_joint_point(const System& system, const Evaluation<double>& ev, int i) {
  const TreeBody& body = system.bodies[i];
  if (body.first_is_child) return ev.bodies[i].X_WB.p - ev.bodies[i].p_MB;
  if (body.parent < 0) return body.X_PF.p;
  const Pose& X_WP = ev.bodies[body.parent].X_WB;
  if (body.parent_interface < 0) return X_WP * body.X_PF.p;
  const Interface<double> interface = parent_interface<double>(system, body, ev);
  const Vector3 p_WI = X_WP.p + interface.p_PI();
  return body.on_frame ? Vector3(p_WI + interface.R_WI() * body.X_PF.p) : p_WI;
}

Vector6 tree_joint_reaction(const System& system, const Evaluation<double>& ev, int i) {
  return joint_wrench(system, ev, i) - tree_joint_drive(system, ev, i);
}

Vector6 tree_joint_drive(const System& system, const Evaluation<double>& ev, int i) {
  Vector6 drive = Vector6::Zero();
  const auto* joint = std::get_if<PrescribedJoint>(&system.bodies[i].joint);
  if (joint == nullptr) return drive;
  const int part = joint->kind == PrescribedJoint::Kind::revolute ? 0 : 3;
  drive.segment<3>(part) = -tree_joint_driving_force(system, ev, i) * drive_axis(system, *joint, ev, i);
  return drive;
}

double tree_joint_driving_force(const System& system, const Evaluation<double>& ev, int i) {
  const auto& joint = std::get<PrescribedJoint>(system.bodies[i].joint);
  const int part = joint.kind == PrescribedJoint::Kind::revolute ? 0 : 3;
  return -drive_axis(system, joint, ev, i).dot(joint_wrench(system, ev, i).segment<3>(part));
}

}  // namespace wishbone
