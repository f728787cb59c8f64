// Flexible bodies in free flight: energy and both momenta are conserved, or lost where theory.md says so.

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "flexible_forms.h"
#include "identification/spin_stiffening.h"

namespace wishbone {
namespace {

using namespace flexible_forms;

/// One step of the explicit midpoint rule with Gragg's smoothing, extrapolated over 2, 4, 6, 8, 10 substeps:
/// order 10.
VectorX extrapolated_step(const std::function<VectorX(const VectorX&)>& rate, const VectorX& y, double H) {
  std::vector<VectorX> row;
  for (int k = 0; k < 5; ++k) {
    const int n = 2 * (k + 1);
    const double h = H / n;
    VectorX before = y, now = y + h * rate(y);
    for (int step = 1; step < n; ++step) {
      const VectorX after = before + 2 * h * rate(now);
      before = std::exchange(now, after);
    }
    row.insert(row.begin(), 0.5 * (before + now + h * rate(now)));
    for (int j = 1; j <= k; ++j) {
      const double ratio = double(n) / (n - 2 * j);
      row[j] = row[j - 1] + (row[j - 1] - row[j]) / (ratio * ratio - 1);
    }
  }
  return row.back();
}

/// Free flight with y = (p_WBo, v_WBo, quaternion wxyz, w_B, z, z', energy lost to damping).
class FreeFlight {
 public:
  explicit FreeFlight(const ModalBody& body) : body_(body), state_(body.make_state()), m_(body.mode_count()) {
    const Motion motion(body);
    y_.resize(14 + 2 * m_);
    y_ << Vector3(0.5, 1, 2), motion.v_WBo, 1, 0, 0, 0, motion.w_B, motion.z, motion.zdot, 0;
  }

  void fly(double duration, int steps) {
    for (int i = 0; i < steps; ++i)
      y_ = extrapolated_step([this](const VectorX& y) { return rate(y); }, y_, duration / steps);
    evaluate(y_);
  }

  struct Balance {
    double energy;
    Vector3 linear_momentum, angular_momentum;  ///< inertial axes; the angular one about the inertial origin
  };

  /// Summed over the nodes in inertial coordinates.
  Balance balance() const {
    const ShapeSet& set = body_.set();
    const Matrix3 R = rotation_from_quaternion(y_.data() + 6);
    const Matrix3X b =
        set.node_position + Matrix3X((set.shapes * y_.segment(13, m_)).reshaped(3, set.node_count()));
    const Matrix3X delta_dot = (set.shapes * y_.segment(13 + m_, m_)).reshaped(3, set.node_count());
    const VectorX z = y_.segment(13, m_);
    Balance sum{0.5 * z.dot(full(set.stiffness) * z), Vector3::Zero(), Vector3::Zero()};
    if (set.stiffening.size() > 0) {
      // - 1/2 w.(Gamma w) and - Gamma w, w.(Gamma w) = sum_{a <= b} w_a w_b z^T K_ab z
      const Vector3 w = y_.segment<3>(10);
      const Matrix3 Gamma = shortening(set.stiffening, z);
      sum.energy -= 0.5 * w.dot(Gamma * w);
      sum.angular_momentum -= R * (Gamma * w);
    }
    for (int i = 0; i < set.node_count(); ++i) {
      const Vector3 x = y_.head<3>() + R * b.col(i);
      const Vector3 w_B = y_.segment<3>(10);
      const Vector3 v = y_.segment<3>(3) + R * (w_B.cross(b.col(i)) + delta_dot.col(i));
      sum.energy += 0.5 * set.node_mass[i] * v.squaredNorm();
      sum.linear_momentum += set.node_mass[i] * v;
      sum.angular_momentum += set.node_mass[i] * x.cross(v);
    }
    return sum;
  }

  double energy_lost() const { return y_[13 + 2 * m_]; }

 private:
  void evaluate(const VectorX& y) {
    body_.set_position(y.data() + 13, state_);
    body_.set_velocity(Vector3(y.segment<3>(10)), y.data() + 13 + m_, state_);
  }

  VectorX rate(const VectorX& y) {
    evaluate(y);
    const Accelerations a(body_, state_, Vector3::Zero(), Vector3::Zero(), VectorX::Zero(m_));
    const Matrix3 R = rotation_from_quaternion(y.data() + 6);
    VectorX rate(y.size());
    rate << y.segment<3>(3), R * a.a, quaternion_rate<double>(y.data() + 6, y.segment<3>(10)), a.alpha,
        y.segment(13 + m_, m_), a.zddot, body_.damping_power(state_);
    return rate;
  }

  const ModalBody& body_;
  ModalBodyState state_;
  int m_;
  VectorX y_;
};

void expect_same_momenta(const FreeFlight::Balance& start, const FreeFlight::Balance& end) {
  EXPECT_LE((end.linear_momentum - start.linear_momentum).norm(), 1e-9 * start.linear_momentum.norm());
  EXPECT_LE((end.angular_momentum - start.angular_momentum).norm(), 1e-9 * start.angular_momentum.norm());
}

TEST(ModalBody, FreeFlightConservesEnergyAndMomenta) {
  for (int count : {54, 10, 3}) {
    const ModalBody body(chassis().lowest(count), kInterface);
    FreeFlight flight(body);
    const FreeFlight::Balance start = flight.balance();
    flight.fly(1.0, count == 54 ? 5000 : 1500);
    const FreeFlight::Balance end = flight.balance();
    EXPECT_NEAR(end.energy / start.energy, 1, 1e-9) << count << " modes";
    expect_same_momenta(start, end);
  }
}

TEST(ModalBody, InNodalFormConservesEnergyAndMomentaInFreeFlight) {
  for (const NamedShapes& form : complete_forms()) {
    SCOPED_TRACE(form.form);
    const ModalBody body(form.set, {});
    FreeFlight flight(body);
    const FreeFlight::Balance start = flight.balance();
    flight.fly(0.1, 500);
    const FreeFlight::Balance end = flight.balance();
    EXPECT_NEAR(end.energy / start.energy, 1, 1e-9);
    expect_same_momenta(start, end);
  }
}

TEST(ModalBody, StiffenedBySpinConservesEnergyAndMomentaInFreeFlight) {
  ShapeSet set = shapes_of(chassis().lowest(8));
  set.stiffening = spin_stiffening(chassis_mesh(), kMaterial, chassis().lowest(8), {});
  ASSERT_GT(set.stiffening.norm(), 0.1);
  for (const InertiaMethod method : {InertiaMethod::node_sums, InertiaMethod::invariants}) {
    const ModalBody body(set, {}, {}, InertiaTerms::consistent, method);
    FreeFlight flight(body);
    const FreeFlight::Balance start = flight.balance();
    flight.fly(0.5, 1500);
    const FreeFlight::Balance end = flight.balance();
    EXPECT_NEAR(end.energy / start.energy, 1, 1e-9);
    expect_same_momenta(start, end);
  }
}

TEST(ModalBody, WithTheTermsOfTheSourceLosesAngularMomentum) {
  const ModalBody body(chassis().lowest(10), {}, {}, InertiaTerms::source);
  FreeFlight flight(body);
  const FreeFlight::Balance start = flight.balance();
  flight.fly(0.1, 300);
  const FreeFlight::Balance end = flight.balance();
  EXPECT_LE((end.linear_momentum - start.linear_momentum).norm(), 1e-9 * start.linear_momentum.norm());
  EXPECT_GE((end.angular_momentum - start.angular_momentum).norm(), 1e-6 * start.angular_momentum.norm());
}

void expect_loss_without_momentum(const ModalBody& body, double duration, int steps) {
  FreeFlight flight(body);
  const FreeFlight::Balance start = flight.balance();
  flight.fly(duration, steps);
  const FreeFlight::Balance end = flight.balance();
  EXPECT_LE(end.energy, 0.999 * start.energy);
  EXPECT_NEAR((start.energy - end.energy) / flight.energy_lost(), 1, 1e-9);
  expect_same_momenta(start, end);
}

TEST(ModalBody, DampingTakesEnergyButNoMomentum) {
  expect_loss_without_momentum(ModalBody(damped(chassis().lowest(27), 0.05), kInterface), 0.5, 500);
  for (const NamedShapes& form : complete_forms(0.05)) {
    SCOPED_TRACE(form.form);
    expect_loss_without_momentum(ModalBody(form.set, kInterface), 0.1, 500);
  }
}

}  // namespace
}  // namespace wishbone
