#include "solver/initial_speeds.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "solver/articulated_body.h"
#include "solver/closure_dynamics.h"
#include "solver/closure_rank.h"
#include "solver/kinematics.h"

namespace wishbone {
namespace {

constexpr double kExact = 1e-9;           // relative deviation of a given speed that is rounding
constexpr double kSpeedRounding = 1e-12;  // where all are zero [m/s, rad/s]
constexpr double kFewDigits = 1e-3;       // relative deviation that stands for digits left out
constexpr double kTakesPart = 1e-6;       // of a row in another one

/// Rows u . w = b met by the smallest w, one after the other: U = Q R, R^T y = b, w = Q y.
class Staircase {
 public:
  Staircase(Eigen::Index size, Eigen::Index most) : Q_(size, most), R_(MatrixX::Zero(most, most)), y_(most) {}

  /// What a row finds: b - u . w of the rows before, and by what that is to be measured.
  struct Found {
    bool independent = false;
    double open = 0, scale = 0;
    VectorX projection;  ///< Q^T u
  };
  Found add(VectorX u, double b, double length) {
    Found found{false, b, std::abs(b), VectorX::Zero(n_)};
    for (int pass = 0; pass < 2; ++pass) {
      const VectorX h = Q_.leftCols(n_).transpose() * u;
      u.noalias() -= Q_.leftCols(n_) * h;
      found.projection += h;
    }
    const VectorX terms = found.projection.cwiseProduct(y_.head(n_));
    found.open -= terms.sum();
    found.scale += terms.cwiseAbs().sum();
    found.independent = n_ < Q_.cols() && u.norm() > kRankTolerance * length;
    if (found.independent) step(u, found);
    return found;
  }

  VectorX solution() const { return Q_.leftCols(n_) * y_.head(n_); }

  /// The factors with which the independent rows make up a dependent one.
  VectorX combination(const Found& found) const {
    return R_.topLeftCorner(n_, n_).triangularView<Eigen::Upper>().solve(found.projection);
  }

 private:
  void step(const VectorX& left, const Found& found) {
    Q_.col(n_) = left.normalized();
    R_.col(n_).head(n_) = found.projection;
    R_(n_, n_) = left.norm();
    y_[n_] = found.open / left.norm();
    ++n_;
  }

  MatrixX Q_, R_;
  VectorX y_;
  Eigen::Index n_ = 0;
};

double speed_of(const GivenSpeed& given, const State& state, const Workspace& ws) {
  if (given.of == GivenSpeed::Of::speed) return state.v[given.index];
  const MarkerState &A = ws.markers[given.A], &B = ws.markers[given.B];
  Vector6 W_A, W_B;
  given.wrenches(A, B, W_A, W_B);
  return W_A.dot(spatial(A.w_WM, A.v_WM)) + W_B.dot(spatial(B.w_WM, B.v_WM));
}

/// Calls f(j) for the speeds j that move a marker.
template <class F>
void for_each_speed_of(const System& system, MarkerIndex marker, F f) {
  for (int i = system.markers[marker].body; i >= 0; i = system.bodies[i].parent) {
    const TreeBody& body = system.bodies[i];
    for (int j = 0; j < body.nv; ++j) f(body.v_start + j);
    if (body.flexible < 0) continue;
    const FlexibleBody& flexible = system.flexible[body.flexible];
    for (int j = 0; j < flexible.modal.mode_count(); ++j) f(flexible.z_rate_start + j);
  }
}

void move(const System& system, const State& state, Workspace& ws) {
  update_velocities<double>(system, state.t, state.q, state.v, ws);
  update_markers<double>(system, ws);
}

/// The row g of a given speed: of what markers measure, by moving one speed after the other.
VectorX row_of(const System& system, const GivenSpeed& given, const State& state, Workspace& ws) {
  VectorX g = VectorX::Zero(system.nv);
  if (given.of == GivenSpeed::Of::speed) {
    g[given.index] = 1;
    return g;
  }
  State probe = state;
  probe.v.setZero();
  move(system, probe, ws);
  const double drift = speed_of(given, probe, ws);
  for (const MarkerIndex marker : {given.A, given.B})
    for_each_speed_of(system, marker, [&](int j) {
      probe.v[j] = 1;
      move(system, probe, ws);
      g[j] = speed_of(given, probe, ws) - drift;
      probe.v[j] = 0;
    });
  move(system, state, ws);
  return g;
}

const char* unit_of(const GivenSpeed& given) {
  return given.is_angle ? "rad/s" : "m/s";
}

std::string shown(double speed, const GivenSpeed& given) {
  return fmt::format("{:.6g} {}", speed, unit_of(given));
}

/// A speed that is given and follows from other rows as well.
struct Conflict {
  const GivenSpeed& given;
  double possible;
  std::vector<std::string> others;  // given speeds and motions that it follows from
};

Diagnostic describe(const Conflict& conflict) {
  const GivenSpeed& given = conflict.given;
  const std::string value = shown(conflict.possible, given);
  const std::string follows = conflict.others.empty()
                                  ? "the joints leave it"
                                  : fmt::format("{} leave it", fmt::join(conflict.others, ", "));
  return {given.where.empty() ? given.name : given.where, "",
          fmt::format("{} is given {}, {} {}", given.name, shown(given.value, given), follows, value),
          conflict.others.empty()
              ? fmt::format(
                    "leave this speed out, or give {}; 'wishbone plan' says what closes the mechanism", value)
              : fmt::format("leave one of these speeds out, or give {}", value)};
}

[[noreturn]] void refuse(const Conflict& conflict) {
  Diagnostic diagnostic = describe(conflict);
  diagnostic.what = conflict.others.empty() ? "the joints do not allow this initial speed"
                                            : "initial speeds contradict each other";
  throw InputError(std::move(diagnostic));
}

Diagnostic adjusted(const Conflict& conflict) {
  Diagnostic diagnostic = describe(conflict);
  diagnostic.what = "the run starts with another speed than is given";
  diagnostic.remedy = fmt::format("give more digits, or leave it out");
  return diagnostic;
}

/// Names of the motions and given speeds among the rows that make up a dependent one.
std::vector<std::string> participants(const System& system, const std::vector<int>& kept,
                                      const std::vector<const GivenSpeed*>& before, const VectorX& factors) {
  const double least = kTakesPart * factors.cwiseAbs().maxCoeff();
  std::vector<std::string> names;
  for (const Closure& closure : system.closures) {
    if (!is_driven(closure.joint)) continue;
    const auto row = std::find(kept.begin(), kept.end(), closure.row_start);
    if (row != kept.end() && std::abs(factors[row - kept.begin()]) > least)
      names.push_back("the motion of '" + closure.name + "'");
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (std::abs(factors[static_cast<Eigen::Index>(kept.size() + i)]) > least)
      names.push_back(before[i]->name + " (" + shown(before[i]->value, *before[i]) + ")");
  return names;
}

}  // namespace

bool has_speeds(const std::vector<GivenSpeed>& given, const State& state, const Workspace& ws) {
  return std::ranges::all_of(given, [&](const GivenSpeed& g) {
    return std::abs(speed_of(g, state, ws) - g.value) <= kExact * std::abs(g.value);
  });
}

void solve_given_speeds(const System& system, const std::vector<GivenSpeed>& given_speeds, State& state,
                        Workspace& ws, Warnings& warnings) {
  const std::vector<int>& kept = ws.closure.kept;
  const auto n_kept = static_cast<Eigen::Index>(kept.size());
  Staircase rows(system.nv,
                 std::min<Eigen::Index>(system.nv, n_kept + static_cast<Eigen::Index>(given_speeds.size())));
  calc_closure_factor(system, ws);
  for (Eigen::Index i = 0; i < n_kept; ++i) rows.add(ws.closure.U.col(i), -ws.Phi_rate[kept[i]], 0);

  double largest = 0;
  for (const GivenSpeed& given : given_speeds) largest = std::max(largest, std::abs(given.value));
  const double least_length = 1 / std::sqrt(system.total_mass());
  std::vector<const GivenSpeed*> before;
  for (const GivenSpeed& given : given_speeds) {
    ws.hinge_force = row_of(system, given, state, ws);
    calc_bias(system, Terms::hinge_forces, ws);
    const VectorX u = ws.e;
    const double speed = speed_of(given, state, ws);
    const auto found = rows.add(u, given.value - speed, std::max(u.norm(), least_length));
    if (found.independent) {
      before.push_back(&given);
      continue;
    }
    const double scale = std::max(std::abs(given.value), std::abs(speed)) + found.scale;
    if (std::abs(found.open) <= kExact * (scale + largest) + kSpeedRounding) continue;
    const VectorX factors = rows.combination(found);
    const Conflict conflict{given, given.value - found.open, participants(system, kept, before, factors)};
    double size = std::abs(given.value);
    for (std::size_t i = 0; i < before.size(); ++i)
      size += std::abs(factors[n_kept + static_cast<Eigen::Index>(i)] * before[i]->value);
    if (std::abs(found.open) > kFewDigits * size) refuse(conflict);
    warnings.push_back(adjusted(conflict));
  }
  ws.e = rows.solution();
  calc_accelerations(system, Terms::hinge_forces, ws, ws.displacement);
  state.v += ws.displacement;
}

}  // namespace wishbone
