// Nodal masses that are not given, and the nodes of the body that follow from them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "identification/body_nodes.h"
#include "identification/identify.h"
#include "identification/measured.h"
#include "identification/mode_set_of.h"
#include "text_files.h"

namespace wishbone {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Masses, FollowFromTotalCentreAndInertia) {
  for (Support (*support)() : {chassis_springs, chassis_joints, chassis_springs_with_masses}) {
    const TestStructure s = chassis();
    IdentificationTask task = task_on(s, support());
    RigidBodyData body;
    body.mass = s.node_mass.sum();
    body.centre = s.nodes * s.node_mass / body.mass;
    for (Eigen::Index i = 0; i < s.node_mass.size(); ++i) {
      const Vector3 p = s.nodes.col(i) - body.centre;
      body.inertia += s.node_mass[i] * (p.squaredNorm() * Matrix3::Identity() - p * p.transpose());
    }
    task.measured.node_mass.resize(0);
    task.rigid_body = body;
    const Identification found = identify(task);
    EXPECT_LE(worst_relative(found.modes.node_mass, s.node_mass), 1e-6);
    EXPECT_LE(worst_relative(frequencies(found), free_frequencies(s)), 1e-6);
    EXPECT_THAT(found.judgement.warnings, IsEmpty());
  }
}

TEST(Masses, MayBeAMatrix) {
  const TestStructure s = chassis();
  IdentificationTask task = task_on(s, chassis_springs());
  task.measured.node_mass.resize(0);
  task.mass = s.M;
  EXPECT_LE(worst_relative(frequencies(identify(task)), free_frequencies(s)), 1e-8);
  for (const SparseMatrix& wrong : {SparseMatrix(57, 57), SparseMatrix(60, 57)}) {
    task.mass = wrong;
    EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
                HasSubstr("the mass matrix must have a row and a column for every freedom of the modes"));
  }
}

TEST(Masses, MustBeKnown) {
  IdentificationTask task = task_on(chassis(), chassis_springs());
  task.measured.node_mass.resize(0);
  EXPECT_THAT(message_of<InputError>([&] { identify(task); }),
              HasSubstr("the masses of the nodes are not known (got 20 nodes)"));
}

TEST(Nodes, OfTheBodyAreKnownBeforeItsModes) {
  const TestStructure s = distorted_block({2, 1, 1}, 3);
  std::vector<IdentificationTask> tasks(3, task_on(s, springs_at({1, 2, 5, 8}, 1e5)));
  tasks[1].goal = Goal::kChanged;
  tasks[1].change.masses = {{4, 30}, {1, -2}, {4, 5}};
  tasks[2].measured =
      seen_at({1, 2, 3, 5, 7, 8, 11, 12}, task_on(s, springs_at({1, 2, 5, 8}, 1e5), 9).measured);
  tasks[2].model = model_of(s);
  tasks[2].coverage = Coverage::kSerep;
  for (const IdentificationTask& task : tasks) {
    const BodyNodes nodes = body_nodes(task);
    const ModeSet set = mode_set_of(identify(task).modes);
    EXPECT_EQ(nodes.ids, set.node_ids);
    EXPECT_LE((nodes.position - set.node_position).cwiseAbs().maxCoeff(), 1e-12);
  }
}

}  // namespace
}  // namespace wishbone
