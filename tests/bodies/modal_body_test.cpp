// The modal body against mechanics that knows nothing of modes: sums over nodes, Newton's law of every node
// in inertial coordinates, and the conserved quantities of free flight.

#include "bodies/modal_body.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cstdlib>
#include <functional>
#include <random>
#include <vector>

#include "bodies/nodal_shapes.h"
#include "core/error.h"
#include "identification/free_free_modes.h"
#include "identification/nodal_model.h"

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

MatrixX full(const MatrixX& matrix) {
  return matrix.cols() == 1 ? MatrixX(matrix.col(0).asDiagonal()) : matrix;
}

/// The chassis in every form with all its freedoms.
struct NamedShapes {
  std::string form;
  ShapeSet set;
};
std::vector<NamedShapes> complete_forms(double zeta = 0) {
  const ModeSet modes = damped(chassis(), zeta);
  const NodalModel model = nodal_model(modes);
  return {{"modal", shapes_of(modes)},
          {"nodal, mean axes", mean_axis_shapes(model)},
          {"nodal, fixed axes", fixed_axis_shapes(model, {1, 17, 3})}};
}

/// Spinning and vibrating strongly: deflections of some centimetres, on a body of 2.4 m that turns with 3
/// rad/s.
struct Motion {
  Vector3 w_B{1.5, -0.8, 2.5};
  Vector3 v_WBo{3, 1, -2};
  VectorX z, zdot;

  explicit Motion(const ModalBody& body)
      : z(flexibility(body.set().stiffness) * some_numbers(body.mode_count(), 1) * 100),
        zdot(some_numbers(body.mode_count(), 2) * 100) {}

 private:
  /// K^-1/2
  static MatrixX flexibility(const MatrixX& K) {
    if (K.cols() == 1) return K.col(0).cwiseSqrt().cwiseInverse().asDiagonal();
    return Eigen::SelfAdjointEigenSolver<MatrixX>(K).operatorInverseSqrt();
  }
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
  NodeMotion(const ShapeSet& set, const Motion& motion)
      : delta((set.shapes * motion.z).reshaped(3, set.node_count())),
        b(set.node_position + delta),
        delta_dot((set.shapes * motion.zdot).reshaped(3, set.node_count())) {}
};

/// The inertia and the biases as the book writes them, node by node.
struct NodeSums {
  Matrix3 J = Matrix3::Zero();
  Matrix3X S, P;
  Vector3 c = Vector3::Zero(), t_bias = Vector3::Zero(), f_bias = Vector3::Zero();
  VectorX h_bias;

  NodeSums(const ShapeSet& set, const Motion& motion)
      : S(Matrix3X::Zero(3, set.shape_count())), P(Matrix3X::Zero(3, set.shape_count())) {
    const NodeMotion node(set, motion);
    const Vector3& w = motion.w_B;
    h_bias = full(set.damping) * motion.zdot + full(set.stiffness) * motion.z;
    Vector3 coriolis = Vector3::Zero();
    for (int i = 0; i < set.node_count(); ++i) {
      const double m = set.node_mass[i];
      const Vector3 b = node.b.col(i), delta_dot = node.delta_dot.col(i);
      J -= m * skew(b) * skew(b);
      S += m * skew(b) * set.shapes.middleRows<3>(3 * i);
      P += m * set.shapes.middleRows<3>(3 * i);
      c += m * b;
      f_bias += m * (w.cross(w.cross(b)) + 2 * w.cross(delta_dot));
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
  const NodeSums sums(body.set(), motion);
  EXPECT_LE((state.J - sums.J).norm(), 1e-13 * sums.J.norm());
  EXPECT_LE((state.c - sums.c).norm(), 1e-12);
  EXPECT_LE((state.f_bias - sums.f_bias).norm(), 1e-13 * sums.t_bias.norm());
  if (!body.mean_axes()) {
    EXPECT_LE((body.momentum_shape() - sums.P).norm(), 1e-13 * sums.P.norm());
  }
  EXPECT_LE((state.S - sums.S).norm(), 1e-13 * sums.S.norm());
  EXPECT_LE((state.t_bias - sums.t_bias).norm(), 1e-13 * sums.t_bias.norm());
  EXPECT_LE((state.h_bias - sums.h_bias).norm(), 1e-13 * sums.h_bias.norm());
}

/// The three equations of motion solved for v_Bo' + w x v_Bo (body axes), w' and z''.
struct Accelerations {
  Vector3 a, alpha;
  VectorX zddot;

  Accelerations(const ModalBody& body, const ModalBodyState& state, const Vector3& force,
                const Vector3& moment, const VectorX& modal_load) {
    const int m = body.mode_count();
    const Matrix3X P = body.mean_axes() ? Matrix3X(Matrix3X::Zero(3, m)) : body.momentum_shape();
    MatrixX M(6 + m, 6 + m);
    M << body.mass() * Matrix3::Identity(), -skew(state.c), P, skew(state.c), state.J, state.S, P.transpose(),
        state.S.transpose(), MatrixX::Identity(m, m);
    VectorX r(6 + m);
    r << force - state.f_bias, moment - state.t_bias, modal_load - state.h_bias;
    const VectorX rates = M.llt().solve(r);
    a = rates.head<3>();
    alpha = rates.segment<3>(3);
    zddot = rates.tail(m);
  }
};

TEST(ModalBody, EvaluatesTheSumsOverItsNodes) {
  expect_node_sums(ModalBody(damped(chassis(), 0.05), kInterface));
  expect_node_sums(ModalBody(damped(chassis().lowest(10), 0.02), kInterface));
  expect_node_sums(ModalBody(chassis().lowest(3), {}));
  for (const NamedShapes& form : complete_forms(0.05)) {
    SCOPED_TRACE(form.form);
    expect_node_sums(ModalBody(form.set, kInterface));
  }
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
  const NodeMotion node(body.set(), motion);
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
    const NodeMotion node(body.set(), motion);
    double T = 0;
    Vector3 h = Vector3::Zero();
    for (int i = 0; i < 20; ++i) {
      const Vector3 v = motion.v_WBo + motion.w_B.cross(node.b.col(i)) + node.delta_dot.col(i);
      T += 0.5 * chassis().node_mass[i] * v.squaredNorm();
      h += chassis().node_mass[i] * node.b.col(i).cross(v);
    }
    EXPECT_NEAR(body.kinetic_energy(motion.v_WBo, state) / T, 1, 1e-13);
    EXPECT_LE((body.angular_momentum(motion.v_WBo, state) - h).norm(), 1e-13 * h.norm());

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

/// What the deflections of a form satisfy: six rows G with G delta = 0.
MatrixX reference_condition(const ShapeSet& set) {
  const VectorX mass = set.node_mass.transpose().replicate(3, 1).reshaped();
  if (set.mean_axes)
    return rigid_body_modes(set.node_mass, set.node_position).transpose() * mass.asDiagonal();
  MatrixX G = MatrixX::Zero(6, mass.size());
  int row = 0;
  for (Eigen::Index freedom = 0; freedom < mass.size(); ++freedom)
    if (set.shapes.row(freedom).isZero(0)) G(row++, freedom) = 1;
  EXPECT_EQ(row, 6);
  return G;
}

/// Elastic energy as a function of the inertial node positions alone: delta_i = R^T (x_i - p) - s_i, where the axes p, R are
/// found from the reference condition by Newton iteration.
class ElasticPotential {
 public:
  ElasticPotential(const ShapeSet& set, const MatrixX& K)
      : s_(set.node_position.cast<Real>()), G_(reference_condition(set).cast<Real>()), K_(K.cast<Real>()) {}

  Real operator()(const RealMatrix3X& x, RealVector3 p, RealMatrix3 R) const {
    for (int iteration = 0; iteration < 8; ++iteration) {
      // delta changes by -dp - phi x b
      const RealMatrix3X b = R.transpose() * (x.colwise() - p);
      RealMatrixX change(3 * b.cols(), 6);
      for (Eigen::Index i = 0; i < b.cols(); ++i) {
        change.block<3, 3>(3 * i, 0) = -RealMatrix3::Identity();
        change.block<3, 3>(3 * i, 3) << 0, -b(2, i), b(1, i), b(2, i), 0, -b(0, i), -b(1, i), b(0, i), 0;
      }
      const RealVectorX step = -(G_ * change).fullPivLu().solve(G_ * RealVectorX((b - s_).reshaped()));
      const RealVector3 phi = step.tail<3>();
      p += R * step.head<3>();
      const Real angle = phi.norm();
      if (angle > 0) R = R * Eigen::AngleAxis<Real>(angle, phi / angle).toRotationMatrix();
    }
    const RealVectorX delta = (RealMatrix3X(R.transpose() * (x.colwise() - p)) - s_).reshaped();
    return delta.dot(K_ * delta) / 2;
  }

  /// -dV/dx by sixth-order central differences.
  RealMatrix3X force(const RealMatrix3X& x, const RealVector3& p, const RealMatrix3& R) const {
    const Real h = 1e-3L;
    RealMatrix3X f(3, x.cols());
    for (Eigen::Index c = 0; c < x.size(); ++c) {
      const auto difference = [&](int steps) {
        RealMatrix3X forward = x, backward = x;
        forward(c % 3, c / 3) += steps * h;
        backward(c % 3, c / 3) -= steps * h;
        return (*this)(forward, p, R) - (*this)(backward, p, R);
      };
      f(c % 3, c / 3) = -(45 * difference(1) - 9 * difference(2) + difference(3)) / (60 * h);
    }
    return f;
  }

 private:
  RealMatrix3X s_;
  RealMatrixX G_, K_;
};

void expect_newtons_law_of_every_node(const ShapeSet& set) {
  const ModalBody body(set, kInterface);
  const Motion motion(body);
  const ModalBodyState state = state_of(body, motion);
  const NodeMotion node(set, motion);
  const Matrix3 R = Eigen::AngleAxisd(0.9, Vector3(2, -1, 0.5).normalized()).toRotationMatrix();
  const Vector3 p_WBo(4, -2, 1);

  // m_i x_i'' = f_i - dV/dx_i in inertial axes, with forces on the interface nodes
  const Matrix3X f_B = 1e3 * some_numbers(60, 3).reshaped(3, 20);
  const RealMatrix3X x = ((R * node.b).colwise() + p_WBo).cast<Real>();
  const ElasticPotential potential(set, MatrixX(stiffness_matrix(chassis_mesh(), kMaterial)));
  Matrix3X force =
      (R.transpose().cast<Real>() * potential.force(x, p_WBo.cast<Real>(), R.cast<Real>())).cast<double>();
  Vector3 resultant = Vector3::Zero(), moment = Vector3::Zero();
  VectorX modal_load = VectorX::Zero(54);
  for (int k = 0; k < body.interface_count(); ++k) {
    const Vector3 f = f_B.col(k), b = state.interface_b.col(k);
    force.col(kInterface[k] - 1) += f;
    resultant += f;
    moment += b.cross(f);
    modal_load += body.interface_shape(k).transpose() * f;
  }
  const Matrix3X newton = force * set.node_mass.cwiseInverse().asDiagonal();

  // the same accelerations from v_Bo', w', z''
  const Accelerations modal(body, state, resultant, moment, modal_load);
  const Vector3& w = motion.w_B;
  Matrix3X kinematic = (set.shapes * modal.zddot).reshaped(3, 20);
  for (int i = 0; i < 20; ++i) {
    const Vector3 b = node.b.col(i), delta_dot = node.delta_dot.col(i);
    kinematic.col(i) += modal.a + modal.alpha.cross(b) + w.cross(w.cross(b)) + 2 * w.cross(delta_dot);
  }
  EXPECT_LE((kinematic - newton).norm(), 1e-11 * newton.norm());
}

TEST(ModalBody, WithAllShapesObeysNewtonsLawOfEveryNode) {
  for (const NamedShapes& form : complete_forms()) {
    SCOPED_TRACE(form.form);
    expect_newtons_law_of_every_node(form.set);
  }
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
    const ShapeSet& set = body_.set();
    const Matrix3 R = rotation_from_quaternion(y_.data() + 6);
    const Matrix3X b =
        set.node_position + Matrix3X((set.shapes * y_.segment(13, m_)).reshaped(3, set.node_count()));
    const Matrix3X delta_dot = (set.shapes * y_.segment(13 + m_, m_)).reshaped(3, set.node_count());
    const VectorX z = y_.segment(13, m_);
    Balance sum{0.5 * z.dot(full(set.stiffness) * z), Vector3::Zero(), Vector3::Zero()};
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

TEST(ModalBody, InNodalFormConservesEnergyAndMomentaInFreeFlight) {
  for (const NamedShapes& form : complete_forms()) {
    SCOPED_TRACE(form.form);
    const ModalBody body(form.set, {});
    FreeFlight flight(body);
    const FreeFlight::Balance start = flight.balance();
    flight.fly(0.1, 500);
    const FreeFlight::Balance end = flight.balance();
    EXPECT_NEAR(end.energy / start.energy, 1, 1e-8);
    expect_same_momenta(start, end);
  }
}

TEST(ModalBody, WithTheTermsOfTheSourceLosesAngularMomentum) {
  const ModalBody body(chassis().lowest(10), {}, {}, InertiaTerms::source);
  FreeFlight flight(body);
  const FreeFlight::Balance start = flight.balance();
  flight.fly(0.1, 300);
  const FreeFlight::Balance end = flight.balance();
  EXPECT_LE((end.linear_momentum - start.linear_momentum).norm(), 1e-8 * start.linear_momentum.norm());
  EXPECT_GE((end.angular_momentum - start.angular_momentum).norm(), 1e-6 * start.angular_momentum.norm());
}

void expect_loss_without_momentum(const ModalBody& body, double duration, int steps) {
  FreeFlight flight(body);
  const FreeFlight::Balance start = flight.balance();
  flight.fly(duration, steps);
  const FreeFlight::Balance end = flight.balance();
  EXPECT_LE(end.energy, 0.999 * start.energy);
  EXPECT_NEAR((start.energy - end.energy) / flight.energy_lost(), 1, 1e-8);
  expect_same_momenta(start, end);
}

TEST(ModalBody, DampingTakesEnergyButNoMomentum) {
  expect_loss_without_momentum(ModalBody(damped(chassis().lowest(27), 0.05), kInterface), 0.5, 500);
  for (const NamedShapes& form : complete_forms(0.05)) {
    SCOPED_TRACE(form.form);
    expect_loss_without_momentum(ModalBody(form.set, kInterface), 0.1, 500);
  }
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
