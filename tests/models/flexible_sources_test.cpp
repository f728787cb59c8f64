// Where the nodes, masses and stiffness of a flexible body come from: the same body by different ways.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "compiled_modes.h"
#include "core/error.h"
#include "identification/elements/mesh.h"
#include "identification/formats/matrix_market.h"
#include "models/compile.h"
#include "models/scene_loader.h"
#include "text_files.h"

namespace wishbone {
namespace {

const Mesh kMesh = make_block({1, 0.1, 0.2}, {3, 1, 2});
constexpr IsotropicMaterial kMaterial{210e6, 0.3, 2600};
constexpr std::string_view kMaterialText = "{young: 210 MPa, poisson: 0.3, density: 2600}";

/// Nodes, elements and matrices of one block as files.
class FlexibleSources : public testing::Test {
 protected:
  FlexibleSources() {
    write_nodes("nodes.csv", false);
    write_nodes("masses.csv", true);
    std::string elements = "n1,n2,n3,n4,n5,n6,n7,n8\n";
    for (const auto& element : kMesh.elements.colwise())
      elements += fmt::format("{}\n", fmt::join(ids_of(element), ","));
    files_.write("elements.csv", elements);
    write_matrix_market(files_ / "K.mtx", stiffness_matrix(kMesh, kMaterial), false);
    const SparseMatrix M = lumped_mass_matrix(lumped_mass(kMesh, kMaterial.density));
    write_matrix_market(files_ / "M.mtx", M, true);
    SparseMatrix consistent = M;  // some mass of the first node moves with the second
    for (int axis = 0; axis < 3; ++axis) {
      consistent.coeffRef(axis, axis) -= 0.01;
      consistent.coeffRef(3 + axis, 3 + axis) -= 0.01;
      consistent.coeffRef(axis, 3 + axis) = 0.01;
      consistent.coeffRef(3 + axis, axis) = 0.01;
    }
    write_matrix_market(files_ / "consistent.mtx", consistent, true);
    files_.write("short.mtx", "%%MatrixMarket matrix coordinate real symmetric\n9 9 1\n1 1 5\n");
  }

  static std::vector<int> ids_of(const Eigen::Matrix<int, 8, 1>& element) {
    std::vector<int> ids;
    for (const int node : element) ids.push_back(kMesh.node_ids[static_cast<std::size_t>(node)]);
    return ids;
  }

  void write_nodes(const std::string& name, bool masses) const {
    const VectorX mass = lumped_mass(kMesh, kMaterial.density);
    std::string text = masses ? "node,x,y,z,mass\n" : "node,x,y,z\n";
    for (Eigen::Index i = 0; i < kMesh.nodes.cols(); ++i) {
      const Vector3 p = kMesh.nodes.col(i) + Vector3(3, 0.5, -1);  // wherever the program had its origin
      text += fmt::format("{},{:.17g},{:.17g},{:.17g}", kMesh.node_ids[static_cast<std::size_t>(i)], p.x(),
                          p.y(), p.z());
      text += masses ? fmt::format(",{:.17g}\n", mass[i]) : "\n";
    }
    files_.write(name, text);
  }

  Scene load(const std::string& source, const std::string& modes = "12\n      attachment: [1, 24]") const {
    return load_scene(files_.write("scene.yaml", R"(wishbone: 1
bodies:
  beam:
    form: modal
    position: [0, 0, 0]
    flexible:
      )" + source + "\n      modes: " + modes + "\n"));
  }
  ModeSet modes(const std::string& source) const { return compiled_modes(compile(load(source))); }
  ModeSet block_modes() const {
    return modes(fmt::format("block: {{size: [1, 0.1, 0.2], elements: [3, 1, 2]}}\n      material: {}",
                             kMaterialText));
  }
  std::string message(const std::string& source, const std::string& choice = "12") const {
    return files_.relative(message_of<InputError>([&] { compile(load(source, choice)); }));
  }

  void expect_block(const std::string& source) const {
    const ModeSet found = modes(source), expected = block_modes();
    EXPECT_EQ(found.node_ids, expected.node_ids) << source;
    EXPECT_LE((found.node_position - expected.node_position).norm(), 1e-14) << source;
    EXPECT_LE((found.omega - expected.omega).cwiseQuotient(expected.omega).cwiseAbs().maxCoeff(), 1e-10)
        << source;
    EXPECT_LE((found.node_mass - expected.node_mass).norm(), 1e-12) << source;
  }

  TextFiles files_;
};

TEST_F(FlexibleSources, OfOneBlockGiveTheSameBody) {
  expect_block("model: {nodes: nodes.csv, stiffness: K.mtx, mass: M.mtx}");
  expect_block("model: {nodes: masses.csv, stiffness: K.mtx}");
  expect_block(
      fmt::format("model: {{nodes: nodes.csv, elements: elements.csv, material: {}}}", kMaterialText));
  std::string list;
  for (const auto& element : kMesh.elements.colwise())
    list += fmt::format("{}[{}]", list.empty() ? "" : ", ", fmt::join(ids_of(element), ", "));
  expect_block(fmt::format("model: {{nodes: nodes.csv, elements: [{}], material: {}}}", list, kMaterialText));
}

TEST_F(FlexibleSources, AreListedAmongTheFilesOfTheScene) {
  const Scene scene = load("model: {nodes: nodes.csv, stiffness: K.mtx, mass: M.mtx}");
  EXPECT_THAT(scene.data_files,
              testing::ElementsAre((files_ / "nodes.csv").string(), (files_ / "K.mtx").string(),
                                   (files_ / "M.mtx").string()));
}

TEST_F(FlexibleSources, ServeAsTheModelOfAnIdentification) {
  const Scene scene = load("model: {nodes: nodes.csv, stiffness: K.mtx, mass: M.mtx}",
                           "{measured: {from: model, modes: 20}}");
  const ModeSet set = compiled_modes(compile(scene));
  EXPECT_EQ(set.mode_count(), 20);
  EXPECT_LE(
      (set.omega.head(12) -
       compiled_modes(compile(load("model: {nodes: nodes.csv, stiffness: K.mtx, mass: M.mtx}", "12"))).omega)
          .norm(),
      1e-8 * set.omega.norm());
}

TEST_F(FlexibleSources, AreLumpedWhereAsked) {
  EXPECT_EQ(message("model: {nodes: nodes.csv, stiffness: K.mtx, mass: consistent.mtx}"),
            "scene.yaml:7:7: bodies.beam.flexible.model: error: a flexible body needs lumped masses, and "
            "this mass "
            "matrix is not lumped\n"
            "  add 'lumping: row_sum' or 'lumping: diagonal' to the model");
  // sums of rows give back the masses that were moved off the diagonal
  expect_block("model: {nodes: nodes.csv, stiffness: K.mtx, mass: consistent.mtx, lumping: row_sum}");
  const ModeSet diagonal =
      modes("model: {nodes: nodes.csv, stiffness: K.mtx, mass: consistent.mtx, lumping: diagonal}");
  EXPECT_NEAR(diagonal.mass(), block_modes().mass(), 1e-12);
  EXPECT_EQ(message("model: {nodes: nodes.csv, stiffness: K.mtx, mass: M.mtx, lumping: rows}"),
            "scene.yaml:7:73: bodies.beam.flexible.model.lumping: error: not one of the kinds of lumping "
            "(got 'rows')\n"
            "  the kinds of lumping are: row_sum, diagonal");
}

/// A table of the nodes of a mesh, and its elements as a table.
void write_mesh(const TextFiles& files, const Mesh& mesh) {
  std::string nodes = "node,x,y,z\n", elements;
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    nodes += fmt::format("{},{:.17g},{:.17g},{:.17g}\n", mesh.node_ids[static_cast<std::size_t>(i)],
                         mesh.nodes(0, i), mesh.nodes(1, i), mesh.nodes(2, i));
  for (Eigen::Index a = 0; a < mesh.elements.rows(); ++a)
    elements += fmt::format("{}n{}", a == 0 ? "" : ",", a + 1);
  for (const auto& element : mesh.elements.colwise()) {
    elements += '\n';
    for (Eigen::Index a = 0; a < element.size(); ++a)
      elements += fmt::format("{}{}", a == 0 ? "" : ",", mesh.node_ids[static_cast<std::size_t>(element[a])]);
  }
  files.write("quadratic_nodes.csv", nodes);
  files.write("quadratic_elements.csv", elements + "\n");
}

// The number of nodes says which elements are listed; those of the same block have the same lowest bending, 20 nodes or 10.
TEST_F(FlexibleSources, QuadraticMeshesAreListedAsHexahedraAndTetrahedra) {
  const Mesh block = make_block({1, 0.1, 0.2}, {6, 1, 1});
  constexpr int kPaths[6][4] = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6},
                                {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  Mesh corners{block.node_ids, block.nodes, Eigen::MatrixXi(4, 6 * block.elements.cols()), {}};
  for (int e = 0; e < block.elements.cols(); ++e)
    for (int t = 0; t < 6; ++t)
      for (int a = 0; a < 4; ++a) corners.elements(a, 6 * e + t) = block.elements(kPaths[t][a], e);
  std::vector<double> lowest;
  for (const Mesh& mesh :
       {with_middle_nodes(block), with_middle_nodes(corners, ElementType::tetrahedron10)}) {
    write_mesh(files_, mesh);
    const ModeSet set = compiled_modes(compile(load(
        fmt::format("model: {{nodes: quadratic_nodes.csv, elements: quadratic_elements.csv, material: {}}}",
                    kMaterialText))));
    EXPECT_EQ(set.node_count(), mesh.nodes.cols());
    lowest.push_back(set.omega[0]);
  }
  EXPECT_NEAR(lowest[1] / lowest[0], 1, 0.05);
}

TEST_F(FlexibleSources, AreRefusedWithPlaceValueAndRemedy) {
  EXPECT_EQ(message("model: {nodes: nodes.csv, stiffness: short.mtx, mass: M.mtx}"),
            "scene.yaml:7:44: bodies.beam.flexible.model.stiffness: error: 24 nodes have 72 freedoms, this "
            "matrix has "
            "9 rows (got 'short.mtx')\n"
            "  give three freedoms to every node, in the order of the table");
  EXPECT_EQ(message("model: {nodes: nodes.csv, stiffness: none.mtx}"),
            "scene.yaml:7:44: bodies.beam.flexible.model.stiffness: error: there is no file none.mtx (got "
            "'none.mtx')\n"
            "  names are relative to the file that they stand in");
  EXPECT_EQ(message("model: {nodes: nodes.csv, stiffness: K.mtx}"),
            "scene.yaml:7:7: bodies.beam.flexible.model: error: the masses of the model are not known\n"
            "  add 'mass: M.mtx', or a column 'mass' to the nodes");
  EXPECT_EQ(
      message(fmt::format("model: {{nodes: nodes.csv, elements: [[1, 2, 3]], material: {}}}", kMaterialText)),
      "scene.yaml:7:44: bodies.beam.flexible.model.elements[1]: error: there is no element of 3 nodes\n"
      "  write [n1, ..., n8] or [n1, ..., n20] for hexahedra, [n1, ..., n10] for tetrahedra");
  EXPECT_EQ(
      message(fmt::format("model: {{nodes: nodes.csv, elements: [[1, 2, 3, 4, 5, 6, 7, 99]], material: {}}}",
                          kMaterialText)),
      "scene.yaml:7:66: bodies.beam.flexible.model.elements[1][8]: error: the mesh has no such node (got "
      "'99')\n"
      "  its nodes are 1 to 24");
  EXPECT_EQ(message(fmt::format("model: {{nodes: nodes.csv, elements: [[{}]], material: {}}}",
                                fmt::join(ids_of(kMesh.elements.col(0)), ", "), kMaterialText)),
            "scene.yaml:7:22: bodies.beam.flexible.model.nodes: error: node 5 belongs to no element (got "
            "'nodes.csv')\n"
            "  remove it from the table");
  EXPECT_EQ(message(fmt::format("model: {{nodes: masses.csv, elements: elements.csv, material: {}}}",
                                kMaterialText)),
            "scene.yaml:7:22: bodies.beam.flexible.model.nodes: error: the masses of a mesh are those of its "
            "elements "
            "(got 'masses.csv')\n"
            "  remove the column 'mass' from the table");
  EXPECT_EQ(message("model: {nodes: nodes.csv, stiffness: K.mtx, mass: M.mtx}\n      material: " +
                    std::string(kMaterialText)),
            "scene.yaml:7:7: bodies.beam.flexible.model: error: the nodes come either from a block or from "
            "a model\n"
            "  remove one of the two");
  EXPECT_EQ(message("model: {nodes: nodes.csv, stiffness: M.mtx, mass: M.mtx}").substr(0, 120),
            "scene.yaml:3:3: bodies.beam: free-free modes: error: the stiffness must not resist rigid-body "
            "motion of a "
            "free body (got");
}

}  // namespace
}  // namespace wishbone
