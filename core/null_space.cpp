#include "core/null_space.h"

#include <Eigen/QR>

namespace wishbone {

MatrixX null_space(const MatrixX& C) {
  Eigen::ColPivHouseholderQR<MatrixX> qr;
  qr.setThreshold(1e-9);
  qr.compute(C.transpose());
  const Eigen::Index left = C.cols() - qr.rank();
  MatrixX basis = MatrixX::Zero(C.cols(), left);
  basis.bottomRows(left).setIdentity();
  basis.applyOnTheLeft(qr.householderQ());
  return basis;
}

}  // namespace wishbone
