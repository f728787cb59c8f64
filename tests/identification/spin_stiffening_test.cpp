// Geometric stiffening of a mesh by its spin, against the tension of a bar and the statics of rigid turns.

#include "identification/spin_stiffening.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "text_files.h"

namespace wishbone {
namespace {

/// A mesh with its lumped masses, from its mass centre, and the shapes given.
ModeSet set_of(const Mesh& mesh, const IsotropicMaterial& material, MatrixX shapes) {
  ModeSet set;
  set.node_ids = mesh.node_ids;
  set.node_mass = lumped_mass(mesh, material.density);
  set.node_position = mesh.nodes;
  set.omega = VectorX::Ones(shapes.cols());
  set.damping_ratio = VectorX::Zero(shapes.cols());
  set.shapes = std::move(shapes);
  return set;
}

std::vector<int> nodes_at(const Mesh& mesh, double x) {
  std::vector<int> ids;
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    if (std::abs(mesh.nodes(0, i) - x) < 1e-9) ids.push_back(mesh.node_ids[static_cast<std::size_t>(i)]);
  return ids;
}

constexpr double kLength = 2, kSide = 0.05;
constexpr IsotropicMaterial kSteel{2e11, 0.0, 7800};  // no lateral contraction: the stress is that of a bar

/// Sections of a bar that turn with its line v = (x + L/2)^2 along y and z: Bernoulli's kinematics.
MatrixX bending(const Mesh& mesh) {
  MatrixX shapes = MatrixX::Zero(mesh.nodes.size(), 2);
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const double x = mesh.nodes(0, i) + kLength / 2;
    for (int k = 0; k < 2; ++k) {
      shapes(3 * i + 1 + k, k) = x * x;
      shapes(3 * i, k) = -2 * x * mesh.nodes(1 + k, i);
    }
  }
  return shapes;
}

/// int T v'^2 dx of a bar held at its left end that spins about x = -L/2 - r, T = rho A (r (L - x) + (L^2 - x^2) / 2), v' = 2 x,
/// and of the warped sections, int rho A i^2 T/(rho A) v''^2 dx: u = -y v' is stretched likewise.
double work_of_tension(double r) {
  const double L = kLength, A = kSide * kSide, rho = kSteel.density;
  const double bent = 4 * rho * A * (r * std::pow(L, 4) / 12 + std::pow(L, 5) / 15);
  const double section = kSide * kSide / 12;  // mean of y^2
  const double warped = 4 * rho * A * section * (r * L * L / 2 + L * L * L / 3);
  return bent + warped;
}

TEST(SpinStiffening, IsTheTensionOfAHeldBar) {
  for (const double r : {0.0, 1.5}) {
    std::array<double, 3> work{};
    for (int i = 0; i < 3; ++i) {
      const Mesh mesh = make_block({kLength, kSide, kSide}, {10 << i, 2, 2});
      const ModeSet set = set_of(mesh, kSteel, bending(mesh));
      const SpinLoad load{nodes_at(mesh, -kLength / 2), Vector3(-kLength / 2 - r, 0, 0)};
      const MatrixX K = spin_stiffening(mesh, kSteel, set, load);
      ASSERT_EQ(K.cols(), 12);
      EXPECT_LT((K.middleCols<2>(2) - K.middleCols<2>(4)).norm(), 1e-3 * K.norm());  // about y as about z
      EXPECT_NEAR(K(0, 2), K(1, 5), 1e-9 * K(0, 2));  // bent along its axis of spin, y or z
      EXPECT_NEAR(K(0, 4), K(1, 3), 1e-9 * K(0, 4));  // bent across it
      EXPECT_LT(std::abs(K(0, 3)), 1e-9 * K(0, 2));
      work[i] = K(0, 4);
    }
    EXPECT_NEAR(work[2], work_of_tension(r), 2e-3 * work[2]) << r;
    EXPECT_NEAR((work[0] - work[1]) / (work[1] - work[2]), 4, 0.2)
        << r;  // second order in the length of an element
  }
}

// A body that spins freely is pulled by itself only: the tension of its half is that of a bar held in its middle.
TEST(SpinStiffening, OfAFreeBodyIsThatOfOneHeldAtItsCentre) {
  const Mesh mesh = make_block({kLength, kSide, kSide}, {20, 2, 2});
  const ModeSet set = set_of(mesh, kSteel, bending(mesh));
  const MatrixX free = spin_stiffening(mesh, kSteel, set, {});
  const MatrixX held = spin_stiffening(mesh, kSteel, set, {nodes_at(mesh, 0), std::nullopt});
  EXPECT_LT((free.middleCols<2>(4) - held.middleCols<2>(4)).norm(), 1e-3 * free.middleCols<2>(4).norm());
}

// Turned as it stands a body carries its stresses along: K_sigma (phi x s) = phi x f, with the loads f that it is in
// equilibrium with, and so Psi^T K_sigma Psi of rigid turns is sum (phi x s).(phi x f).
TEST(SpinStiffening, TurnsTheLoadsWithTheBody) {
  constexpr IsotropicMaterial soft{1e9, 0.3, 2000};
  const Mesh mesh = make_block({0.9, 0.5, 0.7}, {1, 1, 1});
  MatrixX turns(24, 3);
  for (Eigen::Index i = 0; i < 8; ++i) turns.middleRows<3>(3 * i) = -skew(mesh.nodes.col(i));
  const ModeSet set = set_of(mesh, soft, turns);
  const MatrixX K = spin_stiffening(mesh, soft, set, {});
  // spin about x: f_i = m_i (0, y_i, z_i) is in equilibrium; its field is linear on one element
  Matrix3 expected = Matrix3::Zero();
  for (Eigen::Index i = 0; i < 8; ++i) {
    const Vector3 s = mesh.nodes.col(i), f = set.node_mass[i] * Vector3(0, s.y(), s.z());
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) expected(a, b) += Vector3::Unit(a).cross(s).dot(Vector3::Unit(b).cross(f));
  }
  EXPECT_LT((K.leftCols<3>() - expected).norm(), 1e-10 * expected.norm());
}

TEST(SpinStiffening, NeedsNodesThatHoldTheBody) {
  const Mesh mesh = make_block({1, 1, 1}, {1, 1, 1});
  const ModeSet set = set_of(mesh, kSteel, MatrixX::Zero(24, 1));
  const auto complaint = [&](std::vector<int> held) {
    return message_of<InputError>([&] {
      spin_stiffening(mesh, kSteel, set, {std::move(held), std::nullopt});
    });
  };
  EXPECT_EQ(
      complaint({1}),
      "geometric stiffening: error: the held nodes must hold the body (got 3 of 6 rigid motions left free)\n"
      "  name at least three nodes that do not lie on one line, or spin it 'free'");
  EXPECT_THAT(complaint({1, 2}), testing::HasSubstr("1 of 6 rigid motions"));
  EXPECT_THAT(complaint({99}), testing::HasSubstr("there is no such node (got node 99)"));
}

}  // namespace
}  // namespace wishbone
