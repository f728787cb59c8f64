#include "identification/free_free_modes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <fstream>
#include <numbers>
#include <numeric>
#include <string>

#include "core/error.h"

namespace wishbone {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr IsotropicMaterial kChassisMaterial{2.1e8, 0.3, 2600};

Mesh chassis_mesh() {
  return make_block({2.4, 0.4, 0.4}, {4, 1, 1}, ElementType::mean_dilatation);
}
const ModeSet& chassis() {
  static const ModeSet set = free_free_modes(chassis_mesh(), kChassisMaterial);
  return set;
}

/// tests/data/chassis_free_free.csv: Table C.6 of the source [Hz].
std::vector<double> published_chassis_frequencies() {
  std::ifstream file(WISHBONE_TEST_DATA "/chassis_free_free.csv");
  std::vector<double> frequencies;
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && std::isdigit(line[0]))
      frequencies.push_back(std::stod(line.substr(line.find(',') + 1)));
  return frequencies;
}

TEST(FreeFreeModes, ReproduceThePublishedChassis) {
  const std::vector<double> published = published_chassis_frequencies();
  ASSERT_EQ(published.size(), 54u);
  ASSERT_EQ(chassis().mode_count(), 54);
  double worst = 0;
  for (int j = 0; j < 54; ++j)
    worst = std::max(worst, std::abs(chassis().omega[j] / (2 * kPi * published[j]) - 1));
  RecordProperty("worst_relative_difference", fmt::format("{:.3g}", worst));
  EXPECT_LE(worst, 1e-5);
}

TEST(FreeFreeModes, KeepTheMassPropertiesOfTheChassis) {
  EXPECT_NEAR(chassis().mass(), 998.4, 1e-11);
  const Matrix3 J = chassis().inertia();
  EXPECT_LE((J - Matrix3(Vector3(79.872, 579.072, 579.072).asDiagonal())).norm(), 1e-11);
}

TEST(FreeFreeModes, AreMassOrthonormalAndFreeOfRigidMotion) {
  const ModeSet& set = chassis();
  set.validate();
  const VectorX mass = mass_of_freedoms(set.node_mass);
  const MatrixX gram = set.shapes.transpose() * mass.asDiagonal() * set.shapes;
  EXPECT_LE((gram - MatrixX::Identity(54, 54)).cwiseAbs().maxCoeff(), 1e-12);
  const MatrixX rigid = rigid_body_modes(set.node_mass, set.node_position);
  EXPECT_LE((rigid.transpose() * mass.asDiagonal() * rigid - Matrix6::Identity()).cwiseAbs().maxCoeff(),
            1e-12);
  EXPECT_LE((rigid.transpose() * mass.asDiagonal() * set.shapes).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FreeFreeModes, SolveTheEigenproblem) {
  const ModeSet& set = chassis();
  const MatrixX K = MatrixX(stiffness_matrix(chassis_mesh(), kChassisMaterial));
  const VectorX mass = mass_of_freedoms(set.node_mass);
  const MatrixX residual =
      K * set.shapes - mass.asDiagonal() * set.shapes * set.omega.cwiseAbs2().asDiagonal();
  EXPECT_LE(residual.cwiseAbs().maxCoeff(), 1e-12 * (K * set.shapes).cwiseAbs().maxCoeff());
}

TEST(FreeFreeModes, HaveTheirLargestComponentPositive) {
  for (auto shape : chassis().shapes.colwise())
    EXPECT_GE(shape.maxCoeff(), (1 - 1e-6) * shape.cwiseAbs().maxCoeff());
}

TEST(FreeFreeModes, DoNotDependOnWhereTheBodyIs) {
  Mesh moved = chassis_mesh();
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(3, -1, 2).normalized()).toRotationMatrix();
  moved.nodes = (R * moved.nodes).colwise() + Vector3(5, -3, 8);
  const ModeSet set = free_free_modes(moved, kChassisMaterial);
  EXPECT_LE(((set.omega - chassis().omega).array() / chassis().omega.array()).abs().maxCoeff(), 1e-11);
  EXPECT_LE((set.node_position - R * chassis().node_position).norm(), 1e-13);
}

TEST(FreeFreeModes, AgreeWithTheLumpedChainInAxialVibration) {
  // Without lateral contraction a row of N elements stretches as a chain of springs EA/h with lumped masses:
  // omega_k = (2 c / h) sin(k pi / 2N), c = sqrt(E / rho).
  const int N = 6;
  const IsotropicMaterial material{2.0e9, 0.0, 2000};
  const ModeSet set = free_free_modes(make_block({3, 0.2, 0.3}, {N, 1, 1}), material);
  const double c = std::sqrt(material.youngs_modulus / material.density), h = 0.5;
  for (int k = 1; k < N; ++k) {
    const double expected = 2 * c / h * std::sin(k * kPi / (2 * N));
    EXPECT_LE((set.omega.array() / expected - 1).abs().minCoeff(), 1e-12) << "axial mode " << k;
  }
}

/// Lowest elastic frequency [Hz] of the free beam 1 x 0.05 x 0.05 m, of steel, cut into 10 k x k x k
/// elements: inverse iteration on K + sigma M, kept clear of rigid motion.
double lowest_beam_frequency(int k) {
  const Mesh mesh = make_block({1, 0.05, 0.05}, {20 * k, k, k});
  const IsotropicMaterial material{2.1e11, 0.3, 7850};
  const VectorX node_mass = lumped_mass(mesh, material.density);
  const VectorX mass = mass_of_freedoms(node_mass);
  const MatrixX rigid = rigid_body_modes(node_mass, mesh.nodes);
  const Eigen::SparseMatrix<double> K = stiffness_matrix(mesh, material);
  Eigen::SparseMatrix<double> M(K.rows(), K.cols());
  M.setIdentity();
  M.diagonal() = mass;
  const double sigma = 1e5;  // far below the first elastic eigenvalue, 2.7e6
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> shifted(K + sigma * M);

  MatrixX x = MatrixX::Zero(K.rows(), 2);  // the two bending modes of equal frequency, started as parabolas
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    x(3 * i + 1, 0) = x(3 * i + 2, 1) = std::pow(mesh.nodes(0, i), 2);
  MatrixX eigenvalues;
  for (int iteration = 0; iteration < 12; ++iteration) {
    x -= rigid * (rigid.transpose() * mass.asDiagonal() * x);
    const MatrixX gram = x.transpose() * mass.asDiagonal() * x;
    x *= MatrixX(gram.llt().matrixU()).inverse();
    eigenvalues = x.transpose() * (K * x);
    const MatrixX M_x = mass.asDiagonal() * x;
    x = shifted.solve(M_x);
  }
  return std::sqrt(eigenvalues(0, 0)) / (2 * kPi);
}

TEST(FreeFreeModes, ConvergeToTheTimoshenkoBeam) {
  // Shear factor 5/6; 50-digit transfer matrix. The beam theory itself is some 1e-4 away from the solid.
  const double timoshenko = 263.4399741272268;
  const double f3 = lowest_beam_frequency(3), f5 = lowest_beam_frequency(5);
  const double limit = (25 * f5 - 9 * f3) / 16;  // f(h) = f + a h^2
  EXPECT_LE(std::abs(f5 / timoshenko - 1), 2e-3);
  EXPECT_LE(std::abs(f5 - timoshenko), 0.6 * std::abs(f3 - timoshenko));
  EXPECT_LE(std::abs(limit / timoshenko - 1), 1e-3);
}

TEST(FreeFreeModes, RejectABodyTiedToTheGround) {
  const Mesh mesh = chassis_mesh();
  MatrixX K = MatrixX(stiffness_matrix(mesh, kChassisMaterial));
  K(2, 2) += 47e3;
  EXPECT_THROW(free_free_modes(mesh.node_ids, lumped_mass(mesh, 2600), mesh.nodes, K), InputError);
}

TEST(FreeFreeModes, RejectAMechanism) {
  // Two blocks side by side, not joined.
  const Mesh one = make_block({1, 1, 1}, {1, 1, 1});
  Mesh two;
  two.nodes.resize(3, 16);
  two.nodes << one.nodes, one.nodes.colwise() + Vector3(3, 0, 0);
  two.elements.resize(8, 2);
  two.elements << one.elements, one.elements.array() + 8;
  two.node_ids.resize(16);
  std::iota(two.node_ids.begin(), two.node_ids.end(), 1);
  EXPECT_THROW(free_free_modes(two, kChassisMaterial), InputError);
}

}  // namespace
}  // namespace wishbone
