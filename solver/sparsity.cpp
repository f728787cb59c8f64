#include "solver/sparsity.h"

#include <algorithm>
#include <set>

#include "solver/loads.h"

namespace wishbone {
namespace {

using Bodies = std::set<int>;

void add_path(const System& system, int body, Bodies& bodies) {
  for (; body >= 0; body = system.bodies[body].parent) bodies.insert(body);
}

/// The growing pattern, addressed by bodies.
class Pattern {
 public:
  Pattern(const System& system, const std::vector<int>& kept)
      : system_(system),
        n_(system.nq + system.nv + system.nx + 2),
        m_(static_cast<int>(kept.size())),
        rows_(n_ + 2 * m_) {
    for (int i = 0; i < n_; ++i) rows_[i].insert(i);
  }

  /// All q and v indices of some bodies, their modes included.
  std::vector<int> coordinates(const Bodies& bodies) const {
    return indices(bodies, &TreeBody::q_start, &TreeBody::nq, &FlexibleBody::z_start, 0);
  }
  std::vector<int> speeds(const Bodies& bodies) const {
    return indices(bodies, &TreeBody::v_start, &TreeBody::nv, &FlexibleBody::z_rate_start, system_.nq);
  }

  void couple(const std::vector<int>& rows, const std::vector<int>& columns) {
    for (const int row : rows) rows_[row].insert(columns.begin(), columns.end());
  }

  /// Bodies whose equations of motion depend on each other's motion.
  void couple_motion(const Bodies& bodies) {
    couple(speeds(bodies), coordinates(bodies));
    couple(speeds(bodies), speeds(bodies));
  }

  void add_closure_row(const Bodies& bodies, int i) {
    const std::vector<int> q = coordinates(bodies), v = speeds(bodies);
    const int Phi = n_ + i, Phi_rate = n_ + m_ + i;
    couple(v, {Phi});
    couple(v, q);
    couple(q, {Phi_rate});
    couple(q, q);
    couple({Phi}, q);
    couple({Phi_rate}, q);
    couple({Phi_rate}, v);
  }

  SparsityPattern finish() const {
    SparsityPattern pattern;
    for (const std::set<int>& row : rows_) pattern.emplace_back(row.begin(), row.end());
    return pattern;
  }

 private:
  std::vector<int> indices(const Bodies& bodies, int TreeBody::*start, int TreeBody::*count,
                           int FlexibleBody::*modal_start, int offset) const {
    std::vector<int> all;
    for (const int b : bodies) {
      const TreeBody& body = system_.bodies[b];
      for (int i = 0; i < body.*count; ++i) all.push_back(offset + body.*start + i);
      if (body.flexible < 0) continue;
      const FlexibleBody& flexible = system_.flexible[body.flexible];
      for (int i = 0; i < flexible.modal.mode_count(); ++i) all.push_back(offset + flexible.*modal_start + i);
    }
    return all;
  }

  const System& system_;
  int n_, m_;
  std::vector<std::set<int>> rows_;
};

Bodies bodies_of(const System& system, const std::vector<MarkerIndex>& markers) {
  Bodies bodies;
  for (const MarkerIndex marker : markers) add_path(system, system.markers[marker].body, bodies);
  return bodies;
}

/// Markers that a force element looks at or acts on, those of its signals included.
template <class Force>
std::vector<MarkerIndex> markers_of(const System& system, const Force& element) {
  std::vector<MarkerIndex> markers = element.markers();
  if constexpr (requires { element.variables(); }) {
    for (const int variable : element.variables()) {
      if (variable == Function::kTime) continue;
      const std::vector<MarkerIndex> more = system.signals[variable - 1].markers();
      markers.insert(markers.end(), more.begin(), more.end());
    }
  }
  return markers;
}

}  // namespace

SparsityPattern ggl_pattern(const System& system, const std::vector<int>& kept) {
  Pattern pattern(system, kept);
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) {
    Bodies path;
    add_path(system, b, path);
    pattern.couple_motion(path);
    pattern.couple(pattern.coordinates({b}), pattern.coordinates({b}));
    pattern.couple(pattern.coordinates({b}), pattern.speeds({b}));
  }
  int x = system.nq + system.nv;
  for_each_force(system, [&](const auto& element, int) {
    const Bodies bodies = bodies_of(system, markers_of(system, element));
    pattern.couple_motion(bodies);
    std::vector<int> states(element.state_count());
    for (int& state : states) state = x++;
    pattern.couple(pattern.speeds(bodies), states);
    pattern.couple(states, states);
    pattern.couple(states, pattern.coordinates(bodies));
    pattern.couple(states, pattern.speeds(bodies));
  });
  std::size_t next = 0;
  for (const Closure& closure : system.closures) {
    const Bodies bodies = bodies_of(system, closure.markers);
    for (; next < kept.size() && kept[next] < closure.row_start + closure.rows; ++next)
      pattern.add_closure_row(bodies, static_cast<int>(next));
  }
  return pattern.finish();
}

std::vector<int> colour_columns(const SparsityPattern& pattern, int columns) {
  std::vector<std::vector<int>> rows_of(columns);
  for (int row = 0; row < static_cast<int>(pattern.size()); ++row)
    for (const int column : pattern[row]) rows_of[column].push_back(row);
  std::vector<int> colours(columns, -1);
  for (int column = 0; column < columns; ++column) {
    std::set<int> taken;
    for (const int row : rows_of[column])
      for (const int other : pattern[row])
        if (colours[other] >= 0) taken.insert(colours[other]);
    int colour = 0;
    while (taken.count(colour) > 0) ++colour;
    colours[column] = colour;
  }
  return colours;
}

}  // namespace wishbone
