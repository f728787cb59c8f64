#pragma once

#include <vector>

#include "solver/system.h"

namespace wishbone {

/// Motion and loads of one body. Vectors and matrices have world axes and are referred to the body origin Bo; P is the
/// parent.
template <class T>
struct BodyMotionT {
  PoseT<T> X_WB;
  Vector3T<T> p_PB = Vector3T<T>::Zero();  ///< from the parent's origin to Bo
  Vector3T<T> p_MB = Vector3T<T>::Zero();  ///< from the outboard joint frame's origin to Bo
  Vector6T<T> V = Vector6T<T>::Zero();     ///< V_WB
  /// A_WB - shift(A_WP) - H v': velocity products and prescribed motion.
  Vector6T<T> c = Vector6T<T>::Zero();
  Vector6T<T> A = Vector6T<T>::Zero();          ///< A_WB
  Vector6T<T> F_applied = Vector6T<T>::Zero();  ///< sum of applied wrenches, gravity included, about Bo
  Vector6T<T> F_joint = Vector6T<T>::Zero();    ///< that the inboard joint exerts on the body, about Bo
};
using BodyMotion = BodyMotionT<double>;

/// Deformation and loads of one flexible body, body axes.
template <class T>
struct FlexibleMotionT {
  ModalBodyStateT<T> modal;
  VectorXT<T> load;  ///< modal load Q = sum Psi_i^T f_i
  VectorXT<T> z_dd;  ///< z''
};

/// What is remembered between evaluations and changes only when a step is accepted: the same for every scalar.
struct Memory {
  std::vector<int> segments;         ///< discrete state of each force element, in the order of System::forces
  std::vector<double> force_angles;  ///< of the force elements' gauges, from which turns are counted [rad]
  std::vector<double> closure_angles;   ///< of the closures' gauges [rad]
  std::vector<double> measured_angles;  ///< of System::measured [rad or m]
  std::vector<double> signal_values;    ///< of System::signals, from which their turns are counted
};

/// One evaluation of the equations of motion in residual form (inverse dynamics), for the scalar T: double, or Dual where
/// derivatives are wanted. Sized once; evaluating allocates nothing.
template <class T>
struct Evaluation {
  explicit Evaluation(const System& system);

  std::vector<BodyMotionT<T>> bodies;
  /// Hinge matrices: the velocity of the joint's body for each unit speed of the joint.
  std::vector<Vector6T<T>> H;
  std::vector<FlexibleMotionT<T>> flexible;
  std::vector<MarkerStateT<T>> markers;
  std::vector<MarkerAccelerationT<T>> marker_accelerations;  ///< of the closures' markers
  std::vector<WrenchT<T>> wrenches;                          ///< of force elements, on the markers
  std::vector<T> element_powers;                             ///< of each force element [W]
  std::vector<T> variables;                                  ///< of functions: the time and the signals
  VectorXT<T> x_rate;                                        ///< rates of the force elements' states
  VectorXT<T> Phi, Phi_rate, Phi_dd;  ///< of all closure rows: residual, its rate, its second rate
  Matrix6XT<T> W;                     ///< unit wrenches of the rows on their markers (Closure::column_start)
  Memory memory;
};

}  // namespace wishbone
