#include "solver/interface_wrenches.h"

#include "solver/closures.h"

namespace wishbone {
namespace {

/// Sums wrenches in world axes into the columns of one body.
class WrenchSum {
 public:
  WrenchSum(const System& system, int body, const Workspace& ws, Eigen::Ref<Matrix6X>& F)
      : system_(system), body_(body), ws_(ws), F_(F) {
    F_.setZero();
  }

  /// Moment about the point p_W and force at it, on an interface or (-1) on the body as a whole.
  void add(int interface, const Vector3& p_W, const Vector3& t, const Vector3& f) {
    const Pose& X_WB = ws_.bodies[body_].X_WB;
    const Vector3 t_about = t + (p_W - place(interface)).cross(f);
    auto column = F_.col(interface >= 0 ? interface : F_.cols() - 1);
    column.head<3>() += X_WB.R.transpose() * t_about;
    column.tail<3>() += X_WB.R.transpose() * f;
  }

  void add(MarkerIndex i, const Vector3& t, const Vector3& f) {
    const Marker& marker = system_.markers[i];
    if (marker.body == body_) add(marker.interface, ws_.markers[i].p_WM, t, f);
  }

 private:
  /// Of an interface or of Bo, world axes.
  Vector3 place(int interface) const {
    const Pose& X_WB = ws_.bodies[body_].X_WB;
    if (interface < 0) return X_WB.p;
    return X_WB * Vector3(ws_.flexible[system_.bodies[body_].flexible].modal.interface_b.col(interface));
  }

  const System& system_;
  int body_;
  const Workspace& ws_;
  Eigen::Ref<Matrix6X>& F_;
};

}  // namespace

void calc_interface_wrenches(const System& system, int k, const Workspace& ws, Eigen::Ref<Matrix6X> F) {
  const int body = system.flexible[k].body;
  WrenchSum sum(system, body, ws, F);
  for (std::size_t i = 0; i < system.markers.size(); ++i)
    sum.add(static_cast<MarkerIndex>(i), ws.wrenches[i].t, ws.wrenches[i].f);
  for (const Closure& closure : system.closures)
    for (std::size_t p = 0; p < closure.markers.size(); ++p) {
      if (system.markers[closure.markers[p]].body != body) continue;
      const Vector6 W = closure_wrench(closure, static_cast<int>(p), ws.lambda, ws);
      sum.add(closure.markers[p], angular(W), linear(W));
    }
  // the free joint that carries the body exerts nothing
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const TreeBody& child = system.bodies[i];
    if (child.parent != body) continue;
    const Vector6 W = -ws.bodies[i].F_joint;
    sum.add(child.parent_interface, ws.bodies[i].X_WB.p, angular(W), linear(W));
  }
}

}  // namespace wishbone
