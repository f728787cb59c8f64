#include "bodies/interface_frame.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/error.h"

namespace wishbone {
namespace {

/// Nodes lie on one line when I_w about it is below this part of I_w across it: the square of width over length.
constexpr double kOnOneLine = 1e-12;

[[noreturn]] void reject(const InterfaceFrame& frame, std::string what, std::string value,
                         std::string remedy) {
  throw InputError({"frame '" + frame.name + "'", std::move(what), std::move(value), std::move(remedy)});
}

void check_nodes(const InterfaceFrame& frame) {
  const auto& ids = frame.node_ids;
  if (ids.size() < 3)
    reject(frame, "a frame needs at least three nodes", fmt::format("{}", ids.size()),
           "name more nodes, or hold the body at a node");
  for (auto id = ids.begin(); id != ids.end(); ++id)
    if (std::find(ids.begin(), id, *id) != id)
      reject(frame, "a node of a frame must be named once", fmt::format("node {}", *id),
             "give it a larger weight instead");
}

VectorX checked_weights(const InterfaceFrame& frame) {
  const auto count = static_cast<Eigen::Index>(frame.node_ids.size());
  if (frame.weights.empty()) return VectorX::Ones(count);
  const VectorX weights =
      Eigen::Map<const VectorX>(frame.weights.data(), static_cast<Eigen::Index>(frame.weights.size()));
  if (weights.size() != count)
    reject(frame, fmt::format("there are {} weights for {} nodes", weights.size(), count), "",
           "give one weight per node, or none for equal ones");
  if (!(weights.minCoeff() > 0 && weights.allFinite()))
    reject(frame, "the weights of a frame must be positive", fmt::format("{:g}", weights.minCoeff()),
           "leave nodes out that the frame is not to follow");
  return weights;
}

}  // namespace

FrameGeometry frame_geometry(const InterfaceFrame& frame, const Matrix3X& node_position) {
  check_nodes(frame);
  FrameGeometry g;
  g.weights = checked_weights(frame);
  g.origin = node_position * g.weights / g.weights.sum();
  g.arms = node_position.colwise() - g.origin;
  const Matrix3 inertia = point_mass_inertia(g.weights, g.arms);
  const Vector3 principal =
      Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(principal[0] > kOnOneLine * principal[2]))
    reject(frame, "the nodes of a frame must not lie on one line",
           fmt::format("nodes {}", fmt::join(frame.node_ids, ", ")),
           "add a node beside the line, or the frame could not follow turns about it");
  g.inverse_inertia = inertia.inverse();
  return g;
}

FrameShapes frame_shapes(const InterfaceFrame& frame, const ShapeSet& set) {
  const auto count = static_cast<Eigen::Index>(frame.node_ids.size());
  Matrix3X position(3, count);
  std::vector<int> nodes;
  for (Eigen::Index i = 0; i < count; ++i) {
    nodes.push_back(set.node_index(frame.node_ids[static_cast<std::size_t>(i)]));
    position.col(i) = set.node_position.col(nodes.back());
  }
  const FrameGeometry g = frame_geometry(frame, position);
  const double total = g.weights.sum();
  FrameShapes shapes{g.origin, Matrix3X::Zero(3, set.shape_count()), Matrix3X::Zero(3, set.shape_count())};
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto Psi = set.shapes.middleRows<3>(3 * nodes[static_cast<std::size_t>(i)]);
    shapes.translation += g.weights[i] / total * Psi;
    shapes.rotation += g.inverse_inertia * (g.weights[i] * skew(g.arms.col(i))) * Psi;
  }
  return shapes;
}

}  // namespace wishbone
