#include "identification/methods/released_modes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <limits>

#include "core/error.h"
#include "identification/methods/joint_support.h"
#include "identification/methods/residual.h"

namespace wishbone {
namespace {

constexpr double kUnheld = 1e-9;  // of the motion that is held best

/// What joints and springs do to the rigid motions, row by row; only its null space means something.
MatrixX resistance(const SupportMatrices& support, const MatrixX& rigid) {
  MatrixX held(support.D.rows() + support.K_s.rows(), rigid.cols());
  const MatrixX joints = support.D * rigid, springs = support.K_s * rigid;
  held << joints, springs / std::max(springs.norm(), std::numeric_limits<double>::min());
  return held;
}

/// Joints that leave a rigid motion free hide it from the measurement, unless springs resist it.
void check_holds(const SupportMatrices& support, Eigen::Index held, Eigen::Index rigid) {
  if (support.D.rows() > 0 && held < rigid)
    throw InputError({"support", "the joints leave rigid-body motion of the structure free",
                      fmt::format("{} of {} rigid-body motions are held", held, rigid),
                      "name every joint of the support, or the springs that hold the other motions"});
}

/// Number of independent joint directions, rank D.
int joint_directions(const SparseMatrix& D) {
  if (D.rows() == 0) return 0;
  const MatrixX gram = D * D.transpose();
  return static_cast<int>(Eigen::FullPivLU<MatrixX>(gram).rank());
}

/// K Psi of the free structure, the reactions of the joints from equilibrium (least norm if indeterminate).
MatrixX elastic_forces(const Modes& supported, const SparseMatrix& M, const SupportMatrices& support,
                       const MatrixX& rigid) {
  MatrixX F = (M + support.M_s) * supported.shapes * supported.lambda.asDiagonal();
  F -= support.K_s * supported.shapes;
  if (support.D.rows() == 0) return F;
  // Psi_0^T (F + D^T mu) = 0
  const Eigen::CompleteOrthogonalDecomposition<MatrixX> balance((support.D * rigid).transpose());
  const MatrixX mu = -balance.solve(rigid.transpose() * F);
  return F + support.D.transpose() * mu;
}

/// Orthogonal directions V of the set and the elastic part X of each, scaled to unit modal mass.
struct ElasticPart {
  MatrixX V;  ///< m x k
  MatrixX X;  ///< n x k, (1 - Psi_0 Psi_0^T M) Psi V
};

ElasticPart elastic_part(const MatrixX& shapes, const SparseMatrix& M, const MatrixX& rigid,
                         double least_elastic_share) {
  // Psi L^-T is M-orthonormal; the singular directions of its rigid part P are rigid to the degree sigma
  const Eigen::LLT<MatrixX> L(shapes.transpose() * (M * shapes));
  if (L.info() != Eigen::Success)
    throw InputError(
        {"support", "the given modes must be linearly independent", fmt::format("{} modes", shapes.cols()),
         "leave out modes that were listed twice, and support masses that exceed those of the nodes"});
  const MatrixX basis = L.matrixL().solve(shapes.transpose()).transpose();
  const MatrixX M_rigid = M * rigid;
  const Eigen::JacobiSVD<MatrixX> svd(M_rigid.transpose() * basis, Eigen::ComputeFullV);
  ElasticPart part{L.matrixU().solve(svd.matrixV()), basis * svd.matrixV()};
  // twice: the second pass leaves nothing but rounding even of a direction that was nearly rigid
  for (int pass = 0; pass < 2; ++pass) part.X -= rigid * (M_rigid.transpose() * part.X);

  std::vector<Eigen::Index> kept;
  const VectorX share = modal_masses(part.X, M);
  for (Eigen::Index j = 0; j < share.size(); ++j)
    if (share[j] > least_elastic_share) kept.push_back(j);
  const VectorX scale = share(kept).cwiseSqrt().cwiseInverse();
  return {part.V(Eigen::all, kept) * scale.asDiagonal(), part.X(Eigen::all, kept) * scale.asDiagonal()};
}

/// Leaves out the highest modes as long as they lie 5 % above the highest measured frequency and nothing shows that they
/// are right: of such motions an incomplete set knows nothing.
void leave_out_unknown(double highest_lambda, ReleasedModes& released) {
  constexpr double kAbove = 1.1, kSmallResidual = 0.1;  // both of lambda
  Eigen::Index count = released.modes.count();
  while (count > 1 && released.modes.lambda[count - 1] > kAbove * highest_lambda &&
         !(released.residual[count - 1] <= kSmallResidual))
    --count;
  released.modes = released.modes.lowest(count);
  released.coefficients = MatrixX(released.coefficients.leftCols(count));
  released.K_shapes = MatrixX(released.K_shapes.leftCols(count));
  released.residual = VectorX(released.residual.head(count));
}

}  // namespace

int held_motions(const SupportMatrices& support, const MatrixX& rigid) {
  Eigen::ColPivHouseholderQR<MatrixX> qr;
  qr.setThreshold(kUnheld);
  return static_cast<int>(qr.compute(resistance(support, rigid)).rank());
}

MatrixX unheld_motions(const SupportMatrices& support, const MatrixX& rigid) {
  Eigen::FullPivLU<MatrixX> lu;
  lu.setThreshold(kUnheld);
  lu.compute(resistance(support, rigid));
  if (lu.dimensionOfKernel() == 0) return MatrixX(rigid.rows(), 0);
  return rigid * lu.kernel();
}

ReleasedModes release(const Modes& supported, const SparseMatrix& M, const SupportMatrices& support,
                      const MatrixX& rigid, double least_elastic_share) {
  const Eigen::Index held = held_motions(support, rigid);
  check_holds(support, held, rigid.cols());
  const Modes unit = mass_normalised(supported, M + support.M_s);
  const MatrixX F = elastic_forces(unit, M, support, rigid);
  const ElasticPart part = elastic_part(unit.shapes, M, rigid, least_elastic_share);

  const int held_by_joints = held_rigid_freedoms(support.D, rigid);
  const Eigen::Index sprung = held - held_by_joints;
  const Eigen::Index count = std::min(unit.count() - sprung, part.X.cols());
  if (count < 1)
    throw InputError({"support", "there must be more modes than rigid-body motions on springs",
                      fmt::format("{} modes, {} such motions", unit.count(), sprung), "measure more modes"});

  const MatrixX K_X = part.X.transpose() * F * part.V;
  const Modes small = solve_eigenproblem((K_X + K_X.transpose()) / 2, part.X.transpose() * (M * part.X));
  ReleasedModes released;
  released.modes = {small.lambda.head(count), part.X * small.shapes.leftCols(count)};
  released.coefficients = part.V * small.shapes.leftCols(count);
  const VectorX signs = dominant_signs(released.modes.shapes);
  released.modes.shapes *= signs.asDiagonal();
  released.coefficients *= signs.asDiagonal();
  released.K_shapes = F * released.coefficients;
  const int directions = joint_directions(support.D);
  released.lost_modes = directions - held_by_joints;
  released.residual =
      released.lost_modes > 0
          ? VectorX::Constant(count, std::numeric_limits<double>::quiet_NaN())
          : relative_residuals(released.modes, released.K_shapes, M, SparseMatrix(0, M.rows()));
  const bool is_complete = unit.count() + rigid.cols() - held >= M.rows() - directions;
  if (!is_complete) leave_out_unknown(unit.lambda.maxCoeff(), released);
  return released;
}

}  // namespace wishbone
