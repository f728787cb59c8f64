#include "identification/formats/identification_file.h"

#include <span>

#include "core/hdf5.h"
#include "core/partial_file.h"
#include "identification/formats/mode_file.h"

namespace wishbone {
namespace {

void describe(hdf5::Dataset dataset, const char* units, const char* about) {
  dataset.set_attribute("units", std::string(units));
  dataset.set_attribute("about", std::string(about));
}

void write(hdf5::Group& group, const char* name, const VectorX& values, const char* units,
           const char* about) {
  if (values.size() == 0) return;
  const auto size = static_cast<std::size_t>(values.size());
  describe(group.write(name, {size}, std::span(values.data(), size)), units, about);
}

void write(hdf5::Group& group, const char* name, const MatrixX& values, const char* about) {
  if (values.size() > 0) describe(group.write(name, values), "1", about);
}

void write_judgement(hdf5::Group group, const Judgement& judgement) {
  write(group, "input_frequency", judgement.input_hz, "Hz", "frequencies of the modes that were measured");
  write(group, "residual", judgement.residual, "1",
        "bound on the relative error of omega^2 by what the measured set leaves open; NaN: none");
  write(group, "error_estimate", judgement.error_estimate, "1",
        "estimated relative error of the frequencies by what the measured set leaves open; NaN: none");
  write(group, "frequency_std", judgement.frequency_std_hz, "Hz",
        "standard deviation of the frequencies under the given measurement noise; NaN: mode not told from "
        "others");
  write(group, "auto_mac", judgement.auto_mac, "modal assurance criterion of the modes among each other");
  write(group, "input_mac", judgement.input_mac,
        "modal assurance criterion of the modes (rows) and the measured ones");
  group.set_attribute("input_orthogonality_error", judgement.input_orthogonality_error);
  group.set_attribute("orthogonality_error", judgement.orthogonality_error);
  group.set_attribute("rigid_body_error", judgement.rigid_body_error);
  group.set_attribute("lost_modes", static_cast<double>(judgement.lost_modes));
  group.set_attribute("notes", judgement.notes);
  group.set_attribute("warnings", judgement.warnings);
  for (const auto& [name, value] : judgement.condition_numbers)
    group.set_attribute("condition number of " + name, value);
  if (!judgement.reference) return;
  group.set_attribute("reference", judgement.reference->name);
  write(group, "reference_frequency", judgement.reference->reference_hz, "Hz",
        "frequencies of the reference");
  write(group, "reference_mac", judgement.reference->mac,
        "modal assurance criterion of the modes (rows) and those of the reference");
}

}  // namespace

void write_identification(const std::string& path, const Identification& identification) {
  identification.modes.validate();
  PartialFile partial(path);
  hdf5::File file = hdf5::File::create(partial.name());
  write_mode_file(file, identification.modes);
  write_judgement(file.create_group("judgement"), identification.judgement);
  file.close();
  partial.finish();
}

}  // namespace wishbone
