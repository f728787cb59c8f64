// The modal body against mechanics that knows nothing of modes: sums over nodes, Newton's law of every node
// in inertial coordinates, and the conserved quantities of free flight.

#include "bodies/modal_body.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <random>
#include <vector>

#include "core/error.h"
#include "identification/free_free_modes.h"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
// Every allocation of this program, operator new and Eigen's own, passes here.
namespace {
long allocation_count = 0;
}
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}
#define WISHBONE_COUNTS_ALLOCATIONS
#endif

namespace wishbone {
namespace {

constexpr IsotropicMaterial kMaterial{2.1e8, 0.3, 2600};
const std::vector<int> kInterface = {1, 5, 2, 6, 17, 13, 18, 14, 3, 4, 19, 20};

HexahedralMesh chassis_mesh() {
  return make_block({2.4, 0.4, 0.4}, {4, 1, 1});
}

const ModeSet& chassis() {
  static const ModeSet set = free_free_modes(chassis_mesh(), kMaterial);
  return set;
}

ModeSet damped(ModeSet set, double zeta) {
  set.damping_ratio.setConstant(zeta);
  return set;
}

/// A reproducible vector of numbers in [-1, 1].
VectorX some_numbers(Eigen::Index count, unsigned seed) {
  std::mt19937 generator(seed);
  return VectorX::NullaryExpr(count, [&] { return 2.0 * generator() / std::mt19937::max() - 1; });
}

/// Spinning and vibrating strongly: deflections of some centimetres, on a body of 2.4 m that turns with 3
/// rad/s.
struct Motion {
  Vector3 w_B{1.5, -0.8, 2.5};
  Vector3 v_WBo{3, 1, -2};
  VectorX z, zdot;

  explicit Motion(const ModalBody& body)
      : z(some_numbers(body.mode_count(), 1).cwiseQuotient(body.modes().omega) * 100),
        zdot(some_numbers(body.mode_count(), 2) * 100) {}
};

ModalBodyState state_of(const ModalBody& body, const Motion& motion) {
  ModalBodyState state = body.make_state();
  body.set_position(motion.z.data(), state);
  body.set_velocity(motion.w_B, motion.zdot.data(), state);
  return state;
}

/// b_i and delta_i' of every node from the mode set alone.
struct NodeMotion {
  Matrix3X delta, b, delta_dot;
  NodeMotion(const ModeSet& set, const Motion& motion)
      : delta((set.shapes * motion.z).reshaped(3, set.node_count())),
        b(set.node_position + delta),
        delta_dot((set.shapes * motion.zdot).reshaped(3, set.node_count())) {}
};

/// J, S, t_bias and h_bias as the book writes them, node by node.
struct NodeSums {
  Matrix3 J = Matrix3::Zero();
  Matrix3X S;
  Vector3 t_bias = Vector3::Zero();
  VectorX h_bias;

  NodeSums(const ModeSet& set, const Motion& motion) : S(Matrix3X::Zero(3, set.mode_count())) {
    const NodeMotion node(set, motion);
    const Vector3& w = motion.w_B;
    h_bias = 2 * set.damping_ratio.cwiseProduct(set.omega).cwiseProduct(motion.zdot) +
             set.omega.cwiseAbs2().cwiseProduct(motion.z);
    Vector3 coriolis = Vector3::Zero();
    for (int i = 0; i < set.node_count(); ++i) {
      const double m = set.node_mass[i];
      const Vector3 b = node.b.col(i), delta_dot = node.delta_dot.col(i);
      J -= m * skew(b) * skew(b);
      S += m * skew(node.delta.col(i)) * set.shapes.middleRows<3>(3 * i);
      coriolis += m * b.cross(w.cross(delta_dot));
      h_bias +=
          m * set.shapes.middleRows<3>(3 * i).transpose() * (w.cross(w.cross(b)) + 2 * w.cross(delta_dot));
    }
    t_bias = w.cross(J * w) + 2 * coriolis;
  }
};

void expect_node_sums(const ModalBody& body) {
  const Motion motion(body);
  const ModalBodyState state = state_of(body, motion);
  const NodeSums sums(body.modes(), motion);
  EXPECT_LE((state.J - sums.J).norm(), 1e-13 * sums.J.norm());
  EXPECT_LE((state.S - sums.S).norm(), 1e-13 * sums.S.norm());
  EXPECT_LE((state.t_bias - sums.t_bias).norm(), 1e-13 * sums.t_bias.norm());
  EXPECT_LE((state.h_bias - sums.h_bias).norm(), 1e-13 * sums.h_bias.norm());
}

/// The three equations of motion solved for v_Bo' + w x v_Bo (body axes), w' and z''.
struct Accelerations {
  Vector3 a, alpha;
  VectorX zddot;

  Accelerations(const ModalBody& body, const ModalBodyState& state, const Vector3& force,
                const Vector3& moment, const VectorX& modal_load)
      : a(force / body.mass()) {
    const VectorX h = modal_load - state.h_bias;
    alpha = (state.J - state.S * state.S.transpose()).llt().solve(moment - state.t_bias - state.S * h);
    zddot = h - state.S.transpose() * alpha;
  }
};

TEST(ModalBody, EvaluatesTheSumsOverItsNodes) {
  expect_node_sums(ModalBody(damped(chassis(), 0.05), kInterface));
  expect_node_sums(ModalBody(damped(chassis().lowest(10), 0.02), kInterface));
  expect_node_sums(ModalBody(chassis().lowest(3), {}));
}

TEST(ModalBody, EvaluatesTheSumsOfALargeMeshFromFewPoints) {
  const ModeSet set = free_free_modes(make_block({2.4, 0.5, 0.4}, {6, 2, 2}), kMaterial).lowest(5);
  const ModalBody body(damped(set, 0.01), {1, 63, 30});
  EXPECT_EQ(body.make_state().b.rows(), 3 + 3 * (5 + 1));  // of 63 nodes
  expect_node_sums(body);
}

TEST(ModalBody, HasQuadraticInertiaAndLinearCoupling) {
  const ModalBody body(chassis(), kInterface);
  const VectorX z = Motion(body).z;
  ModalBodyState state = body.make_state();
  const Matrix3 J0 = state.J;
  EXPECT_LE((J0 - chassis().inertia()).norm(), 1e-14 * J0.norm());
  EXPECT_EQ(state.S.norm(), 0);

  const auto at = [&](double factor) {
    const VectorX scaled = factor * z;
    body.set_position(scaled.data(), state);
    return std::pair(state.J, state.S);
  };
  const auto [J1, S1] = at(1);
  const auto [J2, S2] = at(2);
  const auto [J3, S3] = at(3);
  EXPECT_LE((S2 - 2 * S1).norm(), 1e-14 * S1.norm());
  EXPECT_LE((J3 - 3 * J2 + 3 * J1 - J0).norm(), 1e-14 * J0.norm());  // third difference of a quadratic
  EXPECT_GE((J2 - 2 * J1 + J0).norm(), 1e-6 * J0.norm());            // which is not linear
}

TEST(ModalBody, PlacesItsInterfaceNodes) {
  const ModalBody body(chassis(), kInterface);
  const Motion motion(body);
  const ModalBodyState state = state_of(body, motion);
  const NodeMotion node(chassis(), motion);
  ASSERT_EQ(body.interface_count(), 12);
  for (int k = 0; k < body.interface_count(); ++k) {
    const int i = kInterface[k] - 1;
    EXPECT_LE((state.interface_b.col(k) - node.b.col(i)).norm(), 1e-14);
    EXPECT_LE((state.interface_delta_dot.col(k) - node.delta_dot.col(i)).norm(), 1e-13);
    EXPECT_EQ(body.interface_shape(k), chassis().shapes.middleRows<3>(3 * i));
  }
  EXPECT_LE((body.deflection(9, state) - node.delta.col(8)).norm(), 1e-15);
}

TEST(ModalBody, CountsEnergyAndMomentumOfItsNodes) {
  for (int count : {54, 7}) {
    const ModalBody body(damped(chassis().lowest(count), 0.03), kInterface);
    const Motion motion(body);
    const ModalBodyState state = state_of(body, motion);
    const NodeMotion node(body.modes(), motion);
    double T = 0;
    Vector3 h = Vector3::Zero();
    for (int i = 0; i < 20; ++i) {
      const Vector3 v = motion.v_WBo + motion.w_B.cross(node.b.col(i)) + node.delta_dot.col(i);
      T += 0.5 * chassis().node_mass[i] * v.squaredNorm();
      h += chassis().node_mass[i] * node.b.col(i).cross(v);
    }
    EXPECT_NEAR(body.kinetic_energy(motion.v_WBo, state) / T, 1, 1e-13);
    EXPECT_LE((body.angular_momentum(state) - h).norm(), 1e-13 * h.norm());

    double modal = 0;
    for (int j = 0; j < count; ++j) modal += body.mode_energy(j, state);
    EXPECT_NEAR(modal, 0.5 * motion.zdot.squaredNorm() + body.elastic_energy(state), 1e-13 * modal);
  }
  const MatrixX K = MatrixX(stiffness_matrix(chassis_mesh(), kMaterial));
  const ModalBody body(chassis(), {});
  const Motion motion(body);
  const VectorX delta = chassis().shapes * motion.z;
  const double V = 0.5 * delta.dot(K * delta);
  EXPECT_NEAR(body.elastic_energy(state_of(body, motion)) / V, 1, 1e-12);
}

TEST(ModalBody, RejectsInterfaceNodesThatItDoesNotHave) {
  EXPECT_THROW(ModalBody(chassis(), {1, 21}), InputError);
  EXPECT_THROW(ModalBody(chassis(), {1, 2, 1}), InputError);
}

TEST(ModalBody, DoesNotAllocateWhenEvaluated) {
#ifdef WISHBONE_COUNTS_ALLOCATIONS
  const ModeSet large = free_free_modes(make_block({2.4, 0.5, 0.4}, {6, 2, 2}), kMaterial);
  for (const ModeSet& set : {chassis(), chassis().lowest(10), large.lowest(5)}) {
    const ModalBody body(set, {1, 5, 20});
    const Motion motion(body);
    ModalBodyState state = body.make_state();
    long before = allocation_count;
    body.set_position(motion.z.data(), state);
    body.set_velocity(motion.w_B, motion.zdot.data(), state);
    EXPECT_EQ(allocation_count, before);
    const VectorX copy = motion.z;
    EXPECT_EQ(allocation_count, before + 1) << "the counter must count Eigen's allocations";
  }
#else
  GTEST_SKIP() << "allocations are counted with the GNU C library only";
#endif
}

// ---------------------------------------------------------------- Newton's law of every node

using Real = long double;
using RealVector3 = Eigen::Matrix<Real, 3, 1>;
using RealMatrix3 = Eigen::Matrix<Real, 3, 3>;
using RealMatrix3X = Eigen::Matrix<Real, 3, Eigen::Dynamic>;
using RealVectorX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrixX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Elastic energy as a function of the inertial node positions alone: delta_i = R^T (x_i - x_c) - s_i, where
/// the mean axes R are found from sum m_i s_i x delta_i = 0 by Newton iteration.
class ElasticPotential {
 public:
  ElasticPotential(const ModeSet& set, const MatrixX& K)
      : mass_(set.node_mass.cast<Real>()), s_(set.node_position.cast<Real>()), K_(K.cast<Real>()) {}

  Real operator()(const RealMatrix3X& x, RealMatrix3 R) const {
    const RealVector3 centre = x * mass_ / mass_.sum();
    for (int iteration = 0; iteration < 8; ++iteration)
      R = R * correction(R.transpose() * (x.colwise() - centre));
    const RealVectorX delta = (RealMatrix3X(R.transpose() * (x.colwise() - centre)) - s_).reshaped();
    return delta.dot(K_ * delta) / 2;
  }

  /// -dV/dx by sixth-order central differences.
  RealMatrix3X force(const RealMatrix3X& x, const RealMatrix3& R) const {
    const Real h = 1e-3L;
    RealMatrix3X f(3, x.cols());
    for (Eigen::Index c = 0; c < x.size(); ++c) {
      const auto difference = [&](int steps) {
        RealMatrix3X forward = x, backward = x;
        forward(c % 3, c / 3) += steps * h;
        backward(c % 3, c / 3) -= steps * h;
        return (*this)(forward, R) - (*this)(backward, R);
      };
      f(c % 3, c / 3) = -(45 * difference(1) - 9 * difference(2) + difference(3)) / (60 * h);
    }
    return f;
  }

 private:
  /// The small rotation that turns the frame toward sum m_i s_i x y_i = 0, y = R^T (x - x_c).
  RealMatrix3 correction(const RealMatrix3X& y) const {
    // sum m s x (y - phi x y) = 0:  sum m [(s.y) 1 - y s^T] phi = sum m s x y
    RealMatrix3 A = RealMatrix3::Zero();
    RealVector3 r = RealVector3::Zero();
    for (Eigen::Index i = 0; i < y.cols(); ++i) {
      const RealVector3 s = s_.col(i), y_i = y.col(i);
      A += mass_[i] * (s.dot(y_i) * RealMatrix3::Identity() - y_i * s.transpose());
      r += mass_[i] * s.cross(y_i);
    }
    const RealVector3 phi = A.inverse() * r;
    const Real angle = phi.norm();
    return angle == 0 ? RealMatrix3(RealMatrix3::Identity())
                      : Eigen::AngleAxis<Real>(angle, phi / angle).toRotationMatrix();
  }

  RealVectorX mass_;
  RealMatrix3X s_;
  RealMatrixX K_;
};

TEST(ModalBody, WithAllModesObeysNewtonsLawOfEveryNode) {
  const ModalBody body(chassis(), kInterface);
  const Motion motion(body);
  const ModalBodyState state = state_of(body, motion);
  const NodeMotion node(chassis(), motion);
  const Matrix3 R = Eigen::AngleAxisd(0.9, Vector3(2, -1, 0.5).normalized()).toRotationMatrix();
  const Vector3 p_WBo(4, -2, 1);

  // m_i x_i'' = f_i - dV/dx_i in inertial axes, with forces on the interface nodes
  const Matrix3X f_B = 1e3 * some_numbers(60, 3).reshaped(3, 20);
  const RealMatrix3X x = ((R * node.b).colwise() + p_WBo).cast<Real>();
  const ElasticPotential potential(chassis(), MatrixX(stiffness_matrix(chassis_mesh(), kMaterial)));
  Matrix3X force = (R.transpose().cast<Real>() * potential.force(x, R.cast<Real>())).cast<double>();
  Vector3 resultant = Vector3::Zero(), moment = Vector3::Zero();
  VectorX modal_load = VectorX::Zero(54);
  for (int k = 0; k < body.interface_count(); ++k) {
    const Vector3 f = f_B.col(k), b = state.interface_b.col(k);
    force.col(kInterface[k] - 1) += f;
    resultant += f;
    moment += b.cross(f);
    modal_load += body.interface_shape(k).transpose() * f;
  }
  const Matrix3X newton = force * chassis().node_mass.cwiseInverse().asDiagonal();

  // the same accelerations from v_Bo', w', z''
  const Accelerations modal(body, state, resultant, moment, modal_load);
  const Vector3& w = motion.w_B;
  Matrix3X kinematic = (chassis().shapes * modal.zddot).reshaped(3, 20);
  for (int i = 0; i < 20; ++i) {
    const Vector3 b = node.b.col(i), delta_dot = node.delta_dot.col(i);
    kinematic.col(i) += modal.a + modal.alpha.cross(b) + w.cross(w.cross(b)) + 2 * w.cross(delta_dot);
  }
  const double difference = (kinematic - newton).norm() / newton.norm();
  RecordProperty("relative_difference", fmt::format("{:.3g}", difference));
  EXPECT_LE(difference, 1e-11);
}

// ---------------------------------------------------------------- free flight

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
    const ModeSet& set = body_.modes();
    const Matrix3 R = rotation_from_quaternion(y_.data() + 6);
    const Matrix3X b =
        set.node_position + Matrix3X((set.shapes * y_.segment(13, m_)).reshaped(3, set.node_count()));
    const Matrix3X delta_dot = (set.shapes * y_.segment(13 + m_, m_)).reshaped(3, set.node_count());
    Balance sum{0.5 * set.omega.cwiseProduct(y_.segment(13, m_)).squaredNorm(), Vector3::Zero(),
                Vector3::Zero()};
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
    VectorX rate(y.size());
    rate << y.segment<3>(3), a.a, quaternion_rate<double>(y.data() + 6, y.segment<3>(10)), a.alpha,
        y.segment(13 + m_, m_), a.zddot, body_.damping_power(state_);
    return rate;
  }

  const ModalBody& body_;
  ModalBodyState state_;
  int m_;
  VectorX y_;
};

void expect_same_momenta(const FreeFlight::Balance& start, const FreeFlight::Balance& end) {
  EXPECT_LE((end.linear_momentum - start.linear_momentum).norm(), 1e-8 * start.linear_momentum.norm());
  EXPECT_LE((end.angular_momentum - start.angular_momentum).norm(), 1e-8 * start.angular_momentum.norm());
}

TEST(ModalBody, FreeFlightConservesEnergyAndMomenta) {
  for (int count : {54, 10, 3}) {
    const ModalBody body(chassis().lowest(count), kInterface);
    FreeFlight flight(body);
    const FreeFlight::Balance start = flight.balance();
    flight.fly(1.0, count == 54 ? 5000 : 1500);
    const FreeFlight::Balance end = flight.balance();
    EXPECT_NEAR(end.energy / start.energy, 1, 1e-8) << count << " modes";
    expect_same_momenta(start, end);
  }
}

TEST(ModalBody, DampingTakesEnergyButNoMomentum) {
  const ModalBody body(damped(chassis().lowest(27), 0.05), kInterface);
  FreeFlight flight(body);
  const FreeFlight::Balance start = flight.balance();
  flight.fly(0.5, 500);
  const FreeFlight::Balance end = flight.balance();
  EXPECT_LE(end.energy, 0.999 * start.energy);
  EXPECT_NEAR((start.energy - end.energy) / flight.energy_lost(), 1, 1e-8);
  expect_same_momenta(start, end);
}

TEST(ModalBody, WithoutModesIsARigidBody) {
  const ModalBody body(chassis().lowest(0), kInterface);
  const Motion motion(body);
  const ModalBodyState state = state_of(body, motion);
  const Matrix3 J = chassis().inertia();
  EXPECT_LE((state.t_bias - motion.w_B.cross(J * motion.w_B)).norm(), 1e-12 * J.norm());
  EXPECT_NEAR(body.kinetic_energy(Vector3::Zero(), state), 0.5 * motion.w_B.dot(J * motion.w_B), 1e-10);
}

}  // namespace
}  // namespace wishbone
