#pragma once

#include <Eigen/LU>
#include <vector>

#include "solver/first_order.h"

namespace wishbone {

/// The equations of motion in independent coordinates [Wehage & Haug 1982]: y = (d_I, v_I, x, work). The displacement d from a
/// reference pose (Joint::retract) and the speeds v are split into independent parts I and dependent ones J, as many as there
/// are kept closure rows; the dependent ones follow in every evaluation from
///
///     Phi(q(d_I, d_J)) = 0  (Newton),     D_J v_J = -(Phi_t + D_I v_I),
///
/// so there is nothing to project and nothing drifts. J are the columns of D that pivoting in the metric of kinetic energy
/// finds best conditioned; when they have lost much of that, or a joint has turned far from the reference, the choice is
/// outlived and the integration starts anew with another.
class PartitionedSystem final : public FirstOrderSystem {
 public:
  PartitionedSystem(const System& system, Workspace& ws, ProgressGuard& guard);

  void pack(const State& state, const Work& work, Eigen::Ref<VectorX> y) override;
  void unpack(double t, const Eigen::Ref<const VectorX>& y, State& state, Work& work) override;
  void calc_rate(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<VectorX> y_rate) override;
  void calc_jacobian(double t, const Eigen::Ref<const VectorX>& y, Eigen::Ref<MatrixX> J) override;
  bool project(double t, double tolerance, Eigen::Ref<VectorX> y, double implicit_step) override;
  bool outlived() override;
  std::string name(Eigen::Index i) const override;

 private:
  void choose(const State& state);
  void close_positions(State& state);
  bool find_dependent(State& state);
  void close_velocities(State& state);
  void calc_closure_jacobian();
  enum class Of { speeds, displacements };
  void gather_dependent(Of what);
  void factor_dependent(Of what);
  double dependent_sine(Of what);
  void calc_displacement_rate(const VectorX& v, VectorX& d_rate) const;
  void calc_speeds(const VectorX& d_rate, VectorX& v) const;
  void set_directions(const State& state);
  void differentiate_displacement_rate(const State& state, Eigen::Ref<MatrixX> J);

  int n_dependent_, n_independent_;
  std::vector<int> independent_, dependent_;  // speeds, ascending
  VectorX q_reference_;
  VectorX d_;       // all displacements of the last evaluation
  VectorX closed_;  // those that were closed last, from which the next are sought
  VectorX wanted_;
  double sine_ = 1;  // of the dependent columns when they were chosen
  MatrixX D_;        // kept rows x nv, of speeds
  MatrixX D_J_;      // its dependent columns, or those of D times the tangent of the displacements
  Eigen::PartialPivLU<MatrixX> lu_;
  VectorX row_force_, mu_, residual_, change_, d_rate_, speeds_;
  std::vector<const TreeBody*> turning_;  // bodies on joints with quaternions
  Directions directions_;
  MotionDerivatives derivatives_;
  MatrixX d_directions_, Phi_rate_;
};

}  // namespace wishbone
