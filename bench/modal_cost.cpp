// Cost of one evaluation against the number of modes of a flexible body: microseconds of calc_forward_dynamics for a floating
// block of 1701 nodes that carries two arms, by cut joints or by tree joints. Then the inertia of the block alone (positions and
// velocities of ModalBody) by node sums and by invariants, and of one of 27 nodes. Prints Markdown tables; the smallest of
// several repetitions counts.
//
//   modal_cost [M]     with a number of modes: evaluates the block with cut joints a thousand times and measures nothing,
//                      for profilers

#include <fmt/core.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>

#include "bench/least_time.h"
#include "identification/elements/mesh.h"
#include "solver/assembly.h"
#include "solver/forward_dynamics.h"
#include "solver/system_builder.h"

namespace wishbone::bench {
namespace {

const Vector3 kSize(2.4, 0.4, 0.4);
const Eigen::Vector3i kDivisions(20, 8, 8), kCoarseDivisions(2, 2, 2);

/// Forms of the inertial terms: a column each.
struct Column {
  const char* name;
  InertiaTerms terms;
};
constexpr Column kColumns[] = {{"consistent", InertiaTerms::consistent}, {"source", InertiaTerms::source}};

/// Field j of a sequence of ever shorter waves: products of cosines that move one axis.
void set_wave(const Mesh& mesh, int j, Eigen::Ref<VectorX> field) {
  const int axis = j % 3, wave = j / 3;
  const Vector3 k = std::numbers::pi * Vector3(wave % 14 + 1, wave / 14 % 4, wave / 56).cwiseQuotient(kSize);
  field.setZero();
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    const Vector3 p = mesh.nodes.col(i) + 0.5 * kSize;
    field[3 * i + axis] = std::cos(k.x() * p.x()) * std::cos(k.y() * p.y()) * std::cos(k.z() * p.z());
  }
}

/// As many modes as asked for: waves made mass-orthonormal and orthogonal to rigid motion. What an evaluation costs does not
/// depend on whether they are those of a material.
ModeSet waves(int count, const Eigen::Vector3i& divisions = kDivisions) {
  const Mesh mesh = make_block(kSize, divisions);
  ModeSet set;
  set.node_ids = mesh.node_ids;
  set.node_mass = lumped_mass(mesh, 2600);
  set.node_position = mesh.nodes.colwise() - mesh.nodes * set.node_mass / set.node_mass.sum();
  const VectorX root_mass = set.node_mass.cwiseSqrt().replicate(1, 3).transpose().reshaped();
  MatrixX fields(root_mass.size(), 6 + count);
  fields.leftCols<6>() = rigid_body_modes(set.node_mass, set.node_position);
  for (int j = 0; j < count; ++j) set_wave(mesh, j, fields.col(6 + j));
  const Eigen::HouseholderQR<MatrixX> qr(root_mass.asDiagonal() * fields);
  const MatrixX Q = qr.householderQ() * MatrixX::Identity(fields.rows(), fields.cols());
  set.shapes = root_mass.cwiseInverse().asDiagonal() * Q.rightCols(count);
  set.omega = VectorX::LinSpaced(count, 100, 100.0 * count);
  set.damping_ratio = VectorX::Constant(count, 0.01);
  return set;
}

enum class Arms { cut, hung };

std::pair<System, State> mechanism(const ModeSet& modes, InertiaTerms terms, Arms arms) {
  SystemBuilder b;
  const int block = b.add_flexible_body("block", modes, {}, terms);
  b.set_velocity(block, {3, 1, -2}, {1.5, -0.8, 2.5});
  for (const int node : {modes.node_ids.front(), modes.node_ids.back()}) {
    const Vector3 p_W = b.attachment_pose({block, node}).p;
    const Matrix3 J = Vector3(2, 3, 2.5).asDiagonal();
    const int arm = b.add_body("arm", 40, J, {Matrix3::Identity(), p_W + Vector3(0.2, 0.3, -0.4)});
    if (arms == Arms::hung)
      b.add_joint("ball", {block, node}, arm, p_W, SphericalJoint{});
    else
      b.add_closure("ball", b.add_marker({block, node}), b.add_marker({arm}, p_W), SphericalClosure{});
  }
  return std::move(b).build();
}

double microseconds(const ModeSet& modes, InertiaTerms terms, Arms arms) {
  auto [system, state] = mechanism(modes, terms, arms);
  Workspace ws(system);
  assemble(system, state, ws);
  const int inner = std::max(1, 4000 / modes.mode_count());
  const double seconds = least_cpu_seconds([&, &system = system, &state = state] {
    for (int i = 0; i < inner; ++i) calc_forward_dynamics(system, state, ws);
    return true;
  });
  return 1e6 * seconds / inner;
}

void print_table() {
  fmt::print("| modes |");
  for (const char* arms : {"cut", "hung"})
    for (const Column& column : kColumns) fmt::print(" arms {}, {}, us |", arms, column.name);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < 2 * std::size(kColumns); ++i) fmt::print("---|");
  fmt::print("\n");
  for (const int count : {5, 10, 20, 50, 100, 200, 500}) {
    const ModeSet modes = waves(count);
    fmt::print("| {} |", count);
    for (const Arms arms : {Arms::cut, Arms::hung})
      for (const Column& column : kColumns) fmt::print(" {:.1f} |", microseconds(modes, column.terms, arms));
    fmt::print("\n");
    std::fflush(stdout);
  }
}

double inertia_microseconds(const ModeSet& modes, InertiaMethod method) {
  const ModalBody body(modes, {modes.node_ids.front(), modes.node_ids.back()}, {}, InertiaTerms::consistent,
                       method);
  ModalBodyState state = body.make_state();
  const VectorX z = VectorX::Constant(modes.mode_count(), 0.01), zdot = VectorX::Ones(modes.mode_count());
  const int inner = std::max(1, 20000 / modes.mode_count());
  const double seconds = least_cpu_seconds([&] {
    for (int i = 0; i < inner; ++i) {
      body.set_position(z.data(), state);
      body.set_velocity(Vector3(1.5, -0.8, 2.5), zdot.data(), state);
    }
    return true;
  });
  return 1e6 * seconds / inner;
}

void print_inertia_table(const Eigen::Vector3i& divisions, std::initializer_list<int> counts) {
  fmt::print("\n| nodes | modes | node sums, us | invariants, us | chosen |\n|---|---|---|---|---|\n");
  for (const int count : counts) {
    const ModeSet modes = waves(count, divisions);
    const bool sums = ModalBody(modes, {modes.node_ids.front(), modes.node_ids.back()}).inertia_method() ==
                      InertiaMethod::node_sums;
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {} |\n", modes.node_count(), count,
               inertia_microseconds(modes, InertiaMethod::node_sums),
               inertia_microseconds(modes, InertiaMethod::invariants), sums ? "node sums" : "invariants");
    std::fflush(stdout);
  }
}

void evaluate(int count) {
  auto [system, state] = mechanism(waves(count), InertiaTerms::consistent, Arms::cut);
  Workspace ws(system);
  assemble(system, state, ws);
  for (int i = 0; i < 1000; ++i) calc_forward_dynamics(system, state, ws);
}

}  // namespace
}  // namespace wishbone::bench

int main(int argc, char** argv) {
  using namespace wishbone::bench;
  if (argc > 1) {
    evaluate(std::stoi(argv[1]));
    return 0;
  }
  print_table();
  print_inertia_table(kDivisions, {5, 10, 20, 50, 100, 200, 500});
  print_inertia_table(kCoarseDivisions, {5, 10, 15, 20, 25, 30, 40, 50, 60, 75});
  return 0;
}
