// Loads and drives that depend on signals, within the equations of motion.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/dual.h"
#include "solver/assembly.h"
#include "solver/ggl_jacobian.h"
#include "solver/ggl_residual.h"
#include "solver/kinematics.h"
#include "solver/loads.h"
#include "solver/mechanisms.h"
#include "solver/sparsity.h"
#include "solver/system_builder.h"

namespace wishbone {
namespace {

using testing::Built;

/// A cart on a slide and a rotor beside it, joined by nothing but a drive of the slide that depends on the
/// angle of the rotor, and a force on the rotor that depends on its distance from the cart and on the cart's
/// speed.
Built cart_and_rotor() {
  SystemBuilder b;
  const Pose at_cart{Matrix3::Identity(), Vector3(0.1, 0.2, 0)},
      at_rotor{Matrix3::Identity(), Vector3(1.2, 0.4, 0.3)};
  const int cart = b.add_body("cart", 2, Vector3(1, 1, 1).asDiagonal(), at_cart);
  const int rotor = b.add_body("rotor", 1, Vector3(0.3, 0.4, 0.5).asDiagonal(), at_rotor);
  b.add_joint("slide", {}, cart, at_cart.p, PrismaticJoint(Vector3::UnitX()), {{0.2}, {1.5}, {1}});
  b.add_joint("axle", {}, rotor, Vector3(1, 0, 0), RevoluteJoint(Vector3::UnitZ()), {{0.3}, {-2}, {1}});
  const MarkerIndex ground = b.add_marker({}), on_cart = b.add_marker({cart}),
                    on_rotor = b.add_marker({rotor});
  using enum MotionSignal::Quantity;
  b.add_signal({"angle", ground, on_rotor, Gauge{Gauge::Kind::rotation}, position});
  b.add_signal({"distance", on_cart, on_rotor, Gauge{Gauge::Kind::distance}, position});
  b.add_signal({"cart_speed", on_cart, 0, speed});
  const auto function = [](const char* text) {
    return Function(Expression(text, {"t", "angle", "distance", "cart_speed"}));
  };
  b.add_force(JointDrive("drive", ground, on_cart, Gauge{Gauge::Kind::translation, 0},
                         function("3*sin(2*angle) + t")));
  b.add_force(
      AppliedLoad("push", on_rotor,
                  {{0.0, 0.0, function("-cart_speed^3")}, {function("5/distance"), function("angle*t"), 0.0}},
                  LoadAxes::kMarker));
  Built built;
  std::tie(built.system, built.state) = std::move(b).build();
  return built;
}

// r(y, y') of the form that IDA solves; its Jacobian dr/dy + c dr/dy' by central differences.
TEST(LoadSignals, EnterTheJacobianExactly) {
  const Built m = cart_and_rotor();
  GglResidual<double> residual(m.system, {});
  GglJacobian jacobian(m.system, {});
  const Eigen::Index n = residual.size();
  ASSERT_EQ(jacobian.size(), n);
  ASSERT_FALSE(jacobian.sparse());
  VectorX y = VectorX::Zero(n), y_rate = VectorX::LinSpaced(n, -1, 2);
  y.head(4) << m.state.q, m.state.v;
  const double t = 0.7, c = 13;
  MatrixX J(n, n);
  jacobian.calc(t, c, y.data(), y_rate.data(), residual.evaluation().memory, J.data());
  const auto r = [&](Eigen::Index j, double h) {
    VectorX at = y, rate = y_rate, value(n);
    at[j] += h;
    rate[j] += c * h;
    residual.calc(t, at.data(), rate.data(), value.data());
    return value;
  };
  const double h = 1e-6;
  for (Eigen::Index j = 0; j < n; ++j)
    EXPECT_LT((J.col(j) - (r(j, h) - r(j, -h)) / (2 * h)).norm(), 1e-7) << "column " << j;
  EXPECT_GT(std::abs(J(2, 1)), 1);  // the cart's equation feels the angle of the rotor
}

// Bodies that a signal alone connects are coupled in the pattern of large Jacobians, too.
TEST(LoadSignals, CoupleBodiesInTheSparsityPattern) {
  const Built m = cart_and_rotor();
  const SparsityPattern pattern = ggl_pattern(m.system, {});
  const auto holds = [&](int row, int column) {
    return std::find(pattern[row].begin(), pattern[row].end(), column) != pattern[row].end();
  };
  EXPECT_TRUE(holds(2, 1));  // v' of the cart by q of the rotor
  EXPECT_TRUE(holds(3, 0));
  EXPECT_TRUE(holds(3, 2));
}

TEST(LoadSignals, StopTheRunWhereLoadsDo) {
  SystemBuilder b;
  const int body = b.add_body("body", 1, Matrix3::Identity(), {});
  const MarkerIndex marker = b.add_marker({body});
  const Function pulse(Expression("step(t, 1, 0, 2, 5)", {"t"}));
  const Function ramp(Table("ramp", {0.5, 1 + 1e-15, 3}, {0, 1, 0}, Table::Interpolation::linear));
  b.add_force(AppliedLoad("push", marker, {{0.0, 0.0, 0.0}, {pulse, ramp, 0.0}}));
  const auto [system, state] = std::move(b).build();
  const std::vector<double> times = system.stop_times();
  ASSERT_EQ(times.size(), 4u);  // 1 and 1 + 1e-15 are one
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(times[i], std::vector<double>({0.5, 1, 2, 3})[i], 1e-14);
}

}  // namespace
}  // namespace wishbone
