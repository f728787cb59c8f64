#include "app/svg/view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace wishbone {
namespace {

constexpr double kRadian = 3.14159265358979323846 / 180;

/// Smallest box round the projected points.
Eigen::AlignedBox2d box(const View& view, const Matrix3X& points) {
  Eigen::AlignedBox2d box;
  for (const auto& p : points.colwise()) box.extend(view.project(p));
  return box.isEmpty() ? Eigen::AlignedBox2d(Point(0, 0)) : box;
}

}  // namespace

View view_of(const Matrix3X& nodes) {
  constexpr double kElevation = 22 * kRadian;
  constexpr double kTurnOfSlender = 16 * kRadian, kTurnOfCompact = 32 * kRadian;
  constexpr double kSlender = 1.8;  // length over breadth

  double turn = kTurnOfCompact;
  if (nodes.cols() > 1) {
    const Eigen::Matrix2Xd flat = nodes.topRows(2).colwise() - nodes.topRows(2).rowwise().mean().eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> spread(flat * flat.transpose());
    const Eigen::Vector2d length = spread.eigenvalues().cwiseMax(0).cwiseSqrt();
    if (length[1] > kSlender * length[0]) {
      Eigen::Vector2d along = spread.eigenvectors().col(1);
      if (along.x() + 1e-9 * along.y() < 0) along = -along;
      turn = kTurnOfSlender + std::atan2(along.y(), along.x());
    }
  }
  const Vector3 right(std::cos(turn), std::sin(turn), 0);
  const Vector3 away(-std::sin(turn), std::cos(turn), 0);
  return {right, std::sin(kElevation) * away + std::cos(kElevation) * Vector3::UnitZ()};
}

Placement::Placement(const View& view, const Matrix3X& points, const Point& corner, const Point& size)
    : view_(view) {
  const Eigen::AlignedBox2d shown = box(view, points);
  const Point extent = shown.sizes();
  if (extent.maxCoeff() > 0)
    scale_ = std::min(extent.x() > 0 ? size.x() / extent.x() : INFINITY,
                      extent.y() > 0 ? size.y() / extent.y() : INFINITY);
  const Point middle = shown.center();
  origin_ = corner + size / 2 - scale_ * Point(middle.x(), -middle.y());
}

Point Placement::operator()(const Vector3& p) const {
  const Point q = view_.project(p);
  return origin_ + scale_ * Point(q.x(), -q.y());
}

double aspect(const View& view, const Matrix3X& points) {
  const Point extent = box(view, points).sizes();
  return extent.maxCoeff() > 0 ? extent.y() / std::max(extent.x(), 1e-9 * extent.y()) : 1;
}

}  // namespace wishbone
