// The choice of tree joints against all choices that there are, on small random graphs.
#include "models/spanning_tree.h"

#include <gmock/gmock.h>

#include <functional>
#include <numeric>
#include <random>
#include <tuple>

namespace wishbone {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int kGround = -1;

struct Graph {
  std::vector<GraphBody> bodies;
  std::vector<GraphJoint> joints;
};

/// Up to five bodies and eight joints between them and the ground.
Graph random_graph(std::mt19937& engine) {
  const auto below = [&](int n) { return std::uniform_int_distribution<>(0, n - 1)(engine); };
  Graph g;
  g.bodies.resize(2 + below(4));
  const int bodies = static_cast<int>(g.bodies.size());
  for (GraphBody& body : g.bodies) body = {below(6) == 0, below(4) == 0};
  for (int i = 1 + below(8); i > 0; --i) {
    const int first = below(bodies + 1) - 1, second = below(bodies + 1) - 1;
    if (first != second) g.joints.push_back({first, second, 1 + below(6), std::nullopt, below(3) == 0});
  }
  return g;
}

/// Sets of bodies that are tied together, the ground and floating bodies being one root.
class Ties {
 public:
  explicit Ties(const Graph& g) : set_(g.bodies.size() + 1) {
    std::iota(set_.begin(), set_.end(), 0);
    for (std::size_t b = 0; b < g.bodies.size(); ++b)
      if (g.bodies[b].floats) set_[b + 1] = 0;
  }
  int of(int body) const { return set_[body + 1]; }
  /// Whether the two were apart.
  bool tie(int a, int b) {
    const int one = of(a), other = of(b);
    for (int& s : set_)
      if (s == other) s = one;
    return one != other;
  }

 private:
  std::vector<int> set_;
};

/// Calls f with every set of joints, as a bit each, that could be a spanning tree: without a loop, tying together whatever
/// joints can tie, and with the pinned ones where they are pinned to.
void for_each_tree(const Graph& g, const std::function<void(unsigned)>& f) {
  Ties most(g);
  int needed = 0;
  for (const GraphJoint& joint : g.joints)
    if (joint.cut != true && most.tie(joint.first, joint.second)) ++needed;
  for (unsigned tree = 0; tree < (1u << g.joints.size()); ++tree) {
    Ties ties(g);
    int count = 0;
    bool allowed = true;
    for (std::size_t j = 0; j < g.joints.size(); ++j) {
      const GraphJoint& joint = g.joints[j];
      const bool carries = (tree >> j & 1) != 0;
      if (joint.cut && *joint.cut == carries) allowed = false;
      if (!carries) continue;
      ++count;
      allowed = allowed && ties.tie(joint.first, joint.second);
    }
    if (allowed && count == needed) f(tree);
  }
}

unsigned chosen(const SpanningTree& tree) {
  unsigned bits = 0;
  for (std::size_t j = 0; j < tree.roles.size(); ++j)
    if (tree.roles[j] != JointRole::closes) bits |= 1u << j;
  return bits;
}

/// Closure rows of the joints that a tree cuts, and how many of these have initial values.
std::pair<int, int> cost(const Graph& g, unsigned tree) {
  std::pair<int, int> sum{0, 0};
  for (std::size_t j = 0; j < g.joints.size(); ++j)
    if ((tree >> j & 1) == 0) {
      sum.first += g.joints[j].closure_rows;
      sum.second += g.joints[j].preferred ? 1 : 0;
    }
  return sum;
}

/// Joints between a body and its root; `roots` are the bodies that nothing carries.
std::vector<int> depths(const Graph& g, unsigned tree, const std::vector<int>& roots) {
  std::vector<int> depth(g.bodies.size(), -1);
  for (const int root : roots) depth[root] = 0;
  const auto of = [&](int body) { return body == kGround ? 0 : depth[body]; };
  for (std::size_t round = 0; round < g.bodies.size(); ++round)
    for (std::size_t j = 0; j < g.joints.size(); ++j) {
      if ((tree >> j & 1) == 0) continue;
      const auto [a, b] = std::pair(g.joints[j].first, g.joints[j].second);
      if (of(a) >= 0 && of(b) < 0) depth[b] = of(a) + 1;
      if (of(b) >= 0 && of(a) < 0) depth[a] = of(b) + 1;
    }
  return depth;
}

std::vector<int> floating(const SpanningTree& tree) {
  std::vector<int> roots;
  for (std::size_t b = 0; b < tree.carrier.size(); ++b)
    if (tree.carrier[b] < 0) roots.push_back(static_cast<int>(b));
  return roots;
}

TEST(SpanningTree, HasTheFewestClosureRowsOfAllAndThenCutsTheFewestInitialValues) {
  std::mt19937 engine(1);
  for (int sample = 0; sample < 2000; ++sample) {
    const Graph g = random_graph(engine);
    std::pair best{1000, 1000};
    for_each_tree(g, [&](unsigned tree) { best = std::min(best, cost(g, tree)); });
    EXPECT_EQ(cost(g, chosen(span(g.bodies, g.joints))), best) << "sample " << sample;
  }
}

TEST(SpanningTree, KeepsPinnedJointsInTheirRolesAtTheLeastCostThatLeaves) {
  std::mt19937 engine(2);
  int pinned = 0;
  for (int sample = 0; sample < 2000; ++sample) {
    Graph g = random_graph(engine);
    for (GraphJoint& joint : g.joints)
      if (engine() % 3 == 0) joint.cut = engine() % 2 == 0;
    std::pair best{1000, 1000};
    for_each_tree(g, [&](unsigned tree) { best = std::min(best, cost(g, tree)); });
    const SpanningTree tree = span(g.bodies, g.joints);
    EXPECT_EQ(tree.impossible.empty(), best.first < 1000) << "sample " << sample;
    if (!tree.impossible.empty()) continue;
    ++pinned;
    EXPECT_EQ(cost(g, chosen(tree)), best) << "sample " << sample;
    for (std::size_t j = 0; j < g.joints.size(); ++j)
      if (const auto cut = g.joints[j].cut) {
        EXPECT_EQ(tree.roles[j] == JointRole::closes, *cut) << "sample " << sample;
      }
  }
  EXPECT_GT(pinned, 1000);
}

TEST(SpanningTree, IsTheShallowestOfAllWhereJointsCostTheSame) {
  std::mt19937 engine(3);
  for (int sample = 0; sample < 2000; ++sample) {
    Graph g = random_graph(engine);
    for (GraphJoint& joint : g.joints) joint.closure_rows = 5, joint.preferred = false;
    const SpanningTree tree = span(g.bodies, g.joints);
    const std::vector<int> roots = floating(tree), depth = depths(g, chosen(tree), roots);
    std::vector<int> least(g.bodies.size(), 1000);
    for_each_tree(g, [&](unsigned other) {
      const std::vector<int> d = depths(g, other, roots);
      for (std::size_t b = 0; b < d.size(); ++b)
        if (d[b] >= 0) least[b] = std::min(least[b], d[b]);
    });
    EXPECT_EQ(depth, least) << "sample " << sample;
  }
}

TEST(SpanningTree, HangsEveryBodyOnItsCarrierTheWayItsRoleSays) {
  std::mt19937 engine(4);
  for (int sample = 0; sample < 500; ++sample) {
    const Graph g = random_graph(engine);
    const SpanningTree tree = span(g.bodies, g.joints);
    std::vector<int> carrier(g.bodies.size(), -1);
    for (std::size_t j = 0; j < g.joints.size(); ++j) {
      if (tree.roles[j] == JointRole::closes) continue;
      const int child = tree.roles[j] == JointRole::carries_second ? g.joints[j].second : g.joints[j].first;
      ASSERT_NE(child, kGround);
      EXPECT_FALSE(g.bodies[child].floats);
      carrier[child] = static_cast<int>(j);
    }
    EXPECT_EQ(tree.carrier, carrier) << "sample " << sample;
    // upwards every body comes to one that floats, or to the ground
    for (const int d : depths(g, chosen(tree), floating(tree))) EXPECT_GE(d, 0) << "sample " << sample;
  }
}

GraphJoint joint(int first, int second, std::optional<bool> cut = std::nullopt) {
  return {first, second, 5, cut, false};
}

TEST(SpanningTree, LeavesOneBodyOfEveryUntiedPartFloating) {
  const auto carrier = [](const std::vector<GraphBody>& bodies, const std::vector<GraphJoint>& joints) {
    return span(bodies, joints).carrier;
  };
  // by choice, else the one that no joint names second, else the first
  EXPECT_THAT(carrier({{}, {false, true}, {}}, {joint(0, 1), joint(1, 2)}), ElementsAre(0, -1, 1));
  EXPECT_THAT(carrier({{}, {}, {}}, {joint(2, 1), joint(1, 0)}), ElementsAre(1, 0, -1));
  EXPECT_THAT(carrier({{}, {}}, {joint(0, 1), joint(1, 0)}), ElementsAre(-1, 0));
  // two parts, neither tied to the ground; a cut joint does not tie
  EXPECT_THAT(carrier({{}, {}, {}, {}}, {joint(0, 1), joint(2, 3), joint(kGround, 0, true)}),
              ElementsAre(-1, 0, -1, 1));
}

TEST(SpanningTree, NamesTheJointsThatArePinnedIntoALoop) {
  const GraphJoint left = joint(kGround, 0, false), top = joint(0, 1, false),
                   right = joint(kGround, 1, false);
  EXPECT_THAT(span({{}, {}}, {left, top}).impossible, IsEmpty());
  EXPECT_THAT(span({{}, {}}, {left, top, right}).impossible, ElementsAre(1));
  EXPECT_THAT(span({{true, false}}, {left}).impossible, ElementsAre(0))
      << "a floating body cannot be carried";
}

}  // namespace
}  // namespace wishbone
