#include "solver/failure_cause.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "solver/assembly.h"
#include "solver/largest_force.h"
#include "solver/progress_guard.h"

namespace wishbone {
namespace {

/// Joints and closures that move as prescribed at t, in the loops of a closure row.
std::vector<std::string> motions_against(const System& system, int row, double t) {
  const auto closure = std::ranges::find_if(
      system.closures, [&](const Closure& c) { return row >= c.row_start && row < c.row_start + c.rows; });
  const auto moves = [&](const Motion& motion) { return motion.at(t).rate != 0; };
  std::vector<std::string> names;
  for (const int i : closure->path)
    if (const auto* joint = std::get_if<PrescribedJoint>(&system.bodies[i].joint);
        joint != nullptr && moves(joint->motion))
      names.push_back("joint '" + system.bodies[i].joint_name + "'");
  for (const Closure& other : system.closures) {
    const Motion* motion = drive(other.joint);
    if (motion == nullptr || !moves(*motion)) continue;
    if (std::ranges::find_first_of(other.path, closure->path) != other.path.end())
      names.push_back("'" + other.name + "'");
  }
  return names;
}

}  // namespace

NumericsError explained(const NumericsError& error, const System& system, double t, const VectorX& x,
                        const Workspace& ws) {
  if (dynamic_cast<const StepsFailed*>(&error) == nullptr) return error;  // says itself what it comes from
  const int row = ws.closure.least_row;
  if (near_singular(ws) && row >= 0) {
    const std::vector<std::string> motions = motions_against(system, row, t);
    if (!motions.empty())
      return NumericsError(
          {fmt::format("t = {:.9g} s, {}", t, fmt::join(motions, ", ")),
           "the mechanism cannot follow the prescribed motion",
           fmt::format("at the end of its reach, {} closes no further", system.row_name(row)),
           "shorten the motion, or drive another joint where this one turns back"});
  }
  if (dynamic_cast<const HopelessRun*>(&error) == nullptr) return error;
  Diagnostic d = error.diagnostic();
  d.what += largest_force_text(system, t, x, ws);
  return NumericsError(d);
}

}  // namespace wishbone
