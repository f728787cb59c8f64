// Laws that any displacement element must keep, on the patch of R. H. MacNeal and R. L. Harder, "A proposed
// standard set of problems to test finite element accuracy", Finite Elements in Analysis and Design 1, 1985.

#include "identification/elements/hexahedron.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "identification/elements/hexahedral_mesh.h"

namespace wishbone {
namespace {

using ::testing::HasSubstr;

constexpr IsotropicMaterial kPatchMaterial{1e6, 0.25, 1.0};

/// Unit cube with an inner hexahedron (columns 8..15) joined to the six faces by one element each.
HexahedralMesh patch() {
  HexahedralMesh mesh;
  mesh.nodes.resize(3, 16);
  mesh.nodes << 0, 1, 1, 0, 0, 1, 1, 0, .249, .826, .850, .273, .320, .677, .788, .165,  //
      0, 0, 1, 1, 0, 0, 1, 1, .342, .288, .649, .750, .186, .305, .693, .745,            //
      0, 0, 0, 0, 1, 1, 1, 1, .192, .288, .263, .230, .643, .683, .644, .702;
  mesh.node_ids.resize(16);
  std::iota(mesh.node_ids.begin(), mesh.node_ids.end(), 1);
  mesh.elements.resize(8, 7);
  const int faces[6][4] = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                           {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  for (int f = 0; f < 6; ++f)  // a face of the cube (seen from inside), then the face of the inner element
    for (int a = 0; a < 4; ++a) {
      mesh.elements(a, f) = faces[f][a];
      mesh.elements(a + 4, f) = faces[f][a] + 8;
    }
  mesh.elements.col(6) << 8, 9, 10, 11, 12, 13, 14, 15;
  return mesh;
}

/// u = 1e-3 (2x+y+z, x+2y+z, x+y+2z) / 2: every strain component is 1e-3.
Matrix3X constant_strain_field(const Matrix3X& x) {
  return 0.5e-3 * (Matrix3::Ones() + Matrix3::Identity()) * x;
}

/// Displacements of all nodes when the cube's corners are moved as the field says and the inner nodes are
/// free.
Matrix3X patch_solution(const HexahedralMesh& mesh) {
  const MatrixX K = MatrixX(stiffness_matrix(mesh, kPatchMaterial));
  VectorX u = constant_strain_field(mesh.nodes).reshaped();
  u.tail(24) = -K.bottomRightCorner(24, 24).llt().solve(K.bottomLeftCorner(24, 24) * u.head(24));
  return u.reshaped(3, 16);
}

Hexahedron::Corners distorted_corners() {
  const HexahedralMesh mesh = patch();
  return mesh.nodes.rightCols<8>();
}

Matrix3 some_rotation() {
  return Eigen::AngleAxisd(1.1, Vector3(1, 2, -3).normalized()).toRotationMatrix();
}

TEST(Hexahedron, PassesThePatchTest) {
  const HexahedralMesh mesh = patch();
  const Matrix3X u = patch_solution(mesh), exact = constant_strain_field(mesh.nodes);
  EXPECT_LE((u - exact).norm() / exact.norm(), 1e-11);

  Vector6 stress;
  stress << 2000, 2000, 2000, 400, 400, 400;
  for (int e = 0; e < 7; ++e) {
    const Hexahedron element = mesh.element(e);
    const VectorX u_e = u(Eigen::all, mesh.elements.col(e)).reshaped();
    for (const Vector3& xi : {Vector3(0, 0, 0), Vector3(0.5, -0.7, 0.3), Vector3(-1, 1, 1)}) {
      const Vector6 strain = element.strain_operator(xi) * u_e;
      EXPECT_LE((strain - Vector6::Constant(1e-3)).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_LE((kPatchMaterial.elasticity() * strain - stress).cwiseAbs().maxCoeff(), 1e-11 * 2000);
    }
  }
}

TEST(Hexahedron, FillsThePatchWithItsVolume) {
  const HexahedralMesh mesh = patch();
  EXPECT_NEAR(lumped_mass(mesh, 3.0).sum(), 3.0, 3e-15);
}

TEST(Hexahedron, HasSixZeroEnergyModes) {
  const Hexahedron::Stiffness K = Hexahedron(distorted_corners(), 1).stiffness(kPatchMaterial.elasticity());
  const VectorX lambda = Eigen::SelfAdjointEigenSolver<MatrixX>(K, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_LE(lambda.head(6).cwiseAbs().maxCoeff(), 1e-13 * lambda[23]);
  EXPECT_GE(lambda[6], 1e-3 * lambda[23]);
}

TEST(Hexahedron, DoesNotResistRigidMotion) {
  const Hexahedron::Corners corners = distorted_corners();
  const Hexahedron::Stiffness K = Hexahedron(corners, 1).stiffness(kPatchMaterial.elasticity());
  const Matrix3X turned = skew(Vector3(1, -2, 0.5)) * corners;
  EXPECT_LE((K * turned.reshaped()).norm(), 1e-14 * K.norm() * turned.norm());
}

TEST(Hexahedron, EnergyDoesNotDependOnTheFrame) {
  // K R u = R K u with R the rotation of every corner: elasticity of the element is isotropic.
  const Hexahedron::Corners corners = distorted_corners();
  const Matrix6 D = kPatchMaterial.elasticity();
  const Matrix3 R = some_rotation();
  const MatrixX K = Hexahedron(corners, 1).stiffness(D), K_turned = Hexahedron(R * corners, 1).stiffness(D);
  MatrixX R24 = MatrixX::Zero(24, 24);
  for (int a = 0; a < 8; ++a) R24.block<3, 3>(3 * a, 3 * a) = R;
  EXPECT_LE((R24.transpose() * K_turned * R24 - K).norm(), 1e-14 * K.norm());
}

TEST(Hexahedron, EnergyDoesNotDependOnTheNumbering) {
  // A third of a turn about the diagonal through corners 1 and 7 renumbers the corners and keeps the
  // handedness.
  const int renumbered[8] = {0, 3, 7, 4, 1, 2, 6, 5};
  const Hexahedron::Corners corners = distorted_corners();
  const Hexahedron::Corners permuted = corners(Eigen::all, renumbered);
  const Matrix6 D = kPatchMaterial.elasticity();
  const MatrixX K = Hexahedron(corners, 1).stiffness(D), K_permuted = Hexahedron(permuted, 1).stiffness(D);
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b)
      EXPECT_LE(
          (K_permuted.block<3, 3>(3 * a, 3 * b) - K.block<3, 3>(3 * renumbered[a], 3 * renumbered[b])).norm(),
          1e-14 * K.norm());
}

TEST(Hexahedron, TakesUpTheWorkOfUniformPressure) {
  // A box squeezed by p on all faces: corner forces are p times a quarter of the faces, volume change -3 (1 -
  // 2 nu) p / E.
  const HexahedralMesh box = make_block({2, 3, 4}, {1, 1, 1});
  const Hexahedron element = box.element(0);
  const double p = 5, strain = -(1 - 2 * kPatchMaterial.poissons_ratio) * p / kPatchMaterial.youngs_modulus;
  const Hexahedron::Corners corners = box.nodes(Eigen::all, box.elements.col(0));
  const Hexahedron::Corners u = strain * corners;
  const VectorX f = element.stiffness(kPatchMaterial.elasticity()) * u.reshaped();
  for (int a = 0; a < 8; ++a) {
    const Vector3 expected = -p / 4 * Vector3(3 * 4, 2 * 4, 2 * 3).cwiseProduct(corners.col(a).cwiseSign());
    EXPECT_LE((f.segment<3>(3 * a) - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(Hexahedron, DoesNotLockWhenNearlyIncompressible) {
  // Of the modes of a cube, mean dilatation makes only the uniform change of volume stiff as nu tends to 1/2.
  const HexahedralMesh cube = make_block({1, 1, 1}, {1, 1, 1});
  const auto K = cube.element(0).stiffness(IsotropicMaterial{1, 0.5 - 1e-9, 1}.elasticity());
  const VectorX lambda = Eigen::SelfAdjointEigenSolver<MatrixX>(K, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_LE(lambda[22], 10);
  EXPECT_GE(lambda[23], 1e6);
}

TEST(Hexahedron, NamesTheElementThatIsInsideOut) {
  Hexahedron::Corners corners = distorted_corners();
  corners.leftCols<4>().swap(corners.rightCols<4>());
  try {
    Hexahedron(corners, 42);
    FAIL() << "an element inside out was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("element 42"));
    EXPECT_THAT(error.what(), HasSubstr("counterclockwise"));
  }
}

TEST(IsotropicMaterial, IsRejectedOutsideItsRange) {
  EXPECT_THROW((IsotropicMaterial{0, 0.3, 1}).validate(), InputError);
  EXPECT_THROW((IsotropicMaterial{1, 0.5, 1}).validate(), InputError);
  EXPECT_THROW((IsotropicMaterial{1, 0.3, -1}).validate(), InputError);
}

TEST(HexahedralMesh, NumbersTheChassisSectionBySection) {
  // The vehicle's attachment points, in chassis axes.
  const HexahedralMesh mesh = make_block({2.4, 0.4, 0.4}, {4, 1, 1});
  const auto expect_node = [&](int id, double x, double y, double z) {
    EXPECT_EQ(mesh.node_ids[id - 1], id);
    EXPECT_LE((mesh.nodes.col(id - 1) - Vector3(x, y, z)).norm(), 1e-15) << "node " << id;
  };
  expect_node(1, -1.2, -0.2, -0.2);
  expect_node(5, -0.6, -0.2, -0.2);
  expect_node(2, -1.2, 0.2, -0.2);
  expect_node(6, -0.6, 0.2, -0.2);
  expect_node(17, 1.2, -0.2, -0.2);
  expect_node(13, 0.6, -0.2, -0.2);
  expect_node(18, 1.2, 0.2, -0.2);
  expect_node(14, 0.6, 0.2, -0.2);
  expect_node(3, -1.2, 0.2, 0.2);
  expect_node(4, -1.2, -0.2, 0.2);
  expect_node(19, 1.2, 0.2, 0.2);
  expect_node(20, 1.2, -0.2, 0.2);
}

TEST(HexahedralMesh, KeepsVolumeAndFreedomFromGroundWhenRefined) {
  const HexahedralMesh mesh = make_block({2, 3, 5}, {2, 3, 4});
  EXPECT_EQ(mesh.nodes.cols(), 3 * 4 * 5);
  EXPECT_NEAR(lumped_mass(mesh, 0.1).sum(), 3, 1e-14);
  const Eigen::SparseMatrix<double> K = stiffness_matrix(mesh, kPatchMaterial);
  const VectorX shift = Vector3(1, 2, 3).replicate(mesh.nodes.cols(), 1);
  EXPECT_LE((K * shift).norm(), 1e-14 * K.norm() * shift.norm());
}

TEST(HexahedralMesh, RejectsAnEmptyBlock) {
  EXPECT_THROW(make_block({1, 0, 1}, {1, 1, 1}), InputError);
  EXPECT_THROW(make_block({1, 1, 1}, {1, 0, 1}), InputError);
}

}  // namespace
}  // namespace wishbone
