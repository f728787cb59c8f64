#include "app/mode_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace wishbone {

std::string significant_text(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  // of what is written: 0.0996 is 0.10 in two digits
  const double rounded = std::stod(fmt::format("{:.{}e}", std::abs(value), digits - 1));
  const int before_point = rounded == 0 ? 1 : static_cast<int>(std::floor(std::log10(rounded))) + 1;
  return fmt::format("{:.{}f}", value, std::clamp(digits - before_point, 0, 9));
}

std::string percent_text(double share) {
  if (!std::isfinite(share)) return "–";
  const double percent = 100 * share;
  const bool tiny = percent != 0 && std::abs(percent) < 0.01;
  return tiny ? fmt::format("{:.1e}", percent) : fmt::format("{:.2f}", percent);
}

VectorX frequencies_hz(const VectorX& omega) {
  return omega / (2 * 3.14159265358979323846);
}

std::string mode_title(const ModalData& data, int mode) {
  std::string title =
      fmt::format("Mode {} · {} Hz", mode + 1, significant_text(frequencies_hz(data.omega)[mode], 4));
  if (const double zeta = data.damping_ratio[mode]; zeta > 0)
    title += fmt::format(" · ζ {} %", significant_text(100 * zeta, 2));
  return title;
}

std::vector<std::string> mode_labels(const VectorX& hz) {
  std::vector<std::string> labels;
  for (const double f : hz)
    labels.push_back(fmt::format("{} · {}", labels.size() + 1, significant_text(f, 4)));
  return labels;
}

}  // namespace wishbone
