#include "forces/applied_load.h"

#include <utility>

#include "core/require.h"

namespace wishbone {

AppliedLoad::AppliedLoad(std::string name, MarkerIndex marker, Wrench load, LoadAxes axes)
    : name_(std::move(name)), marker_(marker), load_(std::move(load)), axes_(axes) {
  require(load_.f.allFinite(), name_, "the force must be finite", load_.f.sum(), "give its components in N");
  require(load_.t.allFinite(), name_, "the moment must be finite", load_.t.sum(),
          "give its components in N m");
}

void AppliedLoad::apply(const ForceInput& input, ForceOutput& output) const {
  const MarkerState& M = input.markers[marker_];
  Wrench load = load_;
  if (axes_ == LoadAxes::kMarker) load = {M.R_WM * load_.t, M.R_WM * load_.f};
  output.wrenches[marker_].t += load.t;
  output.wrenches[marker_].f += load.f;
  output.power = load.f.dot(M.v_WM) + load.t.dot(M.w_WM);
}

}  // namespace wishbone
