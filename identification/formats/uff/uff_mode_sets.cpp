#include "identification/formats/uff/uff_mode_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <unordered_set>
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
  const UffOscillation oscillation = uff_oscillation(shape);
  mode.omega = oscillation.omega;
  mode.damping_ratio = oscillation.damping_ratio;
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

/// Analysis, load case, number, frequency and eigenvalue: equal for the parts of one mode.
using Key = std::tuple<int, int, int, double, double, double>;

Key key_of(const UffShape& s) {
  return {s.analysis, s.load_case, s.number, s.frequency, s.eigenvalue.real(), s.eigenvalue.imag()};
}

bool repeats(const UffModeSet& mode, const UffShape& shape) {
  return std::any_of(mode.parts.begin(), mode.parts.end(), [&](const UffShape* part) {
    return part->nodes == shape.nodes && part->values == shape.values;
  });
}

/// Whether the shape has none of the nodes that the mode has.
bool completes(const UffModeSet& mode, const UffShape& shape) {
  const std::unordered_set<int> nodes(shape.nodes.begin(), shape.nodes.end());
  return std::none_of(mode.parts.begin(), mode.parts.end(), [&](const UffShape* part) {
    return std::any_of(part->nodes.begin(), part->nodes.end(),
                       [&](int node) { return nodes.contains(node); });
  });
}

std::vector<UffModeSet> grouped(const std::vector<const UffShape*>& shapes,
                                std::vector<std::string>& provenance) {
  std::vector<UffModeSet> modes;
  std::map<Key, std::vector<std::size_t>> modes_of;
  int repeated = 0;
  for (const UffShape* shape : shapes) {
    std::vector<std::size_t>& alike = modes_of[key_of(*shape)];
    if (std::any_of(alike.begin(), alike.end(), [&](std::size_t j) { return repeats(modes[j], *shape); })) {
      ++repeated;
      continue;
    }
    auto mode =
        std::find_if(alike.begin(), alike.end(), [&](std::size_t j) { return completes(modes[j], *shape); });
    if (mode == alike.end()) {
      modes.push_back(mode_of(*shape));
      mode = alike.insert(alike.end(), modes.size() - 1);
    }
    modes[*mode].parts.push_back(shape);
    modes[*mode].is_complex = modes[*mode].is_complex || has_imaginary_part(*shape);
  }
  if (repeated > 0)
    provenance.push_back(fmt::format("left out {} datasets that repeat another one", repeated));
  return modes;
}

/// Complex modes come in pairs; the one with Im s > 0 stands for both. Without oscillation there is no mode.
void leave_out_conjugates(std::vector<UffModeSet>& modes, std::vector<std::string>& provenance) {
  std::vector<std::complex<double>> upper;
  for (const UffModeSet& mode : modes)
    if (is_complex_mode(*mode.parts.front()) && mode.parts.front()->eigenvalue.imag() > 0)
      upper.push_back(mode.parts.front()->eigenvalue);
  const std::size_t count = std::erase_if(modes, [&](const UffModeSet& mode) {
    const std::complex<double> s = mode.parts.front()->eigenvalue;
    if (!is_complex_mode(*mode.parts.front()) || s.imag() > 0) return false;
    return s.imag() == 0 || std::any_of(upper.begin(), upper.end(), [&](std::complex<double> other) {
             return std::abs(std::conj(other) - s) <= 1e-5 * std::abs(s);
           });
  });
  if (count > 0)
    provenance.push_back(fmt::format("left out {} complex modes: conjugates, or without oscillation", count));
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

UffOscillation uff_oscillation(const UffShape& shape) {
  const bool has_root = is_complex_mode(shape) && shape.eigenvalue != 0.0;
  if (has_root) {
    const double omega = std::abs(shape.eigenvalue);
    return {omega, -shape.eigenvalue.real() / omega};
  }
  const bool has_only_eigenvalue =
      shape.analysis == kUffNormalMode && shape.frequency == 0 && shape.eigenvalue.real() > 0;
  return {has_only_eigenvalue ? std::sqrt(shape.eigenvalue.real()) : 2 * std::numbers::pi * shape.frequency,
          // loss factor eta = 2 zeta at resonance
          shape.viscous_damping != 0 ? shape.viscous_damping : shape.hysteretic_damping / 2};
}

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
