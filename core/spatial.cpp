#include "core/spatial.h"

#include <cmath>
#include <utility>

namespace wishbone {

Quaternion quaternion_from_rotation_vector(const Vector3& phi) {
  const double angle = phi.norm();
  // sin(angle/2)/angle; its series 1/2 - angle^2/48 is exact to double precision below 1e-4
  const double s = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * phi.x(), s * phi.y(), s * phi.z()};
}

Vector3 rotation_vector_from_quaternion(const Quaternion& Q) {
  const double sign = Q.w() < 0 ? -1.0 : 1.0;  // Q and -Q are one rotation
  const Vector3 u = sign * Q.vec();
  const double s = u.norm();
  // angle/sin(angle/2); below 1e-4 its series 2 (1 + s^2/6) is exact to double precision
  return (s < 1e-4 ? 2.0 + s * s / 3.0 : 2.0 * std::atan2(s, sign * Q.w()) / s) * u;
}

std::pair<Vector3, Vector3> perpendiculars(const Vector3& axis) {
  Eigen::Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vector3 first = axis.cross(Vector3::Unit(smallest)).normalized();
  return {first, axis.cross(first)};
}

}  // namespace wishbone
