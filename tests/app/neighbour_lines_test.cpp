#include "app/svg/neighbour_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "identification/elements/element_edges.h"

namespace wishbone {
namespace {

TEST(NeighbourLines, GiveBackTheEdgesOfABlock) {
  for (const Vector3& size : {Vector3(2.4, 0.4, 0.4), Vector3(1, 1, 1), Vector3(1.3, 0.9, 0.01)}) {
    const Mesh mesh = make_block(size, {4, 3, 1});
    auto lines = neighbour_lines(mesh.nodes);
    for (auto& [a, b] : lines) a = mesh.node_ids[a], b = mesh.node_ids[b];
    auto edges = element_edges(mesh);
    std::sort(lines.begin(), lines.end());
    std::sort(edges.begin(), edges.end());
    EXPECT_EQ(lines, edges);
  }
}

// Toussaint 1980: the minimum spanning tree is part of the graph, so it is connected.
TEST(NeighbourLines, ConnectAllPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const Matrix3X points = Matrix3X::NullaryExpr(3, 80, [&]() { return coordinate(random); });
  std::vector<int> component(80);
  std::iota(component.begin(), component.end(), 0);
  for (const auto& [a, b] : neighbour_lines(points))
    std::replace(component.begin(), component.end(), int(component[a]), int(component[b]));
  EXPECT_EQ(std::count(component.begin(), component.end(), component[0]), 80);
}

TEST(NeighbourLines, OfFewOrEqualPointsAreNone) {
  EXPECT_TRUE(neighbour_lines(Matrix3X(3, 0)).empty());
  EXPECT_TRUE(neighbour_lines(Matrix3X::Ones(3, 1)).empty());
  EXPECT_TRUE(neighbour_lines(Matrix3X::Ones(3, 4)).empty());
}

}  // namespace
}  // namespace wishbone
