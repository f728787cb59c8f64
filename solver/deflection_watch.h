#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "core/spatial.h"
#include "solver/system.h"

namespace wishbone {

/// Looks at every output whether the flexible bodies keep within the range of linear elasticity. Linear shapes carry a
/// neighbour on a straight line where a turning body carries it on an arc: between nodes a and b that lie close together the
/// displacement gradient, a turn against the body axes or a stretch,
///     g = |delta_a - delta_b| / |s_a - s_b|,
/// leaves lengths and lever arms wrong by g^2 / 2. Nothing but the nodes is needed, so bodies of measured modes are watched as
/// meshes are: each of up to kNodes nodes, taken evenly from all, with its nearest ones.
class DeflectionWatch {
 public:
  static constexpr double kLimit = 0.15;  ///< of g, where g^2 / 2 is 1 percent
  static constexpr int kNodes = 400;

  explicit DeflectionWatch(const System& system);

  /// Takes note of the largest g of each body. Allocates nothing.
  void observe(const State& state);

  /// Adds a warning for each body that went beyond the limit: the largest g, when and where.
  void report(Warnings& warnings) const;

 private:
  struct Pair {
    int a = 0, b = 0;             ///< places in `node_ids`
    double inverse_distance = 0;  ///< [1/m]
  };
  struct Body {
    std::string name;
    int z_start = 0;
    std::vector<int> node_ids;
    MatrixX shapes;  ///< 3 nodes x m
    std::vector<Pair> pairs;
    VectorX deflection;
    double worst = 0, t_worst = 0, t_first = 0;
    Pair worst_pair;
  };

  static Body watched(const FlexibleBody& flexible, std::string name);

  std::vector<Body> bodies_;
};

}  // namespace wishbone
