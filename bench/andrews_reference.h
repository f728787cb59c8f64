#pragma once

#include <array>

namespace wishbone::bench {

/// Andrews' squeezing mechanism (models/scenes/benchmarks/andrews_squeezer.yaml): its angles at the start and after 0.03 s,
/// from two integrations in quadruple precision; rounded here to doubles.
struct AndrewsAngle {
  const char* joint;
  double start;  ///< [rad]
  double end;    ///< [rad]
};

inline constexpr double kAndrewsDuration = 0.03;  // [s]

inline constexpr std::array<AndrewsAngle, 7> kAndrewsAngles{
    {{"beta", -6.171389001427644963589e-02, 1.581077119515370709712e+01},
     {"theta", 0, -1.575637105841183946973e+01},
     {"gamma", 4.552798191630703802559e-01, 4.082224011964580485828e-02},
     {"phi", 2.226683901658858846745e-01, -5.347301163420795937702e-01},
     {"delta", 4.873649795438425502256e-01, 5.244099658799540693717e-01},
     {"Omega", -2.226683901658858846745e-01, 5.347301163420795937702e-01},
     {"epsilon", 1.230547444549821192497e+00, 1.048080741041937873069e+00}}};

}  // namespace wishbone::bench
