#include "identification/formats/uff/uff_units.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "core/units.h"

namespace wishbone {
namespace {

constexpr double kFoot = 0.3048, kInch = 0.0254, kPound = 0.45359237;

struct System {
  std::string_view name;
  double metres;   ///< in its unit of length
  double newtons;  ///< in its unit of force
};

/// By code; the ninth is user-defined.
constexpr std::array<System, 11> kSystems = {{{},
                                              {"m, N", 1, 1},
                                              {"ft, lbf", kFoot, kPound* kStandardGravity},
                                              {"m, kgf", 1, kStandardGravity},
                                              {"ft, pdl", kFoot, kPound* kFoot},
                                              {"mm, mN", 1e-3, 1e-3},
                                              {"cm, cN", 1e-2, 1e-2},
                                              {"in, lbf", kInch, kPound* kStandardGravity},
                                              {"mm, kgf", 1e-3, kStandardGravity},
                                              {"user-defined", 0, 0},
                                              {"mm, N", 1e-3, 1}}};

constexpr int kUserDefined = 9;

bool differ(double a, double b) {
  return std::abs(a - b) > 1e-4 * b;
}

}  // namespace

UffScale uff_scale(const std::optional<UffUnits>& units) {
  if (!units) return {1, 1, "units: the file says none (no dataset 164), m and N assumed"};
  const System& system = kSystems.at(static_cast<std::size_t>(units->code));
  UffScale scale{1 / units->length, 1 / units->force, ""};
  scale.provenance = fmt::format("units: dataset 164, code {} ({}), length {:g} m, force {:g} N", units->code,
                                 system.name, scale.metre, scale.newton);
  const bool contradicts = units->code != kUserDefined &&
                           (differ(scale.metre, system.metres) || differ(scale.newton, system.newtons));
  if (contradicts)
    scale.provenance += fmt::format("; the code means {:g} m and {:g} N, the factors were used",
                                    system.metres, system.newtons);
  return scale;
}

}  // namespace wishbone
