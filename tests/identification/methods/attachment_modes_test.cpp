// Static shapes of a structure: attachment modes with inertia relief, constraint modes.
#include "identification/methods/attachment_modes.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/methods/constraint_modes.h"
#include "identification/structures.h"
#include "text_files.h"

namespace wishbone {
namespace {

/// n masses m in a row, springs k between neighbours, along one axis.
struct Chain {
  Chain(int n, double m, double k) : K(n, n), M(diagonal_matrix(VectorX::Constant(n, m))) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i + 1 < n; ++i)
      for (const auto& [row, column, sign] :
           {std::tuple(i, i, 1), {i + 1, i + 1, 1}, {i, i + 1, -1}, {i + 1, i, -1}})
        entries.emplace_back(row, column, sign * k);
    K.setFromTriplets(entries.begin(), entries.end());
    rigid = MatrixX::Constant(n, 1, 1 / std::sqrt(n * m));
  }
  SparseMatrix K, M;
  MatrixX rigid;
};

/// sum_j psi_j psi_ja / lambda_j over all elastic modes.
MatrixX flexibility(const TestStructure& s, const std::vector<int>& freedoms) {
  const Modes modes = s.elastic();
  return modes.shapes * modes.lambda.cwiseInverse().asDiagonal() *
         modes.shapes(freedoms, Eigen::all).transpose();
}

TEST(AttachmentModes, OfAPushedRowOfMassesGrowWithTheMassBehind) {
  // all masses accelerate alike, so the spring behind the i-th of n masses carries f (1 - i/n)
  constexpr int kMasses = 12;
  constexpr double kStiffness = 3e5;
  const Chain chain(kMasses, 0.7, kStiffness);
  const VectorX x = attachment_modes(chain.K, chain.M, chain.rigid, {0});
  for (int i = 1; i < kMasses; ++i)
    EXPECT_NEAR(x[i - 1] - x[i], (1 - i / double(kMasses)) / kStiffness, 1e-14 / kStiffness);
  EXPECT_NEAR(x.sum(), 0, 1e-14 / kStiffness);  // the mass centre stays
}

TEST(AttachmentModes, OfAHeldRowOfSpringsAreItsDeflectionsUnderForces) {
  Chain chain(9, 2, 4e4);
  chain.K.coeffRef(0, 0) += 4e4;  // a spring to the ground
  const MatrixX x = attachment_modes(chain.K, chain.M, MatrixX(9, 0), {8, 3});
  for (int i = 0; i < 9; ++i) {
    EXPECT_NEAR(x(i, 0), (i + 1) / 4e4, 1e-17);
    EXPECT_NEAR(x(i, 1), std::min(i + 1, 4) / 4e4, 1e-17);
  }
}

TEST(AttachmentModes, SumUpAllElasticModes) {
  for (const TestStructure& s : {chassis(), slender_block(), l_shape(), random_lumped(9, 7)}) {
    const std::vector<int> freedoms{0, 4, 8, 17, 25};
    const MatrixX expected = flexibility(s, freedoms);
    EXPECT_LE((attachment_modes(s.K, s.M, s.rigid, freedoms) - expected).norm(), 1e-10 * expected.norm());
  }
}

TEST(AttachmentModes, DeformABodyInEquilibrium) {
  const TestStructure s = distorted_block({4, 2, 3}, 5);
  const std::vector<int> freedoms{1, 30, 31};
  const MatrixX X = attachment_modes(s.K, s.M, s.rigid, freedoms);
  MatrixX F = -(s.M * s.rigid) * s.rigid(freedoms, Eigen::all).transpose();
  for (int a = 0; a < 3; ++a) F(freedoms[a], a) += 1;
  EXPECT_LE((s.K * X - F).norm(), 1e-11 * F.norm());
  EXPECT_LE((s.rigid.transpose() * (s.M * X)).norm(), 1e-12 * std::sqrt(s.node_mass.sum()) * X.norm());
  // reciprocity: what a moves at b, b moves at a
  const MatrixX compliance = X(freedoms, Eigen::all);
  EXPECT_LE((compliance - compliance.transpose()).norm(), 1e-12 * compliance.norm());
}

TEST(AttachmentModes, AreRefusedForStructuresThatAreHeldOrLoose) {
  const TestStructure s = chassis();
  SparseMatrix held = s.K;
  held.coeffRef(2, 2) += 1e6;
  EXPECT_EQ(
      message_of<InputError>([&] { attachment_modes(held, s.M, s.rigid, {0}); }).substr(0, 96),
      "attachment modes: error: the stiffness must not resist rigid-body motion of a free body (got rel");

  Chain loose(8, 1, 1e4);
  for (const auto& [row, column, value] : {std::tuple(3, 3, 1e4), {4, 4, 1e4}, {3, 4, 0.0}, {4, 3, 0.0}})
    loose.K.coeffRef(row, column) = value;
  EXPECT_EQ(
      message_of<InputError>([&] { attachment_modes(loose.K, loose.M, loose.rigid, {0}); }).substr(0, 82),
      "static deflection: error: the stiffness must resist every motion that is not rigid");

  EXPECT_EQ(message_of<InputError>([&] { attachment_modes(s.K, s.M, s.rigid, {60}); }),
            "attachment modes: error: the structure has 60 freedoms (got freedom 61)\n"
            "  name freedoms of the structure");
}

TEST(ConstraintModes, OfARowOfSpringsAreStraightLines) {
  const Chain chain(11, 1, 5e3);
  const MatrixX T = constraint_modes(chain.K, chain.rigid, {0, 10});
  for (int i = 0; i < 11; ++i) {
    EXPECT_NEAR(T(i, 0), 1 - i / 10.0, 1e-13);
    EXPECT_NEAR(T(i, 1), i / 10.0, 1e-13);
  }
}

TEST(ConstraintModes, LeaveInnerFreedomsWithoutForceAndSpanRigidMotion) {
  const TestStructure s = l_shape();
  const std::vector<int> freedoms{0, 1, 2, 12, 13, 14, 60, 61, 62, 63};
  const MatrixX T = constraint_modes(s.K, s.rigid, freedoms);
  MatrixX force = s.K * T;
  EXPECT_LE((T(freedoms, Eigen::all) - MatrixX::Identity(10, 10)).norm(), 1e-15);
  for (const int freedom : freedoms) force.row(freedom).setZero();
  EXPECT_LE(force.norm(), 1e-12 * s.K.norm());
  EXPECT_LE((T * s.rigid(freedoms, Eigen::all) - s.rigid).norm(), 1e-11 * s.rigid.norm());
}

TEST(ConstraintModes, AreRefusedWhereTheInterfacesDoNotHoldTheBody) {
  const TestStructure s = chassis();
  EXPECT_EQ(message_of<InputError>([&] {
              constraint_modes(s.K, s.rigid, {0, 1, 2, 3, 4, 5});
            }),
            "constraint modes: error: the interface nodes must hold the body, for all its other nodes follow "
            "statically (got 5 of 6 rigid motions are held)\n"
            "  name at least three nodes that do not lie on one line, or take attachment modes");
  EXPECT_EQ(message_of<InputError>([&] {
              constraint_modes(s.K, s.rigid, {0, 1, 0});
            }),
            "constraint modes: error: an interface freedom is named twice (got freedom 1)\n"
            "  name each once");
}

}  // namespace
}  // namespace wishbone
