#include "solver/car.h"

#include <cmath>

namespace wishbone::testing {
namespace {

constexpr double kSpeed = 120 / 3.6;

struct Corner {
  const char* name;
  double x, y;                // signs of the corner's position
  int node, inner_node, top;  // of the hinges and of the spring
};
constexpr Corner kCorners[] = {{"front left", 1, 1, 18, 14, 19},
                               {"front right", 1, -1, 17, 13, 20},
                               {"rear left", -1, 1, 2, 6, 3},
                               {"rear right", -1, -1, 1, 5, 4}};

UaTireParameters tire() {
  UaTireParameters t;
  t.radius = 0.315;
  t.radial_stiffness = 200e3;
  t.radial_damping_ratio = 0.02;
  t.mass = 10;
  t.slip_stiffness = 80e3;
  t.cornering_stiffness = 73.6e3;
  t.camber_stiffness = 8094;
  t.rolling_resistance = 0.003;
  t.friction_max = 1.0;
  t.friction_min = 0.8;
  t.relaxation_x = 0.3;
  t.relaxation_y = 0.5;
  return t;
}

struct CarBuilder {
  SystemBuilder b;
  int chassis = 0;
  bool flexible = false;
  Road road{0.0, {{7.2, 12, 0.03}}};

  Attachment hold(int node) const { return flexible ? Attachment{chassis, node} : Attachment{chassis}; }

  int add_body(const std::string& name, double mass, const Vector3& J, const Vector3& p) {
    const int body = b.add_body(name, mass, J.asDiagonal(), {Matrix3::Identity(), p});
    b.set_velocity(body, {kSpeed, 0, 0}, Vector3::Zero());
    return body;
  }

  void add_corner(const Corner& c) {
    const std::string name = c.name;
    const Vector3 hub(1.2 * c.x, 0.6 * c.y, 0.3), hinge(1.2 * c.x, 0.2 * c.y, 0.3),
        inner(0.6 * c.x, 0.2 * c.y, 0.3);
    const int link = add_body(name + " link", 20, {1, 1, 1}, {1.2 * c.x, 0.4 * c.y, 0.3});
    b.add_joint(name + " hinge", hold(c.node), link, hinge, SphericalJoint{});
    const MarkerIndex on_chassis =
        flexible ? b.add_marker(hold(c.inner_node)) : b.add_marker({chassis}, inner);
    b.add_closure(name + " inner hinge", b.add_marker({link}, inner), on_chassis, SphericalClosure{});

    const MarkerIndex top =
        flexible ? b.add_marker(hold(c.top)) : b.add_marker({chassis}, {1.2 * c.x, 0.2 * c.y, 0.7});
    b.add_force(SpringDamper(name + " spring", b.add_marker({link}), top, 47e3, 4e3, 0.5683));

    int carrier = link;
    if (c.x > 0) {
      carrier = add_body(name + " knuckle", 20, {1, 1, 1}, hub);
      const Motion steer(name, 0, {{0.1, 0.2, 0.02}});
      b.add_joint(name + " steering", {link}, carrier, hub,
                  PrescribedJoint{PrescribedJoint::Kind::revolute, Vector3::UnitZ(), steer});
    }
    const int wheel = add_body(name + " wheel", 30, {1, 2, 1}, hub);
    b.add_joint(name + " bearing", {carrier}, wheel, hub, RevoluteJoint{Vector3::UnitY()}, 0,
                kSpeed / (0.315 - 0.015 / 3));
    b.add_force(Tire(name + " tire", b.add_marker({wheel}), tire(), road, UaForm::kSmooth, true));
  }
};

}  // namespace

Built car(int modes) {
  CarBuilder car;
  car.b.gravity = {0, 0, -9.81};
  car.flexible = modes > 0;
  const Pose X_WB{Matrix3::Identity(), {0, 0, 0.5}};
  if (car.flexible) {
    const Mesh mesh = make_block({2.4, 0.4, 0.4}, {4, 1, 1}, ElementType::mean_dilatation);
    ModeSet set = free_free_modes(mesh, {2.1e8, 0.3, 2600}).lowest(modes);
    set.damping_ratio.setConstant(0.05);
    car.chassis = car.b.add_flexible_body("chassis", std::move(set), X_WB);
    car.b.set_velocity(car.chassis, {kSpeed, 0, 0}, Vector3::Zero());
  } else {
    car.chassis = car.add_body("chassis", 998, {79.9, 579, 579}, X_WB.p);
  }
  for (const Corner& corner : kCorners) car.add_corner(corner);
  return build(std::move(car.b));
}

}  // namespace wishbone::testing
