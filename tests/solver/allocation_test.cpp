// An evaluation allocates nothing, whatever the system is made of.
#include <gtest/gtest.h>

#include <cstdlib>

#include "solver/assembly.h"
#include "solver/car.h"
#include "solver/energy.h"
#include "solver/forward_dynamics.h"
#include "solver/inverse_dynamics.h"

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
  EXPECT_EQ(allocations([&] { project(m.system, kProjectionTolerance, s, ws); }), 0);
}

TEST(Allocation, CounterSeesOperatorNewAndEigen) {
  EXPECT_GT(allocations([] { VectorX::Random(100).eval(); }), 0);
  EXPECT_GT(allocations([] { ::operator delete(::operator new(3)); }),
            0);  // a plain new may be optimised away
}

TEST(Allocation, NoneInEvaluatingAFlexibleCarOnTires) {
  expect_no_allocation(car(54));
}

TEST(Allocation, NoneInEvaluatingLoopsOfEveryJoint) {
  expect_no_allocation(random_loops(1));
}

}  // namespace
}  // namespace wishbone
#else
TEST(Allocation, IsCountedWithoutSanitizersOnly) {
  GTEST_SKIP() << "the sanitizer replaces malloc";
}
#endif
