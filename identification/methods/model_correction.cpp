#include "identification/methods/model_correction.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>

#include "core/error.h"

namespace wishbone {

CorrectedModel correct_model(const SparseMatrix& M_a, const SparseMatrix& K_a, const Modes& measured) {
  const MatrixX& Phi = measured.shapes;
  const MatrixX M_Phi_a = M_a * Phi;
  const MatrixX m_a = Phi.transpose() * M_Phi_a;
  const Eigen::LLT<MatrixX> m_factor(m_a);
  if (m_factor.info() != Eigen::Success)
    throw InputError({"model correction", "the measured shapes must be linearly independent",
                      fmt::format("{} shapes", Phi.cols()), "leave out modes that were measured twice"});
  CorrectedModel corrected;
  const MatrixX identity = MatrixX::Identity(m_a.rows(), m_a.cols());
  // m_a^-1 (1 - m_a) m_a^-1
  const MatrixX middle = m_factor.solve(m_factor.solve(identity - m_a).transpose());
  corrected.M = MatrixX(M_a) + M_Phi_a * middle * M_Phi_a.transpose();

  const MatrixX M_Phi = corrected.M * Phi, K_Phi = K_a * Phi;
  MatrixX modal = Phi.transpose() * K_Phi;
  modal.diagonal() += measured.lambda;
  const MatrixX cross = K_Phi * M_Phi.transpose();
  corrected.K = MatrixX(K_a) - cross - cross.transpose() + M_Phi * modal * M_Phi.transpose();
  return corrected;
}

}  // namespace wishbone
