#include "solver/erk_integrator.h"

#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/assembly.h"
#include "solver/equations.h"
#include "solver/events.h"
#include "solver/first_order.h"
#include "solver/integrator_failure.h"
#include "solver/sundials.h"

namespace wishbone {
namespace {

/// Trials of a step that left the domain of an element or of a closure, each a quarter of the one before. ARKODE itself
/// gives up at the first.
constexpr int kMaxRetries = 20;

/// Close to a singular position the rounding of the closures spoils the rates by the inverse square of the distance, and steps
/// that grow smaller there only lead closer. Stages leave a gap, from 0.3 to 0.8 of the step [Dormand & Prince 1980]: a step
/// as long as those before is laid so that the position falls into it.
constexpr double kMiddleOfGap = 0.55, kEndOfGap = 0.7;
constexpr double kInSight = 1 + kMiddleOfGap;  // steps to the position, from where on they are laid

/// Length of the next step, d before the position and where steps are `length` long: one with the position in its gap, or one
/// that leads to where the next will have it there.
double aim(double d, double length) {
  return d <= kEndOfGap * length ? d / kMiddleOfGap : d - kMiddleOfGap * length;
}

bool shorter_step_helps(int flag) {
  return flag == ARK_UNREC_RHSFUNC_ERR || flag == ARK_POSTPROCESS_STEP_FAIL;
}

class ErkIntegrator final : public Integrator {
 public:
  ErkIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws, ProgressGuard& guard);

  void restart(const State& state, const Work& work) override;
  Step step(double t_stop) override;
  void pass_over(double t) override { t_singular_ = t; }
  void interpolate(double t, State& state, Work& work) override;
  bool outlived() override { return equations_->outlived(); }
  Statistics statistics() const override;

 private:
  static int rate(realtype t, N_Vector y, N_Vector y_rate, void* self);
  static int project(realtype t, N_Vector y, void* self);
  static int events(realtype t, N_Vector y, realtype* g, void* self);

  void create(const State& state, const Work& work);
  void restart_from(double t, double first_step);
  void aim_at_singular_position();
  VectorX blame() const;

  struct Counts {
    long steps = 0, rates = 0, error_failures = 0;
  };
  Counts counts() const;

  struct ArkodeDeleter {
    void operator()(void* p) const { ERKStepFree(&p); }
  };

  IntegratorOptions options_;
  std::unique_ptr<FirstOrderSystem> equations_;
  int event_count_;
  sundials::Context context_;
  sundials::Vector y_, tolerances_, scratch_;
  std::unique_ptr<void, ArkodeDeleter> arkode_;
  double t_ = 0;
  double t_singular_ = std::numeric_limits<double>::infinity();
  double length_ = 0;  // of the steps before a singular position comes in sight
  VectorX start_;      // y at the start of the step
  double last_step_ = std::numeric_limits<double>::infinity();
  Counts before_;  // of the runs before the last restart
};

ErkIntegrator::ErkIntegrator(const System& system, const IntegratorOptions& options, Workspace& ws,
                             ProgressGuard& guard)
    : options_(options),
      equations_(make_equations(system, options, ws, guard)),
      event_count_(wishbone::event_count(system)),
      y_(sundials::make_vector(equations_->size(), context_)),
      tolerances_(sundials::make_vector(equations_->size(), context_)),
      scratch_(sundials::make_vector(equations_->size(), context_)) {
  equations_->set_tolerances(options.atol, sundials::map(tolerances_));
}

int ErkIntegrator::rate(realtype t, N_Vector y, N_Vector y_rate, void* self) {
  FirstOrderSystem& equations = *static_cast<ErkIntegrator*>(self)->equations_;
  return equations.guard([&] { equations.calc_rate(t, sundials::map(y), sundials::map(y_rate)); });
}

int ErkIntegrator::project(realtype t, N_Vector y, void* self) {
  FirstOrderSystem& equations = *static_cast<ErkIntegrator*>(self)->equations_;
  return equations.guard([&] { return equations.project(t, kProjectionTolerance, sundials::map(y), 0); });
}

int ErkIntegrator::events(realtype t, N_Vector y, realtype* g, void* self) {
  FirstOrderSystem& equations = *static_cast<ErkIntegrator*>(self)->equations_;
  return equations.guard([&] { equations.calc_events(t, sundials::map(y), g); });
}

void ErkIntegrator::create(const State& state, const Work& work) {
  equations_->pack(state, work, sundials::map(y_));
  arkode_.reset(ERKStepCreate(rate, state.t, y_.get(), context_));
  void* arkode = arkode_.get();
  ERKStepSetErrHandlerFn(
      arkode, [](int, const char*, const char*, char*, void*) {}, nullptr);
  ERKStepSVtolerances(arkode, equations_->tolerance_scale() * options_.rtol, tolerances_.get());
  ERKStepSetUserData(arkode, this);
  ERKStepSetMaxNumSteps(arkode, -1);  // counted by the caller
  ERKStepSetTableNum(arkode, ARKODE_DORMAND_PRINCE_7_4_5);
  if (options_.max_step > 0) ERKStepSetMaxStep(arkode, options_.max_step);
  ERKStepSetPostprocessStepFn(arkode, project);
  if (event_count_ > 0) {
    std::vector<int> falling(event_count_, -1);
    ERKStepRootInit(arkode, event_count_, events);
    ERKStepSetRootDirection(arkode, falling.data());
  }
}

void ErkIntegrator::restart(const State& state, const Work& work) {
  t_ = state.t;
  if (!arkode_) return create(state, work);
  before_ = counts();
  equations_->pack(state, work, sundials::map(y_));
  ERKStepReInit(arkode_.get(), rate, state.t, y_.get());
  ERKStepSetInitStep(arkode_.get(), 0.0);  // its own estimate
}

void ErkIntegrator::restart_from(double t, double first_step) {
  before_ = counts();
  t_ = t;
  sundials::map(y_) = start_;
  ERKStepReInit(arkode_.get(), rate, t_, y_.get());
  ERKStepSetInitStep(arkode_.get(), first_step);
}

void ErkIntegrator::aim_at_singular_position() {
  if (t_singular_ - t_ > kInSight * length_) {
    ERKStepGetCurrentStep(arkode_.get(), &length_);
  } else {
    start_ = sundials::map(y_);
    restart_from(t_, aim(t_singular_ - t_, length_));
  }
}

Integrator::Step ErkIntegrator::step(double t_stop) {
  void* arkode = arkode_.get();
  aim_at_singular_position();
  ERKStepSetStopTime(arkode, t_stop);
  start_ = sundials::map(y_);
  const double t_start = t_;
  int flag = ERKStepEvolve(arkode, t_stop, y_.get(), &t_, ARK_ONE_STEP);
  for (int retry = 1; retry <= kMaxRetries && shorter_step_helps(flag); ++retry) {
    restart_from(t_start, std::ldexp(std::min(last_step_, t_stop - t_start), -2 * retry));
    flag = ERKStepEvolve(arkode, t_stop, y_.get(), &t_, ARK_ONE_STEP);
  }
  ERKStepGetLastStep(arkode, &last_step_);
  if (flag < 0)
    throw_integrator_failure(*equations_, "ARKODE", sundials::flag_name(ERKStepGetReturnFlagName(flag)), t_,
                             blame());
  equations_->take_failure();  // a trial state that was retried with a smaller step
  if (flag != ARK_ROOT_RETURN) return {t_, {}};
  return {t_, sundials::events_found(arkode, ERKStepGetRootInfo, event_count_)};
}

void ErkIntegrator::interpolate(double t, State& state, Work& work) {
  if (t == t_) return equations_->unpack(t, sundials::map(y_), state, work);
  ERKStepGetDky(arkode_.get(), t, 0, scratch_.get());
  equations_->unpack(t, sundials::map(scratch_), state, work);
}

VectorX ErkIntegrator::blame() const {
  return sundials::error_shares(arkode_.get(), ERKStepGetErrWeights, ERKStepGetEstLocalErrors,
                                ERKStepGetNumSteps, y_.get(), scratch_.get());
}

ErkIntegrator::Counts ErkIntegrator::counts() const {
  Counts n = before_;
  sundials::add_count(arkode_.get(), ERKStepGetNumSteps, n.steps);
  sundials::add_count(arkode_.get(), ERKStepGetNumRhsEvals, n.rates);
  sundials::add_count(arkode_.get(), ERKStepGetNumErrTestFails, n.error_failures);
  return n;
}

Statistics ErkIntegrator::statistics() const {
  const Counts n = counts();
  return {{"steps", double(n.steps)},
          {"rate_evaluations", double(n.rates)},
          {"error_test_failures", double(n.error_failures)}};
}

}  // namespace

std::unique_ptr<Integrator> make_erk_integrator(const System& system, const IntegratorOptions& options,
                                                Workspace& ws, ProgressGuard& guard) {
  return std::make_unique<ErkIntegrator>(system, options, ws, guard);
}

}  // namespace wishbone
