// The modal body against sums over its nodes that know nothing of how it evaluates them.

#include "bodies/modal_body.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.h"
#include "flexible_forms.h"
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

using namespace flexible_forms;

/// The inertia and the biases as the book writes them, node by node.
struct BookSums {
  Matrix3 J = Matrix3::Zero();
  Matrix3X S, P;
  Vector3 c = Vector3::Zero(), t_bias = Vector3::Zero(), f_bias = Vector3::Zero();
  VectorX h_bias;

  BookSums(const ShapeSet& set, const Motion& motion)
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
  const BookSums sums(body.set(), motion);
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

void expect_node_sums_of_both_methods(const ShapeSet& set, const std::vector<int>& interface_nodes) {
  for (const InertiaMethod method : {InertiaMethod::node_sums, InertiaMethod::invariants}) {
    SCOPED_TRACE(method == InertiaMethod::node_sums ? "node sums" : "invariants");
    const ModalBody body(set, interface_nodes, {}, InertiaTerms::consistent, method);
    ASSERT_EQ(body.inertia_method(), method);
    expect_node_sums(body);
  }
}

TEST(ModalBody, EvaluatesTheSumsOverItsNodes) {
  expect_node_sums_of_both_methods(shapes_of(damped(chassis(), 0.05)), kInterface);
  expect_node_sums_of_both_methods(shapes_of(damped(chassis().lowest(10), 0.02)), kInterface);
  expect_node_sums_of_both_methods(shapes_of(chassis().lowest(3)), {});
  for (const NamedShapes& form : complete_forms(0.05)) {
    SCOPED_TRACE(form.form);
    expect_node_sums_of_both_methods(form.set, kInterface);
  }
}

TEST(ModalBody, EvaluatesTheSumsOfALargeMeshFromFewPoints) {
  const ModeSet set = free_free_modes(make_block({2.4, 0.5, 0.4}, {6, 2, 2}), kMaterial).lowest(5);
  const std::vector<int> interface_nodes{1, 63, 30};
  const ModalBody body(set, interface_nodes, {}, InertiaTerms::consistent, InertiaMethod::node_sums);
  EXPECT_EQ(body.make_state().points.b.rows(), 3 + 3 * (5 + 1));  // of 63 nodes
  expect_node_sums_of_both_methods(shapes_of(damped(set, 0.01)), interface_nodes);
}

TEST(ModalBody, ChoosesTheInertiaThatTakesFewerOperations) {
  // 54 modes of 20 nodes: 15 m p = 16 200, 12 m^2 + 6 m k = 38 880
  const ModalBody many(chassis(), kInterface);
  EXPECT_EQ(many.inertia_method(), InertiaMethod::node_sums);
  EXPECT_EQ(many.operations(InertiaMethod::node_sums), 16200);
  EXPECT_EQ(many.operations(InertiaMethod::invariants), 38880);
  // 4 modes: 1200 against 480
  const ModalBody few(chassis().lowest(4), kInterface);
  EXPECT_EQ(few.inertia_method(), InertiaMethod::invariants);
  EXPECT_EQ(few.operations(few.inertia_method()), 480);
}

TEST(ModalBody, HasTheSameEnergyAndMomentumByBothMethods) {
  for (const InertiaTerms terms : {InertiaTerms::consistent, InertiaTerms::source})
    for (const NamedShapes& form : complete_forms()) {
      const ModalBody sums(form.set, kInterface, {}, terms, InertiaMethod::node_sums);
      const ModalBody invariants(form.set, kInterface, {}, terms, InertiaMethod::invariants);
      const Motion motion(sums);
      const ModalBodyState a = state_of(sums, motion), b = state_of(invariants, motion);
      EXPECT_NEAR(sums.kinetic_energy(motion.v_WBo, a) / invariants.kinetic_energy(motion.v_WBo, b), 1,
                  1e-13);
      const Vector3 h = sums.angular_momentum(motion.v_WBo, a);
      EXPECT_LE((h - invariants.angular_momentum(motion.v_WBo, b)).norm(), 1e-13 * h.norm());
      EXPECT_LE((a.S - b.S).norm(), 1e-13 * (1 + a.S.norm()));
      EXPECT_LE((a.interface_b - b.interface_b).norm(), 1e-14);
      EXPECT_LE((a.interface_delta_dot - b.interface_delta_dot).norm(), 1e-12);
    }
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

// Of the points, less what the body is shorter by: T - 1/2 w.(Gamma w) and h - Gamma w.
TEST(ModalBody, CountsTheShorteningOfAStiffenedBody) {
  ShapeSet set = shapes_of(chassis().lowest(7));
  const ModalBody plain(set, kInterface);
  set.stiffening = 0.01 * some_numbers(7 * 42, 9).reshaped(7, 42);
  for (int pair = 0; pair < 6; ++pair) {
    auto K = set.stiffening.middleCols<7>(7 * pair);
    K = (K + K.transpose()).eval();
  }
  for (const InertiaMethod method : {InertiaMethod::node_sums, InertiaMethod::invariants}) {
    const ModalBody body(set, kInterface, {}, InertiaTerms::consistent, method);
    const Motion motion(body);
    const ModalBodyState state = state_of(body, motion), of_plain = state_of(plain, motion);
    const Matrix3 Gamma = shortening(set.stiffening, motion.z);
    const double shortened = 0.5 * motion.w_B.dot(Gamma * motion.w_B);
    const double T = plain.kinetic_energy(motion.v_WBo, of_plain);
    ASSERT_GT(std::abs(shortened), 1e-6 * T);
    EXPECT_NEAR(body.kinetic_energy(motion.v_WBo, state), T - shortened, 1e-12 * T);
    const Vector3 h = plain.angular_momentum(motion.v_WBo, of_plain);
    EXPECT_LT((body.angular_momentum(motion.v_WBo, state) - (h - Gamma * motion.w_B)).norm(),
              1e-12 * h.norm());
    EXPECT_LT((state.J - (of_plain.J - Gamma)).norm(), 1e-12 * state.J.norm());
  }
}

TEST(ModalBody, RejectsInterfaceNodesThatItDoesNotHave) {
  EXPECT_THROW(ModalBody(chassis(), {1, 21}), InputError);
  EXPECT_THROW(ModalBody(chassis(), {1, 2, 1}), InputError);
}

TEST(ModalBody, DoesNotAllocateWhenEvaluated) {
#ifdef WISHBONE_COUNTS_ALLOCATIONS
  const ModeSet large = free_free_modes(make_block({2.4, 0.5, 0.4}, {6, 2, 2}), kMaterial);
  for (const InertiaMethod method : {InertiaMethod::node_sums, InertiaMethod::invariants})
    for (const ModeSet& modes : {chassis(), chassis().lowest(10), large.lowest(5)}) {
      ShapeSet set = shapes_of(modes);
      set.stiffening = MatrixX::Identity(set.shape_count(), set.shape_count()).replicate(1, 6);
      const ModalBody body(set, {1, 5, 20}, {}, InertiaTerms::consistent, method);
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
