#include "forces/applied_load.h"

#include <gtest/gtest.h>

#include <limits>

#include "forces/support.h"

namespace wishbone {
namespace {

using testing::Applied;
using testing::applied;
using testing::rotation;

const Wrench kLoad{Vector3(0, 0, 5), Vector3(2, 0, 0)};

MarkerState quarter_turn_about_z() {
  MarkerState m;
  m.R_WM = rotation(Vector3::UnitZ(), EIGEN_PI / 2);
  m.v_WM = Vector3(3, 7, 0);
  m.w_WM = Vector3(0, 0, 1);
  return m;
}

TEST(AppliedLoad, DeadLoadKeepsItsDirection) {
  const Applied a = applied(AppliedLoad("load", 0, kLoad), {quarter_turn_about_z()});
  EXPECT_EQ(a.wrenches[0].f, kLoad.f);
  EXPECT_EQ(a.wrenches[0].t, kLoad.t);
  EXPECT_DOUBLE_EQ(a.power, 2 * 3 + 5 * 1);
}

TEST(AppliedLoad, FollowerLoadTurnsWithItsMarker) {
  const Applied a = applied(AppliedLoad("load", 0, kLoad, LoadAxes::kMarker), {quarter_turn_about_z()});
  EXPECT_LT((a.wrenches[0].f - Vector3(0, 2, 0)).norm(), 1e-15);
  EXPECT_LT((a.wrenches[0].t - kLoad.t).norm(), 1e-15);
  EXPECT_NEAR(a.power, 2 * 7 + 5 * 1, 1e-14);
}

TEST(AppliedLoad, RejectsLoadsThatAreNotNumbers) {
  const Wrench broken{Vector3::Zero(), Vector3(0, std::numeric_limits<double>::quiet_NaN(), 0)};
  EXPECT_THROW(AppliedLoad("load", 0, broken), InputError);
}

}  // namespace
}  // namespace wishbone
