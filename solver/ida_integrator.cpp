#include "solver/ida_integrator.h"

#include <ida/ida.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>

#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/closure_rank.h"
#include "solver/events.h"
#include "solver/first_order.h"
#include "solver/forward_dynamics.h"
#include "solver/ggl_jacobian.h"
#include "solver/ggl_residual.h"
#include "solver/integrator_failure.h"
#include "solver/loads.h"
#include "solver/sundials.h"

namespace wishbone {
namespace {

/// Of integrals of multipliers in Newton's iteration: they steer nothing, and their size (impulses) is that of forces, not of
/// motions.
constexpr double kMultiplierTolerance = 1e3;

class IdaIntegrator final : public Integrator {
 public:
  IdaIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws, ProgressGuard& guard);

  void restart(const State& state, const Work& work) override;
  Step step(double t_stop) override;
  void interpolate(double t, State& state, Work& work) override;
  double implicit_step() const override;
  /// Another choice of rows has other multipliers.
  bool outlived() override;
  Statistics statistics() const override;

 private:
  static int residual(realtype t, N_Vector y, N_Vector y_rate, N_Vector r, void* self);
  static int jacobian(realtype t, realtype c, N_Vector y, N_Vector y_rate, N_Vector r, SUNMatrix J,
                      void* self, N_Vector, N_Vector, N_Vector);
  static int events(realtype t, N_Vector y, N_Vector y_rate, realtype* g, void* self);

  void calc_residual(double t, N_Vector y, N_Vector y_rate, N_Vector r);
  void calc_jacobian(double t, double c, N_Vector y, N_Vector y_rate, SUNMatrix J);
  void choose_rows();
  void make_linear_solver();
  void leave_multipliers_untested();
  void create();
  VectorX blame() const;

  struct Counts {
    long steps = 0, residuals = 0, jacobians = 0, error_failures = 0, iteration_failures = 0;
  };
  Counts counts() const;

  struct IdaDeleter {
    void operator()(void* p) const { IDAFree(&p); }
  };

  IntegratorOptions options_;
  FirstOrderSystem equations_;
  int event_count_;
  sundials::Context context_;
  std::vector<int> kept_;  // rows of the multipliers among the unknowns
  std::unique_ptr<GglResidual<double>> residual_;
  std::unique_ptr<GglJacobian> jacobian_;
  sundials::Vector y_, y_rate_, tolerances_, scratch_;
  sundials::Matrix matrix_;
  sundials::LinearSolver linear_;
  std::unique_ptr<void, IdaDeleter> ida_;
  double t_ = 0;
  Counts before_;  // of the runs before the last restart
};

IdaIntegrator::IdaIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws,
                             ProgressGuard& guard)
    : options_(options), equations_(system, ws, guard), event_count_(wishbone::event_count(system)) {}

/// Sizes everything for the rows that are kept; their number and choice can change between restarts.
void IdaIntegrator::choose_rows() {
  const System& system = equations_.system();
  before_ = counts();
  ida_.reset();
  kept_ = equations_.workspace().closure.kept;
  residual_ = std::make_unique<GglResidual<double>>(system, kept_);
  jacobian_ = std::make_unique<GglJacobian>(system, kept_);
  for (sundials::Vector* v : {&y_, &y_rate_, &tolerances_, &scratch_})
    *v = sundials::make_vector(residual_->size(), context_);
  auto tolerances = sundials::map(tolerances_);
  equations_.set_tolerances(options_.atol, tolerances.head(equations_.size()));
  tolerances.tail(2 * static_cast<Eigen::Index>(kept_.size()))
      .setConstant(kMultiplierTolerance * options_.atol);
}

void IdaIntegrator::calc_residual(double t, N_Vector y, N_Vector y_rate, N_Vector r) {
  Workspace& ws = equations_.workspace();
  ++ws.work.position;
  ++ws.work.velocity;
  ++ws.work.inverse_dynamics;
  count_forces(equations_.system(), ws.work);
  residual_->evaluation().memory = ws.memory;
  equations_.note_time(t);
  residual_->calc(t, N_VGetArrayPointer(y), N_VGetArrayPointer(y_rate), N_VGetArrayPointer(r));
  const System& system = equations_.system();
  require_finite(system, t, sundials::map(y).segment(system.nq + system.nv, system.nx),
                 sundials::map(r).segment(system.nq, system.nv), residual_->evaluation());
}

int IdaIntegrator::residual(realtype t, N_Vector y, N_Vector y_rate, N_Vector r, void* self) {
  auto* integrator = static_cast<IdaIntegrator*>(self);
  return integrator->equations_.guard([&] { integrator->calc_residual(t, y, y_rate, r); });
}

void IdaIntegrator::calc_jacobian(double t, double c, N_Vector y, N_Vector y_rate, SUNMatrix J) {
  ++equations_.workspace().work.tangents;
  double* values = jacobian_->sparse() ? SUNSparseMatrix_Data(J) : SUNDenseMatrix_Data(J);
  jacobian_->calc(t, c, N_VGetArrayPointer(y), N_VGetArrayPointer(y_rate), equations_.workspace().memory,
                  values);
  if (!jacobian_->sparse()) return;
  std::copy(jacobian_->column_starts().begin(), jacobian_->column_starts().end(),
            SUNSparseMatrix_IndexPointers(J));
  std::copy(jacobian_->row_indices().begin(), jacobian_->row_indices().end(), SUNSparseMatrix_IndexValues(J));
}

int IdaIntegrator::jacobian(realtype t, realtype c, N_Vector y, N_Vector y_rate, N_Vector, SUNMatrix J,
                            void* self, N_Vector, N_Vector, N_Vector) {
  auto* integrator = static_cast<IdaIntegrator*>(self);
  return integrator->equations_.guard([&] { integrator->calc_jacobian(t, c, y, y_rate, J); },
                                      integrator->equations_.jacobian_cost());
}

int IdaIntegrator::events(realtype t, N_Vector y, N_Vector /*y_rate*/, realtype* g, void* self) {
  FirstOrderSystem& equations = static_cast<IdaIntegrator*>(self)->equations_;
  return equations.guard([&] { equations.calc_events(t, sundials::map(y).head(equations.size()), g); });
}

void IdaIntegrator::make_linear_solver() {
  const sunindextype n = residual_->size();
  if (jacobian_->sparse()) {
    matrix_.reset(SUNSparseMatrix(n, n, jacobian_->entries(), CSC_MAT, context_));
    linear_.reset(SUNLinSol_KLU(y_.get(), matrix_.get(), context_));
  } else {
    matrix_.reset(SUNDenseMatrix(n, n, context_));
    linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
  }
}

/// Multipliers and their integrals follow from the motion. In an equation of index 2 their estimated errors do not fall with the
/// step as those of q and v do, so these alone decide on it.
void IdaIntegrator::leave_multipliers_untested() {
  auto tested = sundials::map(scratch_);
  tested.setZero();
  tested.head(equations_.size()).setOnes();
  IDASetId(ida_.get(), scratch_.get());
  IDASetSuppressAlg(ida_.get(), SUNTRUE);
}

void IdaIntegrator::create() {
  ida_.reset(IDACreate(context_));
  void* ida = ida_.get();
  IDASetErrHandlerFn(
      ida, [](int, const char*, const char*, char*, void*) {}, nullptr);
  IDAInit(ida, residual, t_, y_.get(), y_rate_.get());
  IDASVtolerances(ida, equations_.tolerance_scale() * options_.rtol, tolerances_.get());
  IDASetUserData(ida, this);
  leave_multipliers_untested();
  IDASetMaxNumSteps(ida, -1);  // counted by the caller
  if (options_.max_step > 0) IDASetMaxStep(ida, options_.max_step);
  make_linear_solver();
  IDASetLinearSolver(ida, linear_.get(), matrix_.get());
  IDASetJacFn(ida, jacobian);
  if (event_count_ > 0) {
    std::vector<int> falling(event_count_, -1);
    IDARootInit(ida, event_count_, events);
    IDASetRootDirection(ida, falling.data());
  }
}

void IdaIntegrator::restart(const State& state, const Work& work) {
  // consistent y and y': the rates and multipliers of the index-1 form, the integrals start at zero
  if (!residual_ || kept_ != equations_.workspace().closure.kept) choose_rows();
  const Eigen::Index n = equations_.size();
  auto y = sundials::map(y_);
  auto y_rate = sundials::map(y_rate_);
  y.setZero();
  y_rate.setZero();
  equations_.pack(state, work, y.head(n));
  equations_.calc_rate(state.t, y.head(n), y_rate.head(n));
  const VectorX& lambda = equations_.workspace().lambda;
  for (std::size_t i = 0; i < kept_.size(); ++i) y_rate[n + static_cast<Eigen::Index>(i)] = lambda[kept_[i]];
  t_ = state.t;
  if (!ida_) return create();
  before_ = counts();
  IDAReInit(ida_.get(), t_, y_.get(), y_rate_.get());
}

Integrator::Step IdaIntegrator::step(double t_stop) {
  void* ida = ida_.get();
  IDASetStopTime(ida, t_stop);
  const int flag = IDASolve(ida, t_stop, &t_, y_.get(), y_rate_.get(), IDA_ONE_STEP);
  if (flag < 0)
    throw_integrator_failure(equations_, "IDA", sundials::flag_name(IDAGetReturnFlagName(flag)), t_, blame());
  equations_.take_failure();  // a trial state that was retried with a smaller step
  equations_.workspace().markers = residual_->evaluation().markers;
  if (flag != IDA_ROOT_RETURN) return {t_, {}};
  return {t_, sundials::events_found(ida, IDAGetRootInfo, event_count_)};
}

void IdaIntegrator::interpolate(double t, State& state, Work& work) {
  IDAGetDky(ida_.get(), t, 0, scratch_.get());
  equations_.unpack(t, sundials::map(scratch_).head(equations_.size()), state, work);
}

double IdaIntegrator::implicit_step() const {
  double c = 0;  // of dF/dy + c dF/dy'
  IDAGetCurrentCj(ida_.get(), &c);
  return c > 0 ? 1 / c : 0;
}

bool IdaIntegrator::outlived() {
  const System& system = equations_.system();
  Workspace& ws = equations_.workspace();
  if (static_cast<int>(kept_.size()) == system.n_rows) return false;
  State state;
  Work work;
  equations_.unpack(t_, sundials::map(y_).head(equations_.size()), state, work);
  update_state(system, state, ws);
  factor_inertia(system, ws);
  factor_closures(system, kDynamicsRankTolerance, ws);
  return revise_rows(system, state, ws) != RowRevision::unchanged;
}

VectorX IdaIntegrator::blame() const {
  return sundials::error_shares(ida_.get(), IDAGetErrWeights, IDAGetEstLocalErrors, IDAGetNumSteps, y_.get(),
                                scratch_.get());
}

IdaIntegrator::Counts IdaIntegrator::counts() const {
  Counts n = before_;
  if (!ida_) return n;
  sundials::add_count(ida_.get(), IDAGetNumSteps, n.steps);
  sundials::add_count(ida_.get(), IDAGetNumResEvals, n.residuals);
  sundials::add_count(ida_.get(), IDAGetNumLinResEvals, n.residuals);
  sundials::add_count(ida_.get(), IDAGetNumJacEvals, n.jacobians);
  sundials::add_count(ida_.get(), IDAGetNumErrTestFails, n.error_failures);
  sundials::add_count(ida_.get(), IDAGetNumNonlinSolvConvFails, n.iteration_failures);
  return n;
}

Statistics IdaIntegrator::statistics() const {
  const Counts n = counts();
  return {{"steps", double(n.steps)},
          {"residual_evaluations", double(n.residuals)},
          {"jacobian_evaluations", double(n.jacobians)},
          {"error_test_failures", double(n.error_failures)},
          {"iteration_failures", double(n.iteration_failures)}};
}

}  // namespace

std::unique_ptr<Integrator> make_ida_integrator(const System& system, const IntegratorOptions& options,
                                                Workspace& ws, ProgressGuard& guard) {
  return std::make_unique<IdaIntegrator>(system, options, ws, guard);
}

}  // namespace wishbone
