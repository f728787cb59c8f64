#pragma once

#include <map>
#include <string>
#include <vector>

namespace wishbone {

/// One recorded quantity: where it goes in the result file and what a reader must know about it.
struct Signal {
  std::string path;        ///< "/bodies/chassis/position"
  std::vector<int> shape;  ///< of one row: {} scalar, {3} vector, {k, 3} k vectors
  std::string units;       ///< UDUNITS text, "m/s"; "1" for pure numbers
  std::string frame;       ///< axes of the components, "world"; empty for scalars without direction
  std::string about;       ///< one sentence for the reader
  /// Further attributes that are lists of texts, such as `nodes` of a deflection [k, 3].
  std::map<std::string, std::vector<std::string>> lists;

  /// Numbers in one row.
  int size() const;
};

}  // namespace wishbone
