#include "solver/cvode_integrator.h"

#include <cvode/cvode.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "solver/assembly.h"
#include "solver/equations.h"
#include "solver/events.h"
#include "solver/first_order.h"
#include "solver/integrator_failure.h"
#include "solver/sundials.h"

namespace wishbone {
namespace {

/// What Newton's iteration may leave, as a share of the error that a step may have. CVODE's own tenth shows in the estimate
/// of that error where the motion is stiff, and halves the steps.
constexpr double kNewtonShare = 0.01;

class CvodeIntegrator final : public Integrator {
 public:
  CvodeIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws,
                  ProgressGuard& guard);

  void restart(const State& state, const Work& work) override;
  Step step(double t_stop) override;
  void interpolate(double t, State& state, Work& work) override;
  double implicit_step() const override;
  bool outlived() override { return equations_->outlived(); }
  Statistics statistics() const override;

 private:
  static int rate(realtype t, N_Vector y, N_Vector y_rate, void* self);
  static int projected_rate(realtype t, N_Vector y, N_Vector y_rate, void* self);
  static int jacobian(realtype t, N_Vector y, N_Vector y_rate, SUNMatrix J, void* self, N_Vector, N_Vector,
                      N_Vector);
  static int project(realtype t, N_Vector y, N_Vector correction, realtype eps, N_Vector err, void* self);
  static int events(realtype t, N_Vector y, realtype* g, void* self);

  void create(const State& state, const Work& work);
  VectorX blame() const;

  struct Counts {
    long steps = 0, rates = 0, jacobians = 0, error_failures = 0, iteration_failures = 0;
  };
  Counts counts() const;

  struct CvodeDeleter {
    void operator()(void* p) const { CVodeFree(&p); }
  };

  IntegratorOptions options_;
  std::unique_ptr<FirstOrderSystem> equations_;
  int event_count_;
  sundials::Context context_;
  sundials::Vector y_, tolerances_, scratch_;
  sundials::Matrix matrix_;
  sundials::LinearSolver linear_;
  sundials::NonlinearSolver nonlinear_;
  std::unique_ptr<void, CvodeDeleter> cvode_;
  double t_ = 0;
  Counts before_;  // of the runs before the last restart
};

CvodeIntegrator::CvodeIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws,
                                 ProgressGuard& guard)
    : options_(options),
      equations_(make_equations(system, options, ws, guard)),
      event_count_(wishbone::event_count(system)),
      y_(sundials::make_vector(equations_->size(), context_)),
      tolerances_(sundials::make_vector(equations_->size(), context_)),
      scratch_(sundials::make_vector(equations_->size(), context_)) {
  equations_->set_tolerances(options.atol, sundials::map(tolerances_));
}

int CvodeIntegrator::rate(realtype t, N_Vector y, N_Vector y_rate, void* self) {
  FirstOrderSystem& equations = *static_cast<CvodeIntegrator*>(self)->equations_;
  return equations.guard([&] { equations.calc_rate(t, sundials::map(y), sundials::map(y_rate)); });
}

/// For methods that cannot project the state itself: the rate at the projected state. What is integrated then drifts off the
/// closures by no more than its own errors.
int CvodeIntegrator::projected_rate(realtype t, N_Vector y, N_Vector y_rate, void* self) {
  auto* integrator = static_cast<CvodeIntegrator*>(self);
  FirstOrderSystem& equations = *integrator->equations_;
  return equations.guard([&] {
    auto y_closed = sundials::map(integrator->scratch_);
    y_closed = sundials::map(y);
    const bool closed = equations.project(t, kProjectionTolerance, y_closed, 0);
    if (closed) equations.calc_rate(t, y_closed, sundials::map(y_rate));
    return closed;
  });
}

int CvodeIntegrator::jacobian(realtype t, N_Vector y, N_Vector /*y_rate*/, SUNMatrix J, void* self, N_Vector,
                              N_Vector, N_Vector) {
  FirstOrderSystem& equations = *static_cast<CvodeIntegrator*>(self)->equations_;
  return equations.guard(
      [&] {
        const Eigen::Index n = equations.size();
        equations.calc_jacobian(t, sundials::map(y), Eigen::Map<MatrixX>(SUNDenseMatrix_Data(J), n, n));
      },
      equations.jacobian_cost());
}

int CvodeIntegrator::project(realtype t, N_Vector y, N_Vector correction, realtype /*eps*/, N_Vector /*err*/,
                             void* self) {
  auto* integrator = static_cast<CvodeIntegrator*>(self);
  FirstOrderSystem& equations = *integrator->equations_;
  return equations.guard([&] {
    auto c = sundials::map(correction);
    c = sundials::map(y);
    const bool closed = equations.project(t, kProjectionTolerance, c, integrator->implicit_step());
    c -= sundials::map(y);
    return closed;
  });
}

int CvodeIntegrator::events(realtype t, N_Vector y, realtype* g, void* self) {
  FirstOrderSystem& equations = *static_cast<CvodeIntegrator*>(self)->equations_;
  return equations.guard([&] { equations.calc_events(t, sundials::map(y), g); });
}

void CvodeIntegrator::create(const State& state, const Work& work) {
  const bool adams = options_.method == Method::adams;
  cvode_.reset(CVodeCreate(adams ? CV_ADAMS : CV_BDF, context_));
  void* cvode = cvode_.get();
  equations_->pack(state, work, sundials::map(y_));
  CVodeSetErrHandlerFn(
      cvode, [](int, const char*, const char*, char*, void*) {}, nullptr);  // flags tell the story
  const bool projects = options_.form == Form::index1;
  CVodeInit(cvode, adams && projects ? projected_rate : rate, state.t, y_.get());
  CVodeSVtolerances(cvode, equations_->tolerance_scale() * options_.rtol, tolerances_.get());
  CVodeSetUserData(cvode, this);
  CVodeSetMaxNumSteps(cvode, -1);  // counted by the caller
  if (options_.max_step > 0) CVodeSetMaxStep(cvode, options_.max_step);
  if (adams) {
    nonlinear_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_));
    CVodeSetNonlinearSolver(cvode, nonlinear_.get());
  } else {
    matrix_.reset(SUNDenseMatrix(equations_->size(), equations_->size(), context_));
    linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
    CVodeSetLinearSolver(cvode, linear_.get(), matrix_.get());
    CVodeSetJacFn(cvode, jacobian);
    CVodeSetNonlinConvCoef(cvode, kNewtonShare);
    CVodeSetStabLimDet(cvode, SUNTRUE);  // orders above 2 are left where vibrations make them unstable
    if (options_.max_order > 0) CVodeSetMaxOrd(cvode, options_.max_order);
    if (projects) {
      CVodeSetProjFn(cvode, project);
      CVodeSetProjErrEst(cvode, SUNFALSE);
    }
  }
  if (event_count_ > 0) {
    std::vector<int> falling(event_count_, -1);
    CVodeRootInit(cvode, event_count_, events);
    CVodeSetRootDirection(cvode, falling.data());
  }
}

void CvodeIntegrator::restart(const State& state, const Work& work) {
  t_ = state.t;
  if (!cvode_) return create(state, work);
  before_ = counts();
  equations_->pack(state, work, sundials::map(y_));
  CVodeReInit(cvode_.get(), state.t, y_.get());
}

Integrator::Step CvodeIntegrator::step(double t_stop) {
  void* cvode = cvode_.get();
  CVodeSetStopTime(cvode, t_stop);
  const int flag = CVode(cvode, t_stop, y_.get(), &t_, CV_ONE_STEP);
  if (flag < 0) {
    throw_integrator_failure(*equations_, "CVODE", sundials::flag_name(CVodeGetReturnFlagName(flag)), t_,
                             blame());
  }
  equations_->take_failure();  // a trial state that was retried with a smaller step
  if (flag != CV_ROOT_RETURN) return {t_, {}};
  return {t_, sundials::events_found(cvode, CVodeGetRootInfo, event_count_)};
}

void CvodeIntegrator::interpolate(double t, State& state, Work& work) {
  CVodeGetDky(cvode_.get(), t, 0, scratch_.get());
  equations_->unpack(t, sundials::map(scratch_), state, work);
}

double CvodeIntegrator::implicit_step() const {
  double gamma = 0;
  if (options_.method == Method::bdf) CVodeGetCurrentGamma(cvode_.get(), &gamma);
  return gamma;
}

VectorX CvodeIntegrator::blame() const {
  return sundials::error_shares(cvode_.get(), CVodeGetErrWeights, CVodeGetEstLocalErrors, CVodeGetNumSteps,
                                y_.get(), scratch_.get());
}

CvodeIntegrator::Counts CvodeIntegrator::counts() const {
  Counts n = before_;
  sundials::add_count(cvode_.get(), CVodeGetNumSteps, n.steps);
  sundials::add_count(cvode_.get(), CVodeGetNumRhsEvals, n.rates);
  sundials::add_count(cvode_.get(), CVodeGetNumErrTestFails, n.error_failures);
  sundials::add_count(cvode_.get(), CVodeGetNumNonlinSolvConvFails, n.iteration_failures);
  if (linear_) {
    sundials::add_count(cvode_.get(), CVodeGetNumLinRhsEvals, n.rates);
    sundials::add_count(cvode_.get(), CVodeGetNumJacEvals, n.jacobians);
  }
  return n;
}

Statistics CvodeIntegrator::statistics() const {
  const Counts n = counts();
  return {{"steps", double(n.steps)},
          {"rate_evaluations", double(n.rates)},
          {"jacobian_evaluations", double(n.jacobians)},
          {"error_test_failures", double(n.error_failures)},
          {"iteration_failures", double(n.iteration_failures)}};
}

}  // namespace

std::unique_ptr<Integrator> make_cvode_integrator(const System& system, const IntegratorOptions& options,
                                                  Workspace& ws, ProgressGuard& guard) {
  return std::make_unique<CvodeIntegrator>(system, options, ws, guard);
}

}  // namespace wishbone
