#include "models/compile.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "bodies/nodal_shapes.h"
#include "bodies/rigid_frames.h"
#include "core/yaml.h"
#include "identification/nodal_model.h"
#include "models/compile_joints.h"
#include "models/compile_loads.h"
#include "models/compile_recoveries.h"
#include "models/scene_attachment.h"
#include "models/start.h"
#include "solver/system_builder.h"

namespace wishbone {
namespace {

/// One scene on its way into a SystemBuilder.
class Compiler {
 public:
  explicit Compiler(const Scene& scene) : scene_(scene), joints_(scene, builder_), modes_(scene) {
    builder_.gravity = scene.gravity;
  }

  CompiledScene compile() && {
    for (int b = 0; b < static_cast<int>(scene_.bodies.size()); ++b) add_body(b);
    joints_.add_joints();
    joints_.add_closures();
    joints_.give_speeds();
    for (const Scene::Spring& spring : scene_.springs)
      builder_.add_force(SpringDamper(spring.name, marker(spring.from), marker(spring.to), spring.stiffness,
                                      spring.damping, spring.free_length));
    for (const Scene::Tire& tire : scene_.tires) add_tire(tire);
    add_loads(scene_, joints_, builder_);
    CompiledScene compiled;
    compiled.identified = std::move(modes_.identified);
    compiled.modes = std::move(modes_.tables);
    std::tie(compiled.system, compiled.initial) = std::move(builder_).build();
    check_recoveries(scene_, builder_, compiled.system);
    compiled.warnings = scene_.warnings;
    set_start(scene_, builder_, compiled.system, compiled.initial, compiled.warnings);
    std::ranges::move(warnings_of(compiled.identified, compiled.modes),
                      std::back_inserter(compiled.warnings));
    compiled.observer = observer(compiled.system);
    compiled.transient = transient();
    compiled.transient.given = builder_.given();
    return compiled;
  }

 private:
  Vector3 world_point(const Vector3& p_DP) const { return scene_.X_WD * p_DP; }

  void add_body(int number) {
    const Scene::Body& body = scene_.bodies[static_cast<std::size_t>(number)];
    const Pose X_WB = scene_.X_WD * body.X_DB;
    const int index = body.is_flexible()
                          ? builder_.add_flexible_body(body.name, shapes_of(number), X_WB, terms_of(body))
                          : builder_.add_body(body.name, body.mass, body.inertia, X_WB);
    if (!body.is_flexible()) return;
    for (const Scene::Frame& frame : body.flexible->frames) builder_.add_frame(index, interface_frame(frame));
  }

  static InertiaTerms terms_of(const Scene::Body& body) {
    return body.flexible->source_terms ? InertiaTerms::source : InertiaTerms::consistent;
  }

  ShapeSet shapes_of(int number) {
    const Scene::Body& body = scene_.bodies[static_cast<std::size_t>(number)];
    const StiffenedModes modes = modes_.modes_of(number);
    return within(body.where, [&] {
      modes.set.validate();
      const ShapeSet set = body.form == Scene::BodyForm::kModal ? modal_form(modes) : nodal_form(body, modes);
      return with_rigid_frames(set, rigid_frames(*body.flexible));
    });
  }

  static ShapeSet modal_form(const StiffenedModes& modes) {
    ShapeSet set = wishbone::shapes_of(modes.set);
    set.stiffening = modes.stiffening;
    return set;
  }

  static ShapeSet nodal_form(const Scene::Body& body, const StiffenedModes& modes) {
    const NodalModel model = nodal_model(modes.set);
    const auto& axes = body.flexible->fixed_axes;
    ShapeSet set = axes ? fixed_axis_shapes(model, *axes) : mean_axis_shapes(model);
    // z_modes = Psi^T M Phi z
    const VectorX mass = mass_of_freedoms(modes.set.node_mass);
    set.stiffening =
        stiffening_in(modes.stiffening, modes.set.shapes.transpose() * mass.asDiagonal() * set.shapes);
    return set;
  }

  MarkerIndex marker(const Scene::Point& point) {
    return builder_.add_marker(attachment_of(scene_, point), world_point(point.p_DP));
  }

  void add_tire(const Scene::Tire& tire) {
    const Scene::TireModel& model = scene_.tire_models[tire.model];
    std::vector<RoadDepression> depressions;
    if (scene_.road->depression) {
      const Scene::Depression& d = *scene_.road->depression;
      depressions.push_back({d.start, d.length, d.depth});
    }
    UaTireParameters parameters;
    parameters.radius = model.radius;
    parameters.radial_stiffness = model.vertical_stiffness;
    parameters.radial_damping_ratio = model.damping_ratio;
    parameters.mass = model.mass;
    parameters.slip_stiffness = model.slip_stiffness;
    parameters.cornering_stiffness = model.cornering_stiffness;
    parameters.camber_stiffness = model.camber_stiffness;
    parameters.rolling_resistance = model.rolling_resistance;
    parameters.friction_max = model.friction_max;
    parameters.friction_min = model.friction_min;
    parameters.relaxation_x = model.relaxation_longitudinal;
    parameters.relaxation_y = model.relaxation_lateral;
    builder_.add_force(Tire(tire.name, builder_.add_marker({tire.wheel}), parameters,
                            Road(scene_.road->bank, std::move(depressions)),
                            model.form == Scene::TireForm::kSmooth ? UaForm::kSmooth : UaForm::kClassic,
                            model.lag));
  }

  /// On a flexible body, the node or what the frame carries; on a rigid one, whose nodes are but points of it, the place.
  BodyPoint body_point(const Scene::Point& point, const System& system) const {
    const Scene::Body& body = scene_.bodies[point.body];
    const Attachment on = attachment_of(scene_, point);
    BodyPoint out{builder_.built_index(point.body), body.X_DB.R.transpose() * (point.p_DP - body.X_DB.p),
                  on.node_id};
    if (on.frame >= 0) {
      const ModalBody& modal = system.flexible[system.bodies[out.body].flexible].modal;
      out.frame = frame_shapes(interface_frame(body.flexible->frames[on.frame]), modal.set());
    }
    return out;
  }

  std::string units_of(const Scene::Signal& signal) const {
    bool is_angle = false;
    if (signal.type == Scene::SignalType::kCoordinate)
      is_angle = info(scene_.joints[signal.of.joint].kind).coordinates[signal.of.coordinate].is_angle;
    return std::string(is_angle ? "rad" : "m") + (signal.is_speed ? "/s" : "");
  }

  ObserverOptions observer(const System& system) const {
    ObserverOptions options;
    for (const Scene::FlexibleOutput& output : scene_.output.flexible)
      options.flexible.push_back({builder_.built_index(output.body), output.nodes, output.signals});
    for (const Scene::RecoveryOutput& output : scene_.output.recoveries)
      options.recoveries.push_back(
          {output.name, output.unit, builder_.built_index(output.body), output.rows, output.matrix});
    for (const Scene::PointOutput& output : scene_.output.points)
      options.points.push_back({output.name, body_point(output.point, system)});
    for (const Scene::Signal& signal : scene_.signals)
      options.signals.push_back({signal.name, units_of(signal)});
    if (!scene_.vehicle) return options;
    options.chassis = builder_.built_index(scene_.vehicle->chassis);
    for (const Scene::SteeringAngle& steering : scene_.vehicle->steering)
      options.steering.push_back({steering.name, builder_.built_index(joints_.carried_body(steering.joint)),
                                  scene_.joints[steering.joint].R_DJ(2, 2) < 0 ? -1.0 : 1.0});
    return options;
  }

  TransientOptions transient() const {
    const Scene::Analysis& analysis = scene_.analysis;
    TransientOptions options;
    options.duration = analysis.duration;
    options.interval = scene_.output.interval;
    switch (analysis.form) {
      case Scene::Form::kAuto:
        options.integrator.form = Form::automatic;
        break;
      case Scene::Form::kOde:
        options.integrator.form = Form::ode;
        break;
      case Scene::Form::kIndex1:
        options.integrator.form = Form::index1;
        break;
      case Scene::Form::kPartition:
        options.integrator.form = Form::partition;
        break;
      case Scene::Form::kGgl:
        options.integrator.form = Form::ggl;
        break;
    }
    switch (analysis.integrator) {
      case Scene::Integrator::kAuto:
        options.integrator.method = Method::automatic;
        break;
      case Scene::Integrator::kAdams:
        options.integrator.method = Method::adams;
        break;
      case Scene::Integrator::kBdf:
        options.integrator.method = Method::bdf;
        break;
      case Scene::Integrator::kErk:
        options.integrator.method = Method::erk;
        break;
    }
    options.integrator.rtol = analysis.rtol;
    options.integrator.atol = analysis.atol;
    options.integrator.max_step = analysis.max_step.value_or(0);
    options.integrator.max_steps = analysis.max_steps.value_or(0);
    return options;
  }

  const Scene& scene_;
  SystemBuilder builder_;
  JointCompiler joints_;
  ModeCompiler modes_;
};

}  // namespace

CompiledScene compile(const Scene& scene) {
  return Compiler(scene).compile();
}

}  // namespace wishbone
