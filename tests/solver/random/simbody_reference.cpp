// What Debian's Simbody makes of a mechanism: reads one as JSON from standard input and writes accelerations, reactions and
// the motion after some time to standard output. A program of its own, since Simbody brings functions of an older SUNDIALS
// under the same names. Both sides of the exchange are described in simbody_exchange.h.

#include <Simbody.h>

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/random/simbody_constant_velocity.h"

namespace wishbone::testing {
namespace {

using Json = nlohmann::json;
using SimTK::Constraint;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

Vec3 vector_of(const Json& json) {
  return {json[0], json[1], json[2]};
}
/// Nine numbers, rows first.
SimTK::Mat33 matrix_of(const Json& json) {
  SimTK::Mat33 M;
  for (int i = 0; i < 9; ++i) M(i / 3, i % 3) = json[static_cast<std::size_t>(i)];
  return M;
}
Transform pose_of(const Json& json) {
  return {Rotation(matrix_of(json.at("R")), true), vector_of(json.at("p"))};
}
SpatialVec spatial_of(const Json& json) {
  return {vector_of(json[0]), vector_of(json[1])};
}

Json json_of(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
Json json_of(const SpatialVec& V) {
  return {json_of(V[0]), json_of(V[1])};
}
Json json_of(const Transform& X) {
  Json R;
  for (int i = 0; i < 9; ++i) R.push_back(X.R()[i / 3][i % 3]);
  return {{"R", R}, {"p", json_of(X.p())}};
}

class Mechanism {
 public:
  explicit Mechanism(const Json& json) : matter_(system_), forces_(system_) {
    SimTK::Force::UniformGravity(forces_, matter_, vector_of(json.at("gravity")));
    for (const Json& body : json.at("bodies")) design_.push_back(pose_of(body.at("pose")));
    for (std::size_t i = 0; i < design_.size(); ++i)
      bodies_.push_back(add_body(json.at("bodies")[i], json.at("joints")[i], design_[i]));
    for (const Json& closure : json.at("closures")) add_closure(closure);
    for (const Json& spring : json.at("springs")) add_spring(spring);
    state_ = system_.realizeTopology();
    system_.realizeModel(state_);
    set_state(json.at("poses"), json.at("velocities"));
  }

  Json instant() {
    system_.realize(state_, SimTK::Stage::Acceleration);
    Json result = motion(state_);
    SimTK::Vector_<SpatialVec> at_M;
    matter_.calcMobilizerReactionForces(state_, at_M);
    for (const MobilizedBody& body : bodies_) {
      result["accelerations"].push_back(json_of(body.getBodyAcceleration(state_)));
      result["joint_reactions"].push_back(json_of(at_M[body.getMobilizedBodyIndex()]));
    }
    result["closure_reactions"] = Json::array();
    for (const Closure& closure : closures_)
      result["closure_reactions"].push_back(json_of(reaction(closure)));
    return result;
  }

  Json after(double duration, double accuracy) {
    SimTK::RungeKuttaFeldbergIntegrator integrator(system_);
    integrator.setAccuracy(accuracy);
    integrator.setConstraintTolerance(accuracy);
    integrator.initialize(state_);
    while (integrator.getTime() < duration) integrator.stepTo(duration);  // returns once at the start
    const SimTK::State& end = integrator.getState();
    system_.realize(end, SimTK::Stage::Velocity);
    return motion(end);
  }

 private:
  struct Closure {
    std::vector<Constraint> constraints;
    SimTK::MobilizedBodyIndex A;
    Vec3 p_AM;
  };

  Transform design(int body) const { return body < 0 ? Transform() : design_[body]; }
  MobilizedBody& body(int i) { return i < 0 ? matter_.updGround() : bodies_[i]; }
  Vec3 point_on(int i, const Vec3& p_W) const { return ~design(i) * p_W; }
  UnitVec3 axis_on(int i, const UnitVec3& axis_W) const { return ~design(i).R() * axis_W; }

  MobilizedBody add_body(const Json& data, const Json& joint, const Transform& X_WB) {
    const SimTK::Mat33 J = matrix_of(data.at("inertia"));
    const SimTK::Inertia inertia(Vec3(J(0, 0), J(1, 1), J(2, 2)), Vec3(J(0, 1), J(0, 2), J(1, 2)));
    const SimTK::Body::Rigid rigid(SimTK::MassProperties(data.at("mass"), Vec3(0), inertia));
    const int parent = joint.at("parent");
    const Transform X_WJ = pose_of(joint.at("pose"));
    return mobilized(joint, body(parent), ~design(parent) * X_WJ, rigid, ~X_WB * X_WJ);
  }

  MobilizedBody mobilized(const Json& joint, MobilizedBody& P, const Transform& X_PF,
                          const SimTK::Body::Rigid& rigid, const Transform& X_BM) {
    const std::string kind = joint.at("kind");
    const auto direction = joint.at("reversed").get<bool>() ? MobilizedBody::Reverse : MobilizedBody::Forward;
    if (kind == "fixed") return MobilizedBody::Weld(P, X_PF, rigid, X_BM);
    if (kind == "revolute") return MobilizedBody::Pin(P, X_PF, rigid, X_BM, direction);
    if (kind == "cylindrical") return MobilizedBody::Cylinder(P, X_PF, rigid, X_BM, direction);
    if (kind == "universal") return MobilizedBody::Universal(P, X_PF, rigid, X_BM, direction);
    if (kind == "spherical") return MobilizedBody::Ball(P, X_PF, rigid, X_BM, direction);
    if (kind == "planar") return MobilizedBody::Planar(P, X_PF, rigid, X_BM, direction);
    if (kind == "free") return MobilizedBody::Free(P, X_PF, rigid, X_BM, direction);
    if (kind == "screw") return MobilizedBody::Screw(P, X_PF, rigid, X_BM, joint.at("pitch"), direction);
    if (kind == "prismatic") {  // a slider moves along x
      const Rotation x_to_z(-SimTK::Pi / 2, SimTK::YAxis);
      return MobilizedBody::Slider(P, X_PF * Transform(x_to_z), rigid, X_BM * Transform(x_to_z), direction);
    }
    if (kind == "constant_velocity")
      return MobilizedBody::Custom(P, new ConstantVelocityMobilizer(matter_), X_PF, rigid, X_BM, direction);
    throw std::runtime_error("no mobilizer for the joint '" + kind + "'");
  }

  void add_closure(const Json& json) {
    const int A = json.at("bodies")[0], B = json.at("bodies")[1];
    const Transform X_WA = pose_of(json.at("pose"));
    const Vec3 p_WB = vector_of(json.at("other_point"));
    const Vec3 p_A = point_on(A, X_WA.p()), p_B = point_on(B, p_WB);
    const auto axis = [&](int i, SimTK::CoordinateAxis k) { return axis_on(i, X_WA.R().getAxisUnitVec(k)); };
    const auto normal = [&](SimTK::CoordinateAxis i, SimTK::CoordinateAxis j) -> Constraint {
      return Constraint::ConstantAngle(body(A), axis(A, i), body(B), axis(B, j));
    };
    const SimTK::CoordinateAxis x = SimTK::XAxis, y = SimTK::YAxis, z = SimTK::ZAxis;
    const auto on_line = [&]() -> Constraint {
      return Constraint::PointOnLine(body(A), axis(A, z), p_A, body(B), p_B);
    };
    const auto on_plane = [&]() -> Constraint {
      return Constraint::PointInPlane(body(A), axis(A, z), SimTK::dot(axis(A, z), p_A), body(B), p_B);
    };
    const auto ball = [&]() -> Constraint { return Constraint::Ball(body(A), p_A, body(B), p_B); };

    const std::string kind = json.at("kind");
    Closure closure{{}, body(A).getMobilizedBodyIndex(), p_A};
    auto& parts = closure.constraints;
    if (kind == "fixed")
      parts = {Constraint::Weld(body(A), ~design(A) * X_WA, body(B), ~design(B) * Transform(X_WA.R(), p_WB))};
    else if (kind == "spherical")
      parts = {ball()};
    else if (kind == "revolute")
      parts = {ball(), normal(x, z), normal(y, z)};
    else if (kind == "universal")
      parts = {ball(), normal(x, y)};
    else if (kind == "point_on_line")
      parts = {on_line()};
    else if (kind == "cylindrical")
      parts = {on_line(), normal(x, z), normal(y, z)};
    else if (kind == "prismatic")
      parts = {on_line(), Constraint::ConstantOrientation(body(A), ~design(A).R() * X_WA.R(), body(B),
                                                          ~design(B).R() * X_WA.R())};
    else if (kind == "point_on_plane")
      parts = {on_plane()};
    else if (kind == "planar")
      parts = {on_plane(), normal(x, z), normal(y, z)};
    else if (kind == "distance")
      parts = {Constraint::Rod(body(A), p_A, body(B), p_B, (p_WB - X_WA.p()).norm())};
    else
      throw std::runtime_error("no constraint for the closure '" + kind + "'");
    closures_.push_back(closure);
  }

  void add_spring(const Json& json) {
    const int P = json.at("bodies")[0], Q = json.at("bodies")[1];
    const Vec3 p_P = point_on(P, vector_of(json.at("points")[0])),
               p_Q = point_on(Q, vector_of(json.at("points")[1]));
    SimTK::Force::TwoPointLinearSpring(forces_, body(P), p_P, body(Q), p_Q, json.at("stiffness"),
                                       json.at("free_length"));
    SimTK::Force::TwoPointLinearDamper(forces_, body(P), p_P, body(Q), p_Q, json.at("damping"));
  }

  /// Joint coordinates and speeds from the poses and velocities of bodies, parents first.
  void set_state(const Json& poses, const Json& velocities) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const MobilizedBody& B = bodies_[i];
      system_.realize(state_, SimTK::Stage::Position);
      const Transform X_WF = B.getParentMobilizedBody().getBodyTransform(state_) * B.getInboardFrame(state_);
      B.setQToFitTransform(state_, ~X_WF * pose_of(poses[i]) * B.getOutboardFrame(state_));
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const MobilizedBody &B = bodies_[i], &P = B.getParentMobilizedBody();
      system_.realize(state_, SimTK::Stage::Velocity);
      const Rotation R_WF = P.getBodyRotation(state_) * B.getInboardFrame(state_).R();
      const Vec3 p_WM = B.findStationLocationInGround(state_, B.getOutboardFrame(state_).p());
      const SpatialVec V = spatial_of(velocities[i]);
      const Vec3 w_P = P.getBodyAngularVelocity(state_);
      const Vec3 v_P = P.findStationVelocityInGround(state_, P.findStationAtGroundPoint(state_, p_WM));
      const Vec3 v_M = V[1] + V[0] % (p_WM - B.getBodyOriginLocation(state_));
      B.setUToFitVelocity(state_, SpatialVec(~R_WF * (V[0] - w_P), ~R_WF * (v_M - v_P)));
    }
  }

  Json motion(const SimTK::State& state) const {
    Json result;
    for (const MobilizedBody& body : bodies_) {
      result["poses"].push_back(json_of(body.getBodyTransform(state)));
      result["velocities"].push_back(json_of(body.getBodyVelocity(state)));
    }
    return result;
  }

  /// On A about its marker's origin.
  SpatialVec reaction(const Closure& closure) const {
    SpatialVec sum(Vec3(0), Vec3(0));
    for (const Constraint& part : closure.constraints) {
      // Simbody has the forces of constraints on the left of its equations of motion: their sign is the opposite
      const SimTK::Vector_<SpatialVec> F = part.getConstrainedBodyForcesAsVector(state_);
      for (SimTK::ConstrainedBodyIndex i(0); i < part.getNumConstrainedBodies(); ++i)
        if (part.getMobilizedBodyFromConstrainedBody(i).getMobilizedBodyIndex() == closure.A) sum -= F[i];
    }
    const Vec3 p_AM_W = matter_.getMobilizedBody(closure.A).expressVectorInGroundFrame(state_, closure.p_AM);
    return {sum[0] - p_AM_W % sum[1], sum[1]};
  }

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<Transform> design_;
  std::vector<MobilizedBody> bodies_;
  std::vector<Closure> closures_;
  SimTK::State state_;
};

}  // namespace
}  // namespace wishbone::testing

int main() {
  try {
    const auto json = nlohmann::json::parse(std::cin);
    wishbone::testing::Mechanism mechanism(json);
    nlohmann::json result{{"start", mechanism.instant()}};
    result["end"] = mechanism.after(json.at("duration"), json.at("accuracy"));
    std::cout << result.dump() << "\n";
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << failure.what() << "\n";
    return 1;
  }
}
