// Reactions of over-constrained mechanisms against the least-norm solution of the balances of all bodies.
#include "solver/reactions.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <array>

#include "solver/closures.h"
#include "solver/forward_dynamics.h"
#include "solver/mechanisms.h"

namespace wishbone {
namespace {

using testing::assembled;
using testing::build;
using testing::Built;
using testing::diagonal;

constexpr int kGround = SystemBuilder::kGround;

/// A hinge from its first-named body to its second-named one.
struct Hinge {
  std::string name;
  int first, second;
  Vector3 p_W, axis_W;
};

/// What the first-named body of each hinge feels: (t, f) at the hinge, world axes.
using Reactions = std::vector<Vector6>;

/// The wrenches that a hinge can put on its first-named body, moments in units of N times l.
Eigen::Matrix<double, 6, 5> hinge_wrenches(const Hinge& hinge, double l) {
  const auto [n1, n2] = perpendiculars(hinge.axis_W);
  Eigen::Matrix<double, 6, 5> W = Eigen::Matrix<double, 6, 5>::Zero();
  W.bottomLeftCorner<3, 3>().setIdentity();
  W.topRightCorner<3, 2>() << l * n1, l * n2;
  return W;
}

double spread(const std::vector<Hinge>& hinges) {
  const auto n = static_cast<double>(hinges.size());
  Vector3 mean = Vector3::Zero();
  for (const Hinge& h : hinges) mean += h.p_W / n;
  double square = 0;
  for (const Hinge& h : hinges) square += (h.p_W - mean).squaredNorm() / n;
  return std::sqrt(square);
}

/// Rate of momentum of a body about its mass centre, less its weight: what all its hinges together exert.
Vector6 balance(const System& system, const BodyMotion& motion, const TreeBody& body) {
  const Matrix3 J = motion.X_WB.R * body.J_B * motion.X_WB.R.transpose();
  const Vector3 w = angular(motion.V);
  return spatial(Vector3(J * angular(motion.A) + w.cross(J * w)),
                 Vector3(body.mass * (linear(motion.A) - system.gravity)));
}

/// Of all reactions that move the bodies as they move, those of least sum |f|^2 + |t|^2/l^2.
Reactions least_reactions(const Built& m, const std::vector<Hinge>& hinges, const Workspace& ws) {
  const auto bodies = static_cast<Eigen::Index>(m.system.bodies.size());
  const auto count = static_cast<Eigen::Index>(hinges.size());
  const double l = spread(hinges);
  MatrixX E = MatrixX::Zero(6 * bodies, 5 * count);
  VectorX b(6 * bodies);
  for (Eigen::Index i = 0; i < bodies; ++i)
    b.segment<6>(6 * i) = balance(m.system, ws.bodies[i], m.system.bodies[i]);
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::Matrix<double, 6, 5> W = hinge_wrenches(hinges[j], l);
    const auto add = [&](int body, double sign) {
      if (body == kGround) return;
      const Vector3 p_BoQ = hinges[j].p_W - ws.bodies[body].X_WB.p;
      for (int k = 0; k < 5; ++k)
        E.block<6, 1>(6 * body, 5 * j + k) += sign * shift_wrench<double>(W.col(k), p_BoQ);
    };
    add(hinges[j].first, 1);
    add(hinges[j].second, -1);
  }
  const VectorX z = E.completeOrthogonalDecomposition().solve(b);
  EXPECT_LT((E * z - b).norm(), 1e-10 * b.norm());
  Reactions reactions;
  for (Eigen::Index j = 0; j < count; ++j)
    reactions.emplace_back(hinge_wrenches(hinges[j], l) * z.segment<5>(5 * j));
  return reactions;
}

/// A ring of bodies from the ground to the ground whose hinge `cut` is the cut joint. The bodies have the axes of the world.
struct Ring {
  std::vector<Hinge> hinges;
  Built mechanism;
  Workspace ws;
};

Ring ring(const std::vector<Vector3>& points, const std::vector<Vector3>& axes, std::size_t cut) {
  SystemBuilder b;
  b.gravity = {1, -9.81, 5};
  const auto last = static_cast<int>(points.size()) - 1;
  for (int i = 0; i < last; ++i)
    b.add_body("bar " + std::to_string(i), 1 + i, diagonal(0.2 + 0.1 * i, 0.3, 0.4),
               {Matrix3::Identity(), (points[i] + points[i + 1]) / 2 + Vector3(0.1, 0.2, 0.3)});
  std::vector<Hinge> hinges;
  for (int j = 0; j <= last; ++j)
    hinges.push_back({"hinge " + std::to_string(j), j - 1, j < last ? j : kGround, points[j], axes[j]});
  const auto R_WM = [](const Vector3& axis) {
    Matrix3 R;
    const auto [x, y] = perpendiculars(axis);
    R << x, y, axis;
    return R;
  };
  for (std::size_t j = 0; j < hinges.size(); ++j) {
    const Hinge& h = hinges[j];
    const RevoluteJoint joint{h.axis_W};
    if (j < cut) b.add_joint(h.name, {h.first}, h.second, h.p_W, joint);
    if (j == cut)
      b.add_closure(h.name, b.add_marker({h.first}, h.p_W, R_WM(h.axis_W)),
                    b.add_marker({h.second}, h.p_W, R_WM(h.axis_W)), RevoluteClosure{});
    if (j > cut)
      b.add_joint(h.name, {h.second}, h.first, h.p_W, reverse(joint), SystemBuilder::InitialMotion{}, true);
  }
  auto [system, state] = std::move(b).build();
  for (Hinge& h : hinges)
    for (int* body : {&h.first, &h.second})
      if (*body != kGround) *body = b.built_index(*body);
  Built m{std::move(system), std::move(state)};
  m.state.v = testing::Random(3).numbers(m.system.nv, 2);
  Workspace ws = assembled(m);
  calc_forward_dynamics(m.system, m.state, ws);
  return {std::move(hinges), std::move(m), std::move(ws)};
}

/// As the solver finds them.
Reactions found_reactions(Ring& r) {
  const System& system = r.mechanism.system;
  calc_reactions(system, r.ws);
  Reactions reactions;
  for (const Hinge& h : r.hinges) {
    if (h.name == system.closures.front().name) {
      reactions.push_back(closure_wrench<double>(system.closures.front(), 0, r.ws.lambda, r.ws));
      continue;
    }
    for (std::size_t i = 0; i < system.bodies.size(); ++i)
      if (system.bodies[i].joint_name == h.name)
        reactions.push_back(tree_joint_reaction(system, r.ws, static_cast<int>(i)));
  }
  return reactions;
}

void expect_least(Ring&& r) {
  const Reactions least = least_reactions(r.mechanism, r.hinges, r.ws);
  const Reactions found = found_reactions(r);
  ASSERT_EQ(found.size(), least.size());
  double scale = 0;
  for (const Vector6& F : least) scale = std::max(scale, F.norm());
  for (std::size_t j = 0; j < least.size(); ++j)
    EXPECT_LT((found[j] - least[j]).norm(), 1e-11 * scale) << r.hinges[j].name;
}

TEST(Reactions, AreOfLeastNormWhicheverHingeOfAPlanarFourBarIsCut) {
  const std::vector<Vector3> points{{0, 0, 0}, {0.5, 0.9, 0}, {2.7, 2.3, 0}, {3, 0, 0}};
  for (std::size_t cut = 0; cut < points.size(); ++cut) {
    Ring r = ring(points, std::vector<Vector3>(4, Vector3::UnitZ()), cut);
    EXPECT_EQ(r.ws.closure.kept.size(), 2u) << "three rows are redundant";
    expect_least(std::move(r));
  }
}

TEST(Reactions, AreOfLeastNormInALoopOfSpaceThatMovesThoughItShouldNot) {
  // Bennett's linkage: sides a, b with twists alpha, beta, sin(alpha)/a = sin(beta)/b; here all four sides and twists are the
  // same, four edges of a tetrahedron with the hinge axes along the common normals of the two edges that meet
  const std::vector<Vector3> points{{1, 0, 0.4}, {0, 1, -0.4}, {-1, 0, 0.4}, {0, -1, -0.4}};
  std::vector<Vector3> axes;
  for (int j = 0; j < 4; ++j) {
    const Vector3 to_next = points[(j + 1) % 4] - points[j], to_last = points[(j + 3) % 4] - points[j];
    axes.push_back(to_next.cross(to_last).normalized());
  }
  for (const std::size_t cut : {1u, 3u}) {
    Ring r = ring(points, axes, cut);
    EXPECT_EQ(r.ws.closure.kept.size(), 2u) << "Bennett's linkage moves";
    expect_least(std::move(r));
  }
}

TEST(Reactions, OfADoorOnTwoHingesShareItsWeight) {
  SystemBuilder b;
  b.gravity = {0, 0, -10};
  const int door = b.add_body("door", 30, diagonal(1, 1, 1), {Matrix3::Identity(), {0.5, 0, 1}});
  b.add_joint("lower", {}, door, {0, 0, 0}, RevoluteJoint{Vector3::UnitZ()});
  b.add_closure("upper", b.add_marker({}, {0, 0, 2}), b.add_marker({door}, {0, 0, 2}), RevoluteClosure{});
  Built m = build(std::move(b));
  Workspace ws = assembled(m);
  EXPECT_TRUE(ws.closure.kept.empty()) << "every row is redundant";
  calc_forward_dynamics(m.system, m.state, ws);
  calc_reactions(m.system, ws);
  const Vector6 lower = tree_joint_reaction(m.system, ws, 0);
  const Vector6 upper = closure_wrench<double>(m.system.closures[0], 0, ws.lambda, ws);
  // half the weight each; the couple 300 N x 0.5 m, shared by forces f at 2 m and moments t so that 2 f^2 + 2 t^2/l^2 is
  // least under 2 f + 2 t = 150 N m with l = 1 m: f = t = 37.5
  EXPECT_LT((lower.tail<3>() - Vector3(-37.5, 0, -150)).norm(), 1e-10);
  EXPECT_LT((upper.tail<3>() - Vector3(37.5, 0, -150)).norm(), 1e-10);
  EXPECT_LT((lower.head<3>() - Vector3(0, 37.5, 0)).norm(), 1e-10);
  EXPECT_LT((upper.head<3>() - Vector3(0, 37.5, 0)).norm(), 1e-10);
}

}  // namespace
}  // namespace wishbone
