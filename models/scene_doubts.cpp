#include "models/scene_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/units.h"
#include "identification/identify.h"
#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

/// Sound is faster than in diamond, or slower than a walk in jelly: E or the density is in another unit [m/s].
constexpr double kSlowestSound = 10, kFastestSound = 2e4;
constexpr double kMostGravity = 300;                          // of the sun, 274 [m/s2]
constexpr double kMostDamping = 1;                            // critical
constexpr double kLongestDrive = 7200;                        // of a vehicle [s]
constexpr double kThinnestWheel = 1. / 30, kWidestWheel = 3;  // radius of gyration by radius
constexpr double kWidestBody = 300;  // radius of gyration by the distance to what it is joined to
constexpr double kFarthest = 0.985;  // cosine of 10 degrees

class Doubts {
 public:
  explicit Doubts(const Scene& scene) : scene_(scene) {}

  Warnings all() && {
    gravity();
    for (const Scene::Body& body : scene_.bodies) flexible(body);
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) inertia(static_cast<int>(b));
    twins();
    tires();
    return std::move(warnings_);
  }

 private:
  void doubt(const Source& where, std::string what, std::string value, std::string remedy) {
    warnings_.push_back({where.text(), std::move(what), std::move(value), std::move(remedy)});
  }

  void gravity() {
    const double g = scene_.gravity.norm();
    const auto shown =
        fmt::format("[{:g}, {:g}, {:g}] m/s2", scene_.gravity.x(), scene_.gravity.y(), scene_.gravity.z());
    const Source where{nullptr, 0, 0, "gravity"};
    if (g > kMostGravity)
      doubt(where, "gravity is stronger than that of the sun", shown,
            "is it in mm/s2? write '9810 mm/s2' then");
    if (scene_.road && scene_.gravity.z() > 0)
      doubt(where, "gravity points away from the road", shown, "z is up: write gravity: [0, 0, -9.81]");
  }

  void flexible(const Scene::Body& body) {
    if (!body.flexible) return;
    const Scene::Flexible& f = *body.flexible;
    if (f.block) material(body.where, f.block->young, f.block->density);
    if (!f.block && f.model && f.model->elements)
      material(body.where, f.model->elements->material.youngs_modulus, f.model->elements->material.density);
  }

  void material(const Source& where, double young, double density) {
    const double sound = std::sqrt(young / density);
    const std::string value =
        fmt::format("young {:g} Pa, density {:g} kg/m3, where sound runs {:.3g} m/s", young, density, sound);
    if (sound > kFastestSound)
      doubt(where, "no solid is as stiff for its density", value,
            density < 1e-3 ? fmt::format("is the density in t/mm3? write '{:g} t/mm3' then", density)
                           : fmt::format("is the density in g/cm3? write '{:g} g/cm3' then", density));
    if (sound < kSlowestSound)
      doubt(where, "no solid is as soft for its density", value,
            young < 2e3 ? fmt::format("is the modulus in GPa? write '{:g} GPa' then", young)
                        : fmt::format("is the modulus in MPa (N/mm2)? write '{:g} MPa' then", young));
  }

  /// The farthest point at which something takes hold of a body, from its mass centre [m].
  double reach(int body) const {
    double reach = 0;
    const auto note = [&](const Scene::Point& p) {
      if (p.body == body)
        reach = std::max(reach, (p.p_DP - scene_.bodies[static_cast<std::size_t>(body)].X_DB.p).norm());
    };
    for (const Scene::Joint& joint : scene_.joints) note(joint.first), note(joint.second);
    for (const Scene::Closure& closure : scene_.closures) note(closure.from), note(closure.to);
    for (const Scene::Spring& spring : scene_.springs) note(spring.from), note(spring.to);
    return reach;
  }

  void inertia(int b) {
    const Scene::Body& body = scene_.bodies[static_cast<std::size_t>(b)];
    if (body.is_flexible() || !(body.mass > 0)) return;
    const double radius = std::sqrt(body.inertia.diagonal().maxCoeff() / body.mass), reach = this->reach(b);
    constexpr double kPoint = 1e-3;  // [m]
    if (reach > kPoint && radius > kWidestBody * reach)
      doubt(body.where, "the body has the inertia of one much larger than itself",
            fmt::format("a radius of gyration of {:.3g} m, where all joints and springs are within {:.3g} m",
                        radius, reach),
            "is the inertia in kg mm2 or kg cm2, or the mass in t? write the units");
  }

  static bool same(const Scene::Point& a, const Scene::Point& b) {
    return a.body == b.body && a.node == b.node && a.frame == b.frame && (a.p_DP - b.p_DP).isZero(1e-12);
  }
  /// Between the same points, either way.
  template <class Ends>
  static bool same_ends(const Ends& a, const Ends& b) {
    return (same(a.from, b.from) && same(a.to, b.to)) || (same(a.from, b.to) && same(a.to, b.from));
  }

  static bool twins(const Scene::Spring& a, const Scene::Spring& b) {
    return same_ends(a, b) && a.stiffness == b.stiffness && a.damping == b.damping &&
           a.free_length == b.free_length;
  }
  static bool twins(const Scene::Joint& a, const Scene::Joint& b) {
    const bool ends = (same(a.first, b.first) && same(a.second, b.second)) ||
                      (same(a.first, b.second) && same(a.second, b.first));
    return a.kind == b.kind && ends && std::abs(a.R_DJ.col(2).dot(b.R_DJ.col(2))) > 1 - 1e-12;
  }
  static bool twins(const Scene::Closure& a, const Scene::Closure& b) {
    if (a.type != b.type) return false;
    if (a.type != Scene::ClosureType::kCoupling)
      return same_ends(a, b) && a.direction_D == b.direction_D && a.motion == b.motion &&
             a.length == b.length;
    return a.terms.size() == b.terms.size() && a.constant == b.constant &&
           std::equal(a.terms.begin(), a.terms.end(), b.terms.begin(), [](const auto& s, const auto& t) {
             return s.of.joint == t.of.joint && s.of.coordinate == t.of.coordinate && s.factor == t.factor;
           });
  }
  static bool twins(const Scene::Load& a, const Scene::Load& b) {
    const auto equal = [](const Function& f, const Function& g) {
      return f.constant() && f.constant() == g.constant();
    };
    return same(a.point, b.point) && a.in_body_axes == b.in_body_axes &&
           std::equal(a.force.begin(), a.force.end(), b.force.begin(), equal) &&
           std::equal(a.moment.begin(), a.moment.end(), b.moment.begin(), equal);
  }

  template <class Element>
  void look_for_twins(const std::vector<Element>& elements, const char* kind, const char* effect) {
    constexpr std::size_t kMost = 1000;  // every pair is compared
    if (elements.size() > kMost) return;
    for (std::size_t i = 0; i < elements.size(); ++i)
      for (std::size_t j = i + 1; j < elements.size(); ++j)
        if (twins(elements[i], elements[j]))
          doubt(elements[j].where, fmt::format("this {} is the same as '{}'", kind, elements[i].name),
                fmt::format("'{}'", elements[j].name), effect);
  }

  void twins() {
    look_for_twins(scene_.springs, "spring", "both act: remove one, or give one of them twice the values");
    look_for_twins(scene_.loads, "load", "both act: remove one, or give one of them twice the values");
    look_for_twins(scene_.joints, "joint", "the second binds nothing more: remove one");
    look_for_twins(scene_.closures, "closure", "the second binds nothing more: remove one");
  }

  double total_mass() const {
    double mass = 0;
    for (const Scene::Body& body : scene_.bodies) {
      if (!body.is_flexible()) mass += body.mass;
      if (body.is_flexible() && (body.flexible->block || body.flexible->model))
        mass += node_masses(*body.flexible).sum();
    }
    return mass;
  }

  void tires() {
    if (scene_.tires.empty()) return;
    double stiffness = 0, radius = 0;
    for (const Scene::Tire& tire : scene_.tires) {
      const Scene::TireModel& model = scene_.tire_models[static_cast<std::size_t>(tire.model)];
      stiffness += model.vertical_stiffness;
      radius = std::max(radius, model.radius);
      wheel(tire, model);
    }
    for (const Scene::TireModel& model : scene_.tire_models)
      if (model.damping_ratio > kMostDamping)
        doubt(model.where, "the tire is damped beyond critically",
              fmt::format("a damping ratio of {:g}", model.damping_ratio),
              fmt::format("is it in per cent? write '{:g} %' then", model.damping_ratio));
    const double sag = total_mass() * scene_.gravity.norm() / stiffness;
    if (sag > radius)
      doubt(scene_.tire_models[static_cast<std::size_t>(scene_.tires.front().model)].where,
            "the tires cannot carry the bodies",
            fmt::format("{:.3g} m of deflection under {:.4g} kg, radius {:g} m", sag, total_mass(), radius),
            "is the vertical stiffness in N/mm or kN/m, or a mass in g? write the units");
    if (scene_.analysis.duration > kLongestDrive)
      doubt(scene_.analysis.where, "the drive takes hours", fmt::format("{:g} s", scene_.analysis.duration),
            fmt::format("is it in ms? write '{:g} ms' then", scene_.analysis.duration));
  }

  void wheel(const Scene::Tire& tire, const Scene::TireModel& model) {
    const Scene::Body& body = scene_.bodies[static_cast<std::size_t>(tire.wheel)];
    const double gyration = std::sqrt(body.inertia(1, 1) / body.mass) / model.radius;
    if (gyration > kWidestWheel || (gyration < kThinnestWheel && gyration > 0))
      doubt(body.where, "the inertia about the spin axis does not suit the wheel's mass and radius",
            fmt::format("{:g} kg m2, {:g} kg: a radius of gyration of {:.3g} m, radius {:g} m",
                        body.inertia(1, 1), body.mass, gyration * model.radius, model.radius),
            "is a mass in g, or an inertia in kg mm2 or kg cm2? write the units");
    spin_axis(tire, body);
  }

  /// The revolute joints of a wheel: one must turn it about its y axis.
  void spin_axis(const Scene::Tire& tire, const Scene::Body& body) {
    const Scene::Joint* hub = nullptr;
    for (const Scene::Joint& joint : scene_.joints) {
      if (joint.kind != JointKind::revolute) continue;
      if (joint.first.body != tire.wheel && joint.second.body != tire.wheel) continue;
      hub = &joint;
      if (std::abs(joint.R_DJ.col(2).dot(body.X_DB.R.col(1))) > kFarthest) return;
    }
    if (!hub) return;
    const Vector3 y = body.X_DB.R.col(1), axis = hub->R_DJ.col(2);
    doubt(tire.where, fmt::format("the joint '{}' does not turn the wheel about its spin axis", hub->name),
          fmt::format("axis [{:.3g}, {:.3g}, {:.3g}], the wheel's y axis [{:.3g}, {:.3g}, {:.3g}]", axis.x(),
                      axis.y(), axis.z(), y.x(), y.y(), y.z()),
          "the tire spins about the y axis of its body: turn the body or the joint's axis");
  }

  const Scene& scene_;
  Warnings warnings_;
};

}  // namespace

Warnings doubts_of(const Scene& scene) {
  return Doubts(scene).all();
}

namespace {

/// Whether a number was written as such: with a unit, or by an expression, it is meant as it is.
bool is_plain(const Value& value) {
  return value.node()->origin.empty() && parse_quantity(value.text()).base.empty();
}

}  // namespace

void doubt_damping(const Value& damping, Warnings& warnings) {
  if (damping.is_list()) {
    for (const Value& item : damping.list()) doubt_damping(item, warnings);
    return;
  }
  if (damping.is_mapping() || !is_plain(damping)) return;
  const double ratio = damping.number(kRatio);
  if (ratio <= kMostDamping || damping.text().ends_with('%')) return;
  warnings.push_back(
      {damping.where().text(), "modes are damped beyond critically",
       fmt::format("a damping ratio of {:g}", ratio),
       fmt::format("is it in per cent? write '{:g} %' then, or '{:g} %' if not", ratio, 100 * ratio)});
}

void doubt_angle(const Value& angle, Warnings& warnings) {
  const double value = angle.number(kAngle);
  if (std::abs(value) <= 2 * std::numbers::pi || !is_plain(angle)) return;
  warnings.push_back({angle.where().text(), "the angle is more than a turn", fmt::format("{:g} rad", value),
                      fmt::format("is it in degrees? write '{:g} deg' then", value)});
}

void doubt_joint_angle(const Value& angle, Warnings& warnings) {
  const double value = angle.number(kAngle);
  const bool whole_degrees = std::abs(value) >= 15 && std::remainder(value, 15.0) == 0;
  if (!whole_degrees || !is_plain(angle)) return;
  warnings.push_back({angle.where().text(), "the joint starts turns away from its design pose",
                      fmt::format("{:g} rad, which are {:.3g} turns", value, value / (2 * std::numbers::pi)),
                      fmt::format("is it in degrees? write '{:g} deg' then", value)});
}

}  // namespace wishbone::scene_sections
