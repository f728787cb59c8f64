#pragma once

#include "solver/evaluation.h"

namespace wishbone {

/// What the turning of a frame I against a body P adds to the acceleration of a point at r from Io that moves with v_rel
/// as seen from I. With w_I = w_P + w_PI, and alpha the part of alpha_I beyond alpha_P:
///     alpha x r + w_I x (w_I x r) - w_P x (w_P x r) + 2 w_PI x v_rel.
template <class T>
Vector3T<T> acceleration_by_turning(const Vector3T<T>& w_P, const Vector3T<T>& w_PI, const Vector3T<T>& alpha,
                                    const Vector3T<T>& r, const Vector3T<T>& v_rel) {
  const Vector3T<T> w_PI_x_r = w_PI.cross(r);
  return alpha.cross(r) + w_P.cross(w_PI_x_r) + w_PI.cross(w_P.cross(r) + w_PI_x_r + 2.0 * v_rel);
}

/// An interface of the flexible body P in a state, world axes: the frame I that a node or several of them carry. It moves
/// with V_PI = (w_PI, v_PI) against P, where by what ModalBody says of its shapes
///     V_PI = Theta(z) z',   Theta = [R_WP J Psi_phi; R_WP Psi_u],
/// and a wrench F_Io on it is the modal load Theta^T F_Io. Of a node w_PI is zero, and so is Psi_phi.
template <class T>
class Interface {
 public:
  /// @param body a flexible one
  Interface(const System& system, int body, int interface, const Evaluation<T>& ev)
      : modal_(system.flexible[system.bodies[body].flexible].modal),
        state_(ev.flexible[system.bodies[body].flexible].modal),
        R_WP_(ev.bodies[body].X_WB.R),
        index_(interface),
        turns_(modal_.interface_turns(interface)) {}

  /// Whether it is a frame. What follows is of frames and nodes alike, unless said.
  bool turns() const { return turns_; }

  Vector3T<T> p_PI() const { return R_WP_ * state_.interface_b.col(index_); }
  Vector3T<T> v_PI() const { return R_WP_ * state_.interface_delta_dot.col(index_); }
  /// v of Theta z''.
  Vector3T<T> v_Theta(const VectorXT<T>& z_dd) const {
    const Vector3T<T> u = translation() * z_dd;
    return R_WP_ * u;
  }

  /// Of frames only.
  Matrix3T<T> R_WI() const { return R_WP_ * turn().R_BI; }
  Vector3T<T> w_PI() const { return R_WP_ * turn().w_BI; }
  /// alpha_I - alpha_P at z'' = 0.
  Vector3T<T> alpha_bias(const Vector3T<T>& w_P) const {
    const Vector3T<T> alpha = R_WP_ * turn().alpha_bias;
    return alpha + w_P.cross(w_PI());
  }
  /// w of Theta z''.
  Vector3T<T> w_Theta(const VectorXT<T>& z_dd) const {
    const Vector3T<T> phi = rotation() * z_dd;
    return R_WJ() * phi;
  }
  /// R_WP J, which turns rates of the rotation vector into angular velocities.
  Matrix3T<T> R_WJ() const { return R_WP_ * turn().J; }

  /// Psi_u and, of frames, Psi_phi.
  const Matrix3X& translation() const { return modal_.interface_shape(index_); }
  const Matrix3X& rotation() const { return modal_.interface_rotation(index_); }

  /// Theta z'' as the acceleration of a point Q that moves with I.
  Vector6T<T> acceleration(const VectorXT<T>& z_dd, const Vector3T<T>& p_PQ) const {
    Vector3T<T> alpha = Vector3T<T>::Zero(), a = v_Theta(z_dd);
    if (turns_) {
      alpha = w_Theta(z_dd);
      a += alpha.cross(p_PQ - p_PI());
    }
    return spatial(alpha, a);
  }

  /// load += Theta^T F_Io of a moment t and a force f at a point Q.
  template <class Load>
  void add_load(const Vector3T<T>& t, const Vector3T<T>& f, const Vector3T<T>& p_PQ, Load&& load) const {
    const Vector3T<T> f_P = R_WP_.transpose() * f;
    load += translation().transpose().lazyProduct(f_P);
    if (!turns_) return;
    const Vector3T<T> p_IQ = p_PQ - p_PI(), t_I = t + p_IQ.cross(f);
    const Vector3T<T> t_phi = R_WJ().transpose() * t_I;
    load += rotation().transpose().lazyProduct(t_phi);
  }

 private:
  const FrameTurnT<T>& turn() const { return modal_.interface_turn(index_, state_); }

  const ModalBody& modal_;
  const ModalBodyStateT<T>& state_;
  const Matrix3T<T>& R_WP_;
  int index_;
  bool turns_;
};

/// The interface of the parent that carries the joint of a body (TreeBody::parent_interface >= 0).
template <class T>
Interface<T> parent_interface(const System& system, const TreeBody& body, const Evaluation<T>& ev) {
  return {system, body.parent, body.parent_interface, ev};
}

/// R_WF of a joint on a frame.
template <class T>
[[gnu::noinline]] Matrix3T<T> axes_on_frame(const System& system, const TreeBody& body,
                                            const Evaluation<T>& ev) {
  return parent_interface(system, body, ev).R_WI() * body.X_PF.R;
}

/// R_WF of the inboard joint frame of a body.
template <class T>
Matrix3T<T> inboard_axes(const System& system, const TreeBody& body, const Evaluation<T>& ev) {
  if (body.parent < 0) return body.X_PF.R.template cast<T>();
  if (body.on_frame) return axes_on_frame(system, body, ev);
  const Matrix3T<T>& R_WP = ev.bodies[body.parent].X_WB.R;
  return body.turned_PF ? Matrix3T<T>(R_WP * body.X_PF.R) : R_WP;
}

}  // namespace wishbone
