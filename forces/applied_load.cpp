#include "forces/applied_load.h"

#include <utility>

#include "core/dual.h"
#include "core/require.h"

namespace wishbone {

AppliedLoad::AppliedLoad(std::string name, MarkerIndex marker, Wrench load, LoadAxes axes)
    : name_(std::move(name)), marker_(marker), load_(std::move(load)), axes_(axes) {
  require(load_.f.allFinite(), name_, "the force must be finite", load_.f.sum(), "give its components in N");
  require(load_.t.allFinite(), name_, "the moment must be finite", load_.t.sum(),
          "give its components in N m");
}

std::vector<MarkerIndex> AppliedLoad::markers() const {
  return {marker_};
}

template <class T>
void AppliedLoad::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  const MarkerStateT<T>& M = input.markers[marker_];
  Vector3T<T> f = load_.f.cast<T>(), t = load_.t.cast<T>();
  if (axes_ == LoadAxes::kMarker) {
    f = M.R_WM * load_.f;
    t = M.R_WM * load_.t;
  }
  output.wrenches[marker_].t += t;
  output.wrenches[marker_].f += f;
  output.power = f.dot(M.v_WM) + t.dot(M.w_WM);
}

template void AppliedLoad::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void AppliedLoad::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
