#pragma once

#include <string>
#include <vector>

#include "bodies/shape_set.h"
#include "core/rotation_vector.h"

namespace wishbone {

/// Frame I that follows several nodes of a flexible body in the mean: where joints and forces take hold that turn things.
struct InterfaceFrame {
  std::string name;
  std::vector<int> node_ids;    ///< at least three, not on one line, each once
  std::vector<double> weights;  ///< > 0, of each node; empty: all one
};

/// Where a frame and its nodes are in the undeformed body, body axes.
struct FrameGeometry {
  VectorX weights;          ///< w_i
  Vector3 origin;           ///< Io, the weighted centre: c = sum w_i s_i / sum w_i [m]
  Matrix3X arms;            ///< r_i = s_i - c [m]
  Matrix3 inverse_inertia;  ///< of I_w = sum w_i (|r_i|^2 1 - r_i r_i^T)
};

/// @param node_position s_i of the frame's nodes (3 x n), in the order of their ids
/// @throws InputError if there are fewer than three nodes or they lie on one line, if a node is named twice, or if there
///         is not one positive weight for each
FrameGeometry frame_geometry(const InterfaceFrame& frame, const Matrix3X& node_position);

/// How a frame follows the elastic coordinates: translation u = translation z and rotation vector phi = rotation z.
///
/// Both are the rigid motion that fits the deflections delta_i of the nodes best, which has the least
/// sum w_i |delta_i - u - phi x r_i|^2:
///     u = sum w_i delta_i / sum w_i,      phi = I_w^-1 sum w_i r_i x delta_i.
/// (In finite element programs: an interpolation element, RBE3.) The nodes stay free to move against the frame, which adds
/// no stiffness. A force f and a moment t on the frame are spread over the nodes by the transpose,
///     f_i = w_i f / sum w_i + w_i (I_w^-1 t) x r_i,
/// whose resultants are f and t.
struct FrameShapes {
  Vector3 origin;        ///< Io of the undeformed body, body axes [m]
  Matrix3X translation;  ///< 3 x m
  Matrix3X rotation;     ///< 3 x m
};

/// @throws InputError as frame_geometry does, or if a node is unknown
FrameShapes frame_shapes(const InterfaceFrame& frame, const ShapeSet& set);

/// Rotation of an interface frame I against the body axes B, body components: R_BI = exp(phi~) is a rotation however large
/// phi = rotation z is, and w_BI = J(phi) phi' its angular velocity, exactly. A moment t is felt by the modes as
/// rotation^T J^T t, so that its power is t . w_BI.
template <class T>
struct FrameTurnT {
  Vector3T<T> phi = Vector3T<T>::Zero();         ///< [rad]
  Matrix3T<T> R_BI = Matrix3T<T>::Identity();    ///< exp(phi~)
  Matrix3T<T> J = Matrix3T<T>::Identity();       ///< left Jacobian
  Vector3T<T> w_BI = Vector3T<T>::Zero();        ///< J phi' [rad/s]
  Vector3T<T> alpha_bias = Vector3T<T>::Zero();  ///< J' phi': alpha_BI = J phi'' + alpha_bias [rad/s^2]

  void set_position(const Vector3T<T>& rotation) {
    phi = rotation;
    const RotationVector<T> turn(phi);
    R_BI = turn.R;
    J = turn.J;
  }
  void set_velocity(const Vector3T<T>& phi_rate) {
    w_BI = J * phi_rate;
    alpha_bias = rotation_vector_bias<T>(phi, phi_rate);
  }
};
using FrameTurn = FrameTurnT<double>;

}  // namespace wishbone
