#include "models/joint_choices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "models/scene_tree.h"

namespace wishbone {
namespace {

/// Tree joints from a body to its root.
std::set<int> joints_to_root(const Scene& scene, const SpanningTree& tree, int body) {
  std::set<int> joints;
  while (body != Scene::kGround && tree.carrier[body] >= 0) {
    const int j = tree.carrier[body];
    joints.insert(j);
    const Scene::Joint& joint = scene.joints[j];
    body = tree.roles[j] == JointRole::carries_second ? joint.first.body : joint.second.body;
  }
  return joints;
}

/// Tree joints of the loop that a cut joint closes: on the way from one of its bodies to the root, but not on both.
std::vector<int> loop_of(const Scene& scene, const SpanningTree& tree, const Scene::Joint& cut) {
  const std::set<int> a = joints_to_root(scene, tree, cut.first.body);
  const std::set<int> b = joints_to_root(scene, tree, cut.second.body);
  std::vector<int> loop;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(loop));
  return loop;
}

/// Which joint a loop could have been cut at instead, by its rows.
int extreme(const Scene& scene, const std::vector<int>& loop, bool costliest) {
  const auto fewer = [&](int a, int b) {
    return closure_rows(scene.joints[a]) < closure_rows(scene.joints[b]);
  };
  return costliest ? *std::max_element(loop.begin(), loop.end(), fewer)
                   : *std::min_element(loop.begin(), loop.end(), fewer);
}

void explain_cut(const Scene& scene, const SpanningTree& tree, const Scene::Joint& joint,
                 JointChoice& choice) {
  const std::vector<int> loop = loop_of(scene, tree, joint);
  for (const int j : loop) choice.loop.push_back(scene.joints[j].name);
  choice.reason = choice.pinned ? "pinned; " : "";
  if (joint.kind == JointKind::free || loop.empty()) {
    choice.reason += joint.kind == JointKind::free ? "binds nothing" : "joins two bodies that float";
    return;
  }
  choice.reason += fmt::format("closes the loop with {}", fmt::join(choice.loop, ", "));
  const Scene::Joint& cheapest = scene.joints[extreme(scene, loop, false)];
  const Scene::Joint& costliest = scene.joints[extreme(scene, loop, true)];
  if (closure_rows(cheapest) < choice.rows) {
    choice.saved = closure_rows(cheapest) - choice.rows;
    choice.reason += fmt::format("; '{}' would cost {} rows less", cheapest.name, -choice.saved);
  } else if (closure_rows(costliest) > choice.rows) {
    choice.saved = closure_rows(costliest) - choice.rows;
    choice.reason += fmt::format("; saves {} rows against '{}'", choice.saved, costliest.name);
  }
}

std::string body_name(const Scene& scene, int body) {
  return body == Scene::kGround ? "ground" : scene.bodies[body].name;
}

std::string reason_in_tree(const Scene::Joint& joint, bool in_a_loop) {
  if (joint.cut == false) return "pinned";
  if (!in_a_loop) return "no loop passes through it";
  const int rows = closure_rows(joint);
  if (joint.starts()) return fmt::format("has initial values; would cost {} rows", rows);
  return fmt::format("would cost {} rows", rows);
}

}  // namespace

std::vector<JointChoice> joint_choices(const Scene& scene) {
  const SpanningTree tree = scene_tree(scene);
  std::vector<JointChoice> choices;
  std::set<std::string> in_loops;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const Scene::Joint& joint = scene.joints[j];
    JointChoice choice;
    choice.joint = joint.name;
    choice.kind = info(joint.kind).name;
    choice.first = body_name(scene, joint.first.body);
    choice.second = body_name(scene, joint.second.body);
    choice.cut = tree.roles[j] == JointRole::closes;
    choice.pinned = joint.cut.has_value();
    choice.rows = closure_rows(joint);
    if (choice.cut) explain_cut(scene, tree, joint, choice);
    in_loops.insert(choice.loop.begin(), choice.loop.end());
    choices.push_back(std::move(choice));
  }
  for (std::size_t j = 0; j < choices.size(); ++j)
    if (!choices[j].cut)
      choices[j].reason = reason_in_tree(scene.joints[j], in_loops.contains(choices[j].joint));
  return choices;
}

}  // namespace wishbone
