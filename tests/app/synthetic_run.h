#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "solver/recorder.h"

namespace wishbone {

/// Smooth made-up motions in the layout of a vehicle run, with the sizes of one (no dynamics behind them): a
/// steering pulse, 5 ms output, the chassis flexible or rigid.
struct SyntheticRun {
  bool flexible = true;
  double scale = 1;       ///< of every motion
  double step = 0.005;    ///< [s]
  double duration = 2.0;  ///< [s]
};

inline std::vector<Signal> synthetic_signals(bool flexible) {
  std::vector<Signal> signals{
      {"/bodies/chassis/position", {3}, "m", "world", "origin of the chassis", {}},
      {"/vehicle/lateral_position", {}, "m", "", "y of the chassis origin", {}},
      {"/vehicle/vertical_position", {}, "m", "", "z of the chassis origin", {}},
      {"/bodies/chassis/orientation", {4}, "1", "world", "quaternion w x y z, chassis to world", {}},
      {"/vehicle/side_slip", {}, "rad", "chassis", "side-slip angle of the chassis", {}},
      {"/vehicle/roll_rate", {}, "rad/s", "chassis", "roll rate", {}},
      {"/vehicle/yaw_rate", {}, "rad/s", "chassis", "yaw rate", {}},
      {"/vehicle/lateral_velocity", {}, "m/s", "chassis", "lateral velocity of the chassis origin", {}},
      {"/vehicle/steering_left", {}, "rad", "chassis", "steering angle of the left wheel", {}},
      {"/vehicle/steering_right", {}, "rad", "chassis", "steering angle of the right wheel", {}}};
  for (const char* wheel : {"front_left", "front_right", "rear_left", "rear_right"})
    signals.push_back({std::string("/tires/") + wheel + "/deflection", {}, "m", "", "radial deflection", {}});
  if (flexible)
    signals.push_back({"/flexible/chassis/deflection",
                       {3, 3},
                       "m",
                       "chassis",
                       "deflection of nodes",
                       {{"nodes", {"1", "19", "20"}}}});
  return signals;
}

inline void write_synthetic_run(const std::string& path, const SyntheticRun& run) {
  Recorder recorder(path, synthetic_signals(run.flexible));
  const double pi = std::acos(-1.0);
  const double e = run.flexible ? 1 : 0;  // what flexibility adds
  const long rows = std::lround(run.duration / run.step);
  for (long n = 0; n <= rows; ++n) {
    const double t = static_cast<double>(n) * run.step;
    const auto decay = [&](double f, double zeta) {
      return t < 0.3 ? 0.0 : std::exp(-zeta * 2 * pi * f * (t - 0.3)) * std::sin(2 * pi * f * (t - 0.3));
    };
    const double pulse = t > 0.3 && t < 0.57 ? std::sin(pi * (t - 0.3) / 0.27) : 0;
    const double sag = 0.012 * std::exp(-3 * t) * std::cos(2 * pi * 1.4 * t);
    const double y = t < 0.3 ? 0 : 0.35 * (1 - std::exp(-2.2 * (t - 0.3))) + e * 0.004 * (t - 0.3);
    const double z = 0.42 - sag - e * 0.0006 * std::cos(2 * pi * 11 * t) * std::exp(-2 * t);
    std::vector<double> row{33.333 * t,
                            y,
                            z,
                            y,
                            z,
                            1,
                            0,
                            0,
                            0,
                            -0.018 * decay(1.1, 0.45) + e * 4e-4 * decay(6, 0.2),
                            0.16 * decay(1.6, 0.3) + e * 0.012 * decay(7, 0.1),
                            0.11 * decay(0.9, 0.6) + e * 0.003 * decay(8, 0.1),
                            -0.55 * decay(1.1, 0.45) + e * 0.015 * decay(6, 0.2),
                            0.01745 * pulse,
                            0.01738 * pulse};
    for (int wheel = 0; wheel < 4; ++wheel)
      row.push_back(0.0172 + 0.002 * (wheel < 2 ? 1 : -1) + 0.8 * sag * (wheel < 2 ? 1 : 0.8) +
                    (wheel % 2 ? 1 : -1) * 0.0045 * decay(1.5, 0.35) + e * 0.0004 * decay(9, 0.1));
    if (run.flexible)
      for (const double size : {0.0004, 0.0028, 0.0031})
        for (const double axis : {0.12, 0.3, 1.0})
          row.push_back(-size * axis *
                        (std::exp(-1.6 * t) * std::cos(2 * pi * 5.2 * t) + 0.5 * decay(6.3, 0.12)));
    for (double& value : row) value *= run.scale;
    recorder.append(t, row);
  }
  recorder.set_meta("version", "0.1.0");
  recorder.set_meta(
      "scene", "vehicle:\n  chassis: {flexible: " + std::string(run.flexible ? "true" : "false") + "}\n");
  recorder.set_meta("coordinates", run.flexible ? 84.0 : 46.0);
  recorder.set_meta("integrator", "ida");
  recorder.set_run_meta("host", "example");
  recorder.set_run_meta("wall_time", run.flexible ? 0.42 : 0.11);
  recorder.close(Outcome::kComplete);
}

}  // namespace wishbone
