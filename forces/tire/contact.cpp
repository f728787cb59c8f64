#include "forces/tire/contact.h"

#include <algorithm>
#include <cmath>

namespace wishbone {

WheelContact wheel_contact(const MarkerState& wheel, double radius, const Road& road, int segment) {
  const Vector3& C = wheel.p_WM;
  const Vector3 us = wheel.R_WM.col(1);
  const RoadPoint ground = road.at(C.x(), C.y(), segment);

  WheelContact c;
  c.P0 = Vector3(C.x(), C.y(), ground.height);
  c.uz = ground.uz;

  // both us x uz and uz - (uz.us) us have the length cos(camber)
  const double sine = us.dot(c.uz);
  const Vector3 heading = us.cross(c.uz);
  c.upright = heading.norm();
  c.camber = -std::asin(std::clamp(sine, -1.0, 1.0));
  c.ux = heading / c.upright;
  c.uy = c.uz.cross(c.ux);
  const Vector3 e = (sine * us - c.uz) / c.upright;

  // -e.uz = upright
  c.loaded_radius = (C - c.P0).dot(c.uz) / c.upright;
  c.P = C + c.loaded_radius * e;
  c.deflection = radius - c.loaded_radius;

  c.spin = wheel.w_WM.dot(us);
  const Vector3 v_P = wheel.v_WM + (wheel.w_WM - c.spin * us).cross(c.P - C);
  c.vx = v_P.dot(c.ux);
  c.vy = v_P.dot(c.uy);
  c.deflection_rate = -v_P.dot(c.uz);
  c.v_cir = (radius - std::max(0.0, c.deflection) / 3) * c.spin;
  return c;
}

}  // namespace wishbone
