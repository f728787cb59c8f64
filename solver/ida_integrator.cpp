#include "solver/ida_integrator.h"

#include <ida/ida.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "solver/closure_dynamics.h"
#include "solver/events.h"
#include "solver/first_order.h"
#include "solver/forward_dynamics.h"
#include "solver/integrator_failure.h"
#include "solver/inverse_dynamics.h"
#include "solver/kinematics.h"
#include "solver/sundials.h"

namespace wishbone {
namespace {

/// Integrals of multipliers steer nothing, and their size (impulses) is that of forces, not of motions.
constexpr double kMultiplierTolerance = 1e3;

class IdaIntegrator final : public Integrator {
 public:
  IdaIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws);

  void restart(const State& state, const Work& work) override;
  Step step(double t_stop) override;
  void interpolate(double t, State& state, Work& work) override;
  Statistics statistics() const override;

 private:
  static int residual(realtype t, N_Vector y, N_Vector y_rate, N_Vector r, void* self);
  static int events(realtype t, N_Vector y, N_Vector y_rate, realtype* g, void* self);

  void calc_residual(double t, const Eigen::Ref<const VectorX>& y, const Eigen::Ref<const VectorX>& y_rate,
                     Eigen::Ref<VectorX> r);
  void expand_multipliers(const Eigen::Ref<const VectorX>& kept, VectorX& all) const;
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
  Eigen::Index n_multipliers_;
  int event_count_;
  sundials::Context context_;
  sundials::Vector y_, y_rate_, tolerances_, scratch_;
  sundials::Matrix matrix_;
  sundials::LinearSolver linear_;
  std::unique_ptr<void, IdaDeleter> ida_;
  double t_ = 0;
  Counts before_;  // of the runs before the last restart

  // scratch of the residual
  State state_;
  Work work_;
  VectorX v_rate_, lambda_, gamma_, q_rate_, speed_, force_;
};

IdaIntegrator::IdaIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws)
    : options_(options),
      equations_(system, ws),
      n_multipliers_(static_cast<Eigen::Index>(ws.kept.size())),
      event_count_(wishbone::event_count(system)),
      y_(sundials::make_vector(equations_.size() + 2 * n_multipliers_, context_)),
      y_rate_(sundials::make_vector(equations_.size() + 2 * n_multipliers_, context_)),
      tolerances_(sundials::make_vector(equations_.size() + 2 * n_multipliers_, context_)),
      scratch_(sundials::make_vector(equations_.size() + 2 * n_multipliers_, context_)),
      state_{0, VectorX::Zero(system.nq), VectorX::Zero(system.nv), VectorX::Zero(system.nx)},
      v_rate_(VectorX::Zero(system.nv)),
      lambda_(VectorX::Zero(system.n_rows)),
      gamma_(VectorX::Zero(system.n_rows)),
      q_rate_(VectorX::Zero(system.nq)),
      speed_(VectorX::Zero(system.nv)),
      force_(VectorX::Zero(system.nv)) {
  auto tolerances = sundials::map(tolerances_);
  equations_.set_tolerances(options.atol, tolerances.head(equations_.size()));
  tolerances.tail(2 * n_multipliers_).setConstant(kMultiplierTolerance * options.atol);
}

void IdaIntegrator::expand_multipliers(const Eigen::Ref<const VectorX>& kept, VectorX& all) const {
  const std::vector<int>& rows = equations_.workspace().kept;
  for (std::size_t i = 0; i < rows.size(); ++i) all[rows[i]] = kept[i];
}

void IdaIntegrator::calc_residual(double t, const Eigen::Ref<const VectorX>& y,
                                  const Eigen::Ref<const VectorX>& y_rate, Eigen::Ref<VectorX> r) {
  const System& system = equations_.system();
  Workspace& ws = equations_.workspace();
  const Eigen::Index n = equations_.size();
  const Eigen::Index nq = system.nq, nv = system.nv, nx = system.nx, m = n_multipliers_;
  equations_.unpack(t, y.head(n), state_, work_);
  v_rate_ = y_rate.segment(nq, nv);
  expand_multipliers(y_rate.segment(n, m), lambda_);
  expand_multipliers(y_rate.segment(n + m, m), gamma_);

  // M v' - f - D^T Lambda'
  calc_motion_residual(system, state_, v_rate_, lambda_, ws, r.segment(nq, nv));
  require_finite(system, t, r.segment(nq, nv), ws);
  r.segment(nq + nv, nx) = y_rate.segment(nq + nv, nx) - ws.x_rate;
  const Work rate = calc_work_rate(system, t, ws);
  r[n - 2] = y_rate[n - 2] - rate.loss;
  r[n - 1] = y_rate[n - 1] - rate.input;

  // q' - N (v - D^T Gamma')
  speed_ = state_.v;
  if (m > 0) {
    calc_closure_force(system, gamma_, ws, force_);
    speed_ -= force_;
  }
  calc_q_rate(system, state_.q, speed_, q_rate_);
  r.head(nq) = y_rate.head(nq) - q_rate_;

  for (Eigen::Index i = 0; i < m; ++i) {
    r[n + i] = ws.Phi[ws.kept[i]];
    r[n + m + i] = ws.Phi_rate[ws.kept[i]];
  }
}

int IdaIntegrator::residual(realtype t, N_Vector y, N_Vector y_rate, N_Vector r, void* self) {
  auto* integrator = static_cast<IdaIntegrator*>(self);
  return integrator->equations_.guard(
      [&] { integrator->calc_residual(t, sundials::map(y), sundials::map(y_rate), sundials::map(r)); });
}

int IdaIntegrator::events(realtype t, N_Vector y, N_Vector /*y_rate*/, realtype* g, void* self) {
  FirstOrderSystem& equations = static_cast<IdaIntegrator*>(self)->equations_;
  return equations.guard([&] { equations.calc_events(t, sundials::map(y).head(equations.size()), g); });
}

void IdaIntegrator::create() {
  ida_.reset(IDACreate(context_));
  void* ida = ida_.get();
  IDASetErrHandlerFn(
      ida, [](int, const char*, const char*, char*, void*) {}, nullptr);
  IDAInit(ida, residual, t_, y_.get(), y_rate_.get());
  IDASVtolerances(ida, equations_.tolerance_scale() * options_.rtol, tolerances_.get());
  IDASetUserData(ida, this);
  IDASetMaxNumSteps(ida, -1);  // counted by the caller
  if (options_.max_step > 0) IDASetMaxStep(ida, options_.max_step);
  const sunindextype n = N_VGetLength(y_.get());
  matrix_.reset(SUNDenseMatrix(n, n, context_));
  linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
  IDASetLinearSolver(ida, linear_.get(), matrix_.get());
  if (event_count_ > 0) {
    std::vector<int> falling(event_count_, -1);
    IDARootInit(ida, event_count_, events);
    IDASetRootDirection(ida, falling.data());
  }
}

void IdaIntegrator::restart(const State& state, const Work& work) {
  // consistent y and y': the rates and multipliers of the index-1 form, the integrals start at zero
  const Eigen::Index n = equations_.size();
  auto y = sundials::map(y_);
  auto y_rate = sundials::map(y_rate_);
  y.setZero();
  y_rate.setZero();
  equations_.pack(state, work, y.head(n));
  equations_.calc_rate(state.t, y.head(n), y_rate.head(n));
  const Workspace& ws = equations_.workspace();
  for (Eigen::Index i = 0; i < n_multipliers_; ++i) y_rate[n + i] = ws.lambda[ws.kept[i]];
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
  if (flag != IDA_ROOT_RETURN) return {t_, {}};
  return {t_, sundials::events_found(ida, IDAGetRootInfo, event_count_)};
}

void IdaIntegrator::interpolate(double t, State& state, Work& work) {
  IDAGetDky(ida_.get(), t, 0, scratch_.get());
  equations_.unpack(t, sundials::map(scratch_).head(equations_.size()), state, work);
}

VectorX IdaIntegrator::blame() const {
  return sundials::error_shares(ida_.get(), IDAGetErrWeights, IDAGetEstLocalErrors, IDAGetNumSteps, y_.get(),
                                scratch_.get());
}

IdaIntegrator::Counts IdaIntegrator::counts() const {
  Counts n = before_;
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
                                                Workspace& ws) {
  return std::make_unique<IdaIntegrator>(system, options, ws);
}

}  // namespace wishbone
