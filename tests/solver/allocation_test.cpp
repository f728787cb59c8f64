// An evaluation allocates nothing, whatever the system is made of.
#include <gtest/gtest.h>

#include <cstdlib>

#include "solver/assembly.h"
#include "solver/car.h"
#include "solver/energy.h"
#include "solver/every_part.h"
#include "solver/first_order.h"
#include "solver/forward_dynamics.h"
#include "solver/ggl_jacobian.h"
#include "solver/ggl_residual.h"
#include "solver/inverse_dynamics.h"
#include "solver/loads.h"
#include "solver/observer.h"
#include "solver/partition.h"

// Every allocation of this program, operator new and Eigen's own, passes here; sanitizers bring their own malloc.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
namespace {
long allocation_count = 0;
}
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  ++allocation_count;
  return __libc_malloc(size);
}

namespace wishbone {
namespace {

using testing::Built;
using testing::car;
using testing::NamedMechanism;
using testing::random_loops;

template <class Action>
long allocations(Action&& action) {
  action();  // first use may set things up
  const long before = allocation_count;
  action();
  return allocation_count - before;
}

void expect_no_allocation(Built m) {
  Workspace ws = testing::with_independent_rows(m);
  State& s = m.state;
  VectorX r(m.system.nv), lambda = VectorX::Ones(m.system.n_rows), v_rate = VectorX::Ones(m.system.nv);
  EXPECT_EQ(allocations([&] { calc_forward_dynamics(m.system, s, ws); }), 0);
  EXPECT_EQ(allocations([&] { calc_joint_forces(m.system, ws); }), 0);
  EXPECT_EQ(allocations([&] { calc_motion_residual<double>(m.system, v_rate, lambda, ws, r.data()); }), 0);
  EXPECT_EQ(allocations([&] { calc_closure_force<double>(m.system, lambda, ws, r.data()); }), 0);
  EXPECT_EQ(allocations([&] { calc_energy(m.system, s, ws); }), 0);
  EXPECT_EQ(allocations([&] { calc_work_rate<double>(m.system, s.t, lambda, ws); }), 0);
  for (const double implicit_step : {0.0, 1e-3}) {
    s.v.array() += 1e-6;
    EXPECT_EQ(allocations([&] { project(m.system, kProjectionTolerance, s, ws, implicit_step); }), 0);
  }
}

/// What IDA asks for.
void expect_no_allocation_of_ggl(const Built& m, bool sparse) {
  const Workspace ws = testing::with_independent_rows(m);
  GglResidual<double> residual(m.system, ws.closure.kept);
  GglJacobian jacobian(m.system, ws.closure.kept);
  EXPECT_EQ(jacobian.sparse(), sparse);
  const Eigen::Index n = residual.size();
  VectorX y = VectorX::Zero(n), y_rate = VectorX::Ones(n), r(n);
  VectorX values(sparse ? jacobian.entries() : n * n);
  y.head(m.system.nq + m.system.nv + m.system.nx) << m.state.q, m.state.v, m.state.x;
  EXPECT_EQ(allocations([&] { residual.calc(m.state.t, y.data(), y_rate.data(), r.data()); }), 0);
  EXPECT_EQ(
      allocations([&] { jacobian.calc(m.state.t, 1, y.data(), y_rate.data(), ws.memory, values.data()); }),
      0);
}

/// What CVODE and ARKODE ask for.
void expect_no_allocation_of(FirstOrderSystem& equations, const Built& m) {
  const Eigen::Index n = equations.size();
  VectorX y(n), y_rate(n);
  MatrixX J(n, n);
  equations.pack(m.state, {}, y);
  EXPECT_EQ(allocations([&] { equations.calc_rate(m.state.t, y, y_rate); }), 0);
  EXPECT_EQ(allocations([&] { equations.calc_jacobian(m.state.t, y, J); }), 0);
}

TEST(Allocation, CounterSeesOperatorNewAndEigen) {
  EXPECT_GT(allocations([] { VectorX::Random(100).eval(); }), 0);
  EXPECT_GT(allocations([] { ::operator delete(::operator new(3)); }),
            0);  // a plain new may be optimised away
}

TEST(Allocation, NoneInEvaluatingAFlexibleCarOnTires) {
  expect_no_allocation(car(54));
}

TEST(Allocation, NoneInEvaluatingLoopsOfFlexibleBodies) {
  expect_no_allocation(random_loops(2));
}

TEST(Allocation, NoneInEvaluatingEveryJointAndEveryForce) {
  for (NamedMechanism& around : testing::around_every_part()) {
    SCOPED_TRACE(around.part);
    expect_no_allocation(std::move(around.mechanism));
  }
}

TEST(Allocation, NoneInSolvingForHundredsOfClosureRows) {
  const Built m = testing::four_bars(100, RevoluteClosure{}, 6);
  ASSERT_EQ(testing::with_independent_rows(m).closure.kept.size(), 200u);
  expect_no_allocation(m);
}

TEST(Allocation, NoneInRecordingARowOfAFlexibleCar) {
  const Built m = car(54);
  Workspace ws = testing::with_independent_rows(m);
  ASSERT_EQ(static_cast<int>(ws.closure.kept.size()), m.system.n_rows);
  using enum FlexibleSignal;
  ObserverOptions options;
  options.flexible = {
      {m.system.flexible[0].body,
       {1, 7, 20},
       {deflection_rates, modal_rates, modal_accelerations, energies, modal_energies, interface_forces}}};
  options.recoveries = {{"stress", "Pa", m.system.flexible[0].body, {"1", "2"}, MatrixX::Ones(2, 54)}};
  Observer observer(m.system, options);
  EXPECT_EQ(allocations([&] { observer.sample(m.state, {}, ws); }), 0);
}

TEST(Allocation, NoneInCountingTurns) {
  const Built m = testing::every_part_at_once();
  Workspace ws = testing::with_independent_rows(m);
  ASSERT_TRUE(counts_turns(m.system));
  EXPECT_EQ(allocations([&] { remember_angles(m.system, m.state, ws); }), 0);
}

TEST(Allocation, NoneInTheResidualAndTheJacobianOfTheGglForm) {
  expect_no_allocation_of_ggl(testing::four_bar(RevoluteClosure{}, 6), false);
  expect_no_allocation_of_ggl(testing::every_part_at_once(), true);
}

TEST(Allocation, NoneInTheRatesAndTheJacobianOfFirstOrder) {
  for (const NamedMechanism& around : testing::around_every_part()) {
    SCOPED_TRACE(around.part);
    Workspace ws = testing::with_independent_rows(around.mechanism);
    ProgressGuard guard({}, {});
    FirstOrderSystem equations(around.mechanism.system, ws, guard);
    expect_no_allocation_of(equations, around.mechanism);
  }
}

TEST(Allocation, NoneInTheRatesAndTheJacobianOfIndependentCoordinates) {
  Built m = testing::four_bar(RevoluteClosure{}, 6);
  Workspace ws = testing::assembled(m);
  ProgressGuard guard({}, {});
  PartitionedSystem equations(m.system, ws, guard);
  expect_no_allocation_of(equations, m);
}

}  // namespace
}  // namespace wishbone
#else
TEST(Allocation, IsCountedWithoutSanitizersOnly) {
  GTEST_SKIP() << "the sanitizer replaces malloc";
}
#endif
