#include "identification/judgement/rigid_consensus.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace wishbone {
namespace {

constexpr double kMostlyRigid = 0.7;  ///< least share of rigid motion in a mode that is looked at
constexpr double kNearlyRigid = 0.1;  ///< most that the median node may deviate by in a suspension mode
constexpr double kAgrees = 0.15;      ///< deviation of a node that agrees
constexpr int kTrials = 400;
constexpr std::size_t kJurors = 200;  ///< most nodes that a sampled motion is held against

/// Rows of the data by node.
using RowsOf = std::vector<std::vector<Eigen::Index>>;

RowsOf rows_by_node(const ModalData& data) {
  RowsOf rows(data.node_ids.size());
  for (std::size_t k = 0; k < data.freedoms.size(); ++k)
    rows[static_cast<std::size_t>(data.node_index(data.freedoms[k].node))].push_back(
        static_cast<Eigen::Index>(k));
  std::erase_if(rows, [](const auto& of_node) { return of_node.empty(); });
  return rows;
}

/// Lowest modes, at most six, of which most is rigid motion; each scaled to a root mean square of one.
MatrixX mostly_rigid_modes(const ModalData& data, const MatrixX& G) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixX> fit(G);
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index j = 0; j < data.shapes.cols() && chosen.size() < 6; ++j) {
    const VectorX psi = data.shapes.col(j);
    const double share = 1 - (psi - G * fit.solve(psi)).squaredNorm() / psi.squaredNorm();
    if (share > kMostlyRigid) chosen.push_back(j);
  }
  MatrixX Y = data.shapes(Eigen::all, chosen);
  for (auto psi : Y.colwise()) psi *= std::sqrt(static_cast<double>(psi.size())) / psi.norm();
  return Y;
}

/// Finds X with G X = Y for most nodes.
class Consensus {
 public:
  Consensus(const RowsOf& rows, const MatrixX& G, const MatrixX& Y) : rows_(rows), G_(G), Y_(Y) {
    const Eigen::JacobiSVD<MatrixX> svd(G);
    rank_ = svd.rank();
    least_ = 1e-2 * svd.singularValues()[rank_ - 1];
  }

  /// Nodes that agree with the best of the sampled motions, its own members among them.
  std::vector<std::size_t> agreeing() {
    std::mt19937 random(1);
    std::vector<std::size_t> best, all(rows_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<std::size_t> order = all;
    shuffle(order, random);
    const std::vector<std::size_t> jury(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(std::min(kJurors, order.size())));
    order = jury;
    for (int trial = 0; trial < kTrials; ++trial) {
      shuffle(order, random);
      std::vector<std::size_t> members = agreeing_with(sample(order), jury);
      if (members.size() > best.size()) best = std::move(members);
    }
    if (best.empty()) return best;
    best = agreeing_with(motion_of(best), all);
    for (int round = 0; round < 5; ++round) {
      std::vector<std::size_t> members = agreeing_with(motion_of(best), all);
      if (members.size() < best.size()) break;
      best = std::move(members);
    }
    return best;
  }

  /// Least squares over some nodes.
  MatrixX motion_of(const std::vector<std::size_t>& nodes) const {
    const std::vector<Eigen::Index> rows = rows_of(nodes, nodes.size());
    return MatrixX(G_(rows, Eigen::all))
        .completeOrthogonalDecomposition()
        .solve(MatrixX(Y_(rows, Eigen::all)));
  }

  double deviation(std::size_t node, const MatrixX& X) const {
    const MatrixX rigid = G_(rows_[node], Eigen::all) * X;
    // a node on the axis of all motions does not move: what is common to all nodes keeps its deviation finite
    const double floor = 0.1 * std::sqrt(static_cast<double>(rigid.size()));
    return (Y_(rows_[node], Eigen::all) - rigid).norm() / std::max(rigid.norm(), floor);
  }

 private:
  /// The same order on every machine, unlike std::shuffle.
  static void shuffle(std::vector<std::size_t>& order, std::mt19937& random) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  }

  std::vector<Eigen::Index> rows_of(const std::vector<std::size_t>& nodes, std::size_t count) const {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < count; ++i)
      rows.insert(rows.end(), rows_[nodes[i]].begin(), rows_[nodes[i]].end());
    return rows;
  }

  /// The motion of as few nodes, from the front, as determine it.
  MatrixX sample(const std::vector<std::size_t>& order) const {
    for (std::size_t count = std::min<std::size_t>(3, order.size()); count < order.size(); ++count) {
      const MatrixX G_s = G_(rows_of(order, count), Eigen::all);
      if (G_s.rows() < rank_) continue;
      const Eigen::JacobiSVD<MatrixX> svd(G_s);
      if (svd.singularValues()[rank_ - 1] < least_) continue;
      return motion_of({order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count)});
    }
    return motion_of(order);
  }

  std::vector<std::size_t> agreeing_with(const MatrixX& X, const std::vector<std::size_t>& jury) const {
    std::vector<std::size_t> nodes;
    for (const std::size_t i : jury)
      if (deviation(i, X) < kAgrees) nodes.push_back(i);
    return nodes;
  }

  const RowsOf& rows_;
  const MatrixX &G_, &Y_;
  Eigen::Index rank_ = 0;
  double least_ = 0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Modes in which the median of the agreeing nodes deviates little from the motion X.
std::vector<Eigen::Index> nearly_rigid(const RowsOf& rows, const std::vector<std::size_t>& nodes,
                                       const MatrixX& G, const MatrixX& Y, const MatrixX& X) {
  std::vector<Eigen::Index> modes;
  for (Eigen::Index j = 0; j < Y.cols(); ++j) {
    std::vector<double> deviations;
    for (const std::size_t i : nodes) {
      const VectorX rigid = G(rows[i], Eigen::all) * X.col(j);
      deviations.push_back((Y(rows[i], j) - rigid).norm() / std::max(rigid.norm(), 0.1));
    }
    if (median(deviations) < kNearlyRigid) modes.push_back(j);
  }
  return modes;
}

}  // namespace

std::optional<RigidConsensus> rigid_consensus(const ModalData& measured) {
  const RowsOf rows = rows_by_node(measured);
  if (rows.size() < 4) return std::nullopt;
  MatrixX everywhere =
      rigid_body_shapes(all_freedoms(measured.node_ids), measured.node_ids, measured.node_position);
  // rotations count as much as translations
  everywhere.rightCols(3) /= std::max(everywhere.rightCols(3).cwiseAbs().maxCoeff(), 1e-300);
  MatrixX G(measured.freedom_count(), 6);
  for (Eigen::Index k = 0; k < G.rows(); ++k) {
    const Freedom& freedom = measured.freedoms[static_cast<std::size_t>(k)];
    G.row(k) = everywhere.row(3 * measured.node_index(freedom.node) + freedom.axis);
  }
  const auto enough = [&](const std::vector<std::size_t>& nodes) {
    return nodes.size() >= 4 && 3 * nodes.size() >= rows.size();
  };
  MatrixX Y = mostly_rigid_modes(measured, G);
  if (Y.cols() == 0) return std::nullopt;
  std::vector<std::size_t> nodes = Consensus(rows, G, Y).agreeing();
  if (!enough(nodes)) return std::nullopt;
  const std::vector<Eigen::Index> modes =
      nearly_rigid(rows, nodes, G, Y, Consensus(rows, G, Y).motion_of(nodes));
  if (modes.empty()) return std::nullopt;
  Y = MatrixX(Y(Eigen::all, modes));
  Consensus consensus(rows, G, Y);
  nodes = consensus.agreeing();
  if (!enough(nodes)) return std::nullopt;

  const MatrixX X = consensus.motion_of(nodes);
  RigidConsensus result;
  result.modes = static_cast<int>(Y.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int node = measured.freedoms[static_cast<std::size_t>(rows[i].front())].node;
    RigidConsensus::Sensor sensor{node,
                                  {},
                                  Y(rows[i], Eigen::all),
                                  everywhere.middleRows(3 * measured.node_index(node), 3) * X,
                                  consensus.deviation(i, X)};
    for (const Eigen::Index row : rows[i])
      sensor.axes.push_back(measured.freedoms[static_cast<std::size_t>(row)].axis);
    result.sensors.push_back(std::move(sensor));
  }
  std::vector<double> deviations;
  for (const std::size_t i : nodes) deviations.push_back(result.sensors[i].deviation);
  result.scatter = median(deviations);
  return result;
}

}  // namespace wishbone
