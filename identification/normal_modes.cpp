#include "identification/normal_modes.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "identification/chosen_modes.h"
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
constexpr const char* kWhich = "elastic modes";

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

}  // namespace

ChosenModes normal_modes(const AnalyticalModel& model, const ModeChoice& choice) {
  const Index n = model.K.rows();
  const auto count_below = [&](double omega) {
    // of a small model all are computed anyway
    if (n <= kSmall) return n - kRigid;
    return std::max<Index>(0, modes_below(model.K, model.M, omega * omega) - kRigid);
  };
  const Index needed = lowest_needed(choice, n - kRigid, count_below, kWhich);
  if (needed == 0) return {{VectorX(0), MatrixX(n, 0)}, {}};
  const bool dense = n <= kSmall || 4 * (needed + kRigid) >= n;
  const Vector3 centre = model.node_position * model.node_mass / model.node_mass.sum();
  const Modes modes =
      dense ? dense_modes(model)
            : sparse_modes(model, rigid_body_modes(model.node_mass, model.node_position.colwise() - centre),
                           needed);
  return chosen_modes(choice, modes, kWhich);
}

}  // namespace wishbone
