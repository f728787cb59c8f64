#include "identification/judgement/sensor_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "identification/judgement/rigid_consensus.h"

namespace wishbone {
namespace {

using Sensor = RigidConsensus::Sensor;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLeastDeviation = 0.08;  ///< of a sensor that is looked at
constexpr double kAboveScatter = 5;       ///< times what the agreeing nodes deviate by
constexpr double kExplained = 0.35;       ///< most of the deviation that a named fault may leave
constexpr double kForeign = 0.6;          ///< deviation that is told though nothing explains it,
constexpr double kSharp = 0.04;  ///< of others, for scales and turns: a stiff support bends what it holds
constexpr std::array kAxis = {'x', 'y', 'z'};

/// What the channels of a sensor read instead of their own axes: an axis and a sign each.
struct Channels {
  std::array<int, 3> axis{};
  std::array<int, 3> sign{};
};

/// |measured - rigid seen by the channels| / |rigid|.
double deviation_of(const Sensor& sensor, const Channels& channels) {
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < sensor.axes.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const Eigen::RowVectorXd read = channels.sign[k] * sensor.rigid.row(channels.axis[k]);
    difference += (sensor.measured.row(row) - read).squaredNorm();
    size += sensor.rigid.row(sensor.axes[k]).squaredNorm();
  }
  return std::sqrt(difference / size);
}

int changes(const Sensor& sensor, const Channels& channels) {
  int count = 0;
  for (std::size_t k = 0; k < sensor.axes.size(); ++k)
    count += 2 * (channels.axis[k] != sensor.axes[k]) + (channels.sign[k] < 0);
  return count;
}

/// The exchange of axes and signs that explains the sensor best; of equally good ones that of fewest changes.
Channels best_channels(const Sensor& sensor) {
  Channels best, tried;
  double least = -1;
  const std::size_t count = sensor.axes.size();
  std::array<int, 3> axes = {0, 1, 2};
  do {
    for (unsigned signs = 0; signs < (1U << count); ++signs) {
      for (std::size_t k = 0; k < count; ++k) {
        tried.axis[k] = axes[k];
        tried.sign[k] = (signs >> k) & 1U ? -1 : 1;
      }
      const double deviation = deviation_of(sensor, tried) + 1e-3 * changes(sensor, tried);
      if (least >= 0 && deviation >= least) continue;
      least = deviation;
      best = tried;
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return best;
}

std::string text_of(const Sensor& sensor, const Channels& channels) {
  std::string own, read, flipped;
  bool exchanged = false;
  for (std::size_t k = 0; k < sensor.axes.size(); ++k) {
    const char axis = kAxis[static_cast<std::size_t>(sensor.axes[k])];
    own += fmt::format("{}{}", k > 0 ? ", " : "", axis);
    read += fmt::format("{}{}{}", k > 0 ? ", " : "", channels.sign[k] < 0 ? "-" : "",
                        kAxis[static_cast<std::size_t>(channels.axis[k])]);
    if (channels.sign[k] < 0) flipped += fmt::format("{}{}", flipped.empty() ? "" : " and ", axis);
    exchanged = exchanged || channels.axis[k] != sensor.axes[k];
  }
  if (!exchanged) return fmt::format("the sign of {} is flipped", flipped);
  return fmt::format("axes are swapped: {} {} what should be {}", own,
                     sensor.axes.size() > 1 ? "show" : "shows", read);
}

/// Least-squares factor of the sensor against the rigid motion.
double scale_of(const Sensor& sensor) {
  double product = 0, size = 0;
  for (std::size_t k = 0; k < sensor.axes.size(); ++k) {
    product += sensor.measured.row(static_cast<Eigen::Index>(k)).dot(sensor.rigid.row(sensor.axes[k]));
    size += sensor.rigid.row(sensor.axes[k]).squaredNorm();
  }
  return product / size;
}

double deviation_scaled(const Sensor& sensor, double scale) {
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < sensor.axes.size(); ++k) {
    const Eigen::RowVectorXd rigid = sensor.rigid.row(sensor.axes[k]);
    difference += (sensor.measured.row(static_cast<Eigen::Index>(k)) - scale * rigid).squaredNorm();
    size += rigid.squaredNorm();
  }
  return std::sqrt(difference / size);
}

/// Axes of the sensor in those of the structure, of least |measured - R^T rigid| (W. Kabsch, Acta Cryst. A32, 1976);
/// nothing where fewer than three axes or two directions of motion are known.
std::optional<Matrix3> turned_axes(const Sensor& sensor) {
  if (sensor.axes.size() != 3) return std::nullopt;
  MatrixX measured(3, sensor.measured.cols());
  for (Eigen::Index k = 0; k < 3; ++k)
    measured.row(sensor.axes[static_cast<std::size_t>(k)]) = sensor.measured.row(k);
  const Eigen::JacobiSVD<Matrix3> svd(Matrix3(sensor.rigid * measured.transpose()),
                                      Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.singularValues()[1] < 1e-2 * svd.singularValues()[0]) return std::nullopt;
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * Vector3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

double deviation_turned(const Sensor& sensor, const Matrix3& R) {
  const MatrixX seen = R.transpose() * sensor.rigid;
  double difference = 0;
  for (std::size_t k = 0; k < 3; ++k)
    difference +=
        (sensor.measured.row(static_cast<Eigen::Index>(k)) - seen.row(sensor.axes[k])).squaredNorm();
  return std::sqrt(difference) / sensor.rigid.norm();
}

std::string text_of(const Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  Vector3 axis = turn.axis();
  for (double& x : axis) x = std::abs(x) < 5e-3 ? 0 : x;
  return fmt::format("the sensor is turned by about {:.0f} deg about ({:.2g}, {:.2g}, {:.2g})",
                     turn.angle() / kDegree, axis.x(), axis.y(), axis.z());
}

/// What one sensor suffers from; a factor other than one where it is a scale.
struct Finding {
  int node;
  std::string what;
  double scale = 1;
};

std::optional<Finding> finding(const Sensor& sensor, double scatter) {
  if (sensor.deviation < std::max(kLeastDeviation, kAboveScatter * scatter)) return std::nullopt;
  const double wanted =
      std::max(kExplained * sensor.deviation, std::min(2 * scatter, 0.5 * sensor.deviation));
  const Channels channels = best_channels(sensor);
  const double as_channels = deviation_of(sensor, channels);
  const double scale = scale_of(sensor), as_scaled = deviation_scaled(sensor, scale);
  const std::optional<Matrix3> R = turned_axes(sensor);
  const double as_turned = R ? deviation_turned(sensor, *R) : sensor.deviation;

  if (changes(sensor, channels) > 0 && as_channels <= wanted && as_channels < 2 * as_turned)
    return Finding{sensor.node, text_of(sensor, channels)};
  if (scatter > kSharp) return std::nullopt;
  if (scale > 0.05 && as_scaled <= wanted && as_scaled <= as_turned)
    return Finding{sensor.node, fmt::format("{:.3g} times the motion", scale), scale};
  if (R && as_turned <= wanted) return Finding{sensor.node, text_of(*R)};
  if (sensor.deviation > kForeign)
    return Finding{
        sensor.node,
        "it moves otherwise than the others, as no sign, exchange of axes, scale or turn explains"};
  return std::nullopt;
}

/// Nodes of nearly equal factors become one fault.
void add_scales(std::vector<Finding> scaled, std::vector<SensorFault>& faults) {
  constexpr double kSame = 0.05;
  std::sort(scaled.begin(), scaled.end(), [](const auto& a, const auto& b) { return a.scale < b.scale; });
  for (std::size_t begin = 0, end = 0; begin < scaled.size(); begin = end) {
    SensorFault fault;
    double sum = 0;
    for (; end < scaled.size() && scaled[end].scale < (1 + kSame) * scaled[begin].scale; ++end) {
      fault.nodes.push_back(scaled[end].node);
      sum += scaled[end].scale;
    }
    std::sort(fault.nodes.begin(), fault.nodes.end());
    fault.what = fmt::format("the scale is about {:.2g} times that of the other nodes{}",
                             sum / static_cast<double>(fault.nodes.size()),
                             fault.nodes.size() > 1 ? ", as of another measurement setup" : "");
    faults.push_back(std::move(fault));
  }
}

std::string text_of_nodes(const std::vector<int>& nodes) {
  constexpr std::size_t kShown = 12;
  if (nodes.size() == 1) return fmt::format("node {}", nodes.front());
  const std::span<const int> shown(nodes.data(), std::min(kShown, nodes.size()));
  return fmt::format("nodes {}{}", fmt::join(shown, ", "),
                     nodes.size() > kShown ? fmt::format(" and {} more", nodes.size() - kShown) : "");
}

std::vector<SensorFault> faults_of(const RigidConsensus& consensus) {
  std::vector<SensorFault> faults;
  std::vector<Finding> scaled;
  for (const Sensor& sensor : consensus.sensors) {
    const std::optional<Finding> found = finding(sensor, consensus.scatter);
    if (!found) continue;
    if (found->scale != 1)
      scaled.push_back(*found);
    else
      faults.push_back({{found->node}, found->what});
  }
  add_scales(std::move(scaled), faults);
  return faults;
}

}  // namespace

std::vector<SensorFault> find_sensor_faults(const ModalData& measured) {
  const std::optional<RigidConsensus> consensus = rigid_consensus(measured);
  return consensus ? faults_of(*consensus) : std::vector<SensorFault>{};
}

std::vector<std::string> doubts_of_sensors(const ModalData& measured) {
  constexpr std::size_t kShown = 10;
  const std::optional<RigidConsensus> consensus = rigid_consensus(measured);
  if (!consensus) return {};
  const std::vector<SensorFault> faults = faults_of(*consensus);
  std::vector<std::string> doubts;
  for (const SensorFault& fault : std::span(faults.data(), std::min(kShown, faults.size())))
    doubts.push_back(
        fmt::format("{}: {} (held against rigid motion in {} suspension mode{}, from which the other nodes "
                    "deviate by {:.1f} %)",
                    text_of_nodes(fault.nodes), fault.what, consensus->modes, consensus->modes > 1 ? "s" : "",
                    100 * consensus->scatter));
  if (faults.size() > kShown)
    doubts.push_back(fmt::format("{} more sensors are odd in the suspension modes", faults.size() - kShown));
  return doubts;
}

}  // namespace wishbone
