#include "identification/methods/model_correction.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/methods/clean_up.h"
#include "identification/structures.h"

namespace wishbone {
namespace {

/// A structure that was measured, and a model of it whose material is 20 % too soft and unevenly so.
struct Pair {
  TestStructure truth = chassis();
  SparseMatrix K_model = [&] {
    SparseMatrix K = 0.8 * truth.K;
    const TestStructure other = chassis();
    K += 0.05 * other.K;
    return K;
  }();
};

TEST(ModelCorrection, TakesOverTheMeasuredModes) {
  const Pair pair;
  const Modes measured = cleaned_up(pair.truth.elastic().lowest(8), pair.truth.M, pair.truth.rigid);
  const CorrectedModel model = correct_model(pair.truth.M, pair.K_model, measured);
  const MatrixX inertia = model.M * measured.shapes * measured.lambda.asDiagonal();
  EXPECT_LE((model.K * measured.shapes - inertia).norm(), 1e-11 * inertia.norm());
  EXPECT_LE((model.M - MatrixX(pair.truth.M)).norm(), 1e-11 * pair.truth.M.norm())
      << "orthonormal modes need no change";
}

TEST(ModelCorrection, LeavesTheOtherModesAndRigidMotionAlone) {
  const Pair pair;
  const Modes all = pair.truth.elastic();
  const CorrectedModel model = correct_model(pair.truth.M, pair.K_model, all.lowest(8));
  const MatrixX others = all.shapes.rightCols(46);
  EXPECT_LE((model.K * others - pair.K_model * others).norm(), 1e-9 * (pair.K_model * others).norm());
  EXPECT_LE((model.K * pair.truth.rigid).norm(), 1e-11 * model.K.norm());
  EXPECT_LE((model.K - model.K.transpose()).norm(), 1e-13 * model.K.norm());
}

TEST(ModelCorrection, IsNoneWhenTheModelIsRight) {
  const TestStructure s = l_shape();
  const CorrectedModel model = correct_model(s.M, s.K, s.elastic().lowest(10));
  EXPECT_LE((model.K - MatrixX(s.K)).norm(), 1e-11 * s.K.norm());
}

TEST(ModelCorrection, ChangesTheMassForShapesThatAreNotOrthonormal) {
  const TestStructure s = chassis();
  Modes measured = s.elastic().lowest(5);
  measured.shapes.col(1) += 0.05 * measured.shapes.col(0);
  measured.shapes *= 1.02;
  const CorrectedModel model = correct_model(s.M, s.K, measured);
  const MatrixX gram = measured.shapes.transpose() * model.M * measured.shapes;
  EXPECT_LE((gram - MatrixX::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((model.K * measured.shapes - model.M * measured.shapes * measured.lambda.asDiagonal()).norm(),
            1e-10 * model.K.norm());
}

TEST(ModelCorrection, RefusesDependentShapes) {
  const TestStructure s = chassis();
  EXPECT_THROW(correct_model(s.M, s.K, {VectorX::Ones(2), s.elastic().shapes.col(0).replicate(1, 2)}),
               InputError);
}

}  // namespace
}  // namespace wishbone
