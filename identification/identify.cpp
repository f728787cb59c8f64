#include "identification/identify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "core/version.h"
#include "identification/judgement/judge.h"
#include "identification/judgement/sensor_faults.h"
#include "identification/methods/stiffness_from_modes.h"
#include "identification/solution.h"

namespace wishbone {
namespace {

std::string goal_text(const IdentificationTask& task) {
  switch (task.goal) {
    case Goal::kFree:
      return "free-free modes";
    case Goal::kHeld:
      return fmt::format("modes on a support of {} springs and {} joints", task.support.springs.size(),
                         task.support.joints.size());
    case Goal::kChanged:
      return fmt::format("free-free modes after a design change ({} masses, {} springs{})",
                         task.change.masses.size(), task.change.springs.size(),
                         task.change.dM || task.change.dK ? ", matrices" : "");
    case Goal::kCorrected:
      break;
  }
  return "free-free modes of the corrected model";
}

std::string what_was_done(const IdentificationTask& task, const PreparedStructure& s,
                          const Solution& solution) {
  const Support& support = s.data.support;
  const Eigen::Index complete = s.M.rows() - s.support.D.rows();
  const std::string held =
      support.empty() ? std::string("a free structure")
                      : fmt::format("a support of {} springs, {} joints and {} masses",
                                    support.springs.size(), support.joints.size(), support.masses.size());
  return fmt::format(
      "{} {} from {} measured modes ({}complete set) of {} freedoms on {}, in {} space; wishbone {}",
      solution.modes.count(), goal_text(task), s.data.mode_count(),
      s.data.mode_count() < complete - (support.empty() ? s.rigid.cols() : 0) ? "in" : "",
      s.data.freedom_count(), held, task.space == Space::kModal ? "modal" : "physical", kVersion);
}

/// zeta_k = sum_j c_jk^2 zeta_j omega_j / omega_k: what the damping of the measured modes, that of their support
/// included, does to their combinations. Zero where modes are no combinations of measured ones.
VectorX damping_ratios(const PreparedStructure& s, const Solution& solution, const VectorX& omega) {
  if (solution.coefficients.size() == 0) return VectorX::Zero(omega.size());
  const VectorX rates = s.data.damping_ratio.cwiseProduct(s.data.omega);
  return (solution.coefficients.cwiseAbs2().transpose() * rates).cwiseQuotient(omega);
}

/// True when the masses of a corrected model are those of its nodes: modes that were cleaned up in them change none.
bool has_masses_of_its_nodes(const CorrectedModel& corrected, const VectorX& node_mass) {
  constexpr double kRounding = 1e-9;
  return (corrected.M - MatrixX(lumped_mass_matrix(node_mass))).cwiseAbs().maxCoeff() <=
         kRounding * node_mass.maxCoeff();
}

/// Lumped masses of the identified structure; none where they are not lumped.
VectorX masses_of_nodes(const IdentificationTask& task, const ModalData& data, const Solution& solution) {
  VectorX mass = data.node_mass;
  if (mass.size() > 0 && solution.corrected && !has_masses_of_its_nodes(*solution.corrected, mass)) return {};
  if (task.goal != Goal::kChanged || mass.size() == 0) return mass;
  if (task.change.dM) return {};  // no longer lumped, for all that is known
  for (const Support::Mass& change : task.change.masses) mass[data.node_index(change.node)] += change.mass;
  return mass;
}

/// A negative stiffness is first of all the fault of odd sensors, where there are some.
std::string remedy_of_no_stiffness(const std::vector<std::string>& sensor_doubts) {
  if (!sensor_doubts.empty())
    return fmt::format("correct what is odd in the measurement: {}", fmt::join(sensor_doubts, "; "));
  return "check the stiffness of the support, for no more can be taken off than the modes were measured on; "
         "expand fewer modes, if they were expanded";
}

ModalData as_modal_data(const IdentificationTask& task, const PreparedStructure& s,
                        const Solution& solution) {
  const Eigen::Index m = solution.modes.count();
  if (!(solution.modes.lambda.minCoeff() > 0))
    throw InputError({"identification", "an identified mode has no stiffness",
                      fmt::format("lambda = {:.3g} rad2/s2", solution.modes.lambda.minCoeff()),
                      remedy_of_no_stiffness(doubts_of_sensors(task.measured))});
  ModalData modes = s.data;
  modes.title = task.title;
  modes.node_mass = masses_of_nodes(task, s.data, solution);
  modes.omega = solution.modes.lambda.cwiseSqrt();
  modes.shapes = solution.modes.shapes;
  modes.modal_mass = VectorX::Ones(m);
  modes.damping_ratio = damping_ratios(s, solution, modes.omega);
  modes.support = task.goal == Goal::kHeld ? task.support : Support{};
  modes.provenance.push_back(what_was_done(task, s, solution));
  return modes;
}

}  // namespace

CorrectedModel identified_matrices(const Identification& identification) {
  if (identification.corrected) return *identification.corrected;
  const Modes modes{identification.modes.omega.cwiseAbs2(), identification.modes.shapes};
  return {MatrixX(identification.M), stiffness_from_modes(modes, identification.M)};
}

Identification identify(const IdentificationTask& task) {
  PreparedStructure structure = prepare(task);
  for (std::string& doubt : doubts_of_sensors(task.measured)) structure.warnings.push_back(std::move(doubt));
  Solution solution = solve(task, structure, structure.measured());
  Identification result;
  result.title = task.title;
  result.input = structure.data;
  result.modes = as_modal_data(task, structure, solution);
  result.judgement = judge(task, structure, solution, result.modes);
  result.judgement.notes.push_back(result.modes.provenance.back());
  result.M = std::move(solution.M);
  result.corrected = std::move(solution.corrected);
  return result;
}

}  // namespace wishbone
