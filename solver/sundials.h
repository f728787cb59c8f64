#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nonlinearsolver.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "core/spatial.h"

/// Owners of SUNDIALS handles. Private to the integrators.
namespace wishbone::sundials {

class Context {
 public:
  Context() {
    if (SUNContext_Create(nullptr, &context_) != 0) throw std::bad_alloc();
  }
  ~Context() { SUNContext_Free(&context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

struct VectorDeleter {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
struct MatrixDeleter {
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
};
struct LinearSolverDeleter {
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};
struct NonlinearSolverDeleter {
  void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};

using Vector = std::unique_ptr<_generic_N_Vector, VectorDeleter>;
using Matrix = std::unique_ptr<_generic_SUNMatrix, MatrixDeleter>;
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, LinearSolverDeleter>;
using NonlinearSolver = std::unique_ptr<_generic_SUNNonlinearSolver, NonlinearSolverDeleter>;

/// Text of a return flag, given the heap string that SUNDIALS makes of it.
inline std::string flag_name(char* name) {
  const std::unique_ptr<char, void (*)(void*)> owner(name, std::free);
  return name;
}

inline Vector make_vector(Eigen::Index n, SUNContext context) {
  Vector v(N_VNew_Serial(n, context));
  if (!v) throw std::bad_alloc();
  N_VConst(0.0, v.get());
  return v;
}

/// Adds a counter of an integrator to `total`; nothing when the integrator does not exist yet.
inline void add_count(void* integrator, int (*get)(void*, long*), long& total) {
  long count = 0;
  if (get(integrator, &count) == 0) total += count;
}

/// Indices of the event functions at whose root an integrator has stopped.
inline std::vector<int> events_found(void* integrator, int (*get)(void*, int*), int count) {
  std::vector<int> found(count);
  get(integrator, found.data());
  std::vector<int> events;
  for (int i = 0; i < count; ++i)
    if (found[i] != 0) events.push_back(i);
  return events;
}

inline Eigen::Map<VectorX> map(N_Vector v) {
  return {N_VGetArrayPointer(v), N_VGetLength(v)};
}
inline Eigen::Map<VectorX> map(const Vector& v) {
  return map(v.get());
}

/// Shares of the coordinates in the weighted error of the last step or, before the first step, in the weighted state.
inline VectorX error_shares(void* integrator, int (*get_weights)(void*, N_Vector),
                            int (*get_errors)(void*, N_Vector), int (*get_steps)(void*, long*), N_Vector y,
                            N_Vector scratch) {
  get_weights(integrator, scratch);
  const VectorX weights = map(scratch);
  long steps = 0;
  get_steps(integrator, &steps);
  if (steps == 0) return weights.cwiseProduct(map(y));
  get_errors(integrator, scratch);
  return weights.cwiseProduct(map(scratch));
}

}  // namespace wishbone::sundials
