#include "solver/integrator_failure.h"

#include <fmt/format.h>

namespace wishbone {

void throw_integrator_failure(FirstOrderSystem& equations, const std::string& integrator,
                              const std::string& flag, double t, const VectorX& blame) {
  if (const std::exception_ptr failure = equations.take_failure()) {
    try {
      std::rethrow_exception(failure);
    } catch (const StepsFailed&) {
      throw;  // says when
    } catch (const NumericsError& error) {
      Diagnostic d = error.diagnostic();
      d.where = fmt::format("t = {:.9g} s: {}", t, d.where);
      throw NumericsError(d);
    }
  }
  // the two energies only where nothing else is integrated: every freedom is driven
  const Eigen::Index candidates = equations.size() > 2 ? equations.size() - 2 : 2;
  Eigen::Index worst = 0;
  blame.head(candidates).cwiseAbs().maxCoeff(&worst);
  throw StepsFailed(
      {fmt::format("t = {:.9g} s: {}", t, equations.name(worst)),
       fmt::format("{} gave up ({}); this coordinate had the largest share in the error{}", integrator, flag,
                   equations.largest_force()),
       "",
       "loosen analysis.rtol and analysis.atol, or look for a discontinuity or an extreme stiffness there"});
}

}  // namespace wishbone
