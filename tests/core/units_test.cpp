#include "core/units.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "core/error.h"
#include "text_files.h"

namespace wishbone {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Conversion {
  const char* text;
  Dimension dimension;
  double si;
  friend std::ostream& operator<<(std::ostream& out, const Conversion& conversion) {
    return out << conversion.text;
  }
};

class Units : public testing::TestWithParam<Conversion> {};

TEST_P(Units, AreConvertedToSi) {
  const auto& [text, dimension, si] = GetParam();
  EXPECT_NEAR(parse_quantity(text, dimension), si, 4e-16 * std::abs(si)) << text;
}

// Exact by definition: the international pound, foot and inch (1959), standard gravity.
INSTANTIATE_TEST_SUITE_P(
    Table, Units,
    testing::Values(Conversion{"120 km/h", kVelocity, 120 / 3.6}, Conversion{"47 kN/m", kStiffness, 47e3},
                    Conversion{"4 kN s/m", kDamping, 4e3}, Conversion{"4kN.s/m", kDamping, 4e3},
                    Conversion{"6 deg", kAngle, 6 * kDegree}, Conversion{"-6 degrees", kAngle, -6 * kDegree},
                    Conversion{"1.5°", kAngle, 1.5 * kDegree}, Conversion{"5 ms", kTime, 0.005},
                    Conversion{"210 MPa", kPressure, 210e6}, Conversion{"5 %", kRatio, 0.05},
                    Conversion{"3 mm", kLength, 0.003}, Conversion{"2600 kg/m^3", kDensity, 2600},
                    Conversion{"2.6 g/cm3", kDensity, 2600},
                    Conversion{"73.6 kN/rad", kForcePerAngle, 73.6e3},
                    Conversion{"1 kN/deg", kForcePerAngle, 1e3 / kDegree}, Conversion{"80 kN", kForce, 80e3},
                    Conversion{"1 lbf", kForce, 0.45359237 * 9.80665},
                    Conversion{"1 lbf ft", kMoment, 0.45359237 * 9.80665 * 0.3048},
                    Conversion{"60 rpm", kAngularVelocity, 2 * std::numbers::pi},
                    Conversion{"90 deg/s", kAngularVelocity, 90 * kDegree},
                    Conversion{"579 kg m2", kInertia, 579}, Conversion{"9.81 m/s²", kAcceleration, 9.81},
                    Conversion{"1 N/kg", kAcceleration, 1}, Conversion{"2.5 tonne", kMass, 2500},
                    Conversion{"+1e3", kMass, 1000}, Conversion{" .5 ", kLength, 0.5},
                    Conversion{"-1.", kLength, -1}, Conversion{"0", kStiffness, 0}));

TEST(Units, PlainNumbersKeepEveryBit) {
  std::mt19937_64 random(20240607);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!std::isnormal(x)) continue;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parse_quantity(fmt::format("{}", x)).value),
              std::bit_cast<std::uint64_t>(x));
  }
}

TEST(Units, WrongDimensionIsToldByBothNames) {
  EXPECT_EQ(message_of<InputError>([] { parse_quantity("0.5 m", kStiffness); }),
            "error: wrong dimension: stiffness [N/m] is wanted, this is length [m] (got '0.5 m')\n"
            "  give it in N/m, or in a unit that converts to it");
  EXPECT_EQ(message_of<InputError>([] { parse_quantity("3 kelvin", kLength); }),
            "error: wrong dimension: length [m] is wanted, this is [K] (got '3 kelvin')\n"
            "  give it in m, or in a unit that converts to it");
}

TEST(Units, RadianIsADimension) {
  EXPECT_THROW(parse_quantity("5 deg", kRatio), InputError);
  EXPECT_THROW(parse_quantity("5 %", kAngle), InputError);
  EXPECT_THROW(parse_quantity("80 kN", kForcePerAngle), InputError);
  EXPECT_THROW(parse_quantity("80 kN/rad", kForce), InputError);
  EXPECT_THROW(parse_quantity("5 Hz", kAngularVelocity), InputError);  // 5 Hz is not 5 rad/s
}

class NotQuantities : public testing::TestWithParam<const char*> {};

TEST_P(NotQuantities, AreRefused) {
  EXPECT_THROW(parse_quantity(GetParam()), InputError) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(Texts, NotQuantities,
                         testing::Values("", " ", "abc", "nan", ".nan", "inf", "-inf", ".inf", "-.Inf",
                                         "1e999", "-1e999", "1e-999", "1e308 km", "0x1F", "1_000", "1,5",
                                         "1D3", "1 000", "5 3", "--5", "+-5", "+", ".", "e5", "120 kmh",
                                         "5 rev/min", "20 degC", "5 m @ 3", "5 dB", "m", "5 (", "5 m^",
                                         "5 m/", "5 \x01", "5 m since 2000-01-01", "1 -3 m", "1 +3 m",
                                         "1 .5 m"));

}  // namespace
}  // namespace wishbone
