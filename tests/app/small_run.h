#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/recorder.h"

namespace wishbone {

/// A run of few rows with one scalar and one vector signal.
struct SmallRun {
  std::vector<double> times{0, 1, 2, 3, 4};
  std::function<double(double)> scalar = [](double t) { return t; };
  std::function<std::vector<double>(double)> vector = [](double t) { return std::vector<double>{100, t, 0}; };
  std::string scalar_path = "/group/scalar";
  std::string units = "m";
  Outcome outcome = Outcome::kComplete;

  std::string write(const std::string& path) const {
    Recorder recorder(
        path, {{scalar_path, {}, units, "", "scalar", {}}, {"/group/vector", {3}, "N", "world", "", {}}});
    for (const double t : times) {
      std::vector<double> row = vector(t);
      row.insert(row.begin(), scalar(t));
      recorder.append(t, row);
    }
    recorder.close(outcome, "on purpose");
    return path;
  }
};

}  // namespace wishbone
