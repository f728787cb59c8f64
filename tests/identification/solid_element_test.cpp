// Laws that any displacement element must keep, on the patch of R. H. MacNeal and R. L. Harder, "A proposed
// standard set of problems to test finite element accuracy", Finite Elements in Analysis and Design 1, 1985.

#include "identification/elements/solid_element.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "identification/elements/mesh.h"

namespace wishbone {
namespace {

using ::testing::HasSubstr;

constexpr IsotropicMaterial kPatchMaterial{1e6, 0.25, 1.0};

/// Unit cube with an inner hexahedron (columns 8..15) joined to the six faces by one element each.
Mesh hexahedral_patch(ElementType type) {
  Mesh mesh;
  mesh.type = type;
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

/// Unit cube of twelve tetrahedra that meet at a point inside.
Mesh tetrahedral_patch() {
  Mesh mesh = hexahedral_patch(ElementType::incompatible_modes);
  const Eigen::MatrixXi cube = mesh.elements.leftCols<6>();
  mesh.nodes = Matrix3X(mesh.nodes.leftCols<9>());
  mesh.node_ids.resize(9);
  mesh.elements.resize(4, 12);
  for (int f = 0; f < 6; ++f) {
    mesh.elements.col(2 * f) << cube(0, f), cube(1, f), cube(2, f), 8;
    mesh.elements.col(2 * f + 1) << cube(0, f), cube(2, f), cube(3, f), 8;
  }
  return with_middle_nodes(mesh, ElementType::tetrahedron10);
}

Mesh patch(ElementType type) {
  if (type == ElementType::tetrahedron10) return tetrahedral_patch();
  if (type == ElementType::hexahedron20)
    return with_middle_nodes(hexahedral_patch(ElementType::incompatible_modes));
  return hexahedral_patch(type);
}

/// u = 1e-3 (2x+y+z, x+2y+z, x+y+2z) / 2: every strain component is 1e-3.
Matrix3X constant_strain_field(const Matrix3X& x) {
  return 0.5e-3 * (Matrix3::Ones() + Matrix3::Identity()) * x;
}

/// Displacements of all nodes when those on the surface of the cube are moved as the field says and the inner ones are free.
Matrix3X patch_solution(const Mesh& mesh) {
  const MatrixX K = MatrixX(stiffness_matrix(mesh, kPatchMaterial));
  VectorX u = constant_strain_field(mesh.nodes).reshaped();
  std::vector<int> inner, outer;
  for (int i = 0; i < mesh.nodes.size(); ++i) {
    const Vector3 x = mesh.nodes.col(i / 3);
    (x.minCoeff() > 0 && x.maxCoeff() < 1 ? inner : outer).push_back(i);
  }
  const VectorX pull = K(inner, outer) * u(outer), moved = MatrixX(K(inner, inner)).llt().solve(pull);
  u(inner) = -moved;
  return u.reshaped(3, mesh.nodes.cols());
}

/// One element that is no box.
SolidElement distorted(ElementType type, const Matrix3& R = Matrix3::Identity()) {
  Mesh mesh = patch(type);
  mesh.nodes = Matrix3X(R * mesh.nodes);
  return mesh.element(static_cast<int>(mesh.elements.cols()) - 1, kPatchMaterial.elasticity());
}

Matrix3X nodes_of_distorted(ElementType type) {
  const Mesh mesh = patch(type);
  return mesh.nodes(Eigen::all, mesh.elements.col(mesh.elements.cols() - 1));
}

Matrix3 some_rotation() {
  return Eigen::AngleAxisd(1.1, Vector3(1, 2, -3).normalized()).toRotationMatrix();
}

class EveryElement : public testing::TestWithParam<ElementType> {};

TEST_P(EveryElement, PassesThePatchTest) {
  const Mesh mesh = patch(GetParam());
  const Matrix3X u = patch_solution(mesh), exact = constant_strain_field(mesh.nodes);
  EXPECT_LE((u - exact).norm() / exact.norm(), 1e-11);

  Vector6 stress;
  stress << 2000, 2000, 2000, 400, 400, 400;
  const std::vector<Vector3> places =
      GetParam() == ElementType::tetrahedron10
          ? std::vector<Vector3>{{0.25, 0.25, 0.25}, {0.7, 0.1, 0.1}, {0, 0, 0}}
          : std::vector<Vector3>{{0, 0, 0}, {0.5, -0.7, 0.3}, {-1, 1, 1}};
  for (int e = 0; e < mesh.elements.cols(); ++e) {
    const SolidElement element = mesh.element(e, kPatchMaterial.elasticity());
    const VectorX u_e = u(Eigen::all, mesh.elements.col(e)).reshaped();
    for (const Vector3& xi : places) {
      const Vector6 strain = element.strain_operator(xi) * u_e;
      EXPECT_LE((strain - Vector6::Constant(1e-3)).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_LE((kPatchMaterial.elasticity() * strain - stress).cwiseAbs().maxCoeff(), 1e-10 * 2000);
    }
  }
}

TEST_P(EveryElement, FillsThePatchWithItsMass) {
  const VectorX mass = lumped_mass(patch(GetParam()), 3.0);
  EXPECT_NEAR(mass.sum(), 3.0, 1e-14);
  EXPECT_GT(mass.minCoeff(), 0);
}

TEST_P(EveryElement, HasSixZeroEnergyModes) {
  const MatrixX K = distorted(GetParam()).stiffness();
  const VectorX lambda = Eigen::SelfAdjointEigenSolver<MatrixX>(K, Eigen::EigenvaluesOnly).eigenvalues();
  const double largest = lambda[lambda.size() - 1];
  EXPECT_LE(lambda.head(6).cwiseAbs().maxCoeff(), 1e-13 * largest);
  EXPECT_GE(lambda[6], 1e-4 * largest);
}

TEST_P(EveryElement, DoesNotResistRigidMotion) {
  const MatrixX K = distorted(GetParam()).stiffness();
  const Matrix3X nodes = nodes_of_distorted(GetParam()), turned = skew(Vector3(1, -2, 0.5)) * nodes;
  EXPECT_LE((K * turned.reshaped()).norm(), 1e-13 * K.norm() * turned.norm());
  const VectorX shift = Vector3(1, 2, 3).replicate(nodes.cols(), 1);
  EXPECT_LE((K * shift).norm(), 1e-13 * K.norm() * shift.norm());
}

TEST_P(EveryElement, EnergyDoesNotDependOnTheFrame) {
  // K R u = R K u with R the rotation of every node: elasticity of the element is isotropic.
  const Matrix3 R = some_rotation();
  const MatrixX K = distorted(GetParam()).stiffness(), K_turned = distorted(GetParam(), R).stiffness();
  MatrixX R_all = MatrixX::Zero(K.rows(), K.rows());
  for (Eigen::Index a = 0; a < K.rows(); a += 3) R_all.block<3, 3>(a, a) = R;
  EXPECT_LE((R_all.transpose() * K_turned * R_all - K).norm(), 1e-13 * K.norm());
}

TEST_P(EveryElement, HasTheMassOfItsMotionInside) {
  // all points move by (1, 2, 3): |u|^2 V
  const SolidElement element = distorted(GetParam());
  const VectorX shift = Vector3(1, 2, 3).replicate(element.geometry().node_count(), 1);
  EXPECT_NEAR(shift.dot(element.displacement_products() * shift), 14 * element.geometry().volume(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryElement,
                         testing::Values(ElementType::incompatible_modes, ElementType::mean_dilatation,
                                         ElementType::hexahedron20, ElementType::tetrahedron10));

TEST(Hexahedron, EnergyDoesNotDependOnTheNumbering) {
  // A third of a turn about the diagonal through corners 1 and 7 renumbers the corners and keeps the
  // handedness.
  const int renumbered[8] = {0, 3, 7, 4, 1, 2, 6, 5};
  for (const ElementType type : {ElementType::incompatible_modes, ElementType::mean_dilatation}) {
    const Matrix3X corners = nodes_of_distorted(type), permuted = corners(Eigen::all, renumbered);
    const Matrix6 D = kPatchMaterial.elasticity();
    const MatrixX K = SolidElement(type, corners, D, 1).stiffness(),
                  K_permuted = SolidElement(type, permuted, D, 1).stiffness();
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
        EXPECT_LE((K_permuted.block<3, 3>(3 * a, 3 * b) - K.block<3, 3>(3 * renumbered[a], 3 * renumbered[b]))
                      .norm(),
                  1e-13 * K.norm());
  }
}

TEST(Hexahedron, TakesUpTheWorkOfUniformPressure) {
  // A box squeezed by p on all faces: corner forces are p times a quarter of the faces, volume change -3 (1 -
  // 2 nu) p / E.
  const Mesh box = make_block({2, 3, 4}, {1, 1, 1});
  const double p = 5, strain = -(1 - 2 * kPatchMaterial.poissons_ratio) * p / kPatchMaterial.youngs_modulus;
  const Matrix3X corners = box.nodes(Eigen::all, box.elements.col(0));
  const Matrix3X u = strain * corners;
  const VectorX f = box.element(0, kPatchMaterial.elasticity()).stiffness() * u.reshaped();
  for (int a = 0; a < 8; ++a) {
    const Vector3 expected = -p / 4 * Vector3(3 * 4, 2 * 4, 2 * 3).cwiseProduct(corners.col(a).cwiseSign());
    EXPECT_LE((f.segment<3>(3 * a) - expected).norm(), 1e-12 * expected.norm());
  }
}

TEST(Hexahedron, DoesNotLockWhenNearlyIncompressible) {
  // Of the modes of a cube, mean dilatation makes only the uniform change of volume stiff as nu tends to 1/2.
  const Mesh cube = make_block({1, 1, 1}, {1, 1, 1}, ElementType::mean_dilatation);
  const MatrixX K = cube.element(0, IsotropicMaterial{1, 0.5 - 1e-9, 1}.elasticity()).stiffness();
  const VectorX lambda = Eigen::SelfAdjointEigenSolver<MatrixX>(K, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_LE(lambda[22], 10);
  EXPECT_GE(lambda[23], 1e6);
}

TEST(Hexahedron, NamesTheElementThatIsInsideOut) {
  Matrix3X corners = nodes_of_distorted(ElementType::incompatible_modes);
  corners.leftCols<4>().swap(corners.rightCols<4>());
  try {
    ElementGeometry(ElementType::incompatible_modes, corners, 42);
    FAIL() << "an element inside out was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("element 42"));
    EXPECT_THAT(error.what(), HasSubstr("counterclockwise"));
  }
}

// Gmsh and VTK swap the last two nodes of a tetrahedron, and number the edges of a hexahedron otherwise.
TEST(QuadraticElements, RefuseNodesInAnotherOrder) {
  Matrix3X nodes = nodes_of_distorted(ElementType::tetrahedron10);
  nodes.col(8).swap(nodes.col(9));
  try {
    ElementGeometry(ElementType::tetrahedron10, nodes, 7);
    FAIL() << "nodes out of order were accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("element 7: error: its node 9 must lie near the middle between its nodes 2 and 4"));
    EXPECT_THAT(error.what(), HasSubstr("C3D10"));
  }
}

TEST(QuadraticElements, HaveTheLumpsOfHintonRockAndZienkiewicz) {
  // of a tetrahedron int N^2: corners 1/420, middles 16/2520 (times 6 V)
  const VectorX of_tetrahedron = distorted(ElementType::tetrahedron10).geometry().mass_shares();
  for (int a = 0; a < 10; ++a) EXPECT_NEAR(of_tetrahedron[a], a < 4 ? 1.0 / 36 : 4.0 / 27, 1e-14) << a;
  // of a box: products of integrals over the axes
  const Mesh box = with_middle_nodes(make_block({2, 3, 4}, {1, 1, 1}));
  const VectorX shares = box.geometry(0).mass_shares();
  EXPECT_NEAR(shares[8], 16 * shares[0] / 7, 1e-14);
  EXPECT_NEAR(8 * shares[0] + 12 * shares[8], 1, 1e-14);
}

/// Deflection of one end of a bar against the other, which is held flat but may contract, over that of Timoshenko's beam under the
/// same force.
double cantilever_ratio(const Mesh& mesh, const Vector3& size) {
  constexpr IsotropicMaterial steel{210e9, 0.3, 7850};
  const MatrixX K = MatrixX(stiffness_matrix(mesh, steel));
  const auto at = [&](int row, int axis, double side) {
    return std::abs(mesh.nodes(axis, row / 3) - side * size[axis] / 2) < 1e-9;
  };
  std::vector<int> free, root, tip;
  for (int i = 0; i < mesh.nodes.size(); ++i) {
    const bool corner_below = at(i, 0, -1) && at(i, 1, -1) && at(i, 2, -1),
               beside_it = at(i, 0, -1) && at(i, 1, 1) && at(i, 2, -1);
    const bool held = (i % 3 == 0 && at(i, 0, -1)) || corner_below || (i % 3 == 2 && beside_it);
    if (!held) free.push_back(i);
    if (i % 3 == 2 && at(i, 0, -1)) root.push_back(i);
    if (i % 3 == 2 && at(i, 0, 1)) tip.push_back(i);
  }
  VectorX f = VectorX::Zero(K.rows()), u = f;
  f(tip).setConstant(1.0 / static_cast<double>(tip.size()));
  const VectorX load = f(free), deflection = MatrixX(K(free, free)).llt().solve(load);
  u(free) = deflection;
  const double L = size.x(), area = size.y() * size.z(), I = area * size.z() * size.z() / 12, nu = 0.3;
  const double shear = (12 + 11 * nu) / (10 * (1 + nu)) * L * 2 * (1 + nu) / (210e9 * area);
  return (u(tip).mean() - u(root).mean()) / (L * L * L / (3 * 210e9 * I) + shear);
}

// F L^3/(3 E I) and the deflection by shear [Cowper 1966]: two percent with one element across, one with two.
TEST(Cantilever, BendsAsABeamWithFewElementsAcross) {
  const Vector3 size(1, 0.03, 0.03);
  for (const int along : {5, 10, 40}) {
    EXPECT_NEAR(cantilever_ratio(make_block(size, {along, 1, 1}), size), 1, 0.02) << along;
    EXPECT_NEAR(cantilever_ratio(with_middle_nodes(make_block(size, {along, 1, 1})), size), 1, 0.02) << along;
  }
  EXPECT_NEAR(cantilever_ratio(make_block(size, {10, 2, 2}), size), 1, 0.01);
  // refinement along x changes nothing
  EXPECT_NEAR(cantilever_ratio(make_block(size, {80, 1, 1}), size),
              cantilever_ratio(make_block(size, {20, 1, 1}), size), 3e-3);
  // what the source's element makes of it: locked where it is long, yielding where it is short
  EXPECT_LT(cantilever_ratio(make_block(size, {4, 1, 1}, ElementType::mean_dilatation), size), 0.1);
  EXPECT_GT(cantilever_ratio(make_block(size, {80, 1, 1}, ElementType::mean_dilatation), size), 1.5);
}

// The boxes of a block, each cut into six tetrahedra around a diagonal.
TEST(Cantilever, BendsAsABeamWithTetrahedra) {
  const Vector3 size(1, 0.03, 0.03);
  const Mesh block = make_block(size, {12, 1, 1});
  constexpr int kPaths[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  Mesh corners{block.node_ids, block.nodes, Eigen::MatrixXi(4, 6 * block.elements.cols()), {}};
  for (int e = 0; e < block.elements.cols(); ++e)
    for (int t = 0; t < 6; ++t)
      for (int a = 0; a < 4; ++a) corners.elements(a, 6 * e + t) = block.elements(kPaths[t][a], e);
  EXPECT_NEAR(cantilever_ratio(with_middle_nodes(corners, ElementType::tetrahedron10), size), 1, 0.02);
}

TEST(IsotropicMaterial, IsRejectedOutsideItsRange) {
  EXPECT_THROW((IsotropicMaterial{0, 0.3, 1}).validate(), InputError);
  EXPECT_THROW((IsotropicMaterial{1, 0.5, 1}).validate(), InputError);
  EXPECT_THROW((IsotropicMaterial{1, 0.3, -1}).validate(), InputError);
}

TEST(Block, NumbersTheChassisSectionBySection) {
  // The vehicle's attachment points, in chassis axes.
  const Mesh mesh = make_block({2.4, 0.4, 0.4}, {4, 1, 1});
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

TEST(Block, KeepsVolumeAndFreedomFromGroundWhenRefined) {
  const Mesh mesh = make_block({2, 3, 5}, {2, 3, 4});
  EXPECT_EQ(mesh.nodes.cols(), 3 * 4 * 5);
  EXPECT_NEAR(lumped_mass(mesh, 0.1).sum(), 3, 1e-14);
  const Eigen::SparseMatrix<double> K = stiffness_matrix(mesh, kPatchMaterial);
  const VectorX shift = Vector3(1, 2, 3).replicate(mesh.nodes.cols(), 1);
  EXPECT_LE((K * shift).norm(), 1e-14 * K.norm() * shift.norm());
}

TEST(Block, RejectsAnEmptyBlock) {
  EXPECT_THROW(make_block({1, 0, 1}, {1, 1, 1}), InputError);
  EXPECT_THROW(make_block({1, 1, 1}, {1, 0, 1}), InputError);
}

}  // namespace
}  // namespace wishbone
