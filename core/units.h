#pragma once

#include <string>
#include <string_view>

/// Physical quantities as text: `120 km/h`, `47 kN/m`, `6 deg`, `5 %`. Units are those of udunits2, and the
/// radian counts as a dimension of its own, so that N/rad is not mistaken for N, nor degrees for a ratio.
namespace wishbone {

/// What a number measures: a name for messages and the SI unit in which the program holds it.
struct Dimension {
  std::string_view name;
  std::string_view unit;
};

inline constexpr Dimension kRatio{"ratio", "1"};
inline constexpr Dimension kFrequency{"frequency", "Hz"};
inline constexpr Dimension kRate{"rate", "1/s"};
inline constexpr Dimension kLength{"length", "m"};
inline constexpr Dimension kMass{"mass", "kg"};
inline constexpr Dimension kTime{"time", "s"};
inline constexpr Dimension kAngle{"angle", "rad"};
inline constexpr Dimension kVelocity{"velocity", "m/s"};
inline constexpr Dimension kAngularVelocity{"angular velocity", "rad/s"};
inline constexpr Dimension kAcceleration{"acceleration", "m/s2"};
inline constexpr Dimension kForce{"force", "N"};
inline constexpr Dimension kMoment{"moment", "N m"};
inline constexpr Dimension kStiffness{"stiffness", "N/m"};
inline constexpr Dimension kDamping{"damping", "N s/m"};
inline constexpr Dimension kTorsionalStiffness{"torsional stiffness", "N m/rad"};
inline constexpr Dimension kTorsionalDamping{"torsional damping", "N m s/rad"};
inline constexpr Dimension kPitch{"pitch", "m/rad"};
inline constexpr Dimension kInertia{"moment of inertia", "kg m2"};
inline constexpr Dimension kDensity{"density", "kg/m3"};
inline constexpr Dimension kPressure{"pressure", "Pa"};
inline constexpr Dimension kForcePerAngle{"force per angle", "N/rad"};

inline constexpr double kStandardGravity = 9.80665;  ///< [m/s^2]

/// A number read from text, in SI.
struct Quantity {
  double value = 0;
  std::string base;  ///< dimension in SI base units such as "kg.s-2"; empty when the text was a plain number
};

/// True when `text` begins like a number and so cannot be meant as a word.
bool looks_like_number(std::string_view text);

/// Parses a number, optionally followed by a unit. Throws InputError (without a place: the caller knows it)
/// when there is no number, when it does not fit a double, or when the unit is unknown.
Quantity parse_quantity(std::string_view text);

/// The SI value of `text`, which must be a plain number or a quantity of the dimension `wanted`.
/// Throws InputError naming both dimensions when they differ.
double parse_quantity(std::string_view text, const Dimension& wanted);

/// "stiffness [N/m]" for the base units "kg.s-2"; the base units themselves when they have no name here.
std::string describe_dimension(const std::string& base);

}  // namespace wishbone
