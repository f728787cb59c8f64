#include "app/identification_pictures.h"

#include <filesystem>
#include <system_error>

#include "app/mode_text.h"
#include "app/svg/frequency_svg.h"
#include "app/svg/mac_svg.h"
#include "app/svg/mode_shape_svg.h"
#include "core/partial_file.h"

namespace wishbone {
namespace {

constexpr int kSheetModes = 12;

void add_mac(std::vector<Picture>& pictures, const std::string& name, const MatrixX& mac, const MacAxis& rows,
             const MacAxis& columns, const std::string& title) {
  if (mac.size() > 0) pictures.push_back({name, mac_svg(mac, rows, columns, title)});
}

}  // namespace

std::vector<Picture> identification_pictures(const Identification& identification) {
  const ModalData& input = identification.input;
  const ModalData& modes = identification.modes;
  const Judgement& judgement = identification.judgement;
  std::vector<Picture> pictures;
  if (modes.mode_count() > 0) pictures.push_back({"modes.svg", mode_sheet_svg(modes, kSheetModes)});
  if (input.mode_count() > 0) pictures.push_back({"input_modes.svg", mode_sheet_svg(input, kSheetModes)});
  const MacAxis identified{"identified [Hz]", mode_labels(judgement.frequency_hz)};
  if (const auto& reference = judgement.reference) {
    add_mac(pictures, "mac_reference.svg", reference->mac, identified,
            {"reference [Hz]", mode_labels(reference->reference_hz)}, "MAC against " + reference->name);
    if (reference->frequency_error.size() > 0)
      pictures.push_back({"frequencies.svg", frequency_svg(judgement)});
  }
  add_mac(pictures, "mac_input.svg", judgement.input_mac, identified,
          {"input [Hz]", mode_labels(judgement.input_hz)}, "MAC of identified modes against the input");
  add_mac(pictures, "mac_auto.svg", judgement.auto_mac, identified, identified,
          "MAC of identified modes among each other");
  return pictures;
}

void write_pictures(const std::string& folder, const Identification& identification) {
  std::error_code failed;  // that the folder is missing shows when the first picture is written
  std::filesystem::create_directories(folder, failed);
  for (const Picture& picture : identification_pictures(identification))
    write_file((std::filesystem::path(folder) / picture.name).string(), picture.svg);
}

}  // namespace wishbone
