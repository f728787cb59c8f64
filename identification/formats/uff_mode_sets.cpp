#include "identification/formats/uff_mode_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace wishbone {
namespace {

constexpr int kDisplacement = 8, kVelocity = 11, kAcceleration = 12;
constexpr double kZeroFrequency = 1e-6;  ///< of the highest frequency: numbers of the file have six digits

bool is_complex_mode(const UffShape& shape) {
  return shape.analysis == kUffComplexModeFirstOrder || shape.analysis == kUffComplexModeSecondOrder;
}

/// Displacements first, also those that are not called so; then velocities, then accelerations. 3: no motion.
int rank_of(int quantity) {
  constexpr std::array kUnnamed = {0, 1, 95, 96};  // unknown, general, unknown vectors of 3 and 6
  if (quantity == kDisplacement || std::find(kUnnamed.begin(), kUnnamed.end(), quantity) != kUnnamed.end())
    return 0;
  return quantity == kVelocity ? 1 : quantity == kAcceleration ? 2 : 3;
}

/// Why a shape is no mode; empty when it is one.
std::string objection(const UffShape& shape, int rank) {
  if (shape.analysis != kUffNormalMode && !is_complex_mode(shape))
    return fmt::format("analysis type {} is no mode", shape.analysis);
  const bool is_vector = shape.characteristic == 2 || shape.characteristic == 3 || shape.characteristic == 0;
  if (!is_vector || (shape.values_per_node != 3 && shape.values_per_node != 6))
    return fmt::format("data characteristic {} with {} values per node is no translation",
                       shape.characteristic, shape.values_per_node);
  if (rank_of(shape.quantity) > 2) return fmt::format("data type {} is no motion", shape.quantity);
  if (rank_of(shape.quantity) != rank) return "the same file has displacements";
  if (std::all_of(shape.values.begin(), shape.values.end(), [](double x) { return x == 0; }))
    return "the shape is zero";
  return "";
}

std::vector<const UffShape*> mode_shapes(const UffFile& file, std::vector<std::string>& provenance) {
  int rank = 2;
  for (const UffShape& shape : file.shapes)
    if (objection(shape, rank_of(shape.quantity)).empty()) rank = std::min(rank, rank_of(shape.quantity));
  std::vector<const UffShape*> shapes;
  std::map<std::string, int> left_out;
  for (const UffShape& shape : file.shapes) {
    const std::string why = objection(shape, rank);
    why.empty() ? shapes.push_back(&shape) : void(++left_out[why]);
  }
  for (const auto& [why, count] : left_out)
    provenance.push_back(fmt::format("left out {} nodal results: {}", count, why));
  return shapes;
}

UffModeSet mode_of(const UffShape& shape) {
  UffModeSet mode;
  if (is_complex_mode(shape)) {
    mode.omega = std::abs(shape.eigenvalue);
    mode.damping_ratio = mode.omega > 0 ? -shape.eigenvalue.real() / mode.omega : 0;
  } else {
    const bool has_only_eigenvalue = shape.frequency == 0 && shape.eigenvalue.real() > 0;
    mode.omega =
        has_only_eigenvalue ? std::sqrt(shape.eigenvalue.real()) : 2 * std::numbers::pi * shape.frequency;
    // loss factor eta = 2 zeta at resonance
    mode.damping_ratio = shape.viscous_damping != 0 ? shape.viscous_damping : shape.hysteretic_damping / 2;
  }
  const bool has_mass =
      shape.analysis == kUffNormalMode && rank_of(shape.quantity) == 0 && shape.modal_mass > 0;
  mode.modal_mass = has_mass ? shape.modal_mass : std::numeric_limits<double>::quiet_NaN();
  return mode;
}

bool has_imaginary_part(const UffShape& shape) {
  if (!shape.is_complex) return false;
  for (std::size_t k = 1; k < shape.values.size(); k += 2)
    if (shape.values[k] != 0) return true;
  return false;
}

void add_part(UffModeSet& mode, const UffShape& shape) {
  mode.parts.push_back(&shape);
  mode.nodes.insert(shape.nodes.begin(), shape.nodes.end());
  mode.is_complex = mode.is_complex || has_imaginary_part(shape);
}

bool belong_together(const UffShape& a, const UffShape& b) {
  return a.analysis == b.analysis && a.load_case == b.load_case && a.number == b.number &&
         a.frequency == b.frequency && a.eigenvalue == b.eigenvalue;
}

std::vector<UffModeSet> grouped(const std::vector<const UffShape*>& shapes,
                                std::vector<std::string>& provenance) {
  std::vector<UffModeSet> modes;
  int repeated = 0;
  for (const UffShape* shape : shapes) {
    const auto repeats = [&](const UffShape* part) {
      return belong_together(*part, *shape) && part->nodes == shape->nodes && part->values == shape->values;
    };
    const auto completes = [&](const UffModeSet& mode) {
      return belong_together(*mode.parts.front(), *shape) &&
             std::none_of(shape->nodes.begin(), shape->nodes.end(),
                          [&](int node) { return mode.nodes.contains(node); });
    };
    if (std::any_of(modes.begin(), modes.end(), [&](const auto& mode) {
          return std::any_of(mode.parts.begin(), mode.parts.end(), repeats);
        })) {
      ++repeated;
      continue;
    }
    auto mode = std::find_if(modes.begin(), modes.end(), completes);
    if (mode == modes.end()) mode = modes.insert(modes.end(), mode_of(*shape));
    add_part(*mode, *shape);
  }
  if (repeated > 0)
    provenance.push_back(fmt::format("left out {} datasets that repeat another one", repeated));
  return modes;
}

/// Complex modes come in pairs; the one with Im s > 0 stands for both. Without oscillation there is no mode.
void leave_out_conjugates(std::vector<UffModeSet>& modes, std::vector<std::string>& provenance) {
  const std::size_t before = modes.size();
  const auto is_conjugate_of = [](const UffShape& a, const UffShape& b) {
    return is_complex_mode(b) &&
           std::abs(std::conj(a.eigenvalue) - b.eigenvalue) <= 1e-5 * std::abs(b.eigenvalue);
  };
  const std::vector<UffModeSet> all = modes;
  std::erase_if(modes, [&](const UffModeSet& mode) {
    const UffShape& shape = *mode.parts.front();
    if (!is_complex_mode(shape) || shape.eigenvalue.imag() > 0) return false;
    return shape.eigenvalue.imag() == 0 || std::any_of(all.begin(), all.end(), [&](const UffModeSet& other) {
             return is_conjugate_of(shape, *other.parts.front());
           });
  });
  if (modes.size() < before)
    provenance.push_back(
        fmt::format("left out {} complex modes: conjugates, or without oscillation", before - modes.size()));
}

void leave_out_zero_frequencies(std::vector<UffModeSet>& modes, std::vector<std::string>& provenance) {
  double highest = 0;
  for (const UffModeSet& mode : modes) highest = std::max(highest, mode.omega);
  const std::size_t count =
      std::erase_if(modes, [&](const UffModeSet& mode) { return !(mode.omega > kZeroFrequency * highest); });
  if (count > 0)
    provenance.push_back(
        fmt::format("left out {} modes of zero frequency: rigid-body modes follow from geometry", count));
}

void make_damping_positive(std::vector<UffModeSet>& modes, std::vector<std::string>& provenance) {
  for (std::size_t j = 0; j < modes.size(); ++j) {
    if (modes[j].damping_ratio >= 0) continue;
    provenance.push_back(
        fmt::format("mode {}: negative damping ratio {:g} set to zero", j + 1, modes[j].damping_ratio));
    modes[j].damping_ratio = 0;
  }
}

}  // namespace

std::vector<UffModeSet> uff_mode_sets(const UffFile& file, std::vector<std::string>& provenance) {
  std::vector<UffModeSet> modes = grouped(mode_shapes(file, provenance), provenance);
  leave_out_conjugates(modes, provenance);
  leave_out_zero_frequencies(modes, provenance);
  std::stable_sort(modes.begin(), modes.end(),
                   [](const auto& a, const auto& b) { return a.omega < b.omega; });
  make_damping_positive(modes, provenance);
  return modes;
}

}  // namespace wishbone
