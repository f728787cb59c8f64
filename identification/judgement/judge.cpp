#include "identification/judgement/judge.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "identification/judgement/body_extent.h"
#include "identification/judgement/mac.h"
#include "identification/judgement/mass_products.h"
#include "identification/judgement/reference.h"
#include "identification/methods/clean_up.h"
#include "identification/methods/residual.h"
#include "identification/methods/rigid_modes.h"

namespace wishbone {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

VectorX hertz(const VectorX& omega) {
  return omega / (2 * std::numbers::pi);
}

double condition_number(const MatrixX& symmetric) {
  const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(symmetric, Eigen::EigenvaluesOnly);
  const double smallest = eigen.eigenvalues()[0], largest = eigen.eigenvalues()[symmetric.rows() - 1];
  return smallest > 0 ? largest / smallest : std::numeric_limits<double>::infinity();
}

void list_condition_numbers(const PreparedStructure& s, const Modes& unit, Judgement& judgement) {
  auto& list = judgement.condition_numbers;
  list.emplace_back("Psi^T M Psi of the measured modes",
                    condition_number(unit.shapes.transpose() * (s.M * unit.shapes)));
  if (s.support.D.rows() > 0) {
    const VectorX singular = MatrixX(s.support.D * s.rigid).bdcSvd().singularValues();
    list.emplace_back("D Psi_0 of the joints", singular[0] / singular[singular.size() - 1]);
  }
  const VectorX mass = s.M.diagonal();
  list.emplace_back("diagonal of M", mass.maxCoeff() / mass.minCoeff());
}

/// How far the measured modes are from balancing inertia against the springs: largest |Psi_0^T (lambda M_t psi - K_s
/// psi)| / lambda, zero for exact data.
double imbalance(const PreparedStructure& s, const Modes& unit) {
  const MatrixX F = (s.M + s.support.M_s) * unit.shapes * unit.lambda.asDiagonal();
  const MatrixX forces = s.rigid.transpose() * (F - s.support.K_s * unit.shapes);
  return forces.colwise().norm().transpose().cwiseQuotient(unit.lambda).maxCoeff();
}

std::string mode_list(const std::vector<int>& modes) {
  std::string text;
  for (std::size_t i = 0; i < modes.size(); ++i) text += fmt::format("{}{}", i > 0 ? ", " : "", modes[i]);
  return text;
}

void warn_of_data(const PreparedStructure& s, const Modes& unit, Judgement& judgement) {
  constexpr double kLargeError = 0.1, kLargeImbalance = 0.05;
  if (judgement.input_orthogonality_error > kLargeError)
    judgement.warnings.push_back(fmt::format(
        "the measured modes are not orthogonal in the given masses: largest products {}; check the "
        "masses, the numbering and the directions",
        largest_mass_products(s.data.shapes, s.M + s.support.M_s)));
  const bool on_springs_alone = s.support.D.rows() == 0 && s.support.K_s.nonZeros() > 0;
  if (!on_springs_alone) return;
  if (const double error = imbalance(s, unit); error > kLargeImbalance)
    judgement.warnings.push_back(fmt::format(
        "the measured modes contradict the given springs and masses: inertia and spring forces are out "
        "of balance by {:.1f} %",
        100 * error));
}

/// What was understood of the structure, and whether that can be.
void tell_extent(const PreparedStructure& s, Judgement& judgement) {
  const BodyExtent extent = body_extent(s.data, s.M);
  judgement.notes.push_back("the structure as understood: " + describe(extent));
  if (const auto doubt = doubt_of_units(extent, s.data.omega.size() > 0 ? s.data.omega[0] : 0))
    judgement.warnings.push_back(fmt::format("{} ({}); {}", doubt->what, doubt->value, doubt->remedy));
}

void warn_of_result(const Solution& solution, Judgement& judgement) {
  constexpr double kStiffSupport = 0.3, kLargeError = 0.02;
  if (solution.support_ratio > kStiffSupport)
    judgement.warnings.push_back(fmt::format(
        "the kept modes cannot carry the support: it is {:.2g} times as stiff as the stiffest of them; "
        "keep more modes or use a softer support",
        solution.support_ratio));
  if (solution.lost_modes > 0)
    judgement.warnings.push_back(fmt::format(
        "the support is over-constrained: {} elastic modes cannot be recovered, and the frequencies of "
        "modes that strain the support are too high by an unknown amount",
        solution.lost_modes));
  std::vector<int> poor;
  for (Eigen::Index j = 0; j < judgement.error_estimate.size(); ++j)
    if (judgement.error_estimate[j] > kLargeError) poor.push_back(static_cast<int>(j) + 1);
  if (!poor.empty())
    judgement.warnings.push_back(fmt::format(
        "the measured set is too small for mode{} {}: estimated errors of the frequency above {:.0f} %",
        poor.size() > 1 ? "s" : "", mode_list(poor), 100 * kLargeError));
}

void judge_noise(const IdentificationTask& task, const PreparedStructure& s, const Modes& identified,
                 Judgement& judgement) {
  if (!s.noise) return;
  judgement.frequency_std_hz = frequency_deviation(
      s.measured(), *s.noise, [&](const Modes& measured) { return solve(task, s, measured).modes; });
  judgement.notes.push_back(fmt::format(
      "standard deviations from {} repetitions with {:.3g} % scatter of frequencies and {:.3g} % of shapes "
      "(seed {})",
      s.noise->samples, 100 * s.noise->frequency, 100 * s.noise->shape, s.noise->seed));
  std::vector<int> lost;
  for (Eigen::Index j = 0; j < identified.count(); ++j)
    if (!std::isfinite(judgement.frequency_std_hz[j])) lost.push_back(static_cast<int>(j) + 1);
  if (!lost.empty())
    judgement.warnings.push_back(fmt::format("under this noise mode{} {} cannot be told from others",
                                             lost.size() > 1 ? "s" : "", mode_list(lost)));
}

}  // namespace

Judgement judge(const IdentificationTask& task, const PreparedStructure& s, const Solution& solution,
                const ModalData& modes) {
  Judgement judgement;
  judgement.notes = s.notes;
  judgement.warnings = s.warnings;
  judgement.shape_scatter = s.shape_scatter;
  judgement.input_hz = hertz(s.data.omega);
  judgement.frequency_hz = hertz(modes.omega);
  judgement.residual = solution.residual;
  judgement.error_estimate =
      frequency_error_estimate(solution.modes.lambda, solution.residual, solution.kept_lambda);
  judgement.auto_mac = modal_assurance(modes.shapes, modes.shapes);
  judgement.input_mac = modal_assurance(modes.shapes, s.data.shapes);
  judgement.lost_modes = solution.lost_modes;
  if (task.keep && *task.keep > modes.mode_count())
    judgement.notes.push_back(
        fmt::format("{} modes were to be kept, {} were found", *task.keep, modes.mode_count()));

  const SparseMatrix M_t = s.M + s.support.M_s;
  const Modes unit = mass_normalised(s.measured(), M_t);
  judgement.input_orthogonality_error = orthogonality_error(s.data.shapes, M_t);
  const MatrixX gram = modes.shapes.transpose() * (solution.M * modes.shapes);
  judgement.orthogonality_error = (gram - MatrixX::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
  const bool is_free = task.goal != Goal::kHeld;
  if (is_free) {
    const MatrixX rigid =
        rigid_body_basis(rigid_body_shapes(modes.freedoms, modes.node_ids, modes.node_position), solution.M);
    judgement.rigid_body_error = (rigid.transpose() * (solution.M * modes.shapes)).cwiseAbs().maxCoeff();
  }
  list_condition_numbers(s, unit, judgement);
  tell_extent(s, judgement);
  warn_of_data(s, unit, judgement);
  warn_of_result(solution, judgement);
  judge_noise(task, s, solution.modes, judgement);
  if (task.reference)
    judgement.reference = compare_with_reference(modes, *task.reference, task.reference_name);
  return judgement;
}

}  // namespace wishbone
