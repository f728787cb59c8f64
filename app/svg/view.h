#pragma once

#include "app/svg/svg.h"
#include "core/spatial.h"

namespace wishbone {

/// Parallel projection of body axes to paper, z upright: unit vectors of the paper in body axes.
struct View {
  Vector3 right = Vector3::UnitX();
  Vector3 up = Vector3::UnitZ();

  /// Place on paper in body lengths, second coordinate upwards.
  Point project(const Vector3& p) const { return {right.dot(p), up.dot(p)}; }
  /// Distance towards the viewer: what is nearer covers what is farther.
  double nearness(const Vector3& p) const { return right.cross(up).dot(p); }
};

/// Seen from above and obliquely from the side: the longest horizontal direction of the nodes runs across the
/// paper and comes a little towards the viewer, so that slender bodies fill its width. Bodies without such a
/// direction have x across.
View view_of(const Matrix3X& nodes);

/// A view with its scale and place on paper.
class Placement {
 public:
  /// Fits the points, seen by the view, into the middle of a rectangle of paper.
  Placement(const View& view, const Matrix3X& points, const Point& corner, const Point& size);

  Point operator()(const Vector3& p) const;
  const View& view() const { return view_; }

 private:
  View view_;
  double scale_ = 1;  ///< pixels per length
  Point origin_ = Point::Zero();
};

/// Height over width of the points, seen by the view; 1 where they have no extent.
double aspect(const View& view, const Matrix3X& points);

}  // namespace wishbone
