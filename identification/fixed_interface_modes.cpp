#include "identification/fixed_interface_modes.h"

#include "identification/chosen_modes.h"
#include "identification/methods/model_modes.h"

namespace wishbone {
namespace {

using Eigen::Index;

/// Joints that hold the freedoms.
SupportMatrices held(Index n, const std::vector<int>& freedoms) {
  const auto count = static_cast<Index>(freedoms.size());
  SupportMatrices support{SparseMatrix(n, n), SparseMatrix(n, n), SparseMatrix(count, n)};
  for (Index i = 0; i < count; ++i) support.D.insert(i, freedoms[static_cast<std::size_t>(i)]) = 1;
  support.D.makeCompressed();
  return support;
}

}  // namespace

ChosenModes fixed_interface_modes(const AnalyticalModel& model, const ModeChoice& choice,
                                  const std::vector<int>& freedoms) {
  constexpr const char* kWhich = "modes while its interfaces are held";
  const Index n = model.K.rows();
  const SupportMatrices support = held(n, freedoms);
  const auto count_below = [&](double omega) {
    return model_modes_below(model.K, model.M, support, omega * omega);
  };
  const Index all = n - static_cast<Index>(freedoms.size());
  const Index needed = lowest_needed(choice, all, count_below, kWhich);
  if (needed == 0) return {{VectorX(0), MatrixX(n, 0)}, {}};
  return chosen_modes(choice, model_modes(model.K, model.M, support, needed), kWhich);
}

}  // namespace wishbone
