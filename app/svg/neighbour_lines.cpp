#include "app/svg/neighbour_lines.h"

#include <algorithm>
#include <numeric>

namespace wishbone {

std::vector<std::array<int, 2>> neighbour_lines(const Matrix3X& points) {
  constexpr double kEqual = 1 - 1e-6;
  const int n = static_cast<int>(points.cols());
  std::vector<std::array<int, 2>> lines;
  std::vector<int> nearest(n);
  for (int i = 0; i < n; ++i) {
    const VectorX distance = (points.colwise() - points.col(i)).colwise().norm();
    std::iota(nearest.begin(), nearest.end(), 0);
    std::sort(nearest.begin(), nearest.end(), [&](int a, int b) { return distance[a] < distance[b]; });
    for (int j = i + 1; j < n; ++j) {
      const double between = kEqual * distance[j];
      // the third points, nearest first: most pairs are refuted by the first few
      const auto end =
          std::partition_point(nearest.begin(), nearest.end(), [&](int k) { return distance[k] < between; });
      const bool apart = std::any_of(nearest.begin(), end,
                                     [&](int k) { return (points.col(k) - points.col(j)).norm() < between; });
      if (!apart && distance[j] > 0) lines.push_back({i, j});
    }
  }
  return lines;
}

}  // namespace wishbone
