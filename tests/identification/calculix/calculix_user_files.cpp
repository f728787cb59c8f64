#include "identification/calculix/calculix_user_files.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "identification/formats/matrix_market.h"
#include "identification/formats/modal_file.h"

namespace wishbone {
namespace {

ModalData elastic_modes(const CalculixStructure& structure) {
  const Eigen::Index count = structure.free.count() - 6;
  ModalData data = structure.supported;
  data.title = "free frame by CalculiX";
  data.support = {};
  data.omega = structure.free.lambda.tail(count).cwiseSqrt();
  data.shapes = structure.free.shapes.rightCols(count);
  data.damping_ratio = VectorX::Zero(count);
  data.modal_mass = VectorX::Ones(count);
  return data;
}

std::string task(const Support& support) {
  std::string text =
      "wishbone: 1\ntitle: frame on its support\nidentification:\n  measured: {file: modes.h5}\n  mass: "
      "{matrix: mass.mtx}\n  support:\n";
  const auto out = std::back_inserter(text);
  if (!support.springs.empty()) fmt::format_to(out, "    springs:\n");
  for (const auto& [node, u, k] : support.springs)
    fmt::format_to(out, "      - {{node: {}, direction: [{}, {}, {}], stiffness: {} N/m}}\n", node, u.x(),
                   u.y(), u.z(), k);
  if (!support.joints.empty()) fmt::format_to(out, "    joints:\n");
  for (const auto& [node, u] : support.joints)
    fmt::format_to(out, "      - {{node: {}, direction: [{}, {}, {}]}}\n", node, u.x(), u.y(), u.z());
  return text + "  reference: {file: free.h5}\n";
}

}  // namespace

void write_user_files(const CalculixStructure& structure, const std::filesystem::path& folder) {
  for (const char* name : {"modes.h5", "modes.unv", "modes.csv"})
    write_modal_data(folder / name, structure.supported);
  write_modal_data(folder / "free.h5", elastic_modes(structure));
  write_matrix_market(folder / "mass.mtx", structure.M, true);
  std::ofstream(folder / "identification.yaml") << task(structure.supported.support);
}

}  // namespace wishbone
