#include "identification/calculix/calculix_deck.h"

#include <fmt/format.h>

#include <iterator>

namespace wishbone {
namespace {

// Numbers have thirteen digits because CalculiX reads fields of at most twenty characters.

/// 1, 2, 3: x, y, z.
int axis_number(const Vector3& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis) + 1;
}

void write_structure(const CalculixModel& model, std::back_insert_iterator<std::string> out) {
  const Mesh& mesh = model.mesh;
  fmt::format_to(out, "*NODE,NSET=NALL\n");
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i)
    fmt::format_to(out, "{},{:.12e},{:.12e},{:.12e}\n", mesh.node_ids[static_cast<std::size_t>(i)],
                   mesh.nodes(0, i), mesh.nodes(1, i), mesh.nodes(2, i));
  fmt::format_to(out, "*ELEMENT,TYPE=C3D8,ELSET=EALL\n");
  for (Eigen::Index e = 0; e < mesh.elements.cols(); ++e) {
    fmt::format_to(out, "{}", e + 1);
    for (const int node : mesh.elements.col(e))
      fmt::format_to(out, ",{}", mesh.node_ids[static_cast<std::size_t>(node)]);
    fmt::format_to(out, "\n");
  }
  fmt::format_to(out, "*MATERIAL,NAME=SOLID\n*ELASTIC\n{:.12e},{:.12e}\n*DENSITY\n{:.12e}\n",
                 model.material.youngs_modulus, model.material.poissons_ratio, model.material.density);
  fmt::format_to(out, "*SOLID SECTION,ELSET=EALL,MATERIAL=SOLID\n");
}

void write_support(const CalculixModel& model, std::back_insert_iterator<std::string> out) {
  Eigen::Index element = model.mesh.elements.cols();
  for (const Support::Spring& spring : model.support.springs) {
    ++element;
    fmt::format_to(out, "*ELEMENT,TYPE=SPRING1,ELSET=S{}\n{},{}\n", element, element, spring.node);
    // the stiffness needs its decimal point: a line of whole numbers is taken for freedoms
    fmt::format_to(out, "*SPRING,ELSET=S{}\n{}\n{:.12e}\n", element, axis_number(spring.direction),
                   spring.stiffness);
  }
  if (!model.support.joints.empty()) fmt::format_to(out, "*BOUNDARY\n");
  for (const Support::Joint& joint : model.support.joints)
    fmt::format_to(out, "{},{}\n", joint.node, axis_number(joint.direction));
}

std::string deck(const CalculixModel& model, const std::string& step) {
  std::string text;
  write_structure(model, std::back_inserter(text));
  write_support(model, std::back_inserter(text));
  return text + "*STEP\n" + step + "*END STEP\n";
}

}  // namespace

std::string modes_deck(const CalculixModel& model, int mode_count) {
  return deck(model, fmt::format("*FREQUENCY\n{}\n*NODE FILE\nU\n", mode_count));
}

std::string matrices_deck(const CalculixModel& model) {
  return deck(model, "*FREQUENCY,SOLVER=MATRIXSTORAGE\n1\n");
}

}  // namespace wishbone
