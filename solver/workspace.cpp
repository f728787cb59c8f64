#include "solver/workspace.h"

#include <numeric>

namespace wishbone {

Workspace::Workspace(const System& system)
    : bodies(system.bodies.size()),
      markers(system.markers.size()),
      marker_accelerations(system.markers.size()),
      wrenches(system.markers.size()),
      segments(system.n_forces, 0),
      element_powers(system.n_forces, 0.0),
      v_rate(VectorX::Zero(system.nv)),
      x_rate(VectorX::Zero(system.nx)),
      Phi(VectorX::Zero(system.n_rows)),
      Phi_rate(VectorX::Zero(system.n_rows)),
      Phi_dd(VectorX::Zero(system.n_rows)),
      W_A(Matrix6X::Zero(6, system.n_rows)),
      W_B(Matrix6X::Zero(6, system.n_rows)),
      lambda(VectorX::Zero(system.n_rows)),
      displacement(VectorX::Zero(system.nv)),
      z(Matrix6X::Zero(6, 6 * static_cast<Eigen::Index>(system.bodies.size()))) {
  for (const FlexibleBody& body : system.flexible) {
    const int m = body.modal.mode_count();
    flexible.push_back({body.modal.make_state(), VectorX::Zero(m),
                        body.carries_joints ? MatrixX(MatrixX::Identity(m, m)) : MatrixX(),
                        MatrixX::Zero(m, 6), Matrix3X::Zero(3, m), VectorX::Zero(m), VectorX::Zero(m)});
  }
  std::vector<int> all(system.n_rows);
  std::iota(all.begin(), all.end(), 0);
  keep_rows(all, system, *this);
}

}  // namespace wishbone
