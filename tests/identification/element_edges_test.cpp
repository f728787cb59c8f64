#include "identification/elements/element_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace wishbone {
namespace {

/// Lines along x of an a x b x c block, and so on: (b + 1)(c + 1) rows of a edges.
std::size_t grid_edge_count(int a, int b, int c) {
  return a * (b + 1) * (c + 1) + b * (a + 1) * (c + 1) + c * (a + 1) * (b + 1);
}

TEST(ElementEdges, AreTheLinesOfTheGridEachOnce) {
  for (const Eigen::Vector3i& divisions :
       {Eigen::Vector3i(1, 1, 1), Eigen::Vector3i(4, 1, 1), Eigen::Vector3i(3, 4, 2)}) {
    const Mesh mesh = make_block({2.4, 0.4, 0.4}, divisions);
    const auto edges = element_edges(mesh);
    EXPECT_EQ(edges.size(), grid_edge_count(divisions.x(), divisions.y(), divisions.z()));
    std::set<std::set<int>> different;
    for (const auto& [a, b] : edges) different.insert({a, b});
    EXPECT_EQ(different.size(), edges.size());
  }
}

TEST(ElementEdges, RunAlongOneAxisOverOneDivision) {
  const Vector3 size(2.4, 0.4, 0.6);
  const Eigen::Vector3i divisions(4, 1, 2);
  const Mesh mesh = make_block(size, divisions);
  const Vector3 pitch = size.cwiseQuotient(divisions.cast<double>());
  for (const auto& [a, b] : element_edges(mesh)) {
    // node ids of a block count from 1
    const Vector3 edge = (mesh.nodes.col(b - 1) - mesh.nodes.col(a - 1)).cwiseAbs();
    int axis = 0;
    const double length = edge.maxCoeff(&axis);
    EXPECT_NEAR(length, pitch[axis], 1e-12);
    EXPECT_NEAR(edge.sum(), length, 1e-12);
  }
}

TEST(ElementEdges, NameNodesByTheirIds) {
  Mesh mesh = make_block({1, 1, 1}, {1, 1, 1});
  for (int& id : mesh.node_ids) id *= 100;
  for (const auto& [a, b] : element_edges(mesh)) {
    EXPECT_EQ(a % 100, 0);
    EXPECT_EQ(b % 100, 0);
    EXPECT_NE(a, b);
  }
}

}  // namespace
}  // namespace wishbone
