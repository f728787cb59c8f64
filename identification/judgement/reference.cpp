#include "identification/judgement/reference.h"

#include <limits>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "identification/judgement/matching.h"

namespace wishbone {
namespace {

/// Rows of two sets that belong to the same freedoms.
std::pair<std::vector<int>, std::vector<int>> common_rows(const ModalData& a, const ModalData& b) {
  std::pair<std::vector<int>, std::vector<int>> rows;
  for (int i = 0; i < a.freedom_count(); ++i)
    if (const auto j = b.row(a.freedoms[static_cast<std::size_t>(i)])) {
      rows.first.push_back(i);
      rows.second.push_back(*j);
    }
  return rows;
}

}  // namespace

ReferenceComparison compare_with_reference(const ModalData& modes, const ModalData& reference,
                                           const std::string& name) {
  const auto [rows, reference_rows] = common_rows(modes, reference);
  if (rows.empty())
    throw InputError({"reference", "it has no freedom in common with the identified modes", name,
                      "number its nodes as those of the measurement"});
  const MatrixX shapes = modes.shapes(rows, Eigen::all);
  const MatrixX reference_shapes = reference.shapes(reference_rows, Eigen::all);
  ReferenceComparison comparison;
  comparison.name = name;
  comparison.reference_hz = reference.omega / (2 * std::numbers::pi);
  Matching matching = match_modes(shapes, reference_shapes, reference.omega);
  comparison.mac = std::move(matching.mac);
  comparison.partner = std::move(matching.partner);
  comparison.frequency_error =
      VectorX::Constant(modes.mode_count(), std::numeric_limits<double>::quiet_NaN());
  for (int j = 0; j < modes.mode_count(); ++j)
    if (const int k = comparison.partner[static_cast<std::size_t>(j)]; k >= 0)
      comparison.frequency_error[j] = modes.omega[j] / reference.omega[k] - 1;
  return comparison;
}

}  // namespace wishbone
