// Cost of identification over the size of the structure: CPU seconds, the smallest of several repetitions,
// and memory. Prints a Markdown table. Memory is what the resident set grows at its peak (VmHWM) over the
// input, in a forked child, whose peak starts from what it inherits.
//
//   identification_cost [N]     complete sets up to N freedoms, 600 unless given

#include <fmt/core.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

#include "identification/elements/mesh.h"
#include "identification/methods/lowest_modes.h"
#include "identification/methods/released_modes.h"
#include "identification/methods/rigid_modes.h"
#include "identification/methods/support_matrices.h"
#include "identification/modal_data.h"

namespace {

using namespace wishbone;

constexpr int kModes = 40;

/// Block of hexahedra with n freedoms.
struct Structure {
  Mesh mesh;
  SparseMatrix K, M;
  MatrixX rigid;

  explicit Structure(const Eigen::Vector3i& divisions) : mesh(make_block({2.4, 0.4, 0.5}, divisions)) {
    const IsotropicMaterial steel{2.1e11, 0.3, 7850};
    K = stiffness_matrix(mesh, steel);
    M = lumped_mass_matrix(lumped_mass(mesh, steel.density));
    rigid = rigid_body_basis(rigid_body_shapes(all_freedoms(mesh.node_ids), mesh.node_ids, mesh.nodes), M);
  }
  Eigen::Index n() const { return K.rows(); }
  SupportMatrices matrices(const Support& support) const {
    return support_matrices(support, all_freedoms(mesh.node_ids));
  }
};

/// x, y and z of one corner, y and z of one at the other end, z of another of the first end.
std::vector<std::pair<int, Vector3>> held_freedoms(const Structure& s, const Eigen::Vector3i& divisions) {
  const int across = s.mesh.node_ids[static_cast<std::size_t>(divisions.y())];
  const int far = s.mesh.node_ids.back();
  return {{1, Vector3::UnitX()},   {1, Vector3::UnitY()},   {1, Vector3::UnitZ()},
          {far, Vector3::UnitY()}, {far, Vector3::UnitZ()}, {across, Vector3::UnitZ()}};
}

/// Modes of the structure without the freedoms that its joints take.
Modes modes_on_joints(const Structure& s, const SparseMatrix& D, int count) {
  std::vector<int> kept;
  const VectorX held = VectorX(D.transpose() * VectorX::Ones(D.rows()));
  for (int i = 0; i < s.n(); ++i)
    if (held[i] == 0) kept.push_back(i);
  SparseMatrix N(s.n(), static_cast<Eigen::Index>(kept.size()));
  for (int j = 0; j < N.cols(); ++j) N.insert(kept[static_cast<std::size_t>(j)], j) = 1;
  const Modes modes = lowest_modes(N.transpose() * s.K * N, N.transpose() * s.M * N, count);
  return {modes.lambda, N * modes.shapes};
}

double cpu_seconds(const std::function<void()>& work) {
  double best = 1e300, spent = 0;
  for (int repetition = 0; repetition < 5 && spent < 20; ++repetition) {
    const std::clock_t start = std::clock();
    work();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    best = std::min(best, seconds);
    spent += seconds;
  }
  return best;
}

/// A figure of /proc/self/status [MB].
double own_memory(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stod(line.substr(name.size() + 1)) / 1024;
  return 0;
}

/// Throws when the child does not live to tell.
double peak_megabytes(const std::function<void()>& work) {
  malloc_trim(0);  // memory that was freed before must not be taken for room
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("there is no pipe to be had");
  const pid_t child = fork();
  if (child == 0) {
    const double before = own_memory("VmRSS");
    work();
    const double growth = own_memory("VmHWM") - before;
    _exit(write(ends[1], &growth, sizeof growth) == sizeof growth ? 0 : 1);
  }
  close(ends[1]);  // or reading would wait for this process too
  double growth = 0;
  const bool told = read(ends[0], &growth, sizeof growth) == sizeof growth;
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!told) throw std::runtime_error("the measured process died");
  return growth;
}

void print_row(Eigen::Index n, const char* what, Eigen::Index modes, const std::function<void()>& work) {
  const double memory = peak_megabytes(work);
  fmt::print("| {} | {} | {} | {:.2g} | {:.1f} |\n", n, what, modes, cpu_seconds(work), memory);
  std::fflush(stdout);
}

void print_releases(const Structure& s, const Eigen::Vector3i& divisions, int count) {
  Support springs, joints;
  for (const auto& [node, direction] : held_freedoms(s, divisions)) {
    springs.springs.push_back({node, direction, 1e6});
    joints.joints.push_back({node, direction});
  }
  const SupportMatrices on_springs = s.matrices(springs), on_joints = s.matrices(joints);
  const int most = static_cast<int>(s.n());
  const Modes sprung = lowest_modes(s.K + on_springs.K_s, s.M, std::min(count, most));
  print_row(s.n(), "free-free from springs", sprung.count(),
            [&] { release(sprung, s.M, on_springs, s.rigid); });
  const Modes jointed = modes_on_joints(s, on_joints.D, std::min(count, most - 6));
  print_row(s.n(), "free-free from joints", jointed.count(),
            [&] { release(jointed, s.M, on_joints, s.rigid); });
}

}  // namespace

int main(int argc, char** argv) {
  const int largest_complete = argc > 1 ? std::atoi(argv[1]) : 600;
  fmt::print("| freedoms | what | modes | CPU s | memory MB |\n|---|---|---|---|---|\n");
  for (const Eigen::Vector3i& divisions : {Eigen::Vector3i(4, 1, 1), {7, 4, 4}, {19, 9, 9}}) {
    const Structure s(divisions);
    print_row(s.n(), "lowest modes of K and M", kModes, [&] { lowest_modes(s.K, s.M, kModes); });
    print_releases(s, divisions, kModes);
    if (s.n() <= largest_complete) print_releases(s, divisions, static_cast<int>(s.n()));
  }
  return 0;
}
