// Flexible bodies in every form against Newton's law of every node in inertial coordinates.

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "flexible_forms.h"

namespace wishbone {
namespace {

using namespace flexible_forms;

using Real = long double;
using RealVector3 = Eigen::Matrix<Real, 3, 1>;
using RealMatrix3 = Eigen::Matrix<Real, 3, 3>;
using RealMatrix3X = Eigen::Matrix<Real, 3, Eigen::Dynamic>;
using RealVectorX = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrixX = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// What the deflections of a form satisfy: six rows G with G delta = 0.
MatrixX reference_condition(const ShapeSet& set) {
  const VectorX mass = mass_of_freedoms(set.node_mass);
  if (set.mean_axes)
    return rigid_body_modes(set.node_mass, set.node_position).transpose() * mass.asDiagonal();
  MatrixX G = MatrixX::Zero(6, mass.size());
  int row = 0;
  for (Eigen::Index freedom = 0; freedom < mass.size(); ++freedom)
    if (set.shapes.row(freedom).isZero(0)) G(row++, freedom) = 1;
  EXPECT_EQ(row, 6);
  return G;
}

/// Elastic energy as a function of the inertial node positions alone: delta_i = R^T (x_i - p) - s_i, where the axes p, R are
/// found from the reference condition by Newton iteration.
class ElasticPotential {
 public:
  ElasticPotential(const ShapeSet& set, const MatrixX& K)
      : s_(set.node_position.cast<Real>()), G_(reference_condition(set).cast<Real>()), K_(K.cast<Real>()) {}

  Real operator()(const RealMatrix3X& x, RealVector3 p, RealMatrix3 R) const {
    for (int iteration = 0; iteration < 8; ++iteration) {
      // delta changes by -dp - phi x b
      const RealMatrix3X b = R.transpose() * (x.colwise() - p);
      RealMatrixX change(3 * b.cols(), 6);
      for (Eigen::Index i = 0; i < b.cols(); ++i) {
        change.block<3, 3>(3 * i, 0) = -RealMatrix3::Identity();
        change.block<3, 3>(3 * i, 3) << 0, -b(2, i), b(1, i), b(2, i), 0, -b(0, i), -b(1, i), b(0, i), 0;
      }
      const RealVectorX step = -(G_ * change).fullPivLu().solve(G_ * RealVectorX((b - s_).reshaped()));
      const RealVector3 phi = step.tail<3>();
      p += R * step.head<3>();
      const Real angle = phi.norm();
      if (angle > 0) R = R * Eigen::AngleAxis<Real>(angle, phi / angle).toRotationMatrix();
    }
    const RealVectorX delta = (RealMatrix3X(R.transpose() * (x.colwise() - p)) - s_).reshaped();
    return delta.dot(K_ * delta) / 2;
  }

  /// -dV/dx by sixth-order central differences.
  RealMatrix3X force(const RealMatrix3X& x, const RealVector3& p, const RealMatrix3& R) const {
    const Real h = 1e-3L;
    RealMatrix3X f(3, x.cols());
    for (Eigen::Index c = 0; c < x.size(); ++c) {
      const auto difference = [&](int steps) {
        RealMatrix3X forward = x, backward = x;
        forward(c % 3, c / 3) += steps * h;
        backward(c % 3, c / 3) -= steps * h;
        return (*this)(forward, p, R) - (*this)(backward, p, R);
      };
      f(c % 3, c / 3) = -(45 * difference(1) - 9 * difference(2) + difference(3)) / (60 * h);
    }
    return f;
  }

 private:
  RealMatrix3X s_;
  RealMatrixX G_, K_;
};

void expect_newtons_law_of_every_node(const ShapeSet& set) {
  const ModalBody body(set, kInterface);
  const Motion motion(body);
  const ModalBodyState state = state_of(body, motion);
  const NodeMotion node(set, motion);
  const Matrix3 R = Eigen::AngleAxisd(0.9, Vector3(2, -1, 0.5).normalized()).toRotationMatrix();
  const Vector3 p_WBo(4, -2, 1);

  // m_i x_i'' = f_i - dV/dx_i in inertial axes, with forces on the interface nodes
  const Matrix3X f_B = 1e3 * some_numbers(60, 3).reshaped(3, 20);
  const RealMatrix3X x = ((R * node.b).colwise() + p_WBo).cast<Real>();
  const ElasticPotential potential(set, MatrixX(stiffness_matrix(chassis_mesh(), kMaterial)));
  Matrix3X force =
      (R.transpose().cast<Real>() * potential.force(x, p_WBo.cast<Real>(), R.cast<Real>())).cast<double>();
  Vector3 resultant = Vector3::Zero(), moment = Vector3::Zero();
  VectorX modal_load = VectorX::Zero(54);
  for (int k = 0; k < body.interface_count(); ++k) {
    const Vector3 f = f_B.col(k), b = state.interface_b.col(k);
    force.col(kInterface[k] - 1) += f;
    resultant += f;
    moment += b.cross(f);
    modal_load += body.interface_shape(k).transpose() * f;
  }
  const Matrix3X newton = force * set.node_mass.cwiseInverse().asDiagonal();

  // the same accelerations from v_Bo', w', z''
  const Accelerations modal(body, state, resultant, moment, modal_load);
  const Vector3& w = motion.w_B;
  Matrix3X kinematic = (set.shapes * modal.zddot).reshaped(3, 20);
  for (int i = 0; i < 20; ++i) {
    const Vector3 b = node.b.col(i), delta_dot = node.delta_dot.col(i);
    kinematic.col(i) += modal.a + modal.alpha.cross(b) + w.cross(w.cross(b)) + 2 * w.cross(delta_dot);
  }
  EXPECT_LE((kinematic - newton).norm(), 1e-11 * newton.norm());
}

TEST(ModalBody, WithAllShapesObeysNewtonsLawOfEveryNode) {
  for (const NamedShapes& form : complete_forms()) {
    SCOPED_TRACE(form.form);
    expect_newtons_law_of_every_node(form.set);
  }
}

}  // namespace
}  // namespace wishbone
