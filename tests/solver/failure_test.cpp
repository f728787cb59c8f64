// Runs that cannot go on: they end as failed, say where and why, and keep what was computed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "core/error.h"
#include "solver/first_order.h"
#include "solver/mechanisms.h"
#include "solver/progress_guard.h"

namespace wishbone {
namespace {

using ::testing::AllOf;
using testing::build;
using testing::Built;
using testing::diagonal;
using testing::four_bar;
using ::testing::HasSubstr;
using testing::simulate;
using testing::Trajectory;

constexpr Method kMethods[] = {Method::erk, Method::adams, Method::bdf};

/// A cart on a spring to the ground and, if wanted, a second drive end that a motion brings onto the cart's spring.
Built cart_on_spring(double stiffness) {
  SystemBuilder b;
  const int cart = b.add_body("cart", 2, diagonal(1, 1, 1), {Matrix3::Identity(), {2, 0, 0}});
  b.add_joint("slide", {}, cart, {0, 0, 0}, PrismaticJoint{Vector3::UnitX()});
  b.add_force(
      SpringDamper("main spring", b.add_marker({}, Vector3::Zero()), b.add_marker({cart}), stiffness, 0, 1));
  return build(std::move(b));
}

TEST(Failure, OfImpossibleTolerancesNamesTimeAndCoordinate) {
  for (const Method method : kMethods) {
    const Built m = cart_on_spring(200);
    const Trajectory run = simulate(m.system, m.state, 1.0, 0.1, 1e-30, method);
    EXPECT_EQ(run.summary.status, TransientSummary::Status::failed) << to_string(method);
    EXPECT_THAT(run.summary.message, AllOf(HasSubstr("t = "), HasSubstr("slide"))) << to_string(method);
    EXPECT_GE(run.states.size(), 1u);
  }
}

TEST(Failure, OfASpringWhoseEndsMeetNamesSpringAndTimeAndKeepsTheOutputs) {
  // a motion carries one end of the spring onto the other and stops there at t = 0.5 s
  for (const Method method : kMethods) {
    SystemBuilder b;
    const int slider = b.add_body("slider", 1, diagonal(1, 1, 1), {Matrix3::Identity(), {0, 0, 0}});
    b.add_joint("push", {}, slider, {0, 0, 0},
                PrescribedJoint{PrescribedJoint::Kind::prismatic, Vector3::UnitX(),
                                Motion("push", 1, {{0.1, 0.4, -1}})});
    const int top = b.add_body("top", 1, diagonal(1, 2, 3), {});
    b.set_velocity(top, {1, 0, 0}, {0, 1, 0});
    b.add_force(SpringDamper("main spring", b.add_marker({}, Vector3::Zero()),
                             b.add_marker({slider}, {0, 0, 0}), 100, 0, 0.5));
    const Built m = build(std::move(b));
    const Trajectory run = simulate(m.system, m.state, 1.0, 0.1, 1e-8, method);
    EXPECT_EQ(run.summary.status, TransientSummary::Status::failed) << to_string(method);
    EXPECT_THAT(run.summary.message, AllOf(HasSubstr("main spring"), HasSubstr("t = 0.5")))
        << to_string(method);
    EXPECT_GE(run.states.size(), 5u) << to_string(method);
    EXPECT_NEAR(run.summary.t_end, 0.5, 1e-9) << to_string(method);
  }
}

TEST(Failure, OfAForceThatOverflowsNamesTheElement) {
  for (const Method method : kMethods) {
    Built m = cart_on_spring(1e308);
    m.state.q[0] = 100;
    const Trajectory run = simulate(m.system, m.state, 1.0, 0.1, 1e-8, method);
    EXPECT_EQ(run.summary.status, TransientSummary::Status::failed) << to_string(method);
    EXPECT_THAT(run.summary.message, AllOf(HasSubstr("main spring"), HasSubstr("t = 0")))
        << to_string(method);
  }
}

TEST(Failure, OfALoopCarriedBeyondItsReachComesWhereItIsStretchedOut) {
  // a motion pulls the loop's foot away until two rods of 1 m cannot span it any more
  for (const auto& [form, method] :
       {std::pair(Form::index1, Method::erk), {Form::index1, Method::bdf}, {Form::ggl, Method::bdf}}) {
    SystemBuilder b;
    const int foot = b.add_body("foot", 1, diagonal(1, 1, 1), {});
    b.add_joint(
        "pull", {}, foot, {0, 0, 0},
        PrescribedJoint{PrescribedJoint::Kind::prismatic, Vector3::UnitX(), Motion("pull", 0, {{0, 2, -2}})});
    const int left = b.add_body("left", 1, diagonal(0.1, 0.1, 0.1), {Matrix3::Identity(), {0.3, 0.4, 0}});
    const int right = b.add_body("right", 1, diagonal(0.1, 0.1, 0.1), {Matrix3::Identity(), {0.9, 0.4, 0}});
    b.add_joint("left foot", {foot}, left, {0, 0, 0}, RevoluteJoint{});
    b.add_joint("right foot", {}, right, {1.2, 0, 0}, RevoluteJoint{});
    b.add_closure("apex", b.add_marker({left}, {0.6, 0.8, 0}), b.add_marker({right}, {0.6, 0.8, 0}),
                  SphericalClosure{});
    const Built m = build(std::move(b));
    const Trajectory run = simulate(m.system, m.state, 2.0, 0.1, 1e-8, method, form);
    EXPECT_EQ(run.summary.status, TransientSummary::Status::failed)
        << to_string(form) << " " << to_string(method);
    EXPECT_THAT(run.summary.message, HasSubstr("t = 0.89"));
    EXPECT_NEAR(run.summary.t_end, 0.8925, 1e-4);  // 1.2 m + 2 m s(t/2 s) = 2 m
    EXPECT_EQ(run.states.size(), 9u);
  }
}

TEST(Failure, OfTheStepLimitSaysSo) {
  const Built m = cart_on_spring(200);
  Workspace ws(m.system);
  TransientOptions options;
  options.integrator.max_steps = 3;
  const TransientSummary summary =
      run_transient(m.system, m.state, options, ws, [](const State&, const Work&) {});
  EXPECT_EQ(summary.status, TransientSummary::Status::failed);
  EXPECT_THAT(summary.message, HasSubstr("steps"));
}

TEST(Failure, OfUnsuitableFormsIsRefusedBeforeTheRun) {
  const Built m = four_bar(SphericalClosure{}, 1.0);
  EXPECT_THROW(simulate(m.system, m.state, 1, 0.1, 1e-6, Method::erk, Form::ode), InputError);
  EXPECT_THROW(simulate(m.system, m.state, 1, 0.1, 1e-6, Method::erk, Form::ggl), InputError);
}

/// A bead of given radius of gyration on a joint whose point or axis lies `away` from it along a direction without round
/// numbers.
Built bead(const TreeJoint& joint, const Vector3& direction, double away, double radius) {
  SystemBuilder b;
  b.gravity = {0, 0, -9.81};
  const Vector3 p_WB(0.1, 0.7, -10.3);
  const Matrix3 J_B = 3 * radius * radius * Matrix3::Identity();
  const int body = b.add_body("bead", 3, J_B, {Matrix3::Identity(), p_WB});
  b.add_joint("pin", {}, body, p_WB + away * direction, joint);
  return build(std::move(b));
}

TEST(Failure, OfAJointAboutWhichNothingHasInertiaNamesItEvenWhereRoundingHidesIt) {
  testing::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3 axis = random.vector(1).normalized();
    for (const TreeJoint& joint :
         {TreeJoint(RevoluteJoint{axis}), TreeJoint(SphericalJoint{}), TreeJoint(CylindricalJoint{axis})}) {
      const Built m = bead(joint, axis, random.uniform(-2, 2), 0);
      const Trajectory run = simulate(m.system, m.state, 0.1, 0.1, 1e-8);
      EXPECT_EQ(run.summary.status, TransientSummary::Status::failed)
          << joint_kind(joint) << ", sample " << i;
      EXPECT_THAT(run.summary.message, AllOf(HasSubstr("body 'bead', joint 'pin'"), HasSubstr("the inertia")))
          << joint_kind(joint) << ", sample " << i;
    }
  }
}

TEST(Failure, DoesNotBefallABeadAsSmallAsADustGrain) {
  const Vector3 axis = Vector3(1, 2, 3).normalized();
  for (const TreeJoint& joint : {TreeJoint(RevoluteJoint{axis}), TreeJoint(SphericalJoint{})}) {
    const Built m = bead(joint, axis, 2, 1e-6);
    EXPECT_EQ(simulate(m.system, m.state, 0.1, 0.1, 1e-8).summary.status, TransientSummary::Status::complete)
        << joint_kind(joint);
  }
}

/// Answers of the guard around callbacks at times from t on, all of which fail but every `good`-th.
std::vector<int> answers(FirstOrderSystem& equations, double t, int good) {
  std::vector<int> answers;
  for (int i = 1; i <= 200; ++i)
    answers.push_back(equations.guard([&] {
      equations.note_time(t += 1e-13);  // 200 of them lie within a billionth
      if (i % good != 0) throw NumericsError({"spring", "its ends meet", "", ""});
    }));
  return answers;
}

TEST(Failure, AgainAndAgainAtOneTimeIsHopelessUnlessTheRunHasGoneOn) {
  const Built m = cart_on_spring(200);
  Workspace ws(m.system);
  ProgressGuard progress({}, {});
  FirstOrderSystem stuck(m.system, ws, progress), creeping(m.system, ws, progress);
  EXPECT_THAT(answers(stuck, 1, 1000), ::testing::Contains(-1));
  EXPECT_THAT(answers(creeping, 1, 20), ::testing::Each(::testing::AnyOf(0, 1)));
}

}  // namespace
}  // namespace wishbone
