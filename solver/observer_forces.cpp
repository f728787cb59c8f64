#include "solver/loads.h"
#include "solver/observation.h"
#include "solver/observer.h"

namespace wishbone {

using namespace observation;

void Observer::add_forces(const System& system) {
  int x_start = 0;
  for_each_force(system, [&](const auto& element, int index) {
    using Element = std::decay_t<decltype(element)>;
    const int states = element.state_count();
    const auto input = [=](const Sample& s) {
      return force_input(s.state.t, s.state.x, x_start, states, index, s.ws);
    };
    if constexpr (std::is_same_v<Element, SpringDamper>) {
      const std::string path = "/forces/" + element.name();
      add(path + "/length", {}, "m", "", "distance of the end points",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).length; });
      add(path + "/rate", {}, "m/s", "", "rate of change of the length",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).rate; });
      add(path + "/force", {}, "N", "", "force, positive in tension",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).force; });
    } else if constexpr (std::is_same_v<Element, AppliedLoad>) {
      const std::string path = "/loads/" + element.name();
      add(path + "/force", {3}, "N", kWorld, "on the body, at the point of the load",
          [input, &element](const Sample& s, double* out) { put(element.output(input(s)).f, out); });
      add(path + "/moment", {3}, "N m", kWorld, "on the body, about the point of the load",
          [input, &element](const Sample& s, double* out) { put(element.output(input(s)).t, out); });
    } else if constexpr (requires { element.gauge(); }) {
      const bool angle = element.gauge().is_angle();
      const std::string path = "/forces/" + element.name();
      add(path + "/value", {}, angle ? "rad" : "m", "", "joint coordinate",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).value; });
      add(path + "/force", {}, angle ? "N m" : "N", "", "along the coordinate, positive lets it grow",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).force; });
    } else if constexpr (std::is_same_v<Element, Tire>) {
      const std::string path = "/tires/" + element.name();
      add(path + "/force", {3}, "N", "contact axes ux uy uz", "on the wheel, at the contact point",
          [input, &element](const Sample& s, double* out) { put(element.output(input(s)).force, out); });
      add(path + "/moment", {3}, "N m", "contact axes ux uy uz", "on the wheel, about the contact point",
          [input, &element](const Sample& s, double* out) { put(element.output(input(s)).moment, out); });
      add(path + "/slip_ratio", {}, "1", "", "positive when braking",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).slip_ratio; });
      add(path + "/slip_angle", {}, "rad", "", "positive when the wheel slips to its left",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).slip_angle; });
      add(path + "/camber", {}, "rad", "", "positive when the top leans to the left",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).camber; });
      add(path + "/deflection", {}, "m", "", "radial deflection, negative in the air",
          [input, &element](const Sample& s, double* out) { *out = element.output(input(s)).deflection; });
    }
    x_start += states;
  });
}

}  // namespace wishbone
