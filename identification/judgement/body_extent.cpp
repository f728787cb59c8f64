#include "identification/judgement/body_extent.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace wishbone {
namespace {

constexpr double kLightest = 1, kDensest = 30000;  // kg/m3
constexpr double kLongest = 1000;                  // m
constexpr double kFastest = 20000;                 // m/s
constexpr const char* kRemedy =
    "state the unit of length: dataset 164 of a Universal File, or x[mm], y[mm], z[mm] above the columns of "
    "CSV tables "
    "(wishbone convert writes them)";

/// Of a box whose sides are at least `thinnest` of the longest.
double volume(const Vector3& size, double thinnest) {
  return size.cwiseMax(thinnest * size.maxCoeff()).prod();
}

}  // namespace

BodyExtent body_extent(const ModalData& data) {
  BodyExtent extent;
  if (data.node_count() == 0) return extent;
  const Matrix3X& p = data.node_position;
  extent.size = p.rowwise().maxCoeff() - p.rowwise().minCoeff();
  if (!data.has_masses() || !(data.node_mass.sum() > 0)) return extent;
  extent.mass = data.node_mass.sum();
  extent.centre = p * data.node_mass / extent.mass;
  for (int i = 0; i < data.node_count(); ++i) {
    const Vector3 r = p.col(i) - extent.centre;
    extent.inertia += data.node_mass[i] * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
  }
  return extent;
}

BodyExtent body_extent(const ModalData& data, const SparseMatrix& M) {
  BodyExtent extent = body_extent(data);
  const MatrixX G = rigid_body_shapes(data.freedoms, data.node_ids, data.node_position);
  const Eigen::Matrix<double, 6, 6> S = G.transpose() * (M * G);
  if (!data.is_complete() || !(S(0, 0) > 0)) return extent;
  extent.mass = S(0, 0);
  // about the mean position: S_tr = -m skew(c), S_rr = J_c + m (c^2 1 - c c^T)
  const Vector3 c = Vector3(S(1, 5), S(2, 3), S(0, 4)) / extent.mass;
  extent.centre = data.node_position.rowwise().mean() + c;
  extent.inertia =
      S.bottomRightCorner<3, 3>() - extent.mass * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  return extent;
}

std::string describe(const BodyExtent& extent) {
  std::string text =
      fmt::format("size {:.4g} x {:.4g} x {:.4g} m", extent.size.x(), extent.size.y(), extent.size.z());
  if (!(extent.mass > 0)) return text + "; masses of nodes not known";
  const double small = 1e-9 * extent.size.norm();
  const auto shown = [](double x, double rounding) { return std::abs(x) < rounding ? 0.0 : x; };
  const Matrix3& J = extent.inertia;
  const double least = 1e-9 * J.norm();
  text += fmt::format("; mass {:.6g} kg, mass centre ({:.4g}, {:.4g}, {:.4g}) m", extent.mass,
                      shown(extent.centre.x(), small), shown(extent.centre.y(), small),
                      shown(extent.centre.z(), small));
  return text + fmt::format(
                    ", inertia about it {:.5g}, {:.5g}, {:.5g} kg m2 (xx, yy, zz), {:.4g}, {:.4g}, "
                    "{:.4g} kg m2 (xy, xz, yz)",
                    J(0, 0), J(1, 1), J(2, 2), shown(J(0, 1), least), shown(J(0, 2), least),
                    shown(J(1, 2), least));
}

std::optional<Diagnostic> doubt_of_units(const BodyExtent& extent, double lowest_omega) {
  const double length = extent.size.maxCoeff();
  if (!(length > 0)) return std::nullopt;
  if (extent.mass > 0) {
    const double most = extent.mass / volume(extent.size, 0.01),
                 least = extent.mass / volume(extent.size, 0.2);
    if (most < kLightest || least > kDensest)
      return Diagnostic{
          "",
          fmt::format("the mass does not suit the size: lengths are probably not in m{}, and inertias "
                      "are wrong by the square of the factor",
                      most < kLightest ? " but in mm" : ""),
          fmt::format("{:.4g} kg in {:.4g} x {:.4g} x {:.4g} m, {:.2g} kg/m3", extent.mass, extent.size.x(),
                      extent.size.y(), extent.size.z(), most < kLightest ? most : least),
          kRemedy};
  }
  if (extent.mass == 0 && length > kLongest)
    return Diagnostic{"", "this is the size of a mountain: lengths are probably not in m but in mm",
                      fmt::format("{:.4g} m", length), kRemedy};
  const double frequency = lowest_omega / (2 * std::numbers::pi);
  if (!(2 * length * frequency > kFastest)) return std::nullopt;
  return Diagnostic{
      "",
      "a structure of this length has lower modes than these, for waves do not run so fast: lengths "
      "are probably not in m but in mm",
      fmt::format("{:.4g} m, lowest mode {:.4g} Hz", length, frequency), kRemedy};
}

}  // namespace wishbone
