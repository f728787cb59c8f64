#include "app/identification_text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "app/meta_text.h"
#include "app/text_table.h"

namespace wishbone {

namespace {

std::string known(double value, double factor, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), factor * value) : "-";
}

TextTable mode_table(const Identification& id) {
  const Judgement& j = id.judgement;
  std::vector<std::string> header{"mode", "f [Hz]"};
  if (j.frequency_std_hz.size() > 0) header.push_back("std [Hz]");
  header.insert(header.end(), {"zeta [%]", "est. error [%]", "bound [%]"});
  if (j.reference) header.insert(header.end(), {"reference [Hz]", "error [%]", "MAC"});
  TextTable table(header, 0);
  for (Eigen::Index k = 0; k < j.frequency_hz.size(); ++k) {
    std::vector<std::string> row{std::to_string(k + 1), fmt::format("{:.6g}", j.frequency_hz[k])};
    if (j.frequency_std_hz.size() > 0) row.push_back(known(j.frequency_std_hz[k], 1, "{:.3g}"));
    row.push_back(fmt::format("{:.3g}", 100 * id.modes.damping_ratio[k]));
    row.push_back(known(j.error_estimate[k], 100, "{:.2g}"));
    row.push_back(known(j.residual[k], 50, "{:.2g}"));  // of omega^2: half of it is that of the frequency
    if (j.reference) {
      const int partner = j.reference->partner[static_cast<std::size_t>(k)];
      row.push_back(partner < 0 ? "-" : fmt::format("{:.6g}", j.reference->reference_hz[partner]));
      row.push_back(known(j.reference->frequency_error[k], 100, "{:.2g}"));
      row.push_back(partner < 0 ? "-" : fmt::format("{:.4f}", j.reference->mac(k, partner)));
    }
    table.add_row(row);
  }
  return table;
}

nlohmann::ordered_json json_list(const VectorX& values) {
  auto list = nlohmann::ordered_json::array();
  for (const double value : values) list.push_back(nlohmann::ordered_json(json_number(value)));
  return list;
}

nlohmann::ordered_json json_rows(const MatrixX& values) {
  auto rows = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) rows.push_back(json_list(values.row(i).transpose()));
  return rows;
}

}  // namespace

std::string text_of(const Identification& id) {
  const Judgement& j = id.judgement;
  std::string text = id.title.empty() ? "" : id.title + "\n\n";
  for (const std::string& warning : j.warnings) text += "warning: " + warning + "\n";
  if (!j.warnings.empty()) text += "\n";
  text += mode_table(id).text() + "\n";
  for (const std::string& note : j.notes) text += note + "\n";
  text += fmt::format(
      "mass-orthogonality error: measured {:.2g}, identified {:.2g}; product with rigid motion {:.2g}\n",
      j.input_orthogonality_error, j.orthogonality_error, j.rigid_body_error);
  for (const auto& [name, value] : j.condition_numbers)
    text += fmt::format("condition number of {}: {:.3g}\n", name, value);
  text += fmt::format("lost modes: {}\n", j.lost_modes);
  return text;
}

nlohmann::ordered_json json_of(const Identification& id) {
  const Judgement& j = id.judgement;
  nlohmann::ordered_json out{{"title", id.title},
                             {"frequency_hz", json_list(j.frequency_hz)},
                             {"damping_ratio", json_list(id.modes.damping_ratio)},
                             {"residual", json_list(j.residual)},
                             {"error_estimate", json_list(j.error_estimate)},
                             {"frequency_std_hz", json_list(j.frequency_std_hz)},
                             {"input_frequency_hz", json_list(j.input_hz)},
                             {"shape_scatter", json_number(j.shape_scatter)},
                             {"lost_modes", j.lost_modes},
                             {"input_orthogonality_error", json_number(j.input_orthogonality_error)},
                             {"orthogonality_error", json_number(j.orthogonality_error)},
                             {"rigid_body_error", json_number(j.rigid_body_error)},
                             {"auto_mac", json_rows(j.auto_mac)},
                             {"input_mac", json_rows(j.input_mac)},
                             {"notes", j.notes},
                             {"warnings", j.warnings}};
  for (const auto& [name, value] : j.condition_numbers) out["condition_numbers"][name] = json_number(value);
  if (j.reference)
    out["reference"] = {{"name", j.reference->name},
                        {"frequency_hz", json_list(j.reference->reference_hz)},
                        {"partner", j.reference->partner},
                        {"frequency_error", json_list(j.reference->frequency_error)},
                        {"mac", json_rows(j.reference->mac)}};
  return out;
}

}  // namespace wishbone
