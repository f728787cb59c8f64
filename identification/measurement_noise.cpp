#include "identification/measurement_noise.h"

#include <fmt/format.h>

#include "identification/methods/shape_scatter.h"

namespace wishbone {
namespace {

constexpr double kRounding = 1e-5;    // changes no digit that a frequency is given with
constexpr double kMostScatter = 0.1;  // beyond it no motion is told from rigid-body motion
constexpr double kContradiction = 3;  // more than the estimate itself scatters

/// What the given noise leaves out.
void compare(const MeasurementNoise& given, double estimate, std::vector<std::string>& warnings) {
  if (given.shape == 0 || estimate <= kRounding || estimate <= kContradiction * given.shape) return;
  warnings.push_back(
      fmt::format("the measured shapes scatter by about {:.2g} %, more than the {:.2g} % given: state the "
                  "larger noise, or look "
                  "for an error in the masses",
                  100 * estimate, 100 * given.shape));
}

}  // namespace

std::optional<MeasurementNoise> noise_of(const IdentificationTask& task, PreparedStructure& s, int fitted) {
  std::optional<MeasurementNoise> noise = task.noise;
  if (task.coverage != Coverage::kAsMeasured) return noise;
  const ShapeScatter scatter = shape_scatter(s.measured(), s.M, s.support, s.rigid, fitted);
  if (scatter.products == 0) return noise;
  s.shape_scatter = scatter.size;
  s.notes.push_back(fmt::format(
      "scatter of the measured shapes by their own account: {:.2g} % (from {} products that are none for "
      "exact modes)",
      100 * scatter.size, scatter.products));
  if (noise) compare(*noise, scatter.size, s.warnings);
  if (scatter.size <= kRounding || (noise && noise->shape > 0)) return noise;
  if (scatter.size >= kMostScatter) {
    s.warnings.push_back(fmt::format(
        "the measured modes contradict the given masses as if their shapes scattered by {:.0f} %, "
        "which is no scatter: check the masses, the numbering and the directions",
        100 * scatter.size));
    return noise;
  }
  if (!noise) noise = MeasurementNoise{};
  noise->shape = scatter.size;
  return noise;
}

}  // namespace wishbone
