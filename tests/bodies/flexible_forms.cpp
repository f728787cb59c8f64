#include "flexible_forms.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>
#include <utility>

#include "bodies/nodal_shapes.h"
#include "identification/free_free_modes.h"
#include "identification/nodal_model.h"

namespace wishbone::flexible_forms {
namespace {

/// K^-1/2
MatrixX flexibility(const MatrixX& K) {
  if (K.cols() == 1) return K.col(0).cwiseSqrt().cwiseInverse().asDiagonal();
  return Eigen::SelfAdjointEigenSolver<MatrixX>(K).operatorInverseSqrt();
}

}  // namespace

Mesh chassis_mesh() {
  return make_block({2.4, 0.4, 0.4}, {4, 1, 1}, ElementType::mean_dilatation);
}

const ModeSet& chassis() {
  static const ModeSet set = free_free_modes(chassis_mesh(), kMaterial);
  return set;
}

ModeSet damped(ModeSet set, double zeta) {
  set.damping_ratio.setConstant(zeta);
  return set;
}

VectorX some_numbers(Eigen::Index count, unsigned seed) {
  std::mt19937 generator(seed);
  return VectorX::NullaryExpr(count, [&] { return 2.0 * generator() / std::mt19937::max() - 1; });
}

MatrixX full(const MatrixX& matrix) {
  return matrix.cols() == 1 ? MatrixX(matrix.col(0).asDiagonal()) : matrix;
}

std::vector<NamedShapes> complete_forms(double zeta) {
  const ModeSet modes = damped(chassis(), zeta);
  const NodalModel model = nodal_model(modes);
  return {{"modal", shapes_of(modes)},
          {"nodal, mean axes", mean_axis_shapes(model)},
          {"nodal, fixed axes", fixed_axis_shapes(model, {1, 17, 3})}};
}

Motion::Motion(const ModalBody& body)
    : z(flexibility(body.set().stiffness) * some_numbers(body.mode_count(), 1) * 100),
      zdot(some_numbers(body.mode_count(), 2) * 100) {}

ModalBodyState state_of(const ModalBody& body, const Motion& motion) {
  ModalBodyState state = body.make_state();
  body.set_position(motion.z.data(), state);
  body.set_velocity(motion.w_B, motion.zdot.data(), state);
  return state;
}

Matrix3 shortening(const MatrixX& stiffening, const VectorX& z) {
  const Eigen::Index m = z.size();
  const auto moment = [&](int pair) { return z.dot(stiffening.middleCols(pair * m, m) * z); };
  Matrix3 Gamma = Vector3(moment(0), moment(1), moment(2)).asDiagonal();
  Gamma(0, 1) = Gamma(1, 0) = moment(3) / 2;
  Gamma(0, 2) = Gamma(2, 0) = moment(4) / 2;
  Gamma(1, 2) = Gamma(2, 1) = moment(5) / 2;
  return Gamma;
}

MatrixX mass_of_free_motion(const ShapeSet& set) {
  Matrix3X P = Matrix3X::Zero(3, set.shape_count()), S = P;
  for (int i = 0; i < set.node_count(); ++i) {
    P += set.node_mass[i] * set.shapes.middleRows<3>(3 * i);
    S += set.node_mass[i] * skew(set.node_position.col(i)) * set.shapes.middleRows<3>(3 * i);
  }
  const Matrix3 J = point_mass_inertia(set.node_mass, set.node_position);
  return MatrixX::Identity(set.shape_count(), set.shape_count()) - P.transpose() * P / set.node_mass.sum() -
         S.transpose() * J.inverse() * S;
}

Accelerations::Accelerations(const ModalBody& body, const ModalBodyState& state, const Vector3& force,
                             const Vector3& moment, const VectorX& modal_load) {
  const int m = body.mode_count();
  const Matrix3X P = body.mean_axes() ? Matrix3X(Matrix3X::Zero(3, m)) : body.momentum_shape();
  MatrixX M(6 + m, 6 + m);
  M << body.mass() * Matrix3::Identity(), -skew(state.c), P, skew(state.c), state.J, state.S, P.transpose(),
      state.S.transpose(), MatrixX::Identity(m, m);
  VectorX r(6 + m);
  r << force - state.f_bias, moment - state.t_bias, modal_load - state.h_bias;
  const VectorX rates = M.llt().solve(r);
  a = rates.head<3>();
  alpha = rates.segment<3>(3);
  zddot = rates.tail(m);
}

}  // namespace wishbone::flexible_forms
