// Frames over several nodes against the definition of a least-squares fit, and the transpose against statics.
#include "bodies/interface_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "bodies/modal_body.h"
#include "core/error.h"
#include "identification/free_free_modes.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

/// Six nodes anywhere, whose deflections are what `shapes` says; nothing else of the set is used.
ShapeSet nodes_with(MatrixX shapes) {
  ShapeSet set;
  set.node_ids = {11, 12, 13, 14, 15, 16};
  set.node_position.resize(3, 6);
  set.node_position << 0.3, -0.2, 0.5, 0.1, -0.4, 0.2,  //
      1.1, 0.9, 1.4, 1.0, 1.2, 0.7,                     //
      -0.1, 0.2, 0.1, -0.3, 0.4, 0.6;
  set.shapes = std::move(shapes);
  return set;
}
const InterfaceFrame kHub{"hub", {15, 11, 13, 12}, {1, 2, 0.5, 4}};
const std::array<int, 4> kColumns{4, 0, 2, 1};  // where its nodes are

VectorX some_numbers(Eigen::Index count, unsigned seed) {
  std::mt19937 generator(seed);
  return VectorX::NullaryExpr(count, [&] { return 2.0 * generator() / std::mt19937::max() - 1; });
}

TEST(InterfaceFrame, FollowsARigidMotionOfItsNodesExactly) {
  const ShapeSet bare = nodes_with(MatrixX::Zero(18, 1));
  MatrixX rigid(18, 6);
  for (int i = 0; i < 6; ++i)
    rigid.middleRows<3>(3 * i) << Matrix3::Identity(), -skew(bare.node_position.col(i));
  const FrameShapes frame = frame_shapes(kHub, nodes_with(rigid));
  // delta = a + phi x s:  u = a + phi x c
  EXPECT_LT((frame.translation.leftCols<3>() - Matrix3::Identity()).norm(), 1e-15);
  EXPECT_LT((frame.translation.rightCols<3>() + skew(frame.origin)).norm(), 1e-15);
  EXPECT_LT(frame.rotation.leftCols<3>().norm(), 1e-14);
  EXPECT_LT((frame.rotation.rightCols<3>() - Matrix3::Identity()).norm(), 1e-14);
}

TEST(InterfaceFrame, FitsTheDeflectionsOfItsNodesInTheLeastSquaresSense) {
  const ShapeSet set = nodes_with(some_numbers(18, 1));
  const FrameShapes frame = frame_shapes(kHub, set);
  const auto misfit = [&](const Vector3& u, const Vector3& phi) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const Vector3 r = set.node_position.col(kColumns[i]) - frame.origin;
      const Vector3 delta = set.shapes.middleRows<3>(3 * kColumns[i]).col(0);
      sum += kHub.weights[i] * (delta - u - phi.cross(r)).squaredNorm();
    }
    return sum;
  };
  const Vector3 u = frame.translation.col(0), phi = frame.rotation.col(0);
  // a quadratic whose differences across the fit vanish is least there
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 e = Vector3::Unit(axis);
    EXPECT_NEAR(misfit(u + e, phi), misfit(u - e, phi), 1e-13);
    EXPECT_NEAR(misfit(u, phi + e), misfit(u, phi - e), 1e-13);
    EXPECT_GT(misfit(u + e, phi), misfit(u, phi));
    EXPECT_GT(misfit(u, phi + e), misfit(u, phi));
  }
}

TEST(InterfaceFrame, SpreadsForceAndMomentOverItsNodesWithTheSameResultants) {
  // shapes of single nodal freedoms: the transpose gives the force on each
  const FrameShapes frame = frame_shapes(kHub, nodes_with(MatrixX::Identity(18, 18)));
  const Vector3 f(3, -7, 2), t(0.4, 1.1, -0.9);
  const VectorX nodal = frame.translation.transpose() * f + frame.rotation.transpose() * t;
  const ShapeSet set = nodes_with(MatrixX::Zero(18, 1));
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector3 f_i = nodal.segment<3>(3 * i);
    force += f_i;
    moment += (set.node_position.col(i) - frame.origin).cross(f_i);
  }
  EXPECT_LT((force - f).norm(), 1e-14);
  EXPECT_LT((moment - t).norm(), 1e-14);
  for (const int column : {3, 5}) EXPECT_EQ(nodal.segment<3>(3 * column), Vector3::Zero());
}

TEST(InterfaceFrame, NeedsThreeNodesThatSpanAPlane) {
  const auto complaint = [](InterfaceFrame frame) -> std::string {
    ShapeSet set = nodes_with(MatrixX::Zero(18, 1));
    set.node_position.col(3) = 0.25 * set.node_position.col(0) + 0.75 * set.node_position.col(1);
    try {
      frame_shapes(frame, set);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(complaint({"hub", {11, 12, 13}, {}}), "no error");
  EXPECT_EQ(complaint({"hub", {11, 12, 14}, {}}),
            "frame 'hub': error: the nodes of a frame must not lie on one line (got nodes 11, 12, 14)\n"
            "  add a node beside the line, or the frame could not follow turns about it");
  EXPECT_EQ(complaint({"hub", {11, 12}, {}}),
            "frame 'hub': error: a frame needs at least three nodes (got 2)\n"
            "  name more nodes, or hold the body at a node");
  EXPECT_THAT(complaint({"hub", {11, 12, 13, 12}, {}}), HasSubstr("must be named once (got node 12)"));
  EXPECT_THAT(complaint({"hub", {11, 12, 17}, {}}), HasSubstr("there is no such node (got node 17)"));
  EXPECT_THAT(complaint({"hub", {11, 12, 13}, {1, 2}}), HasSubstr("there are 2 weights for 3 nodes"));
  EXPECT_THAT(complaint({"hub", {11, 12, 13}, {1, 0, 2}}), HasSubstr("must be positive (got 0)"));
}

TEST(ModalBody, PlacesAndMovesItsFramesAfterItsNodes) {
  const ModeSet modes = free_free_modes(make_block({2.4, 0.4, 0.4}, {4, 1, 1}, ElementType::mean_dilatation),
                                        IsotropicMaterial{2.1e8, 0.3, 2600})
                            .lowest(8);
  const InterfaceFrame end{"end", {17, 18, 19, 20}, {}};
  const ModalBody body(modes, {5}, {end});
  ASSERT_EQ(body.interface_count(), 2);
  EXPECT_FALSE(body.interface_turns(0));
  ASSERT_TRUE(body.interface_turns(1));
  const FrameShapes shapes = frame_shapes(end, shapes_of(modes));
  ModalBodyState state = body.make_state();
  const VectorX z = some_numbers(8, 2), z_rate = some_numbers(8, 3);
  body.set_position(z.data(), state);
  body.set_velocity<double>({1, 2, 3}, z_rate.data(), state);
  EXPECT_LT((state.interface_b.col(1) - shapes.origin - shapes.translation * z).norm(), 1e-14);
  EXPECT_LT((state.interface_delta_dot.col(1) - shapes.translation * z_rate).norm(), 1e-14);
  const Vector3 phi = shapes.rotation * z;
  const FrameTurn& turn = body.interface_turn(1, state);
  EXPECT_GT(phi.norm(), 0.05) << "a turn that is not small [rad]";
  EXPECT_LT((turn.R_BI - rotation_about(phi.normalized(), phi.norm())).norm(), 1e-14);
  const Vector3 w_BI_I = turn.R_BI.transpose() * turn.w_BI;
  EXPECT_LT((rotation_vector_rate_matrix<double>(phi) * w_BI_I - shapes.rotation * z_rate).norm(), 1e-13);
  // the node is where it is without the frame
  const ModalBody alone(modes, {5});
  ModalBodyState expected = alone.make_state();
  alone.set_position(z.data(), expected);
  EXPECT_EQ(state.interface_b.col(0), expected.interface_b.col(0));
}

}  // namespace
}  // namespace wishbone
