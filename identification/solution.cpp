#include "identification/solution.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "identification/methods/clean_up.h"
#include "identification/methods/joint_support.h"
#include "identification/methods/model_modes.h"
#include "identification/methods/residual.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/spring_support.h"
#include "identification/methods/support_matrices.h"

namespace wishbone {
namespace {

/// A direction whose elastic share of modal mass noise alone would explain counts as rigid.
double least_elastic_share(const std::optional<MeasurementNoise>& noise) {
  constexpr double kOfExactData = 1e-6;
  return noise ? std::max(kOfExactData, 100 * noise->shape * noise->shape) : kOfExactData;
}

VectorX no_bound(Eigen::Index count) {
  return VectorX::Constant(count, std::numeric_limits<double>::quiet_NaN());
}

/// Stiffest support of one node over the stiffest kept mode; zero when nothing was left out.
double ratio_to_kept_stiffness(const SparseMatrix& K_s, const SparseMatrix& M, const Modes& kept) {
  if (kept.count() >= M.rows() || K_s.nonZeros() == 0) return 0;
  double stiffest = 0;  // Gershgorin bound of M^-1 K_s, exact for springs along the axes
  const VectorX mass = M.diagonal();
  for (Eigen::Index j = 0; j < K_s.outerSize(); ++j) {
    double sum = 0;
    for (SparseMatrix::InnerIterator it(K_s, j); it; ++it) sum += std::abs(it.value());
    stiffest = std::max(stiffest, sum / mass[j]);
  }
  return stiffest / kept.lambda.maxCoeff();
}

/// The measured modes and, ahead of them, the rigid motions that springs leave free: modes at zero that no test lists.
Modes with_unheld_motions(const PreparedStructure& s, const Modes& measured, const SparseMatrix& M_t) {
  const Modes unit = mass_normalised(measured, M_t);
  const MatrixX unheld = unheld_motions(s.support, s.rigid);
  if (unheld.cols() == 0) return unit;
  return with_rigid_body_modes(rigid_body_basis(unheld, M_t), unit);
}

/// Free-free elastic modes by the source's steps in physical space, then cleaned up.
void release_in_physical_space(const PreparedStructure& s, const Modes& measured, ReleasedModes& released) {
  const SupportMatrices& support = s.support;
  const Eigen::Index count = released.modes.count();
  Modes found;
  if (support.D.rows() == 0) {
    const SparseMatrix M_t = s.M + support.M_s;
    found = release_from_springs(Space::kPhysical, with_unheld_motions(s, measured, M_t), M_t, support.M_s,
                                 support.K_s);
    found = {found.lambda.segment(s.rigid.cols(), count), found.shapes.middleCols(s.rigid.cols(), count)};
  } else {
    if (support.K_s.nonZeros() > 0 || support.M_s.nonZeros() > 0)
      throw InputError({"identification", "springs or masses beside joints are taken off in modal space only",
                        "space: physical", "take 'space: modal'"});
    found = release_from_joints(measured, s.M, support.D, s.rigid).lowest(count);
  }
  released.modes = cleaned_up(found, s.M, s.rigid);
  released.coefficients.resize(0, 0);
  released.K_shapes.resize(0, 0);
  released.residual = no_bound(count);
}

/// Free-free elastic modes of the structure that was measured.
ReleasedModes free_modes(const IdentificationTask& task, const PreparedStructure& s, const Modes& measured) {
  if (s.data.support.empty()) {
    ReleasedModes given;
    given.modes = cleaned_up(measured, s.M, s.rigid);
    given.K_shapes = s.M * given.modes.shapes * given.modes.lambda.asDiagonal();
    given.coefficients = MatrixX::Identity(measured.count(), measured.count());
    given.residual = no_bound(measured.count());
    return given;
  }
  ReleasedModes released = release(measured, s.M, s.support, s.rigid, least_elastic_share(s.noise));
  if (task.space == Space::kPhysical) release_in_physical_space(s, measured, released);
  return released;
}

/// Puts free-free modes on a support or changes the structure; what has become of the rigid-body modes is among
/// the result. K x stays known for the residual.
void change(const IdentificationTask& task, const PreparedStructure& s, const ReleasedModes& free,
            const ChangeMatrices& d, const SparseMatrix& D, Solution& out) {
  const Modes set = with_rigid_body_modes(s.rigid, free.modes);
  out.support_ratio = std::max(out.support_ratio, ratio_to_kept_stiffness(d.dK, s.M, set));
  out.kept_lambda = set.lambda.maxCoeff();
  out.M = s.M + d.dM;
  out.D = D;
  out.modes = change_structure(task.space, set, s.M, d.dM, d.dK);
  if (D.rows() > 0)
    out.modes = task.space == Space::kModal ? hold_by_joints_null_space(out.modes, out.M, D)
                                            : hold_by_joints_multipliers(out.modes, out.M, D);
  const bool still_free = task.goal == Goal::kChanged;
  if (still_free) {
    const Eigen::Index elastic = out.modes.count() - s.rigid.cols();
    out.modes = {out.modes.lambda.tail(elastic), out.modes.shapes.rightCols(elastic)};
  }
  const bool in_the_set = task.space == Space::kModal || d.dM.nonZeros() == 0;
  if (!in_the_set || free.K_shapes.size() == 0) {
    out.coefficients.resize(0, 0);
    out.residual = no_bound(out.modes.count());
    return;
  }
  const MatrixX C = free.modes.shapes.transpose() * (s.M * out.modes.shapes);
  out.coefficients = free.coefficients * C;
  const MatrixX K_shapes = free.K_shapes * C + d.dK * out.modes.shapes;
  out.residual = relative_residuals(out.modes, K_shapes, out.M, D);
}

void check_holds(const SupportMatrices& target, const MatrixX& rigid) {
  const int held = held_motions(target, rigid);
  if (held < rigid.cols())
    throw InputError({"new support", "it leaves rigid-body motion of the structure free",
                      fmt::format("{} of {} motions are held", held, rigid.cols()),
                      "hold all of them: modes at zero frequency are no modes of a support"});
}

/// The corrected model's own free-free modes.
void correct(const IdentificationTask& task, const PreparedStructure& s, const ReleasedModes& free,
             Solution& out) {
  if (!task.model || task.model->M.rows() != s.M.rows())
    throw InputError({"identification", "a correction needs a model over the freedoms of the modes",
                      task.model ? fmt::format("{} freedoms of the model, {} of the modes",
                                               task.model->M.rows(), s.M.rows())
                                 : std::string("no model"),
                      "give the model's M and K, and expand modes that were measured at fewer points"});
  out.corrected = correct_model(task.model->M, task.model->K, free.modes);
  const Modes all = solve_eigenproblem(out.corrected->K, out.corrected->M);
  const Eigen::Index elastic = all.count() - s.rigid.cols();
  out.modes = {all.lambda.tail(elastic), all.shapes.rightCols(elastic)};
  out.M = out.corrected->M.sparseView();
  out.coefficients.resize(0, 0);
  out.residual = no_bound(elastic);
}

}  // namespace

Solution solve(const IdentificationTask& task, const PreparedStructure& s, const Modes& measured) {
  const ReleasedModes free = free_modes(task, s, measured);
  Solution out;
  out.modes = free.modes;
  out.M = s.M;
  out.D.resize(0, s.M.rows());
  out.residual = free.residual;
  out.kept_lambda = measured.lambda.maxCoeff();
  out.coefficients = free.coefficients;
  out.lost_modes = free.lost_modes;
  out.support_ratio = ratio_to_kept_stiffness(s.support.K_s, s.M, measured);
  const SparseMatrix no_joints(0, s.M.rows());
  switch (task.goal) {
    case Goal::kFree:
      break;
    case Goal::kHeld: {
      const SupportMatrices target = support_matrices(task.support, s.data.freedoms);
      check_holds(target, s.rigid);
      change(task, s, free, {target.M_s, target.K_s}, target.D, out);
      break;
    }
    case Goal::kChanged:
      change(task, s, free, change_matrices(task.change, s.data.freedoms), no_joints, out);
      break;
    case Goal::kCorrected:
      correct(task, s, free, out);
      break;
  }
  if (task.keep && *task.keep < out.modes.count()) {
    out.modes = out.modes.lowest(*task.keep);
    out.residual = VectorX(out.residual.head(*task.keep));
    if (out.coefficients.size() > 0) out.coefficients = MatrixX(out.coefficients.leftCols(*task.keep));
  }
  return out;
}

}  // namespace wishbone
