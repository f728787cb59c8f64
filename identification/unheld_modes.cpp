#include "identification/unheld_modes.h"

#include <fmt/format.h>

#include <numbers>

#include "core/error.h"
#include "identification/methods/rigid_modes.h"

namespace wishbone {
namespace {

constexpr double kMostly = 0.5;     // of the modal mass
constexpr double kRounding = 1e-2;  // of the lowest elastic frequency: moves it by 0.005 %

std::string listed(const std::vector<int>& modes) {
  std::string text = modes.size() > 1 ? "modes " : "mode ";
  for (std::size_t i = 0; i < modes.size(); ++i) text += fmt::format("{}{}", i > 0 ? ", " : "", modes[i] + 1);
  return text;
}

}  // namespace

void leave_out_unheld_modes(PreparedStructure& s) {
  const SparseMatrix M_t = s.M + s.support.M_s;
  const MatrixX unheld = unheld_motions(s.support, s.rigid);
  if (unheld.cols() == 0) return;
  const VectorX share = rigid_share(rigid_body_basis(unheld, M_t), s.data.shapes, M_t);
  std::vector<int> rigid, elastic;
  for (int j = 0; j < s.data.mode_count(); ++j) (share[j] > kMostly ? rigid : elastic).push_back(j);
  if (rigid.empty()) return;
  if (elastic.empty())
    throw InputError({"identification", "the measured modes are nothing but rigid-body motion", listed(rigid),
                      "measure elastic modes, or name the support that gives these their frequencies"});
  const double highest = s.data.omega[rigid.back()], lowest = s.data.omega[elastic.front()];
  const bool plural = rigid.size() > 1;
  if (highest <= kRounding * lowest)
    s.notes.push_back(
        fmt::format("{} left out: rigid-body motion up to {:.2g} Hz, which a free structure has at zero; at "
                    "most {:.2g} of "
                    "the modal mass is elastic",
                    listed(rigid), highest / (2 * std::numbers::pi), 1 - share(rigid).minCoeff()));
  else
    s.warnings.push_back(
        fmt::format("{} {} mostly rigid-body motion, as on a support, and no support is named: {} left out, "
                    "and the frequencies "
                    "of the other modes are those on it",
                    listed(rigid), plural ? "are" : "is", plural ? "they are" : "it is"));
  s.data = s.data.with_modes(elastic);
}

}  // namespace wishbone
