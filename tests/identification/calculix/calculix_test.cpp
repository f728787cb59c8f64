// Identification of a structure of 3885 freedoms that another program modelled and solved: CalculiX gives
// modes on a support to six digits, and what they are held against, the modes of the free structure.
#include <gtest/gtest.h>

#include <cmath>

#include "identification/calculix/calculix_structure.h"
#include "identification/calculix/calculix_user_files.h"
#include "identification/formats/matrix_market.h"
#include "identification/formats/modal_file.h"
#include "identification/identify.h"
#include "identification/methods/lowest_modes.h"
#include "identification/methods/released_modes.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/support_matrices.h"
#include "models/identification_loader.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

constexpr double kSevenDigits = 5e-7;  // of eigenvalues in a .dat file

class CalculixFrame : public testing::Test {
 protected:
  void SetUp() override {
    if (!calculix_is_installed()) GTEST_SKIP() << "CalculiX (ccx) is not installed";
  }
};

MatrixX rigid_modes_of(const CalculixStructure& s) {
  const ModalData& data = s.supported;
  return rigid_body_basis(rigid_body_shapes(data.freedoms, data.node_ids, data.node_position), s.M);
}

ReleasedModes release(const CalculixStructure& s) {
  const ModalData& data = s.supported;
  return release({data.omega.cwiseAbs2(), data.shapes}, s.M, support_matrices(data.support, data.freedoms),
                 rigid_modes_of(s));
}

/// MAC of each mode with its counterpart, in the metric of M.
VectorX mac(const MatrixX& a, const MatrixX& b, const SparseMatrix& M) {
  const VectorX product = a.cwiseProduct(M * b).colwise().sum();
  return product.cwiseAbs2().cwiseQuotient(modal_masses(a, M).cwiseProduct(modal_masses(b, M)));
}

VectorX relative_difference(const VectorX& a, const VectorX& b) {
  return a.cwiseQuotient(b).array() - 1;
}

/// The `count` lowest released modes against CalculiX's own of the free structure.
void expect_free_modes(const ReleasedModes& released, const CalculixStructure& s, Eigen::Index count,
                       double frequency_error, double least_mac) {
  ASSERT_GE(released.modes.count(), count);
  const Modes found = released.modes.lowest(count);
  const Modes truth{s.free.lambda.segment(6, count), s.free.shapes.middleCols(6, count)};
  const VectorX error = relative_difference(found.frequency_hz(), truth.frequency_hz());
  EXPECT_GE(error.minCoeff(), -kSevenDigits) << "Rayleigh-Ritz bounds frequencies from above";
  EXPECT_LE(error.maxCoeff(), frequency_error);
  EXPECT_GE(mac(found.shapes, truth.shapes, s.M).minCoeff(), least_mac);
  const MatrixX gram = found.shapes.transpose() * (s.M * found.shapes);
  EXPECT_LE((gram - MatrixX::Identity(count, count)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((rigid_modes_of(s).transpose() * (s.M * found.shapes)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(CalculixFrame, IsReadAsItWasModelled) {
  const CalculixModel model = calculix_frame();
  const CalculixStructure s = calculix_supported_structure(frame_springs(1e7));
  ASSERT_GE(s.supported.freedom_count(), 3000);

  double volume = 0;
  for (int e = 0; e < model.mesh.elements.cols(); ++e) volume += model.mesh.geometry(e).volume();
  const MatrixX translations =
      rigid_body_shapes(s.supported.freedoms, s.supported.node_ids, s.supported.node_position).leftCols(3);
  EXPECT_LE((translations.transpose() * s.M * translations / (model.material.density * volume) -
             Matrix3::Identity())
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
  EXPECT_LE((s.K * rigid_modes_of(s)).norm(), 1e-13 * s.K.norm() * rigid_modes_of(s).norm());
}

TEST_F(CalculixFrame, HasTheModesThatCalculixFinds) {
  const CalculixStructure s = calculix_supported_structure(frame_springs(1e7));
  const SparseMatrix K_s = support_matrices(s.supported.support, s.supported.freedoms).K_s;

  const Modes held = lowest_modes(s.K + K_s, s.M, 40);
  EXPECT_LE(relative_difference(held.lambda, s.supported.omega.cwiseAbs2()).cwiseAbs().maxCoeff(),
            kSevenDigits);
  EXPECT_GE(mac(held.shapes, s.supported.shapes, s.M).minCoeff(), 1 - 1e-9);

  const Modes free = lowest_modes(s.K, s.M, 46);
  EXPECT_LE(free.lambda.head(6).cwiseAbs().maxCoeff(), 1e-9 * free.lambda[6]);
  EXPECT_LE(relative_difference(free.lambda.tail(40), s.free.lambda.tail(40)).cwiseAbs().maxCoeff(),
            kSevenDigits);
  EXPECT_GE(mac(free.shapes.rightCols(40), s.free.shapes.rightCols(40), s.M).minCoeff(), 1 - 1e-9);
}

TEST_F(CalculixFrame, IsFreedFromItsSprings) {
  // 40 modes on springs, six of which are rigid motion on them
  const CalculixStructure s = calculix_supported_structure(frame_springs(1e7));
  expect_free_modes(release(s), s, 34, 1e-4, 0.9999);
}

TEST_F(CalculixFrame, IsFreedFromItsJoints) {
  // a joint at a node dents the solid about it: the upper half of a truncated set shows it
  const CalculixStructure s = calculix_supported_structure(frame_joints());
  expect_free_modes(release(s), s, 20, 1e-3, 0.999);
}

TEST_F(CalculixFrame, IsTheSameInEveryFileThatItsAnalystHandsOver) {
  const CalculixStructure s = calculix_supported_structure(frame_springs(1e7));
  const TemporaryFolder folder;
  write_user_files(s, folder / "");
  const VectorX expected = release(s).modes.frequency_hz();
  for (const char* name : {"modes.h5", "modes.unv", "modes.csv"}) {
    CalculixStructure read{read_modal_data(folder / name), read_matrix_market(folder / "mass.mtx"), {}, {}};
    ASSERT_EQ(read.supported.freedoms, s.supported.freedoms) << name;
    read.supported.support = s.supported.support;
    EXPECT_LE(relative_difference(release(read).modes.frequency_hz(), expected).cwiseAbs().maxCoeff(), 1e-5)
        << name;
  }
}

TEST_F(CalculixFrame, IsIdentifiedFromTheFilesOfItsAnalyst) {
  const TemporaryFolder folder;
  write_user_files(calculix_supported_structure(frame_joints()), folder / "");
  const Identification result = identify(load_identification(folder / "identification.yaml").task);
  ASSERT_TRUE(result.judgement.reference);
  const ReferenceComparison& comparison = *result.judgement.reference;
  for (int j = 0; j < 20; ++j) {
    const auto i = static_cast<std::size_t>(j);
    EXPECT_EQ(comparison.partner[i], j);
    EXPECT_LE(std::abs(comparison.frequency_error[j]), 1e-3);
    EXPECT_GE(comparison.mac(j, j), 0.999);
  }
}

}  // namespace
}  // namespace wishbone
