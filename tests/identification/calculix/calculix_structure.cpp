#include "identification/calculix/calculix_structure.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>

#include "core/error.h"
#include "identification/calculix/calculix_files.h"
#include "identification/formats/calculix_matrices.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

/// The frame in the making: cells of a block of 24 x 18 x 4 that lie in one of two legs six cells wide.
const Eigen::Vector3i kDivisions{24, 18, 4};
constexpr int kLegWidth = 6;
const Vector3 kSize{1.2, 0.9, 0.16};

/// Keeps the elements whose centres pass `wanted`, and the nodes they need, numbered from 1.
template <class Predicate>
Mesh part_of(const Mesh& block, Predicate wanted) {
  Mesh part;
  part.type = block.type;
  std::vector<int> elements, nodes, number(block.node_ids.size(), -1);
  for (int e = 0; e < block.elements.cols(); ++e)
    if (wanted(Vector3(block.nodes(Eigen::all, block.elements.col(e)).rowwise().mean())))
      elements.push_back(e);
  part.elements = block.elements(Eigen::all, elements);
  for (int& node : part.elements.reshaped()) {
    int& new_number = number[static_cast<std::size_t>(node)];
    if (new_number < 0) {
      new_number = static_cast<int>(nodes.size());
      nodes.push_back(node);
    }
    node = new_number;
  }
  part.nodes = block.nodes(Eigen::all, nodes);
  part.node_ids.resize(nodes.size());
  std::iota(part.node_ids.begin(), part.node_ids.end(), 1);
  return part;
}

/// Bends, twists and tapers the legs: elements are no longer boxes and the structure has no symmetry.
Vector3 distorted(const Vector3& p) {
  const double taper = 1 - 0.25 * p.x() - 0.15 * p.y();
  return {p.x() + 0.05 * std::sin(4 * p.y()), p.y() + 0.04 * std::sin(3 * p.x()) + 0.1 * p.x() * p.z(),
          taper * p.z() + 0.06 * std::cos(3 * p.x() + 2 * p.y())};
}

int nearest_node(const Mesh& mesh, const Vector3& undistorted) {
  Eigen::Index nearest = 0;
  (mesh.nodes.colwise() - distorted(undistorted)).colwise().squaredNorm().minCoeff(&nearest);
  return mesh.node_ids[static_cast<std::size_t>(nearest)];
}

/// Corner of the frame, tip of the leg along x, tip of the leg along y: on the underside.
std::array<int, 3> support_nodes() {
  const Mesh mesh = calculix_frame().mesh;
  const Vector3 corner = -kSize / 2;
  return {nearest_node(mesh, corner), nearest_node(mesh, corner + Vector3(kSize.x(), 0, 0)),
          nearest_node(mesh, corner + Vector3(0, kSize.y(), 0))};
}

std::string text_of(const std::string& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs the deck under the name `job` and gives the path of its results without extension.
std::string run_calculix(const std::filesystem::path& folder, const std::string& job,
                         const std::string& deck) {
  std::ofstream(folder / (job + ".inp")) << deck;
  const std::string log = (folder / (job + ".log")).string();
  const std::string command =
      fmt::format("cd '{}' && OMP_NUM_THREADS=1 ccx {} > '{}' 2>&1", folder.string(), job, log);
  if (std::system(command.c_str()) != 0 || text_of(log).find("*ERROR") != std::string::npos)
    throw InputError({"CalculiX", "the analysis failed", job, text_of(log)});
  return (folder / job).string();
}

Modes modes_by_calculix(const TemporaryFolder& folder, const std::string& job, const CalculixModel& model,
                        int mode_count) {
  const std::string results = run_calculix(folder / "", job, modes_deck(model, mode_count));
  Modes modes{read_dat_eigenvalues(results + ".dat"), read_frd_shapes(results + ".frd", model.mesh.node_ids)};
  if (modes.lambda.size() != modes.shapes.cols())
    throw InputError({results, "there must be an eigenvalue for every shape",
                      fmt::format("{} and {}", modes.lambda.size(), modes.shapes.cols()),
                      "ask for fewer modes"});
  fix_signs(modes.shapes);
  return modes;
}

}  // namespace

bool calculix_is_installed() {
  return std::system("command -v ccx > /dev/null 2>&1") == 0;
}

CalculixModel calculix_frame() {
  Mesh mesh = part_of(make_block(kSize, kDivisions, ElementType::mean_dilatation), [](const Vector3& centre) {
    const Vector3 cell = (centre + kSize / 2).cwiseQuotient(kSize).cwiseProduct(kDivisions.cast<double>());
    return cell.x() < kLegWidth || cell.y() < kLegWidth;
  });
  for (auto node : mesh.nodes.colwise()) node = distorted(Vector3(node));
  return {mesh, {2.1e11, 0.3, 7850}, {}};
}

Support frame_springs(double k) {
  Support support;
  for (const int node : support_nodes())
    for (int axis = 0; axis < 3; ++axis) support.springs.push_back({node, Vector3::Unit(axis), k});
  return support;
}

Support frame_joints() {
  const auto [corner, tip_x, tip_y] = support_nodes();
  Support support;
  for (int axis = 0; axis < 3; ++axis) support.joints.push_back({corner, Vector3::Unit(axis)});
  support.joints.push_back({tip_x, Vector3::UnitY()});
  support.joints.push_back({tip_x, Vector3::UnitZ()});
  support.joints.push_back({tip_y, Vector3::UnitZ()});
  return support;
}

CalculixStructure analyse_with_calculix(const CalculixModel& model, int mode_count) {
  const TemporaryFolder folder;
  const Mesh& mesh = model.mesh;
  CalculixModel free = model;
  free.support = {};
  CalculixStructure structure;
  structure.free = modes_by_calculix(folder, "free", free, mode_count + 6);

  const Modes held = modes_by_calculix(folder, "held", model, mode_count);
  ModalData& data = structure.supported;
  data.title = "frame by CalculiX";
  data.node_ids = mesh.node_ids;
  data.node_position = mesh.nodes;
  data.freedoms = all_freedoms(mesh.node_ids);
  data.omega = held.lambda.cwiseSqrt();
  data.damping_ratio = VectorX::Zero(held.count());
  data.modal_mass = VectorX::Ones(held.count());
  data.shapes = held.shapes;
  data.support = model.support;
  data.validate();

  const std::string matrices = store_calculix_matrices(free, folder / "", "matrices");
  CalculixMatrices stored = read_calculix_matrices(matrices, matrices + ".inp");
  structure.M = std::move(stored.M);
  structure.K = std::move(stored.K);
  return structure;
}

std::string store_calculix_matrices(const CalculixModel& model, const std::filesystem::path& folder,
                                    const std::string& job) {
  return run_calculix(folder, job, matrices_deck(model));
}

CalculixStructure calculix_supported_structure(const Support& support, int mode_count) {
  CalculixModel model = calculix_frame();
  model.support = support;
  return analyse_with_calculix(model, mode_count);
}

}  // namespace wishbone
