#include "identification/elements/mesh_estimate.h"

#include "bodies/mode_set.h"

namespace wishbone {
namespace {

constexpr Eigen::Index kMostElements = 400;

/// u_j^T A u_j of every column.
VectorX quadratic_forms(const MatrixX& A, const MatrixX& u) {
  return u.cwiseProduct(A * u).colwise().sum();
}

}  // namespace

VectorX frequency_ratios(const Mesh& mesh, const IsotropicMaterial& material, const MatrixX& shapes) {
  const Matrix6 elasticity = material.elasticity();
  Mesh bending = mesh;
  if (mesh.type == ElementType::mean_dilatation) bending.type = ElementType::incompatible_modes;
  VectorX energy = VectorX::Zero(shapes.cols()), mass = energy, energy_inside = energy, mass_inside = energy;
  const Eigen::Index step = (mesh.elements.cols() + kMostElements - 1) / kMostElements;
  for (Eigen::Index e = 0; e < mesh.elements.cols(); e += step) {
    const auto index = static_cast<int>(e);
    const MatrixX u = shapes(mesh.freedoms(index), Eigen::all);
    const SolidElement own = mesh.element(index, elasticity), inside = bending.element(index, elasticity);
    energy += quadratic_forms(own.stiffness(), u);
    energy_inside += quadratic_forms(inside.stiffness(), u);
    const VectorX lumps = mass_of_freedoms(own.geometry().volume() * own.geometry().mass_shares());
    mass += u.cwiseAbs2().transpose() * lumps;
    mass_inside += quadratic_forms(inside.displacement_products(), u);
  }
  return (energy.array() * mass_inside.array() / (energy_inside.array() * mass.array())).sqrt();
}

}  // namespace wishbone
