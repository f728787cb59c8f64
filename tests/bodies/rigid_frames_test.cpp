// Rigid frames against formulations that know no shapes: matrices reduced by u_i = u + phi x r_i, and stiff springs.
#include "bodies/rigid_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "bodies/modal_body.h"
#include "bodies/nodal_shapes.h"
#include "bodies/rayleigh_damping.h"
#include "core/error.h"
#include "flexible_forms.h"
#include "identification/flexible_modes.h"
#include "identification/free_free_modes.h"
#include "identification/nodal_model.h"
#include "identification/spin_stiffening.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr IsotropicMaterial kRubber{1e8, 0.3, 2000};

/// 5 sections of 6 nodes; those of the last are 25 to 30.
Mesh mesh() {
  return make_block({1.2, 0.3, 0.4}, {4, 1, 2});
}
const InterfaceFrame kEnd{"end", {25, 26, 27, 28, 29, 30}, {1, 2, 3, 1, 1, 0.5}};
const InterfaceFrame kStart{"start", {1, 2, 3, 4}, {}};

const ModeSet& all_modes() {
  static const ModeSet set = free_free_modes(mesh(), kRubber);
  return set;
}

/// What the nodes do when those of the frames follow them: x = T (other nodes, u and phi of each frame about the origin of D).
MatrixX following(const std::vector<InterfaceFrame>& frames) {
  const ModeSet& set = all_modes();
  const Eigen::Index n = set.node_count();
  std::vector<int> frame_of(static_cast<std::size_t>(n), -1);
  for (std::size_t f = 0; f < frames.size(); ++f)
    for (const int id : frames[f].node_ids)
      frame_of[static_cast<std::size_t>(set.node_index(id))] = static_cast<int>(f);
  const auto others = std::count(frame_of.begin(), frame_of.end(), -1);
  MatrixX T = MatrixX::Zero(3 * n, 3 * others + 6 * static_cast<Eigen::Index>(frames.size()));
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const int f = frame_of[static_cast<std::size_t>(i)];
    if (f < 0) {
      T.block<3, 3>(3 * i, column).setIdentity();
      column += 3;
    } else {
      T.block<3, 3>(3 * i, 3 * others + 6 * f).setIdentity();
      T.block<3, 3>(3 * i, 3 * others + 6 * f + 3) = -skew(set.node_position.col(i));
    }
  }
  return T;
}

MatrixX stiffness() {
  return MatrixX(stiffness_matrix(mesh(), kRubber));
}
VectorX masses() {
  return mass_of_freedoms(all_modes().node_mass);
}

/// Elastic eigenvalues of a free structure, ascending.
VectorX elastic_eigenvalues(const MatrixX& K, const MatrixX& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(K, M, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().tail(K.rows() - 6);
}

VectorX worst_share(const VectorX& a, const VectorX& b) {
  return (a.cwiseQuotient(b).array() - 1).abs();
}

TEST(RigidFrames, GiveTheFrequenciesOfMatricesThatAreReducedToTheirMotion) {
  for (const auto& frames : {std::vector{kEnd}, {kStart, kEnd}}) {
    const MatrixX T = following(frames);
    const VectorX expected =
        elastic_eigenvalues(T.transpose() * stiffness() * T, T.transpose() * masses().asDiagonal() * T);
    const ShapeSet modal = with_rigid_frames(shapes_of(all_modes()), frames);
    EXPECT_NO_THROW(modal.validate());
    ASSERT_TRUE(modal.has_modes());
    ASSERT_EQ(modal.shape_count(), expected.size());
    EXPECT_LE(worst_share(modal.stiffness.col(0), expected).maxCoeff(), 2e-9);  // of omega^2
    EXPECT_GT(worst_share(modal.stiffness.col(0).head(6), all_modes().omega.head(6).cwiseAbs2()).maxCoeff(),
              0.01)
        << "the frames stiffen the body";

    const NodalModel model = nodal_model(all_modes());
    for (const ShapeSet& nodal : {mean_axis_shapes(model), fixed_axis_shapes(model, {1, 25, 3})}) {
      const ShapeSet set = with_rigid_frames(nodal, frames);
      EXPECT_NO_THROW(set.validate());
      EXPECT_EQ(set.mean_axes, nodal.mean_axes);
      // free motion, whatever the axes: the mass that is left when force and moment vanish
      const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> eigen(
          set.stiffness, flexible_forms::mass_of_free_motion(set), Eigen::EigenvaluesOnly);
      EXPECT_LE(worst_share(eigen.eigenvalues(), expected).maxCoeff(), 2e-9);
    }
  }
}

TEST(RigidFrames, AreTheLimitOfStiffSpringsBetweenTheirNodes) {
  // springs along all lines between the nodes of the last two sections, which do not lie in one plane: the error falls as 1/k
  const ModeSet& set = all_modes();
  const InterfaceFrame block{"block", {19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30}, {}};
  const VectorX rigid = with_rigid_frames(shapes_of(set), {block}).stiffness.col(0).head(8);
  const auto error_at = [&](double k) {
    MatrixX K = stiffness();
    for (const int a : block.node_ids)
      for (const int b : block.node_ids) {
        if (a >= b) continue;
        const int i = set.node_index(a), j = set.node_index(b);
        const Vector3 e = (set.node_position.col(j) - set.node_position.col(i)).normalized();
        VectorX along = VectorX::Zero(K.rows());
        along.segment<3>(3 * i) = -e;
        along.segment<3>(3 * j) = e;
        K += k * along * along.transpose();
      }
    const VectorX found = elastic_eigenvalues(K, MatrixX(masses().asDiagonal())).head(8);
    return worst_share(found, rigid).maxCoeff();
  };
  const double soft = error_at(1e11), stiff = error_at(1e12);
  EXPECT_NEAR(soft / stiff, 10, 0.5);
  EXPECT_LT(stiff, 1e-4);
}

TEST(RigidFrames, KeepTheDistancesOfTheirNodesAndNothingElse) {
  const ShapeSet set = with_rigid_frames(shapes_of(all_modes()), {kEnd});
  const FrameShapes motion = frame_shapes(kEnd, set);
  for (const int id : kEnd.node_ids) {
    const int node = set.node_index(id);
    const Vector3 r = set.node_position.col(node) - motion.origin;
    const Matrix3X expected = motion.translation - skew(r) * motion.rotation;
    EXPECT_LT((set.shapes.middleRows<3>(3 * node) - expected).norm(), 1e-12 * set.shapes.norm());
  }
  EXPECT_EQ(set.shape_count(), all_modes().mode_count() - (3 * 6 - 6));
  // weights place the frame but do not change the body
  const ShapeSet equal = with_rigid_frames(shapes_of(all_modes()), {{"end", kEnd.node_ids, {}}});
  EXPECT_LE(worst_share(set.stiffness.col(0), equal.stiffness.col(0)).maxCoeff(), 1e-11);
}

/// Deflections of a free body under a load, with inertia relief: Phi K^-1 Phi^T f.
VectorX statics(const ShapeSet& set, const VectorX& generalised) {
  return set.shapes * generalised.cwiseQuotient(set.stiffness.col(0));
}

TEST(RigidFrames, BendTheBodyUnderMomentsAsTheReducedMatricesSay) {
  const std::vector<InterfaceFrame> frames{kStart, kEnd};
  const Vector3 t(30, -20, 50);
  // moments t on one frame and -t on the other, in equilibrium
  const MatrixX T = following(frames);
  VectorX load = VectorX::Zero(T.cols());
  load.tail<3>() = t;
  load.segment<3>(T.cols() - 9) = -t;
  const MatrixX rigid = rigid_body_modes(all_modes().node_mass, all_modes().node_position);
  const VectorX x = (T.transpose() * stiffness() * T).completeOrthogonalDecomposition().solve(load);
  VectorX truth = T * x;
  truth -= rigid * (rigid.transpose() * masses().cwiseProduct(truth));

  const auto deflection = [&](const ShapeSet& set) {
    const VectorX generalised =
        frame_shapes(kEnd, set).rotation.transpose() * t - frame_shapes(kStart, set).rotation.transpose() * t;
    return statics(set, generalised);
  };
  const VectorX complete = deflection(with_rigid_frames(shapes_of(all_modes()), frames));
  EXPECT_LE((complete - truth).norm(), 1e-9 * truth.norm());
  const VectorX soft = deflection(shapes_of(all_modes()));
  EXPECT_GT((soft - truth).norm(), 0.02 * truth.norm()) << "the frames matter";

  // few modes and the attachment modes of the nodes of the frames
  AnalyticalModel model;
  model.node_ids = all_modes().node_ids;
  model.node_mass = all_modes().node_mass;
  model.node_position = all_modes().node_position;
  model.K = stiffness_matrix(mesh(), kRubber);
  model.M = lumped_mass_matrix(model.node_mass);
  std::vector<int> nodes = kStart.node_ids;
  nodes.insert(nodes.end(), kEnd.node_ids.begin(), kEnd.node_ids.end());
  const ModeSet few = flexible_modes(model, LowestModes{3}, nodes, {}).set;
  const VectorX reduced = deflection(with_rigid_frames(shapes_of(few), frames));
  EXPECT_LE((reduced - truth).norm(), 1e-9 * truth.norm());
}

TEST(RigidFrames, AreSeenByTheBody) {
  // a frame of the stiffened body turns by phi, and its nodes with it
  const ModalBody body(with_rigid_frames(shapes_of(all_modes()), {kEnd}), {26}, {kEnd});
  ModalBodyState state = body.make_state();
  VectorX z = VectorX::Zero(body.mode_count());
  z.head(6) << 0.3, -0.2, 0.1, 0.2, -0.1, 0.1;
  body.set_position(z.data(), state);
  const Vector3 r = all_modes().node_position.col(25) - frame_shapes(kEnd, body.set()).origin;
  const Vector3 phi = body.interface_turn(1, state).phi;
  EXPECT_GT(phi.norm(), 1e-3);
  EXPECT_LT((state.interface_b.col(0) - state.interface_b.col(1) - r - phi.cross(r)).norm(), 1e-13);
}

TEST(RigidFrames, LeaveProportionalDampingProportional) {
  constexpr RayleighDamping damping{3.0, 2e-4};
  ModeSet modes = all_modes();
  modes.damping_ratio = damping.ratios(modes.omega);
  const ShapeSet set = with_rigid_frames(shapes_of(modes), {kEnd});
  ASSERT_EQ(set.damping.cols(), 1);
  const VectorX expected = damping.mass + damping.stiffness * set.stiffness.col(0).array();
  EXPECT_LE(worst_share(set.damping.col(0), expected).maxCoeff(), 1e-9);
  const ModeSet left = as_modes(set);
  EXPECT_LE((left.damping_ratio - damping.ratios(left.omega)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(RigidFrames, KeepTheDampingOfTheMotionThatIsLeft) {
  // C = M Psi diag(2 zeta omega) Psi^T M of the unstiffened body, over the deflections that the frames allow
  ModeSet modes = all_modes();
  modes.damping_ratio.setConstant(0.02);
  const ShapeSet set = with_rigid_frames(shapes_of(modes), {kEnd});
  const MatrixX expected = set.shapes.transpose() * nodal_model(modes).damping * set.shapes;
  ASSERT_EQ(set.damping.cols(), set.shape_count());
  EXPECT_LE((set.damping - expected).norm(), 1e-11 * expected.norm());
  // as the root of a matrix is concave, no mode has more than the ratio of the free ones
  const VectorX ratio = as_modes(set).damping_ratio;
  EXPECT_LE(ratio.maxCoeff(), 0.02 * (1 + 1e-9));
  EXPECT_GT(ratio.minCoeff(), 0.01);
}

TEST(RigidFrames, AreStiffenedBySpinAsTheShapesTheyAreMadeOf) {
  ShapeSet set = shapes_of(all_modes());
  set.stiffening = spin_stiffening(mesh(), kRubber, all_modes(), {});
  const ShapeSet reduced = with_rigid_frames(set, {kEnd});
  const Eigen::Index m = set.shape_count(), n = reduced.shape_count();
  const MatrixX T = set.shapes.transpose() * masses().asDiagonal() * reduced.shapes;  // z = T z_reduced
  ASSERT_EQ(reduced.stiffening.cols(), 6 * n);
  for (Eigen::Index pair = 0; pair < 6; ++pair) {
    const MatrixX expected = T.transpose() * set.stiffening.middleCols(pair * m, m) * T;
    EXPECT_LT((reduced.stiffening.middleCols(pair * n, n) - expected).norm(), 1e-9 * set.stiffening.norm());
  }
  reduced.validate();
}

TEST(RigidFrames, WithoutFramesChangeNothing) {
  const ShapeSet set = with_rigid_frames(shapes_of(all_modes()), {});
  EXPECT_EQ(set.shapes, all_modes().shapes);
  EXPECT_EQ(set.stiffness, MatrixX(all_modes().omega.cwiseAbs2()));
}

TEST(RigidFrames, AreRefusedWhereNoShapeIsLeft) {
  const ShapeSet few = shapes_of(all_modes().lowest(5));
  EXPECT_EQ(message_of<InputError>([&] { with_rigid_frames(few, {kEnd}); }),
            "frame 'end': error: none of the shapes of the body leaves these nodes at their distances (got 5 "
            "shapes)\n"
            "  keep more modes, among them the attachment modes of the nodes of the frame; a body that is "
            "rigid altogether has 'modes: none'");
  EXPECT_THAT(message_of<InputError>([&] {
                with_rigid_frames(few, {kStart, kEnd});
              }),
              testing::StartsWith("frames 'start', 'end': error: none of the shapes"));
  EXPECT_THAT(message_of<InputError>([&] {
                with_rigid_frames(few, {{"tip", {25, 26, 99}, {}}});
              }),
              testing::HasSubstr("there is no such node (got node 99)"));
}

}  // namespace
}  // namespace wishbone
