// Whatever tolerance is asked for, down to where rounding leaves nothing to gain: a run ends, complete or with a reason, and
// its work is bounded.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "models/compile.h"
#include "models/scene_loader.h"

namespace wishbone {
namespace {

struct Asked {
  Form form;
  Method method;
};

/// Evaluations that no run below may exceed.
constexpr long kMostEvaluations = 3'000'000;

class TightTolerances : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Benchmarks, TightTolerances,
                         ::testing::Values("andrews_squeezer", "bricard", "double_pendulum",
                                           "flyball_governor", "n_four_bar", "simple_pendulum",
                                           "torque_free_top"),
                         [](const auto& p) { return p.param; });

std::vector<Asked> choices_for(const System& system) {
  if (system.n_rows == 0)
    return {{Form::ode, Method::erk}, {Form::ode, Method::adams}, {Form::ode, Method::bdf}};
  return {{Form::automatic, Method::automatic}, {Form::index1, Method::bdf},    {Form::index1, Method::adams},
          {Form::partition, Method::erk},       {Form::partition, Method::bdf}, {Form::ggl, Method::bdf}};
}

/// Through singular positions, where rounding grows with the inverse square of the distance, the last digits take up to 1e7
/// evaluations, and minutes.
double finest(const std::string& scene) {
  return scene == "n_four_bar" ? 1e-11 : 1e-14;
}

TEST_P(TightTolerances, EndARunWithinItsWork) {
  const Scene scene =
      load_scene(std::filesystem::path(WISHBONE_SCENES) / "benchmarks" / (GetParam() + ".yaml"));
  const CompiledScene compiled = compile(scene);
  for (const Asked& asked : choices_for(compiled.system))
    for (const double rtol : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-12, 1e-13, 1e-14}) {
      if (rtol < finest(GetParam())) break;
      SCOPED_TRACE(fmt::format("form {}, integrator {}, rtol {:g}", to_string(asked.form),
                               to_string(asked.method), rtol));
      TransientOptions options = compiled.transient;
      options.duration = std::min(options.duration, 2.0);
      options.integrator.form = asked.form;
      options.integrator.method = asked.method;
      options.integrator.rtol = rtol;
      options.integrator.atol = 0.01 * rtol;
      Workspace ws(compiled.system);
      const TransientSummary summary =
          run_transient(compiled.system, compiled.initial, options, ws, [](auto&&...) {});
      EXPECT_LT(ws.work.position + ws.work.inverse_dynamics, kMostEvaluations);
      if (summary.status == TransientSummary::Status::complete) continue;
      EXPECT_THAT(summary.message, ::testing::StartsWith("t = "));
      EXPECT_THAT(summary.message, ::testing::HasSubstr("\n  ")) << "a remedy";
    }
}

}  // namespace
}  // namespace wishbone
