// What must hold of every identification, tried on structures and supports that chance makes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include "identification/identify.h"
#include "identification/measured.h"
#include "identification/methods/support_matrices.h"

namespace wishbone {
namespace {

/// What rapidcheck draws and shrinks; everything continuous follows from the seeds.
unsigned seed() {
  return *rc::gen::inRange(0u, 1u << 30);
}

/// Masses on random springs, or a block of distorted hexahedra.
TestStructure some_structure() {
  if (*rc::gen::arbitrary<bool>()) return random_lumped(*rc::gen::inRange(4, 10), seed());
  return distorted_block({*rc::gen::inRange(1, 4), *rc::gen::inRange(1, 3), 1}, seed());
}

Vector3 some_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random)).normalized();
}

/// Springs in x, y and z or along any direction, at three nodes or more; fixtures on some of them.
Support some_springs(const TestStructure& s) {
  std::mt19937 random(seed());
  std::vector<int> nodes = s.node_ids;
  std::shuffle(nodes.begin(), nodes.end(), random);
  nodes.resize(static_cast<std::size_t>(*rc::gen::inRange(3, static_cast<int>(nodes.size()) + 1)));
  std::uniform_real_distribution<double> exponent(3, 6), mass(0, 0.5);
  Support support;
  for (const int node : nodes) {
    const Matrix3 axes =
        Eigen::Quaterniond::FromTwoVectors(Vector3::UnitX(), some_direction(random)).matrix();
    for (int axis = 0; axis < 3; ++axis)
      support.springs.push_back({node, axes.col(axis), std::pow(10, exponent(random))});
    if (*rc::gen::arbitrary<bool>()) support.masses.push_back({node, mass(random)});
  }
  return support;
}

/// Six joints of any direction at nodes drawn one by one, which hold rigid motion well.
Support some_joints(const TestStructure& s) {
  std::mt19937 random(seed());
  std::uniform_int_distribution<std::size_t> node(0, s.node_ids.size() - 1);
  Support support;
  for (int i = 0; i < 6; ++i) support.joints.push_back({s.node_ids[node(random)], some_direction(random)});
  const SparseMatrix D = support_matrices(support, s.freedoms()).D;
  const VectorX singular = MatrixX(D * s.rigid).jacobiSvd().singularValues();
  RC_PRE(singular[5] > 0.03 * singular[0]);
  return support;
}

Support some_support(const TestStructure& s) {
  return *rc::gen::arbitrary<bool>() ? some_springs(s) : some_joints(s);
}

IdentificationTask free_from(const ModalData& measured) {
  IdentificationTask task;
  task.measured = measured;
  return task;
}

IdentificationTask held_on(const ModalData& measured, const Support& support) {
  IdentificationTask task = free_from(measured);
  task.goal = Goal::kHeld;
  task.support = support;
  return task;
}

VectorX frequencies(const ModalData& modes) {
  return modes.omega / (2 * std::numbers::pi);
}

/// The truth, when the structure is far enough from a mechanism to speak of eight digits.
VectorX frequencies_of_sound(const TestStructure& s) {
  const VectorX f = true_frequencies(s.K, s.M, true);
  RC_PRE(f[0] > 1e-2 * f[f.size() - 1]);
  return f;
}

/// Psi Lambda Psi^T, which does not care how modes of nearly equal frequency are told apart.
MatrixX flexible_part(const ModalData& modes) {
  return modes.shapes * modes.omega.cwiseAbs2().asDiagonal() * modes.shapes.transpose();
}

double difference(const MatrixX& a, const MatrixX& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

RC_GTEST_PROP(AnyCompleteSet, GivesTheFreeModes, ()) {
  const TestStructure s = some_structure();
  const VectorX truth = frequencies_of_sound(s);
  const ModalData found = identify(free_from(measured_on(s, some_support(s)))).modes;
  RC_ASSERT(found.omega.size() == truth.size());
  RC_ASSERT(worst_relative(frequencies(found), truth) <= 1e-8);
  const MatrixX M_shapes = s.M * found.shapes;
  const MatrixX gram = found.shapes.transpose() * M_shapes;
  RC_ASSERT((gram - MatrixX::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff() <= 1e-12);
  RC_ASSERT((s.rigid.transpose() * M_shapes).cwiseAbs().maxCoeff() <= 1e-12);
}

RC_GTEST_PROP(AnySupport, HoldsAndReleasesWithoutATrace, ()) {
  const TestStructure s = some_structure();
  const VectorX truth = frequencies_of_sound(s);
  const ModalData free = measured_on(s, {});
  const ModalData held = identify(held_on(free, some_support(s))).modes;
  const ModalData released = identify(free_from(held)).modes;
  RC_ASSERT(released.omega.size() == truth.size());
  RC_ASSERT(worst_relative(frequencies(released), truth) <= 1e-8);
  RC_ASSERT(difference(flexible_part(released), flexible_part(free)) <= 1e-8);
}

RC_GTEST_PROP(AnyIncompleteSet, IsHeldAlikeInBothSpacesWithoutChangeOfMass, ()) {
  const TestStructure s = some_structure();
  frequencies_of_sound(s);
  const auto elastic = static_cast<int>(s.n()) - 6;
  const ModalData measured = measured_on(s, {}, *rc::gen::inRange(1, elastic + 1));
  IdentificationTask task = held_on(measured, some_springs(s));
  task.support.masses.clear();
  const ModalData modal = identify(task).modes;
  task.space = Space::kPhysical;
  const ModalData physical = identify(task).modes;
  RC_ASSERT(worst_relative(physical.omega, modal.omega) <= 1e-8);
  RC_ASSERT(difference(flexible_part(physical), flexible_part(modal)) <= 1e-8);
}

RC_GTEST_PROP(AnyIncompleteSet, BoundsTheFreeFrequenciesFromAbove, ()) {
  const TestStructure s = some_structure();
  const VectorX truth = frequencies_of_sound(s);
  const Support support = some_support(s);
  const int held = support.joints.empty() ? 6 : 0;
  const auto count = *rc::gen::inRange(held + 1, static_cast<int>(truth.size()) + held + 1);
  const VectorX found = frequencies(identify(free_from(measured_on(s, support, count))).modes);
  RC_ASSERT(((found.array() - truth.head(found.size()).array()) >= -1e-8 * truth.maxCoeff()).all());
}

/// The same structure with its nodes listed in another order under other numbers.
ModalData renumbered(const ModalData& data, const std::vector<int>& order) {
  const auto renumber = [&](int node) { return 1000 - 3 * node; };
  ModalData other = data;
  std::vector<int> rows;
  for (std::size_t i = 0; i < order.size(); ++i) {
    other.node_ids[i] = renumber(data.node_ids[static_cast<std::size_t>(order[i])]);
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * order[i] + axis);
  }
  other.node_position = data.node_position(Eigen::all, order);
  other.node_mass = data.node_mass(order);
  other.freedoms = all_freedoms(other.node_ids);
  other.shapes = data.shapes(rows, Eigen::all);
  for (auto& spring : other.support.springs) spring.node = renumber(spring.node);
  for (auto& joint : other.support.joints) joint.node = renumber(joint.node);
  for (auto& mass : other.support.masses) mass.node = renumber(mass.node);
  return other;
}

RC_GTEST_PROP(NumbersOfNodes, MakeNoDifference, ()) {
  const TestStructure s = some_structure();
  const VectorX truth = frequencies_of_sound(s);
  const ModalData measured = measured_on(s, some_support(s));
  std::vector<int> order(s.node_ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed()));
  const ModalData found = identify(free_from(renumbered(measured, order))).modes;
  const ModalData expected = renumbered(identify(free_from(measured)).modes, order);
  RC_ASSERT(found.freedoms == expected.freedoms);
  RC_ASSERT(worst_relative(frequencies(found), truth) <= 1e-8);
  RC_ASSERT(difference(flexible_part(found), flexible_part(expected)) <= 1e-8);
}

/// The same structure in axes that are turned by R and moved away.
ModalData seen_from(const Matrix3& R, const ModalData& data) {
  ModalData other = data;
  other.node_position = (R * data.node_position).colwise() + Vector3(3, -2, 1);
  for (Eigen::Index row = 0; row < data.shapes.rows(); row += 3)
    other.shapes.middleRows<3>(row) = R * data.shapes.middleRows<3>(row);
  for (auto& spring : other.support.springs) spring.direction = (R * spring.direction).normalized();
  for (auto& joint : other.support.joints) joint.direction = (R * joint.direction).normalized();
  return other;
}

RC_GTEST_PROP(Axes, MakeNoDifferenceButToComponents, ()) {
  const TestStructure s = some_structure();
  frequencies_of_sound(s);
  std::mt19937 random(seed());
  const Matrix3 R = Eigen::AngleAxisd(2.2, some_direction(random)).matrix();
  const ModalData measured = measured_on(s, some_support(s));
  const ModalData found = identify(free_from(seen_from(R, measured))).modes;
  const ModalData expected = seen_from(R, identify(free_from(measured)).modes);
  RC_ASSERT(worst_relative(found.omega, expected.omega) <= 1e-8);
  RC_ASSERT(difference(flexible_part(found), flexible_part(expected)) <= 1e-8);
}

}  // namespace
}  // namespace wishbone
