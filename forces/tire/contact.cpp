#include "forces/tire/contact.h"

#include <cmath>

#include "core/dual.h"

namespace wishbone {

template <class T>
WheelContactT<T> wheel_contact(const MarkerStateT<T>& wheel, double radius, const Road& road, int segment) {
  using std::asin;
  const Vector3T<T>& C = wheel.p_WM;
  const Vector3T<T> us = wheel.R_WM.col(1);
  const RoadPointT<T> ground = road.at(C.x(), C.y(), segment);

  WheelContactT<T> c;
  c.P0 = Vector3T<T>(C.x(), C.y(), ground.height);
  c.uz = ground.uz;

  // both us x uz and uz - (uz.us) us have the length cos(camber)
  const T sine = us.dot(c.uz);
  const Vector3T<T> heading = us.cross(c.uz);
  c.upright = heading.norm();
  c.camber = -asin(at_most(at_least(sine, -1.0), 1.0));
  c.ux = heading / c.upright;
  c.uy = c.uz.cross(c.ux);
  const Vector3T<T> e = (sine * us - c.uz) / c.upright;

  // -e.uz = upright
  c.loaded_radius = (C - c.P0).dot(c.uz) / c.upright;
  c.P = C + c.loaded_radius * e;
  c.deflection = radius - c.loaded_radius;

  c.spin = wheel.w_WM.dot(us);
  const Vector3T<T> v_P = wheel.v_WM + (wheel.w_WM - c.spin * us).cross(c.P - C);
  c.vx = v_P.dot(c.ux);
  c.vy = v_P.dot(c.uy);
  c.deflection_rate = -v_P.dot(c.uz);
  c.v_cir = (radius - at_least(c.deflection, 0.0) / 3.0) * c.spin;
  return c;
}

template WheelContactT<double> wheel_contact(const MarkerStateT<double>&, double, const Road&, int);
template WheelContactT<Dual> wheel_contact(const MarkerStateT<Dual>&, double, const Road&, int);

}  // namespace wishbone
