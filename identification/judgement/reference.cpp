#include "identification/judgement/reference.h"

#include <Eigen/SVD>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "identification/judgement/mac.h"

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

/// Turns modes `first` ... `last` - 1 of the reference within their space towards their partners among `shapes`.
void turn_towards_partners(const MatrixX& shapes, const std::vector<int>& partner, int first, int last,
                           MatrixX& reference) {
  std::vector<int> partners_of_cluster;
  for (std::size_t j = 0; j < partner.size(); ++j)
    if (partner[j] >= first && partner[j] < last) partners_of_cluster.push_back(static_cast<int>(j));
  if (static_cast<int>(partners_of_cluster.size()) != last - first) return;
  const MatrixX R = reference.middleCols(first, last - first);
  const Eigen::JacobiSVD<MatrixX> svd(R.transpose() * shapes(Eigen::all, partners_of_cluster),
                                      Eigen::ComputeFullU | Eigen::ComputeFullV);
  const MatrixX turned = R * svd.matrixU() * svd.matrixV().transpose();
  for (std::size_t k = 0; k < partners_of_cluster.size(); ++k)
    reference.col(partner[static_cast<std::size_t>(partners_of_cluster[k])]) =
        turned.col(static_cast<Eigen::Index>(k));
}

/// Does so for every group of modes of one frequency.
void turn_within_equal_frequencies(const MatrixX& shapes, const std::vector<int>& partner,
                                   const VectorX& omega, MatrixX& reference) {
  constexpr double kEqual = 1e-4;
  for (int first = 0, last = 1; first < omega.size(); first = last++) {
    while (last < omega.size() && omega[last] <= (1 + kEqual) * omega[last - 1]) ++last;
    if (last - first > 1) turn_towards_partners(shapes, partner, first, last, reference);
  }
}

}  // namespace

ReferenceComparison compare_with_reference(const ModalData& modes, const ModalData& reference,
                                           const std::string& name) {
  const auto [rows, reference_rows] = common_rows(modes, reference);
  if (rows.empty())
    throw InputError({"reference", "it has no freedom in common with the identified modes", name,
                      "number its nodes as those of the measurement"});
  const MatrixX shapes = modes.shapes(rows, Eigen::all);
  MatrixX reference_shapes = reference.shapes(reference_rows, Eigen::all);
  ReferenceComparison comparison;
  comparison.name = name;
  comparison.reference_hz = reference.omega / (2 * std::numbers::pi);
  const std::vector<int> first_partner = partners(modal_assurance(shapes, reference_shapes));
  turn_within_equal_frequencies(shapes, first_partner, reference.omega, reference_shapes);
  comparison.mac = modal_assurance(shapes, reference_shapes);
  comparison.partner = partners(comparison.mac);
  comparison.frequency_error =
      VectorX::Constant(modes.mode_count(), std::numeric_limits<double>::quiet_NaN());
  for (int j = 0; j < modes.mode_count(); ++j)
    if (const int k = comparison.partner[static_cast<std::size_t>(j)]; k >= 0)
      comparison.frequency_error[j] = modes.omega[j] / reference.omega[k] - 1;
  return comparison;
}

}  // namespace wishbone
