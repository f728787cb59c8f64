#include "forces/applied_load.h"

#include <utility>

#include "core/require.h"
#include "forces/load_function.h"

namespace wishbone {
namespace {

void check(const std::array<Function, 3>& components, const std::string& element, std::string_view rule,
           std::string_view remedy) {
  for (const Function& component : components)
    if (const auto constant = component.constant())
      require(std::isfinite(*constant), element, rule, *constant, remedy);
}

template <class T>
Vector3T<T> values(const std::array<Function, 3>& components, const ForceInputT<T>& input,
                   const std::string& element) {
  return {load_value(components[0], input, element), load_value(components[1], input, element),
          load_value(components[2], input, element)};
}

}  // namespace

AppliedLoad::AppliedLoad(std::string name, MarkerIndex marker, const Wrench& load, LoadAxes axes)
    : AppliedLoad(std::move(name), marker,
                  LoadComponents{{load.t.x(), load.t.y(), load.t.z()}, {load.f.x(), load.f.y(), load.f.z()}},
                  axes) {}

AppliedLoad::AppliedLoad(std::string name, MarkerIndex marker, LoadComponents load, LoadAxes axes)
    : name_(std::move(name)), marker_(marker), load_(std::move(load)), axes_(axes) {
  check(load_.f, name_, "the force must be finite", "give its components in N");
  check(load_.t, name_, "the moment must be finite", "give its components in N m");
}

template <class Use>
void AppliedLoad::for_each_component(Use use) const {
  for (const auto* components : {&load_.f, &load_.t})
    for (const Function& component : *components) use(component);
}

std::vector<int> AppliedLoad::variables() const {
  std::vector<int> all;
  for_each_component([&](const Function& component) {
    const std::vector<int> used = component.variables();
    all.insert(all.end(), used.begin(), used.end());
  });
  return all;
}

std::vector<double> AppliedLoad::stop_times() const {
  std::vector<double> all;
  for_each_component([&](const Function& component) {
    const std::vector<double> times = component.stop_times();
    all.insert(all.end(), times.begin(), times.end());
  });
  return all;
}

template <class T>
WrenchT<T> AppliedLoad::wrench(const ForceInputT<T>& input) const {
  Vector3T<T> f = values(load_.f, input, name_), t = values(load_.t, input, name_);
  if (axes_ == LoadAxes::kWorld) return {t, f};
  const Matrix3T<T>& R_WM = input.markers[marker_].R_WM;
  return {R_WM * t, R_WM * f};
}

template <class T>
void AppliedLoad::apply(const ForceInputT<T>& input, ForceOutputT<T>& output) const {
  const MarkerStateT<T>& M = input.markers[marker_];
  const auto [t, f] = wrench(input);
  output.wrenches[marker_].t += t;
  output.wrenches[marker_].f += f;
  output.power = f.dot(M.v_WM) + t.dot(M.w_WM);
}

template WrenchT<double> AppliedLoad::wrench(const ForceInputT<double>&) const;
template void AppliedLoad::apply(const ForceInputT<double>&, ForceOutputT<double>&) const;
template void AppliedLoad::apply(const ForceInputT<Dual>&, ForceOutputT<Dual>&) const;

}  // namespace wishbone
