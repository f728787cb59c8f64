#include "app/mode_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace wishbone {

std::string frequency_text(double hz, int digits) {
  if (!std::isfinite(hz)) return "–";
  const int before_point = hz == 0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(hz)))) + 1;
  return fmt::format("{:.{}f}", hz, std::clamp(digits - before_point, 0, 9));
}

std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g}", 100 * share) : "–";
}

VectorX frequencies_hz(const VectorX& omega) {
  return omega / (2 * 3.14159265358979323846);
}

std::string mode_title(const ModalData& data, int mode) {
  std::string title =
      fmt::format("Mode {} · {} Hz", mode + 1, frequency_text(frequencies_hz(data.omega)[mode], 4));
  if (const double zeta = data.damping_ratio[mode]; zeta > 0)
    title += fmt::format(" · ζ {} %", percent_text(zeta));
  return title;
}

std::vector<std::string> mode_labels(const VectorX& hz) {
  std::vector<std::string> labels;
  for (const double f : hz) labels.push_back(fmt::format("{} · {}", labels.size() + 1, frequency_text(f, 4)));
  return labels;
}

}  // namespace wishbone
