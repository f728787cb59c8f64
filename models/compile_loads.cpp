#include "models/compile_loads.h"

namespace wishbone {
namespace {

const Gauge& gauge_of(const Scene::JointCoordinate& coordinate, const Scene& scene) {
  const Scene::Joint& joint = scene.joints[static_cast<std::size_t>(coordinate.joint)];
  return info(joint.kind).coordinates[static_cast<std::size_t>(coordinate.coordinate)].gauge;
}

MotionSignal signal_of(const Scene::Signal& signal, const Scene& scene, JointCompiler& joints) {
  const std::string element = "signal '" + signal.name + "'";
  const MotionSignal::Quantity quantity =
      signal.is_speed ? MotionSignal::Quantity::speed : MotionSignal::Quantity::position;
  switch (signal.type) {
    case Scene::SignalType::kCoordinate: {
      const auto [A, B] = joints.markers(signal.of.joint);
      return {element, A, B, gauge_of(signal.of, scene), quantity};
    }
    case Scene::SignalType::kDistance:
      return {element, joints.marker(signal.from), joints.marker(signal.to), Gauge{Gauge::Kind::distance},
              quantity};
    case Scene::SignalType::kComponent:
      break;
  }
  return {element, joints.marker(signal.from), signal.axis, quantity};
}

}  // namespace

void add_loads(const Scene& scene, JointCompiler& joints, SystemBuilder& builder) {
  for (const Scene::Signal& signal : scene.signals) builder.add_signal(signal_of(signal, scene, joints));
  for (const Scene::Load& load : scene.loads) {
    const Matrix3& R_DB = scene.bodies[static_cast<std::size_t>(load.point.body)].X_DB.R;
    builder.add_force(AppliedLoad(load.name, joints.marker(load.point, R_DB),
                                  LoadComponents{load.moment, load.force},
                                  load.in_body_axes ? LoadAxes::kMarker : LoadAxes::kWorld));
  }
  for (const Scene::Drive& drive : scene.drives) {
    const auto [A, B] = joints.markers(drive.along.joint);
    builder.add_force(JointDrive(drive.name, A, B, gauge_of(drive.along, scene), drive.force));
  }
}

}  // namespace wishbone
