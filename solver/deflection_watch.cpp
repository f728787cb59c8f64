#include "solver/deflection_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace wishbone {
namespace {

/// The nearest points that lie apart from point i, nearest first. Between points that all but coincide, as on two sides of a weld,
/// a difference of displacements is no gradient.
std::vector<int> nearest(const Matrix3X& points, int i) {
  constexpr std::size_t kNeighbours = 6;
  constexpr double kApart = 1e-3;  // of the diagonal of the box of all points
  const double apart = kApart * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  std::vector<std::pair<double, int>> others;
  for (int j = 0; j < points.cols(); ++j)
    if (const double distance = (points.col(j) - points.col(i)).norm(); distance > apart)
      others.emplace_back(distance, j);
  const std::size_t count = std::min(kNeighbours, others.size());
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count), others.end());
  std::vector<int> found;
  for (std::size_t k = 0; k < count; ++k) found.push_back(others[k].second);
  return found;
}

}  // namespace

DeflectionWatch::Body DeflectionWatch::watched(const FlexibleBody& flexible, std::string name) {
  const ShapeSet& set = flexible.modal.set();
  const int step = (set.node_count() + kNodes - 1) / kNodes;
  std::vector<int> nodes;
  for (int i = 0; i < set.node_count(); i += step) nodes.push_back(i);

  Body body;
  body.name = std::move(name);
  body.z_start = flexible.z_start;
  body.shapes.resize(3 * static_cast<Eigen::Index>(nodes.size()), set.shape_count());
  for (const int node : nodes) {
    body.shapes.middleRows<3>(3 * static_cast<Eigen::Index>(body.node_ids.size())) =
        set.shapes.middleRows<3>(3 * node);
    body.node_ids.push_back(set.node_ids[static_cast<std::size_t>(node)]);
  }
  const Matrix3X places = set.node_position(Eigen::all, nodes);
  for (int a = 0; a < places.cols(); ++a)
    for (const int b : nearest(places, a))
      body.pairs.push_back({a, b, 1 / (places.col(a) - places.col(b)).norm()});
  body.deflection.resize(body.shapes.rows());
  return body;
}

DeflectionWatch::DeflectionWatch(const System& system) {
  for (const FlexibleBody& flexible : system.flexible)
    if (flexible.modal.mode_count() > 0)
      bodies_.push_back(watched(flexible, system.bodies[static_cast<std::size_t>(flexible.body)].name));
}

void DeflectionWatch::observe(const State& state) {
  for (Body& body : bodies_) {
    body.deflection.noalias() = body.shapes * state.q.segment(body.z_start, body.shapes.cols());
    const bool was_within = !(body.worst > kLimit);
    for (const Pair& pair : body.pairs) {
      const double gradient =
          (body.deflection.segment<3>(3 * pair.a) - body.deflection.segment<3>(3 * pair.b)).norm() *
          pair.inverse_distance;
      if (!(gradient > body.worst)) continue;
      body.worst = gradient;
      body.t_worst = state.t;
      body.worst_pair = pair;
    }
    if (was_within && body.worst > kLimit) body.t_first = state.t;
  }
}

void DeflectionWatch::report(Warnings& warnings) const {
  for (const Body& body : bodies_) {
    if (!(body.worst > kLimit)) continue;
    const auto id = [&](int place) { return body.node_ids[static_cast<std::size_t>(place)]; };
    warnings.push_back(
        {fmt::format("{}, t = {:.6g} s", body.name, body.t_worst),
         fmt::format("it deflects beyond the range of linear elasticity: parts of it turn or stretch against "
                     "the body "
                     "axes by more than {:g}, from t = {:.6g} s on",
                     kLimit, body.t_first),
         fmt::format("{:.3g} between nodes {} and {}, which leaves lengths wrong by {:.2g} %", body.worst,
                     id(body.worst_pair.a), id(body.worst_pair.b), 50 * body.worst * body.worst),
         "divide the body into several that are fixed to each other, so that each bends less, or lower the "
         "loads"});
  }
}

}  // namespace wishbone
