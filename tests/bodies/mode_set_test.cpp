#include "bodies/mode_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "core/error.h"

namespace wishbone {
namespace {

using ::testing::HasSubstr;

/// Four masses of 1 kg at the corners of the square (+-1, +-1, 0), warped: corners 1 and 3 up, 2 and 4 down.
ModeSet warping_square() {
  ModeSet set;
  set.node_ids = {10, 20, 30, 40};
  set.node_mass = VectorX::Ones(4);
  set.node_position.resize(3, 4);
  set.node_position << 1, -1, -1, 1,  //
      1, 1, -1, -1,                   //
      0, 0, 0, 0;
  set.omega = VectorX::Constant(1, 3.0);
  set.shapes = MatrixX::Zero(12, 1);
  for (int i = 0; i < 4; ++i) set.shapes(3 * i + 2, 0) = i % 2 == 0 ? 0.5 : -0.5;
  set.damping_ratio = VectorX::Zero(1);
  return set;
}

/// What validate() says of the square after a change.
std::string complaint_after(const std::function<void(ModeSet&)>& change) {
  ModeSet set = warping_square();
  change(set);
  try {
    set.validate();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(ModeSet, KnowsMassAndInertia) {
  const ModeSet set = warping_square();
  EXPECT_NO_THROW(set.validate());
  EXPECT_EQ(set.mass(), 4);
  EXPECT_EQ(set.inertia(), Matrix3(Vector3(4, 4, 8).asDiagonal()));
}

TEST(ModeSet, FindsNodesById) {
  EXPECT_EQ(warping_square().node_index(30), 2);
  EXPECT_THROW(warping_square().node_index(3), InputError);
}

TEST(ElasticComplement, CompletesTheMassWeightedRigidMotions) {
  const VectorX mass{{0.3, 2, 7, 1.1, 0.4}};
  Matrix3X position = Matrix3X::NullaryExpr(
      3, 5, [](Eigen::Index i, Eigen::Index j) { return std::sin(1 + 3.7 * i + 1.3 * j * j); });
  position.colwise() -= Vector3(position * mass / mass.sum());
  const VectorX root_mass = mass.transpose().replicate(3, 1).reshaped().cwiseSqrt();
  MatrixX basis(15, 15);
  basis << root_mass.asDiagonal() * rigid_body_modes(mass, position), elastic_complement(mass, position);
  EXPECT_LE((basis.transpose() * basis - MatrixX::Identity(15, 15)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(ModeSet, KeepsItsLowestModes) {
  const ModeSet rigid = warping_square().lowest(0);
  EXPECT_EQ(rigid.mode_count(), 0);
  EXPECT_NO_THROW(rigid.validate());
  EXPECT_THROW(warping_square().lowest(2), InputError);
  EXPECT_THROW(warping_square().lowest(-1), InputError);
}

TEST(ModeSet, NamesWhatIsWrong) {
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.shapes.conservativeResize(9, 1); }),
              HasSubstr("9 x 1 shapes"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.node_ids[1] = 10; }), HasSubstr("node ids"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.node_mass[2] = 0; }), HasSubstr("mass of node 30"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.omega[0] = 0; }), HasSubstr("elastic mode 1"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.damping_ratio[0] = -0.1; }), HasSubstr("damping ratio"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.node_position.row(0).array() += 0.1; }),
              HasSubstr("mass centre"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.node_position.row(1).setZero(); }), HasSubstr("one line"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.shapes *= 1.001; }), HasSubstr("mass-orthonormal"));
  EXPECT_THAT(
      complaint_after([](ModeSet& s) { s.shapes.col(0) = VectorX::Constant(12, std::sqrt(1. / 12)); }),
      HasSubstr("rigid-body motion"));
  EXPECT_THAT(complaint_after([](ModeSet& s) { s.shapes(0, 0) = std::nan(""); }), HasSubstr("finite"));
}

TEST(ModeSet, WantsAscendingFrequencies) {
  EXPECT_THAT(complaint_after([](ModeSet& s) {
                s.omega = Eigen::Vector2d(3, 2);
                s.damping_ratio = Eigen::Vector2d::Zero();
                s.shapes = s.shapes.replicate(1, 2).eval();
              }),
              HasSubstr("ascend"));
}

TEST(RigidBodyModes, AreMassOrthonormalTranslationsAndRotations) {
  const ModeSet set = warping_square();
  const VectorX masses = Eigen::Vector4d(1, 2, 1, 2);  // keeps the mass centre
  const MatrixX modes = rigid_body_modes(masses, set.node_position);
  const VectorX mass = masses.transpose().replicate(3, 1).reshaped();
  EXPECT_LE((modes.transpose() * mass.asDiagonal() * modes - Matrix6::Identity()).cwiseAbs().maxCoeff(),
            1e-15);
  // a rigid motion changes no distance: (u_i - u_j) . (s_i - s_j) = 0
  for (auto mode : modes.colwise())
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) {
        const Vector3 u = mode.segment<3>(3 * i) - mode.segment<3>(3 * j);
        EXPECT_NEAR(u.dot(set.node_position.col(i) - set.node_position.col(j)), 0, 1e-15);
      }
}

}  // namespace
}  // namespace wishbone
