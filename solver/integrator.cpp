#include "solver/integrator.h"

#include "core/error.h"
#include "solver/cvode_integrator.h"
#include "solver/erk_integrator.h"
#include "solver/ida_integrator.h"

namespace wishbone {

const char* to_string(Form form) {
  switch (form) {
    case Form::automatic:
      return "auto";
    case Form::ode:
      return "ode";
    case Form::index1:
      return "index1";
    case Form::partition:
      return "partition";
    case Form::ggl:
      return "ggl";
  }
  return "";
}

const char* to_string(Method method) {
  switch (method) {
    case Method::automatic:
      return "auto";
    case Method::adams:
      return "adams";
    case Method::bdf:
      return "bdf";
    case Method::erk:
      return "erk";
  }
  return "";
}

IntegratorOptions resolve(const IntegratorOptions& options, const System& system) {
  IntegratorOptions r = options;
  const bool closed = system.n_rows > 0;
  if (r.form == Form::automatic) r.form = closed ? Form::index1 : Form::ode;
  if (r.form == Form::ode && closed)
    throw InputError({"analysis.form",
                      "form ode integrates a mechanism without closures, but this one has cut joints",
                      std::to_string(system.n_rows) + " closure rows", "use form index1, partition or ggl"});
  if (r.method == Method::automatic) r.method = r.form == Form::ggl ? Method::bdf : Method::erk;
  if (r.form == Form::ggl && r.method != Method::bdf)
    throw InputError({"analysis.integrator", "form ggl is integrated by IDA, a bdf method",
                      to_string(r.method), "use integrator bdf or auto with it"});
  return r;
}

std::unique_ptr<Integrator> make_integrator(const System& system, const IntegratorOptions& options,
                                            Workspace& ws, ProgressGuard& guard) {
  if (options.form == Form::ggl) return make_ida_integrator(system, options, ws, guard);
  if (options.method == Method::erk) return make_erk_integrator(system, options, ws, guard);
  return make_cvode_integrator(system, options, ws, guard);
}

}  // namespace wishbone
