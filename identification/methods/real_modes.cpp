#include "identification/methods/real_modes.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <string>
#include <utility>

#include "core/error.h"
#include "identification/methods/modes.h"

namespace wishbone {
namespace {

void check(const Eigen::VectorXcd& s, const Eigen::MatrixXcd& psi) {
  if (s.size() != psi.cols())
    throw InputError({"complex modes", "each mode needs one eigenvalue",
                      fmt::format("{} eigenvalues, {} modes", s.size(), psi.cols()),
                      "list them in the same order"});
  for (Eigen::Index j = 0; j < s.size(); ++j) {
    const double size = std::abs(s[j]), length = psi.col(j).norm();
    if (!(size > 0 && std::isfinite(size)))
      throw InputError({"complex modes",
                        fmt::format("the eigenvalue of mode {} must be finite and not zero", j + 1),
                        fmt::format("|s| = {}", size), "leave rigid-body modes out"});
    if (!(length > 0 && std::isfinite(length)))
      throw InputError({"complex modes",
                        fmt::format("the shape of mode {} must be finite and not zero", j + 1),
                        fmt::format("length {}", length), "leave the mode out"});
  }
}

}  // namespace

RealModes real_modes(const Eigen::VectorXcd& s, const Eigen::MatrixXcd& psi) {
  check(s, psi);
  RealModes modes;
  modes.omega = s.cwiseAbs();
  modes.damping_ratio = -s.real().cwiseQuotient(modes.omega);
  modes.shapes.resize(psi.rows(), psi.cols());
  modes.phase_collinearity.resize(s.size());
  modes.imaginary_share.resize(s.size());
  for (Eigen::Index j = 0; j < s.size(); ++j) {
    const double length = psi.col(j).norm();
    const Eigen::VectorXcd unit = psi.col(j) / length;
    const std::complex<double> squares = unit.cwiseProduct(unit).sum();
    const Eigen::VectorXcd turned = std::polar(1.0, -0.5 * std::arg(squares)) * unit;
    modes.shapes.col(j) = length * turned.real();
    modes.phase_collinearity[j] = std::norm(squares);
    modes.imaginary_share[j] = turned.imag().norm();
  }
  fix_signs(modes.shapes);
  return modes;
}

}  // namespace wishbone
