#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/error.h"
#include "forces/force_element.h"
#include "forces/tire/ua_tire.h"

namespace wishbone::testing {

/// Everything a force element gave in one evaluation.
struct Applied {
  std::vector<Wrench> wrenches;
  std::vector<double> rates;
  double power = 0;
};

template <class Element>
Applied applied(const Element& element, const std::vector<MarkerState>& markers,
                const std::vector<double>& states = {}, int segment = 0) {
  Applied result;
  result.wrenches.resize(markers.size());
  result.rates.resize(states.size());
  ForceOutput output{result.wrenches, result.rates};
  element.apply({0.0, markers, states, segment}, output);
  result.power = output.power;
  return result;
}

inline Matrix3 rotation(const Vector3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// Reproducible random numbers.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(engine_); }
  /// Either sign, magnitudes spread evenly over the decades between `least` and `most`.
  double signed_decades(double least, double most) {
    const double magnitude = least * std::pow(most / least, uniform(0, 1));
    return uniform(-1, 1) < 0 ? -magnitude : magnitude;
  }
  Vector3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }

 private:
  std::mt19937 engine_;
};

/// Two markers anywhere in any motion, whose z axes agree, turned by u.
inline std::vector<MarkerState> hinge(double u, unsigned seed) {
  Random random(seed);
  std::vector<MarkerState> markers(2);
  for (MarkerState& m : markers)
    m = {Matrix3::Identity(), random.vector(1), random.vector(2), random.vector(3)};
  markers[0].R_WM = rotation(random.vector(1), random.uniform(-3, 3));
  markers[1].R_WM = markers[0].R_WM * rotation(Vector3::UnitZ(), u);
  return markers;
}

/// A 205/60 R14 passenger-car tire, the data set of the published reference table.
inline UaTireParameters sample_tire() {
  UaTireParameters t;
  t.radius = 0.3008;
  t.radial_stiffness = 176400;
  t.radial_damping_ratio = 0.01;
  t.mass = 20;
  t.slip_stiffness = 30000;
  t.cornering_stiffness = 73600;
  t.camber_stiffness = 8094;
  t.rolling_resistance = 0.001;
  t.friction_max = 1.0;
  t.friction_min = 0.8;
  t.relaxation_x = 0.3;
  t.relaxation_y = 0.5;
  return t;
}

inline constexpr double kDegree = EIGEN_PI / 180;

/// The message of the error that `action` throws; empty when it throws none.
template <class Err, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Err& error) {
    return error.what();
  }
  return {};
}

}  // namespace wishbone::testing
