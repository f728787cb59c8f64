#include "identification/judgement/matching.h"

#include <Eigen/QR>
#include <algorithm>
#include <tuple>

#include "identification/judgement/mac.h"

namespace wishbone {
namespace {

using Eigen::Index;

constexpr double kClose = 1e-3;  // relative difference of frequencies that a measurement may not tell apart
constexpr double kClear = 0.9;   // share from which on a shape is that of one frequency

/// Reference modes of neighbouring frequencies.
struct Group {
  Index first = 0, count = 0;
  MatrixX basis;             ///< Q, orthonormal
  std::vector<int> members;  ///< modes that belong to it, ascending
};

/// Neighbours in a group differ by `apart` or less.
std::vector<Group> groups_of(const MatrixX& reference, const VectorX& omega, double apart) {
  std::vector<Group> groups;
  for (Index first = 0, last = 1; first < omega.size(); first = last++) {
    while (last < omega.size() && omega[last] <= (1 + apart) * omega[last - 1]) ++last;
    const MatrixX R = reference.middleCols(first, last - first).colwise().normalized();
    const Eigen::ColPivHouseholderQR<MatrixX> qr(R);
    groups.push_back(
        {first, last - first, MatrixX(qr.householderQ() * MatrixX::Identity(R.rows(), qr.rank())), {}});
  }
  return groups;
}

/// Every mode to the group that holds most of it.
void assign(const MatrixX& shapes, double least, std::vector<Group>& groups) {
  std::vector<std::tuple<double, int, std::size_t>> shares;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int i = 0; i < shapes.cols(); ++i) {
      const double share =
          (groups[g].basis.transpose() * shapes.col(i)).squaredNorm() / shapes.col(i).squaredNorm();
      if (share >= least) shares.emplace_back(-share, i, g);
    }
  std::sort(shares.begin(), shares.end());
  std::vector<bool> placed(static_cast<std::size_t>(shapes.cols()), false);
  for (const auto& [share, i, g] : shares) {
    std::vector<int>& members = groups[g].members;
    if (placed[static_cast<std::size_t>(i)] || static_cast<Index>(members.size()) == groups[g].count)
      continue;
    members.push_back(i);
    placed[static_cast<std::size_t>(i)] = true;
  }
  for (Group& group : groups) std::sort(group.members.begin(), group.members.end());
}

/// Places in the group: those of its members, then those that are left. A member that is clearly of one frequency
/// stands there, the others take what is free in the order of their frequencies.
std::vector<Index> places(const Group& group, const MatrixX& shapes, const MatrixX& reference,
                          const VectorX& omega) {
  std::vector<Group> equal =
      groups_of(reference.middleCols(group.first, group.count), omega.segment(group.first, group.count), 0);
  assign(shapes(Eigen::all, group.members), kClear, equal);
  std::vector<Index> place(static_cast<std::size_t>(group.count), -1);
  std::vector<bool> taken(place.size(), false);
  for (const Group& of_one : equal)
    for (std::size_t k = 0; k < of_one.members.size(); ++k) {
      const Index at = of_one.first + static_cast<Index>(k);
      place[static_cast<std::size_t>(of_one.members[k])] = at;
      taken[static_cast<std::size_t>(at)] = true;
    }
  auto free = taken.begin();
  for (Index& at : place) {
    if (at >= 0) continue;
    free = std::find(free, taken.end(), false);
    at = free - taken.begin();
    *free = true;
  }
  return place;
}

/// A basis of the group's space that begins with the projections of its members.
MatrixX turned(const Group& group, const MatrixX& shapes) {
  const MatrixX coordinates = group.basis.transpose() * shapes(Eigen::all, group.members);
  const auto members = static_cast<Index>(group.members.size());
  MatrixX columns = MatrixX::Zero(shapes.rows(), group.count);
  columns.leftCols(members) = group.basis * coordinates;
  const Index others = std::min(group.count, group.basis.cols()) - members;
  if (others <= 0) return columns;
  const MatrixX Q = coordinates.householderQr().householderQ();
  columns.middleCols(members, others) = group.basis * Q.rightCols(others);
  return columns;
}

}  // namespace

Matching match_modes(const MatrixX& shapes, const MatrixX& reference, const VectorX& omega, double least) {
  std::vector<Group> groups = groups_of(reference, omega, kClose);
  assign(shapes, least, groups);
  MatrixX held_against = reference;
  Matching matching{{}, std::vector<int>(static_cast<std::size_t>(shapes.cols()), -1)};
  for (const Group& group : groups) {
    if (group.members.empty()) continue;
    const std::vector<Index> place = places(group, shapes, reference, omega);
    if (group.count > 1)
      held_against.middleCols(group.first, group.count)(Eigen::all, place) = turned(group, shapes);
    for (std::size_t k = 0; k < group.members.size(); ++k)
      matching.partner[static_cast<std::size_t>(group.members[k])] = static_cast<int>(group.first + place[k]);
  }
  matching.mac = modal_assurance(shapes, held_against);
  return matching;
}

}  // namespace wishbone
