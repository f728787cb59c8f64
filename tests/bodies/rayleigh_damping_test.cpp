// Damping in proportion to mass and stiffness: the same in every form of a body, and blind to rigid motion.
#include "bodies/rayleigh_damping.h"

#include <gtest/gtest.h>

#include "bodies/nodal_shapes.h"
#include "flexible_forms.h"
#include "identification/free_free_modes.h"
#include "identification/nodal_model.h"

namespace wishbone {
namespace {

constexpr RayleighDamping kDamping{3.0, 2e-4};

const ModeSet& soft_block() {
  static const ModeSet set = [] {
    ModeSet modes = free_free_modes(make_block({1.2, 0.4, 0.3}, {3, 1, 1}), {1e8, 0.3, 2000});
    modes.damping_ratio = kDamping.ratios(modes.omega);
    return modes;
  }();
  return set;
}

TEST(RayleighDamping, OfAModeIsThatOfTheOscillatorWithProportionalDamper) {
  // m x'' + (alpha m + beta k) x' + k x = 0:  zeta = c / (2 sqrt(k m))
  const double m = 3.2, k = 540;
  const double c = kDamping.mass * m + kDamping.stiffness * k;
  const VectorX omega = VectorX::Constant(1, std::sqrt(k / m));
  EXPECT_NEAR(kDamping.ratios(omega)[0], c / (2 * std::sqrt(k * m)), 1e-15);
}

TEST(RayleighDamping, OfTheNodesIsThatOfTheModes) {
  const ShapeSet mean = mean_axis_shapes(nodal_model(soft_block()));
  const MatrixX expected = kDamping.mass * MatrixX::Identity(mean.shape_count(), mean.shape_count()) +
                           kDamping.stiffness * mean.stiffness;
  EXPECT_LE((mean.damping - expected).norm(), 1e-12 * expected.norm());
}

TEST(RayleighDamping, IsOfTheMassAgainstDeflectionsWhateverAxesTheseAreMeasuredIn) {
  // free motion about fixed axes: what is left of the mass 1 of z when force and moment vanish,
  //   M_z = 1 - P^T P / m - S^T J^-1 S,   S, J about the mass centre
  const ShapeSet set = fixed_axis_shapes(nodal_model(soft_block()), {1, 13, 3});
  const MatrixX M_z = flexible_forms::mass_of_free_motion(set);
  const MatrixX expected = kDamping.mass * M_z + kDamping.stiffness * set.stiffness;
  EXPECT_LE((set.damping - expected).norm(), 1e-12 * expected.norm());
  const MatrixX only_mass = kDamping.mass * M_z;  // which the stiff share would hide
  const MatrixX found = set.damping - kDamping.stiffness * set.stiffness;
  EXPECT_LE((found - only_mass).norm(), 1e-8 * only_mass.norm());
}

}  // namespace
}  // namespace wishbone
