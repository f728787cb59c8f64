#include "app/body_modes_text.h"

#include <fmt/format.h>

#include "app/text_table.h"

namespace wishbone {

std::string text_of(const BodyModes& body) {
  TextTable table({"kind", "mode", "f [Hz]", "zeta [%]", "effective mass [kg]", "at node"}, 1);
  for (std::size_t j = 0; j < body.modes.size(); ++j) {
    const ModeRow& mode = body.modes[j];
    table.add_row({to_string(mode.kind), fmt::format("{}", j + 1), fmt::format("{:.6g}", mode.frequency),
                   fmt::format("{:.4g}", 100 * mode.damping_ratio),
                   fmt::format("{:.4g}", mode.effective_mass), fmt::format("{}", mode.node)});
  }
  return fmt::format("modes of {}: {}\n{}", body.body, body.choice, table.text());
}

}  // namespace wishbone
