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

Matrix3 rotation_from_quaternion(const Eigen::Ref<const Eigen::Vector4d>& q_wxyz) {
  const double s = 1.0 / q_wxyz.norm();
  return Quaternion(s * q_wxyz[0], s * q_wxyz[1], s * q_wxyz[2], s * q_wxyz[3]).toRotationMatrix();
}

Eigen::Vector4d quaternion_rate(const Eigen::Ref<const Eigen::Vector4d>& q_wxyz, const Vector3& w_FM_M) {
  const double w = q_wxyz[0];
  const Vector3 u = q_wxyz.tail<3>();
  Eigen::Vector4d rate;
  rate << -0.5 * u.dot(w_FM_M), 0.5 * (w * w_FM_M + u.cross(w_FM_M));
  return rate;
}

std::pair<Vector3, Vector3> perpendiculars(const Vector3& axis) {
  Eigen::Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vector3 first = axis.cross(Vector3::Unit(smallest)).normalized();
  return {first, axis.cross(first)};
}

}  // namespace wishbone
