#include "identification/judgement/monte_carlo.h"

#include <cmath>
#include <limits>
#include <random>

#include "core/error.h"
#include "identification/judgement/matching.h"

namespace wishbone {
namespace {

Modes disturbed(const Modes& modes, const MeasurementNoise& noise, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Modes sample = modes;
  for (Eigen::Index j = 0; j < modes.count(); ++j) {
    const double factor = 1 + noise.frequency * normal(random);
    sample.lambda[j] *= factor * factor;
    const double rms = modes.shapes.col(j).norm() / std::sqrt(static_cast<double>(modes.shapes.rows()));
    for (double& component : sample.shapes.col(j)) component += noise.shape * rms * normal(random);
  }
  return sample;
}

/// Sums over repetitions of the deviation of one frequency.
struct Scatter {
  int count = 0;
  double sum = 0, sum_of_squares = 0;

  void add(double deviation) {
    ++count;
    sum += deviation;
    sum_of_squares += deviation * deviation;
  }
  double deviation() const {
    return std::sqrt(std::max(0.0, (sum_of_squares - sum * sum / count) / (count - 1)));
  }
};

}  // namespace

VectorX frequency_deviation(const Modes& measured, const MeasurementNoise& noise,
                            const std::function<Modes(const Modes&)>& identify) {
  const Modes undisturbed = identify(measured);
  const VectorX f = undisturbed.frequency_hz(), omega = undisturbed.lambda.cwiseMax(0).cwiseSqrt();
  std::vector<Scatter> scatter(static_cast<std::size_t>(f.size()));
  std::mt19937_64 random(noise.seed);
  for (int sample = 0; sample < noise.samples; ++sample) {
    Modes found;
    try {
      found = identify(disturbed(measured, noise, random));
    } catch (const InputError&) {
      continue;  // disturbed beyond use: counted as lost
    }
    const VectorX f_found = found.frequency_hz();
    const std::vector<int> partner = match_modes(found.shapes, undisturbed.shapes, omega).partner;
    for (std::size_t i = 0; i < partner.size(); ++i)
      if (const int j = partner[i]; j >= 0)
        scatter[static_cast<std::size_t>(j)].add(f_found[static_cast<Eigen::Index>(i)] - f[j]);
  }
  VectorX deviation(f.size());
  for (std::size_t j = 0; j < scatter.size(); ++j)
    deviation[static_cast<Eigen::Index>(j)] = 2 * scatter[j].count > noise.samples
                                                  ? scatter[j].deviation()
                                                  : std::numeric_limits<double>::quiet_NaN();
  return deviation;
}

}  // namespace wishbone
