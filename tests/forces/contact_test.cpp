#include "forces/tire/contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "forces/support.h"

namespace wishbone {
namespace {

using testing::kDegree;
using testing::Random;
using testing::rotation;

constexpr double kRadius = 0.315;

MarkerState wheel_at(const Vector3& C, const Matrix3& R) {
  MarkerState wheel;
  wheel.p_WM = C;
  wheel.R_WM = R;
  return wheel;
}

// A random wheel over `road`: any heading and spin position, leaning up to 15 degrees, 0.27 ... 0.33 m above
// the road.
MarkerState random_wheel(Random& random, const Road& road) {
  const double x = random.uniform(8, 19), y = random.uniform(-2, 2);
  const double z = road.at(x, y, road.segment_at(x)).height + random.uniform(0.27, 0.33);
  const Matrix3 R = rotation(Vector3::UnitZ(), random.uniform(-3, 3)) *
                    rotation(Vector3::UnitX(), random.uniform(-15, 15) * kDegree) *
                    rotation(Vector3::UnitY(), random.uniform(-3, 3));
  MarkerState wheel = wheel_at({x, y, z}, R);
  wheel.v_WM = random.vector(20);
  wheel.w_WM = random.vector(2) + random.uniform(-100, 100) * R.col(1);
  return wheel;
}

const Road kRoads[] = {Road(), Road(6 * kDegree, {}), Road(6 * kDegree, {{7.2, 12.0, 0.03}})};

WheelContact contact_on(const MarkerState& wheel, const Road& road) {
  return wheel_contact(wheel, kRadius, road, road.segment_at(wheel.p_WM.x()));
}

TEST(WheelContact, IsTheDeepestPointOfTheDisc) {
  Random random(10);
  for (const Road& road : kRoads) {
    for (int i = 0; i < 100; ++i) {
      const MarkerState wheel = random_wheel(random, road);
      const WheelContact c = contact_on(wheel, road);
      const auto rim = [&](double angle) -> Vector3 {  // zero toward marker z
        return wheel.p_WM +
               kRadius * (std::cos(angle) * wheel.R_WM.col(2) + std::sin(angle) * wheel.R_WM.col(0));
      };
      // brute force: scan the rim for the point deepest below the tangent plane, then narrow around it
      double best = 0, width = EIGEN_PI;
      for (int pass = 0; pass < 8; ++pass, width *= 0.05) {
        const double centre = best;
        double least = 1e9;
        for (int k = -100; k <= 100; ++k) {
          const double angle = centre + width * k / 100;
          const double height = (rim(angle) - c.P0).dot(c.uz);
          if (height < least) least = height, best = angle;
        }
      }
      const Vector3 e = (rim(best) - wheel.p_WM) / kRadius;
      EXPECT_LT((wheel.p_WM + c.loaded_radius * e - c.P).norm(), 1e-7);
      // the disc cuts the plane iff its deepest point lies below it
      EXPECT_EQ(c.deflection > 0, (rim(best) - c.P0).dot(c.uz) < 0);
    }
  }
}

TEST(WheelContact, PointLiesInWheelPlaneAndTangentPlaneNearestToTheCentre) {
  Random random(11);
  for (const Road& road : kRoads) {
    for (int i = 0; i < 100; ++i) {
      const MarkerState wheel = random_wheel(random, road);
      const WheelContact c = contact_on(wheel, road);
      const Vector3 us = wheel.R_WM.col(1);
      // rounding of positions of 20 m
      EXPECT_NEAR((c.P - c.P0).dot(c.uz), 0, 1e-14);
      EXPECT_NEAR((c.P - wheel.p_WM).dot(us), 0, 1e-14);
      EXPECT_NEAR((c.P - wheel.p_WM).norm(), c.loaded_radius, 1e-14);
      EXPECT_NEAR(c.deflection, kRadius - c.loaded_radius, 1e-16);
      // the planes meet in a line along ux; no point of it is nearer
      for (const double s : {-0.1, -0.001, 0.001, 0.1}) {
        EXPECT_GT((c.P + s * c.ux - wheel.p_WM).norm(), c.loaded_radius);
      }
    }
  }
}

TEST(WheelContact, AxesAreARightHandedTriadOnTheRoad) {
  Random random(12);
  for (const Road& road : kRoads) {
    for (int i = 0; i < 100; ++i) {
      const MarkerState wheel = random_wheel(random, road);
      const WheelContact c = contact_on(wheel, road);
      Matrix3 axes;
      axes << c.ux, c.uy, c.uz;
      EXPECT_LT((axes.transpose() * axes - Matrix3::Identity()).norm(), 1e-14);
      EXPECT_NEAR(axes.determinant(), 1, 1e-14);
      EXPECT_NEAR(c.ux.dot(wheel.R_WM.col(1)), 0, 1e-15);
      EXPECT_NEAR(c.upright, std::cos(c.camber), 1e-15);
    }
  }
}

TEST(WheelContact, HeadsAlongXAndLeansTowardItsCamber) {
  const WheelContact c =
      contact_on(wheel_at({0, 0, 0.3}, rotation(Vector3::UnitX(), -5 * kDegree)), kRoads[0]);
  EXPECT_NEAR(c.ux.x(), 1, 1e-15);
  EXPECT_NEAR(c.uy.y(), 1, 1e-15);
  EXPECT_NEAR(c.camber, 5 * kDegree, 1e-15);  // top of the wheel toward +y
  EXPECT_NEAR(c.P.y(), -0.3 * std::tan(5 * kDegree), 1e-15);
}

TEST(WheelContact, WheelSquareOnABankHasNoCamber) {
  const Matrix3 R = rotation(Vector3::UnitX(), 6 * kDegree);
  const WheelContact c = contact_on(wheel_at(R * Vector3(0, 1, 0.3), R), kRoads[1]);
  EXPECT_NEAR(c.camber, 0, 1e-15);
  EXPECT_NEAR(c.loaded_radius, 0.3, 1e-15);
  EXPECT_LT((c.P - R * Vector3(0, 1, 0)).norm(), 1e-15);
}

TEST(WheelContact, TangentPlaneIsAsGoodAsTheSineRoadItself) {
  // The plane misses the surface by curvature (offset of P from P0)^2/2 = 2e-3/m (2.5 mm)^2/2 = 6e-9 m.
  const Road road(0.0, {{7.2, 12.0, 0.03}});
  for (double x = 7.5; x < 19; x += 0.5) {
    const double z = road.at(x, 0, 1).height + 0.3;
    const WheelContact c = contact_on(wheel_at({x, 0, z}, Matrix3::Identity()), road);
    double nearest = 1e9;  // of the surface, from the wheel centre
    for (int k = -4000; k <= 4000; ++k) {
      const double s = x + 1e-6 * k;
      nearest = std::min(nearest, std::hypot(s - x, road.at(s, 0, 1).height - z));
    }
    EXPECT_NEAR(c.loaded_radius, nearest, 1e-8);
  }
}

TEST(WheelContact, SpinMovesTheTreadOnly) {
  Random random(13);
  MarkerState wheel = random_wheel(random, kRoads[2]);
  const WheelContact c = contact_on(wheel, kRoads[2]);
  wheel.w_WM += 50 * wheel.R_WM.col(1);
  const WheelContact faster = contact_on(wheel, kRoads[2]);
  EXPECT_NEAR(faster.vx, c.vx, 1e-12);
  EXPECT_NEAR(faster.vy, c.vy, 1e-12);
  EXPECT_NEAR(faster.deflection_rate, c.deflection_rate, 1e-12);
  EXPECT_NEAR(faster.spin - c.spin, 50, 1e-12);
}

TEST(WheelContact, VelocityIsThatOfTheCarrierAtTheContactPoint) {
  // the carrier rolls about x at 1 rad/s: a point 0.3 m below moves left with 0.3 m/s
  MarkerState wheel = wheel_at({0, 0, 0.3}, Matrix3::Identity());
  wheel.v_WM = Vector3(10, 0, -0.2);
  wheel.w_WM = Vector3(1, 30, 0);
  const WheelContact c = contact_on(wheel, kRoads[0]);
  EXPECT_NEAR(c.vx, 10, 1e-15);
  EXPECT_NEAR(c.vy, 0.3, 1e-15);
  EXPECT_NEAR(c.deflection_rate, 0.2, 1e-15);
  EXPECT_NEAR(c.v_cir, (0.315 - 0.005) * 30, 1e-14);  // R1 - delta/3
}

TEST(WheelContact, DeflectionRateOfAnUprightWheelIsTheDerivativeOfItsDeflection) {
  const Road& road = kRoads[1];
  const Matrix3 R = rotation(Vector3::UnitX(), 6 * kDegree);
  MarkerState wheel = wheel_at(R * Vector3(1, 2, 0.29), R);
  wheel.v_WM = Vector3(20, -1, 0.4);
  const double h = 1e-4;
  const auto deflection = [&](double t) {
    return contact_on(wheel_at(wheel.p_WM + t * wheel.v_WM, R), road).deflection;
  };
  EXPECT_NEAR(contact_on(wheel, road).deflection_rate, (deflection(h) - deflection(-h)) / (2 * h), 1e-11);
}

}  // namespace
}  // namespace wishbone
