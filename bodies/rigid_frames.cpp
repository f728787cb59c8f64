#include "bodies/rigid_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/SVD>

#include "core/error.h"
#include "core/null_space.h"

namespace wishbone {
namespace {

using Eigen::Index;

/// R of one frame: what each of its nodes does beyond the rigid motion of the frame (3k x m).
MatrixX warping(const InterfaceFrame& frame, const ShapeSet& set) {
  const FrameShapes rigid = frame_shapes(frame, set);
  MatrixX R(3 * static_cast<Index>(frame.node_ids.size()), set.shape_count());
  Index row = 0;
  for (const int id : frame.node_ids) {
    const int node = set.node_index(id);
    const Vector3 r = set.node_position.col(node) - rigid.origin;
    R.middleRows<3>(row) = set.shapes.middleRows<3>(3 * node) - rigid.translation + skew(r) * rigid.rotation;
    row += 3;
  }
  return R;
}

MatrixX warping(const std::vector<InterfaceFrame>& frames, const ShapeSet& set) {
  MatrixX R(0, set.shape_count());
  for (const InterfaceFrame& frame : frames) {
    const MatrixX own = warping(frame, set);
    R.conservativeResize(R.rows() + own.rows(), Eigen::NoChange);
    R.bottomRows(own.rows()) = own;
  }
  return R;
}

/// N^T A N of a matrix or of its diagonal.
MatrixX congruent(const MatrixX& A, const MatrixX& N) {
  if (A.cols() == 1) return N.transpose() * A.col(0).asDiagonal() * N;
  return N.transpose() * A * N;
}

/// The diagonal alone where the rest is but rounding.
MatrixX simplified(const MatrixX& A) {
  constexpr double kRounding = 1e-12;  // of the largest entry
  const MatrixX rest = A - MatrixX(A.diagonal().asDiagonal());
  if (rest.cwiseAbs().maxCoeff() <= kRounding * A.cwiseAbs().maxCoeff()) return A.diagonal();
  return A;
}

/// The set in the shapes Phi N, but for its stiffness.
ShapeSet in_basis(const ShapeSet& set, const MatrixX& N) {
  ShapeSet reduced = set;
  reduced.shapes = set.shapes * N;
  reduced.damping = simplified(congruent(set.damping, N));
  reduced.stiffening = stiffening_in(set.stiffening, N);
  return reduced;
}

/// N V and the ascending singular values of K^1/2 N. They are taken instead of the eigenvalues of N^T K N, whose rounding
/// is that of the highest: as K spans ten powers of ten, the lowest would lose as many digits.
struct ModalBasis {
  MatrixX NV;
  VectorX omega;

  ModalBasis(const VectorX& stiffness, const MatrixX& N) {
    const Eigen::BDCSVD<MatrixX> svd(stiffness.cwiseSqrt().asDiagonal() * N, Eigen::ComputeThinV);
    NV = N * svd.matrixV().rowwise().reverse();
    omega = svd.singularValues().reverse();
  }
};

std::string names_of(const std::vector<InterfaceFrame>& frames) {
  std::vector<std::string> names;
  for (const InterfaceFrame& frame : frames) names.push_back("'" + frame.name + "'");
  return fmt::format("frame{} {}", names.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

}  // namespace

ShapeSet with_rigid_frames(const ShapeSet& set, const std::vector<InterfaceFrame>& frames) {
  if (frames.empty()) return set;
  const MatrixX N = null_space(warping(frames, set));
  if (N.cols() == 0)
    throw InputError(
        {names_of(frames), "none of the shapes of the body leaves these nodes at their distances",
         fmt::format("{} shape{}", set.shape_count(), set.shape_count() == 1 ? "" : "s"),
         "keep more modes, among them the attachment modes of the nodes of the frame; a body that is "
         "rigid altogether has 'modes: none'"});
  if (!set.has_modes()) {
    ShapeSet reduced = in_basis(set, N);
    reduced.stiffness = congruent(set.stiffness, N);
    return reduced;
  }
  const ModalBasis modes(set.stiffness.col(0), N);
  ShapeSet reduced = in_basis(set, modes.NV);
  reduced.stiffness = modes.omega.cwiseAbs2();
  return reduced;
}

}  // namespace wishbone
