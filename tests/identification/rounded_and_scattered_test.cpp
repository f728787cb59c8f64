// Modes as files and tests have them, of few digits and with scatter, and what nobody asked for among them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "identification/free_model.h"
#include "identification/identify.h"
#include "identification/judgement/mac.h"
#include "identification/measured.h"
#include "identification/methods/support_matrices.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

void scatter(double size, unsigned seed, ModalData& data) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int j = 0; j < data.mode_count(); ++j) {
    const double rms = data.shapes.col(j).norm() / std::sqrt(static_cast<double>(data.freedom_count()));
    for (double& x : data.shapes.col(j)) x += size * rms * normal(random);
  }
}

void write_with(int digits, ModalData& data) {
  for (double& x : data.shapes.reshaped())
    if (x != 0) {
      const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) + 1 - digits);
      x = std::round(x / unit) * unit;
    }
}

/// A free test that lists the rigid-body modes too, all six or some of them, at frequencies of their own.
ModalData with_rigid_modes(const TestStructure& s, int rigid, double hz, int elastic) {
  ModalData data = measured_on(s, {}, elastic);
  MatrixX shapes(s.n(), rigid + elastic);
  VectorX omega(rigid + elastic);
  shapes.rightCols(elastic) = data.shapes;
  omega.tail(elastic) = data.omega;
  data.shapes = shapes;
  data.omega = omega;
  data.damping_ratio = VectorX::Zero(rigid + elastic);
  data.modal_mass = VectorX::Ones(rigid + elastic);
  // no basis that geometry suggests
  const MatrixX turned =
      MatrixX::NullaryExpr(6, 6, [](auto i, auto j) { return std::sin(1.0 + 7 * i + 3 * j * j); })
          .householderQr()
          .householderQ();
  data.shapes.leftCols(rigid) = (s.rigid * turned).leftCols(rigid);
  for (int j = 0; j < rigid; ++j) data.omega[j] = 2 * 3.141592653589793 * hz * (1 + 0.1 * j);
  return data;
}

TEST(RigidModes, AreLeftOutWhateverTheirDigits) {
  for (const TestStructure& s : {chassis(), random_lumped(4, 7), l_shape()})
    for (const int digits : {4, 5, 6, 9})
      for (const int rigid : {1, 3, 6}) {
        const Modes truth = s.elastic().lowest(5);
        IdentificationTask task;
        task.measured = with_rigid_modes(s, rigid, 1e-3, 5);
        write_with(digits, task.measured);
        const Identification found = identify(task);
        ASSERT_EQ(found.modes.mode_count(), 5);
        EXPECT_LE(worst_relative(found.modes.omega.cwiseAbs2(), truth.lambda), 1e-12);
        const VectorX mac = modal_assurance(found.modes.shapes, task.measured.shapes.rightCols(5)).diagonal();
        EXPECT_GE(mac.minCoeff(), 1 - 1e-6) << digits << " digits, " << rigid << " rigid-body modes";
        EXPECT_THAT(found.judgement.warnings, IsEmpty());
        EXPECT_THAT(found.judgement.notes, Contains(HasSubstr("left out: rigid-body motion up to")));
      }
}

TEST(RigidModes, OnASupportThatNobodyNamedAreTold) {
  IdentificationTask task;
  task.measured = with_rigid_modes(chassis(), 2, 3, 5);
  const Identification found = identify(task);
  EXPECT_EQ(found.modes.mode_count(), 5);
  EXPECT_THAT(found.judgement.warnings,
              Contains(HasSubstr(
                  "modes 1, 2 are mostly rigid-body motion, as on a support, and no support is named")));
}

TEST(RigidModes, AloneAreRefused) {
  IdentificationTask task;
  task.measured = with_rigid_modes(chassis(), 6, 1e-3, 1).with_modes({0, 1, 2});
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
              HasSubstr("the measured modes are nothing but rigid-body motion (got modes 1, 2, 3)"));
}

TEST(Scatter, IsFoundAndHandledAsIfItHadBeenGiven) {
  const TestStructure s = chassis();
  for (const double size : {1e-4, 1e-3, 1e-2}) {
    IdentificationTask task = task_on(s, springs_at({1, 2, 17, 18}, 12e3), 30);
    scatter(size, 5, task.measured);
    const Identification found = identify(task);
    EXPECT_NEAR(found.judgement.shape_scatter, size, 0.15 * size);
    IdentificationTask given = task;
    given.noise = MeasurementNoise{0, size, 200, 1};
    EXPECT_LE(worst_relative(frequencies(found), frequencies(identify(given))), 1e-12);
    EXPECT_LE(worst_relative(frequencies(found).head(10), free_frequencies(s).head(10)), 10 * size);
    EXPECT_EQ(found.judgement.frequency_std_hz.size(), found.modes.mode_count());
  }
}

TEST(Scatter, OfExactModesIsRoundingAndChangesNothing) {
  const Identification found = identify(task_on(chassis(), chassis_springs(), 30));
  EXPECT_LE(found.judgement.shape_scatter, 1e-9);
  EXPECT_EQ(found.judgement.frequency_std_hz.size(), 0);
}

TEST(Scatter, BeyondWhatWasGivenIsTold) {
  IdentificationTask task = task_on(chassis(), chassis_springs(), 30);
  scatter(1e-2, 5, task.measured);
  task.noise = MeasurementNoise{0, 1e-3, 20, 1};
  EXPECT_THAT(identify(task).judgement.warnings, Contains(HasSubstr("more than the 0.1 % given")));
}

TEST(FreeModel, IsRefusedWithTheNodesThatHoldIt) {
  for (const double stiffness : {1e3, 1e5, 1e8}) {
    AnalyticalModel model = model_of(chassis());
    const SupportMatrices support = support_matrices(springs_at({3, 17}, stiffness), model.freedoms());
    check_is_free(model);
    model.K += support.K_s;
    EXPECT_THAT(message_of<InputError>([&] { check_is_free(model); }),
                AllOf(HasSubstr("must not resist rigid-body motion"), HasSubstr("(got nodes "),
                      HasSubstr("3"), HasSubstr("17"), HasSubstr(" held, by ")));
  }
}

TEST(FreeModel, IsRefusedInRowsThatRunAxisByAxis) {
  for (const TestStructure& s : {chassis(), l_shape(), random_lumped(6, 3)}) {
    AnalyticalModel model = model_of(s);
    const Eigen::Index n = s.n() / 3;
    Eigen::PermutationMatrix<Eigen::Dynamic> order(s.n());
    for (Eigen::Index i = 0; i < s.n(); ++i) order.indices()[i] = static_cast<int>(n * (i % 3) + i / 3);
    model.K = SparseMatrix(order * model.K * order.transpose());
    EXPECT_THAT(message_of<InputError>([&] { check_is_free(model); }),
                HasSubstr("x of all nodes first, then y"));
  }
}

TEST(FreeModel, MayHaveBeenWrittenWithSixDigits) {
  for (const TestStructure& s : {chassis(), l_shape(), random_lumped(6, 3)}) {
    AnalyticalModel model = model_of(s);
    for (double& k : model.K.coeffs())
      if (k != 0) {
        const double unit = std::pow(10.0, std::floor(std::log10(std::abs(k))) - 5);
        k = std::round(k / unit) * unit;
      }
    EXPECT_NO_THROW(check_is_free(model));
  }
}

}  // namespace
}  // namespace wishbone
