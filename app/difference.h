#pragma once

#include <string>
#include <utility>
#include <vector>

#include "solver/result_file.h"

namespace wishbone {

/// One number of a signal: its path and which of its components.
struct Channel {
  std::string path;
  int component = 0;
  std::string name;  ///< of the component, "node 19 z"; empty for a scalar

  /// "/bodies/chassis/position y"
  std::string text() const { return name.empty() ? path : path + " " + name; }
};

/// Every component of a signal.
std::vector<Channel> channels(const Signal& signal);

/// The instants at which two files are compared: those of A within the time span that both cover. Where B was
/// not recorded at these instants (within 1e-12 s), it is interpolated linearly.
class CommonTime {
 public:
  /// Throws InputError when the two files cover no common instant.
  CommonTime(const ResultFile& a, const ResultFile& b);

  const VectorX& time() const { return time_; }
  bool interpolated() const { return interpolated_; }
  /// Signals of A [nt_A x m] and of B [nt_B x m] at these instants.
  MatrixX of_a(const MatrixX& values) const { return values.middleRows(first_, time_.size()); }
  MatrixX of_b(const MatrixX& values) const;
  /// One line that tells the reader what was compared.
  std::string text() const;

 private:
  /// Row of B before (or at) an instant, and the weight of the row after it.
  struct Position {
    Eigen::Index row;
    double weight;
  };

  VectorX time_;
  Eigen::Index first_ = 0;
  std::vector<Position> positions_;
  bool interpolated_ = false;
};

/// How far a channel of B is from the same channel of A.
struct Difference {
  Channel channel;
  std::string units;
  double max_a = 0;            ///< max |A|
  double max_b = 0;            ///< max |B|
  double max_difference = 0;   ///< max |A - B|; NaN as soon as one of the two is
  double rms_difference = 0;   ///< sqrt(mean (A - B)^2) over the instants compared
  double time_of_maximum = 0;  ///< first instant of max |A - B| [s]
};

/// `a` and `b` are the channel at the instants `time`, not empty.
Difference difference(const Channel& channel, const std::string& units, const VectorX& time,
                      const Eigen::Ref<const VectorX>& a, const Eigen::Ref<const VectorX>& b);

}  // namespace wishbone
