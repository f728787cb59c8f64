// Frequencies of meshes of hexahedra against published problems whose converged values are known independently of any mesh.
// The element is linear and its masses are lumped: what its second order of convergence leaves at no element size is compared.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "identification/elements/mesh.h"
#include "identification/methods/lowest_modes.h"

namespace wishbone {
namespace {

/// Whether a node at a place is held along an axis (0, 1, 2).
using HeldPlaces = std::function<bool(const Vector3& place, int axis)>;

/// The `count` lowest frequencies of a held structure, ascending [Hz].
VectorX lowest_frequencies(const Mesh& mesh, const IsotropicMaterial& material, const HeldPlaces& held,
                           int count) {
  const SparseMatrix K = stiffness_matrix(mesh, material);
  const VectorX mass = lumped_mass(mesh, material.density);
  std::vector<int> row_of(static_cast<std::size_t>(K.rows()), -1);
  int n = 0;
  for (int i = 0; i < K.rows(); ++i)
    if (!held(mesh.nodes.col(i / 3), i % 3)) row_of[i] = n++;
  std::vector<Eigen::Triplet<double>> stiffness, masses;
  for (int c = 0; c < K.cols(); ++c) {
    if (row_of[c] < 0) continue;
    masses.emplace_back(row_of[c], row_of[c], mass[c / 3]);
    for (SparseMatrix::InnerIterator entry(K, c); entry; ++entry)
      if (row_of[entry.row()] >= 0) stiffness.emplace_back(row_of[entry.row()], row_of[c], entry.value());
  }
  SparseMatrix K_free(n, n), M_free(n, n);
  K_free.setFromTriplets(stiffness.begin(), stiffness.end());
  M_free.setFromTriplets(masses.begin(), masses.end());
  return lowest_modes(K_free, M_free, count).frequency_hz();
}

/// The frequencies of a structure that looks the same along two axes: those that come twice, bending along one or the other,
/// and those that come once. Their order among each other may change from mesh to mesh.
struct Sorted {
  std::vector<double> single, twice;
};
Sorted sorted(const VectorX& f) {
  Sorted out;
  for (Eigen::Index i = 0; i < f.size(); ++i) {
    const bool repeated = i + 1 < f.size() && f[i + 1] / f[i] - 1 < 1e-6;
    (repeated ? out.twice : out.single).push_back(f[i]);
    if (repeated) ++i;
  }
  return out;
}

/// Value at no element size of the polynomial in h^2 through values on meshes of `fineness` 1/h [Richardson].
double extrapolated(const std::vector<int>& fineness, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double weight = 1;
    const double own = 1.0 / (fineness[i] * fineness[i]);
    for (std::size_t j = 0; j < values.size(); ++j) {
      const double other = 1.0 / (fineness[j] * fineness[j]);
      if (j != i) weight *= other / (other - own);
    }
    sum += weight * values[i];
  }
  return sum;
}

/// Values number `index` of lists.
std::vector<double> of_each(const std::vector<std::vector<double>>& lists, std::size_t index) {
  std::vector<double> values;
  for (const auto& list : lists) values.push_back(list.at(index));
  return values;
}

TEST(PublishedFrequencies, ASlenderBlockBendsAsTimoshenkosBeam) {
  // S. P. Timoshenko, "On the transverse vibrations of bars of uniform cross-section", Philosophical Magazine 43, 1922; shear
  // factor 5/6, free ends, 1 x 0.05 x 0.05 m. Roots of the transfer matrix in 50 digits, equal to those of a Ritz series.
  const double timoshenko[] = {263.4399741272268379912, 714.3816035569708859668, 1368.781785976214421445};
  constexpr IsotropicMaterial steel{2.1e11, 0.3, 7850};
  const std::vector<int> fineness{2, 3, 4};
  std::vector<std::vector<double>> bending;
  for (const int k : fineness) {
    const VectorX f = lowest_frequencies(
        make_block({1, 0.05, 0.05}, {20 * k, k, k}), steel, [](const Vector3&, int) { return false; }, 13);
    EXPECT_LT(f[5], 1e-4 * f[6]) << "six rigid-body modes";
    bending.push_back(sorted(f.tail(7)).twice);
  }
  // the theory of beams and that of solids differ by less
  for (std::size_t mode = 0; mode < 3; ++mode)
    EXPECT_NEAR(extrapolated(fineness, of_each(bending, mode)) / timoshenko[mode], 1, 2e-3) << mode;
}

TEST(PublishedFrequencies, ATaperedMembraneInPlaneStressAgreesWithNafems) {
  // NAFEMS, "The standard NAFEMS benchmarks", TNSB rev. 3, 1990, problem FV32: cantilevered tapered membrane. Converged values:
  // one element of degree 8 to 24; the published targets are those of a mesh, up to 0.05 percent above.
  const double converged[] = {44.617, 130.010, 162.689, 245.986, 379.717, 391.404};
  constexpr IsotropicMaterial steel{2e11, 0.3, 8000};
  constexpr double half_thickness = 0.025;  // above the plane of symmetry; free to thicken: plane stress
  const HeldPlaces held = [](const Vector3& p, int axis) { return axis == 2 ? p.z() < 1e-9 : p.x() < 1e-9; };
  for (const ElementType type : {ElementType::incompatible_modes, ElementType::mean_dilatation}) {
    std::vector<VectorX> f;
    for (const int k : {1, 2}) {
      Mesh mesh = make_block({10, 1, half_thickness}, {16 * k, 8 * k, 1}, type);
      for (auto p : mesh.nodes.colwise()) {
        p += Vector3(5, 0, half_thickness / 2);
        p.y() *= 5 - 0.4 * p.x();
      }
      f.push_back(lowest_frequencies(mesh, steel, held, 6));
    }
    for (int mode = 0; mode < 6; ++mode) {
      // elements that are a little too stiff make up for lumped masses, which are a little too slow
      const double on_mesh = type == ElementType::mean_dilatation ? 2e-3 : 4e-3;
      EXPECT_NEAR(f[1][mode] / converged[mode], 1, on_mesh) << mode;
      EXPECT_NEAR(extrapolated({1, 2}, {f[0][mode], f[1][mode]}) / converged[mode], 1, 2e-4) << mode;
    }
  }
}

TEST(PublishedFrequencies, AThickPlateOnSlidingEdgesConvergesWithSecondOrder) {
  // NAFEMS problem FV52 (a thick square plate, 10 x 10 x 1 m) with supports that make it well posed: every edge face can slide
  // along its normal alone. Exact solution by separation of variables with a Legendre series through the thickness.
  const double single[] = {45.9712116, 168.8192942, 219.2645048, 310.086836};
  const double twice[] = {109.8568616, 155.0434182, 205.8646120, 258.5598857};
  constexpr IsotropicMaterial steel{2e11, 0.3, 8000};
  const auto on_edge = [](double x) { return std::abs(x) > 5 - 1e-9; };
  const HeldPlaces held = [&](const Vector3& p, int axis) {
    return (axis != 0 && on_edge(p.x())) || (axis != 1 && on_edge(p.y()));
  };
  // thickness-constant shear, the coarsest wave along one side: sqrt(mu/rho)/(2 a)
  EXPECT_NEAR(twice[1], std::sqrt(2e11 / 2.6 / 8000) / 20, 1e-7);

  const std::vector<int> fineness{2, 3, 4};
  for (const ElementType type : {ElementType::mean_dilatation, ElementType::incompatible_modes}) {
    std::vector<std::vector<double>> singles, pairs;
    for (const int k : fineness) {
      const Sorted f =
          sorted(lowest_frequencies(make_block({10, 10, 1}, {4 * k, 4 * k, k}, type), steel, held, 12));
      singles.push_back(f.single);
      pairs.push_back(f.twice);
    }
    const auto check = [&](const std::vector<std::vector<double>>& found, const double* exact,
                           std::size_t long_waves) {
      for (std::size_t mode = 0; mode < 4; ++mode) {
        const std::vector<double> f = of_each(found, mode);
        EXPECT_NEAR(extrapolated(fineness, f) / exact[mode], 1, 5e-4) << exact[mode] << " Hz";
        const double order = std::log2((f[0] - exact[mode]) / (f[2] - exact[mode]));
        if (mode < long_waves) {
          EXPECT_NEAR(order, 2, 0.15) << exact[mode] << " Hz";
        }
      }
    };
    // The coarsest mesh of mean dilatation resolves waves of the first kinds alone so well that one order of error prevails;
    // with incompatible modes the errors of second order of stiffness and lumped masses nearly cancel.
    const bool one_order = type == ElementType::mean_dilatation;
    check(singles, single, one_order ? 1 : 0);
    check(pairs, twice, one_order ? 2 : 0);
  }
}

}  // namespace
}  // namespace wishbone
