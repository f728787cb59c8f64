// Points that meet: a distance of zero has a value, and a spring of free length zero a force.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.h"
#include "models/ran_scene.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

/// A body of 2 kg on a rail along x.
std::string railed(const std::string& joint, const std::string& rest) {
  return "wishbone: 1\ngravity: [0, 0, 0]\n"
         "bodies: {puck: {mass: 2, inertia: [0.1, 0.1, 0.1], position: [0, 0, 0]}}\n"
         "joints: {rail: {type: prismatic, bodies: [ground, puck], at: [0, 0, 0], axis: [1, 0, 0], " +
         joint + "}}\n" + rest;
}

constexpr const char* kGap =
    "signals: {gap: {from: {ground: [0, 0, 0]}, to: {body: puck}}, "
    "parting: {from: {ground: [0, 0, 0]}, to: {body: puck}, quantity: speed}}\n";

TEST(MeetingPoints, ADistanceThatStartsAtZeroIsMeasured) {
  for (const char* method : {"erk", "bdf", "adams"}) {
    const RanScene run(
        railed("speed: 1", kGap +
                               std::string("loads: {push: {joint: rail, force: {expression: "
                                           "'0*gap*parting'}}}\nanalysis: {duration: 0.5, integrator: ") +
                               method + "}\noutput: {interval: 0.1}\n"));
    const MatrixX gap = run.read("/signals/gap"), parting = run.read("/signals/parting");
    for (Eigen::Index k = 0; k < gap.rows(); ++k) {
      EXPECT_NEAR(gap(k, 0), 0.1 * static_cast<double>(k), 1e-9) << method;
      EXPECT_NEAR(parting(k, 0), 1, 1e-9) << method;
    }
  }
}

TEST(MeetingPoints, ADistanceMayPassAndRestAtZero) {
  const RanScene passing(railed("position: -0.2, speed: 1",
                                kGap + std::string("analysis: {duration: 0.4}\noutput: {interval: 0.1}\n")));
  EXPECT_NEAR(passing.read("/signals/gap")(2, 0), 0, 1e-9);
  EXPECT_NEAR(passing.read("/signals/gap")(4, 0), 0.2, 1e-9);
  const RanScene resting(
      railed("speed: 0", kGap + std::string("analysis: {duration: 0.1}\noutput: {interval: 0.1}\n")));
  EXPECT_EQ(resting.read("/signals/gap")(1, 0), 0);
  EXPECT_EQ(resting.read("/signals/parting")(1, 0), 0);
}

TEST(MeetingPoints, ASpringOfNoFreeLengthOscillatesThroughZero) {
  for (const char* method : {"erk", "bdf", "adams"}) {
    const RanScene run(railed(
        "position: 0.3",
        std::string(
            "springs: {s: {from: {ground: [0, 0, 0]}, to: {body: puck}, stiffness: 50 N/m, free_length: 0}}\n"
            "analysis: {duration: 10, rtol: 1e-8, atol: 1e-10, integrator: ") +
            method + "}\noutput: {interval: 0.01}\n"));
    const MatrixX x = run.read("/joints/rail/coordinates");
    for (Eigen::Index k = 0; k < x.rows(); ++k)
      ASSERT_NEAR(x(k, 0), 0.3 * std::cos(5 * 0.01 * static_cast<double>(k)), 1e-5)
          << method << ", row " << k;
  }
}

TEST(MeetingPoints, ASpringAndDamperOfNoFreeLengthStartAtZero) {
  // 2 x'' + 4 x' + 50 x = 0, x' = 1: x = exp(-t) sin(w t)/w, w^2 = 24
  const RanScene run(railed("speed: 1",
                            "springs: {s: {from: {ground: [0, 0, 0]}, to: {body: puck}, stiffness: 50, "
                            "damping: 4, free_length: 0}}\n"
                            "analysis: {duration: 2, rtol: 1e-9, atol: 1e-11}\noutput: {interval: 0.01}\n"));
  const MatrixX x = run.read("/joints/rail/coordinates");
  const double w = std::sqrt(24.0);
  for (Eigen::Index k = 0; k < x.rows(); ++k) {
    const double t = 0.01 * static_cast<double>(k);
    ASSERT_NEAR(x(k, 0), std::exp(-t) * std::sin(w * t) / w, 1e-7) << "row " << k;
  }
}

std::string failure_of(const std::string& text) {
  const TextFiles files;
  try {
    const Scene scene = load_scene(files.write("scene.yaml", text));
    return run_scene(scene, compile(scene), {"scene.yaml", files / "out.h5", {}, {}}).summary.message;
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(MeetingPoints, ASpringWithAFreeLengthIsNamed) {
  EXPECT_THAT(failure_of(railed("speed: 0",
                                "springs: {coil: {from: {ground: [0, 0, 0]}, to: {body: puck}, stiffness: "
                                "50, free_length: 0.1}}\n")),
              testing::AllOf(HasSubstr("coil"), HasSubstr("the ends of the spring must not coincide")));
}

TEST(MeetingPoints, ADistanceJointIsAdvisedAsItCanBeFollowed) {
  const auto rod = [](const std::string& joint, const std::string& length) {
    return railed(joint, "closures: {rod: {type: distance, from: {ground: [0, 0, 0]}, to: {body: puck}" +
                             length + "}}\nanalysis: {duration: 0.1}\n");
  };
  EXPECT_THAT(failure_of(rod("speed: 0", "")), HasSubstr("set them apart, by 'position' of a joint"));
  EXPECT_EQ(failure_of(rod("position: 0.2", ", length: 0.2")), "complete");
}

TEST(MeetingPoints, StopsTakeTheirStiffnessInTheUnitOfTheirExponent) {
  const auto stop = [](const std::string& limits) {
    return failure_of(
        railed("position: 0.5, limits: {lower: 0, " + limits + "}", "analysis: {duration: 0.1}\n"));
  };
  EXPECT_EQ(stop("stiffness: 1e6"), "complete");
  EXPECT_EQ(stop("stiffness: 1e3 kN/m, exponent: 1, damping: 0.1 s/m"), "complete");
  EXPECT_EQ(stop("stiffness: 1e6 N/m2, exponent: 2"), "complete");
  EXPECT_THAT(stop("stiffness: 1e6 N/m"), HasSubstr("the stiffness of a stop of exponent 1.5 is in N/m^1.5"));
  EXPECT_THAT(stop("stiffness: 1e6 N/m, exponent: 2"), HasSubstr("stiffness of a stop [N/m2] is wanted"));
  EXPECT_THAT(stop("stiffness: 1e6, damping: 2 N s/m"), HasSubstr("damping of a stop [s/m] is wanted"));
}

}  // namespace
}  // namespace wishbone
