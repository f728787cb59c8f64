#include "identification/normal_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "identification/free_free_modes.h"
#include "identification/methods/clean_up.h"
#include "identification/methods/lowest_modes.h"
#include "identification/methods/model_modes.h"
#include "identification/methods/modes_below.h"

namespace wishbone {
namespace {

using Eigen::Index;

constexpr Index kRigid = 6;
constexpr Index kSmall = 600;  // freedoms

/// As many of the lowest modes as hold all that are chosen; of a limit below which there are fewer, some more.
Index lowest_needed(const AnalyticalModel& model, const ModeChoice& choice) {
  const Index elastic = model.K.rows() - kRigid;
  if (const auto* lowest = std::get_if<LowestModes>(&choice)) return lowest->count;
  if (const auto* listed = std::get_if<ListedModes>(&choice))
    return listed->numbers.empty() ? 0 : listed->numbers.back();
  if (const auto* below = std::get_if<ModesBelow>(&choice); below && model.K.rows() > kSmall)
    return std::max<Index>(0, modes_below(model.K, model.M, below->omega * below->omega) - kRigid);
  return elastic;
}

Modes dense_modes(const AnalyticalModel& model) {
  if (model.K.rows() > kMostDenseFreedoms)
    throw InputError({"flexible body", "the model is too large for that many of its modes",
                      fmt::format("{} of at most {} freedoms", model.K.rows(), kMostDenseFreedoms),
                      "choose fewer modes than a quarter of the freedoms"});
  const ModeSet set = free_free_modes(model.node_ids, model.node_mass, model.node_position, MatrixX(model.K));
  return {set.omega.cwiseAbs2(), set.shapes};
}

/// By iteration, which finds the rigid-body modes too: six, and no more, without frequency.
Modes sparse_modes(const AnalyticalModel& model, const MatrixX& rigid, Index count) {
  const Modes found = lowest_modes(model.K, model.M, static_cast<int>(count + kRigid));
  constexpr double kNoFrequency = 1e-6;  // of the lowest elastic eigenvalue
  const double elastic = found.lambda[kRigid];
  if (!(found.lambda.head(kRigid).cwiseAbs().maxCoeff() <= kNoFrequency * elastic))
    throw InputError({"flexible body",
                      "the stiffness must resist every motion but the six of a rigid body, and none of these",
                      fmt::format("eigenvalues {:.3g}, ..., {:.3g}, {:.3g} rad2/s2", found.lambda[0],
                                  found.lambda[kRigid - 1], elastic),
                      "remove supports; look for loose parts or hinges between elements"});
  Modes modes = cleaned_up({found.lambda.tail(count), found.shapes.rightCols(count)}, model.M, rigid);
  fix_signs(modes.shapes);
  return modes;
}

/// The columns of what was computed that are chosen, 0-based.
std::vector<Index> chosen_columns(const ModeChoice& choice, const Modes& modes) {
  std::vector<Index> chosen;
  if (const auto* listed = std::get_if<ListedModes>(&choice)) {
    for (const int number : listed->numbers) {
      if (number < 1 || number > modes.count())
        throw InputError({"flexible body", fmt::format("the body has {} elastic modes", modes.count()),
                          fmt::format("mode {}", number), "list modes that it has"});
      chosen.push_back(number - 1);
    }
    return chosen;
  }
  Index count = modes.count();
  if (const auto* lowest = std::get_if<LowestModes>(&choice)) count = lowest->count;
  if (const auto* below = std::get_if<ModesBelow>(&choice))
    count = (modes.lambda.array() < below->omega * below->omega).count();
  chosen.resize(static_cast<std::size_t>(count));
  std::iota(chosen.begin(), chosen.end(), Index{0});
  return chosen;
}

}  // namespace

Modes normal_modes(const AnalyticalModel& model, const ModeChoice& choice) {
  const Index n = model.K.rows(), needed = lowest_needed(model, choice);
  if (needed > n - kRigid)
    throw InputError({"flexible body", fmt::format("the body has {} elastic modes", n - kRigid),
                      fmt::format("{} wanted", needed), "choose fewer"});
  if (needed == 0) return {VectorX(0), MatrixX(n, 0)};
  const bool dense = n <= kSmall || 4 * (needed + kRigid) >= n;
  const Vector3 centre = model.node_position * model.node_mass / model.node_mass.sum();
  const Modes modes =
      dense ? dense_modes(model)
            : sparse_modes(model, rigid_body_modes(model.node_mass, model.node_position.colwise() - centre),
                           needed);
  const std::vector<Index> chosen = chosen_columns(choice, modes);
  return {modes.lambda(chosen), modes.shapes(Eigen::all, chosen)};
}

}  // namespace wishbone
