#include <fmt/format.h>

#include "models/scene_sections.h"

namespace wishbone::scene_sections {
namespace {

double read_poisson(const Value& value) {
  const double poisson = value.number(kRatio);
  if (!(poisson > -1 && poisson < 0.5))
    value.refuse("Poisson's ratio must be between -1 and 0.5", "metals have 0.3");
  return poisson;
}

/// Beyond it the modes of a block would take minutes.
constexpr int kMostNodes = 40000;

/// Corners, and with quadratic elements the middles of the edges.
long node_count(const Scene::Block& block) {
  const Eigen::Vector3i corners = block.elements + Eigen::Vector3i::Ones();
  long count = corners.prod();
  if (block.type == ElementType::hexahedron20)
    for (int axis = 0; axis < 3; ++axis) count += long{corners.prod()} / corners[axis] * block.elements[axis];
  return count;
}

}  // namespace

IsotropicMaterial read_material(const Value& value) {
  const Mapping keys(value, {"young", "poisson", "density"});
  IsotropicMaterial material;
  material.youngs_modulus = keys.required("young").positive(kPressure);
  material.poissons_ratio = read_poisson(keys.required("poisson"));
  material.density = keys.required("density").positive(kDensity);
  return material;
}

Scene::Block read_block(const Value& value, const Value& material_value) {
  Scene::Block block;
  const Mapping keys(value, {"size", "elements", "element"});
  const Value size = keys.required("size");
  block.size = size.vector3(kLength);
  if (!(block.size.minCoeff() > 0))
    size.refuse("the edges of the block must be positive", "give three lengths above zero");
  const Value elements = keys.required("elements");
  const std::vector<Value> counts = elements.list();
  if (counts.size() != 3) elements.refuse("three numbers of elements are wanted", "write [nx, ny, nz]");
  constexpr int kMostElements = 100;
  for (int i = 0; i < 3; ++i)
    block.elements[i] = counts[static_cast<std::size_t>(i)].integer(1, kMostElements);
  if (const auto type = keys.optional("element"))
    block.type = type->choice<ElementType>({{"incompatible_modes", ElementType::incompatible_modes},
                                            {"quadratic", ElementType::hexahedron20},
                                            {"mean_dilatation", ElementType::mean_dilatation}},
                                           "the elements of blocks");
  if (const long nodes = node_count(block); nodes > kMostNodes)
    elements.refuse(fmt::format("the block has {} nodes, more than the {} whose modes can be computed", nodes,
                                kMostNodes),
                    "take fewer elements");

  const IsotropicMaterial material = read_material(material_value);
  block.young = material.youngs_modulus;
  block.poisson = material.poissons_ratio;
  block.density = material.density;
  return block;
}

}  // namespace wishbone::scene_sections
