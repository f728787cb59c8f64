#include "app/regression.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <optional>

#include "app/difference.h"
#include "app/text_table.h"

namespace wishbone {

namespace {

constexpr double kSameInstant = 1e-12;  // [s]

Verdict passed(const std::string& signal, const std::string& message) {
  return {signal, true, message, 0, 0, 0};
}
Verdict failed(const std::string& signal, const std::string& message) {
  return {signal, false, message, 0, 0, 0};
}

Verdict check_status(const ResultFile& fresh) {
  const std::string status = fresh.status();
  if (status == "complete") return passed("/meta/status", status);
  return failed("/meta/status", "the run is not complete: " + (status.empty() ? "no status" : status));
}

/// Rows of the new file at the instants of the base; those that it lacks are left out.
struct Alignment {
  std::vector<Eigen::Index> rows;
  std::optional<double> first_missing;
};

Alignment align(const VectorX& fresh, const VectorX& base) {
  Alignment alignment;
  Eigen::Index row = 0;
  for (const double time : base) {
    while (row < fresh.size() && fresh[row] < time - kSameInstant) ++row;
    if (row < fresh.size() && fresh[row] <= time + kSameInstant)
      alignment.rows.push_back(row++);  // the next row at the same time is the other side of a jump
    else if (!alignment.first_missing)
      alignment.first_missing = time;
  }
  return alignment;
}

Verdict check_time(const VectorX& fresh, const VectorX& base, const Alignment& alignment) {
  if (base.size() == 0) return failed("/time", "the base has no rows");
  if (fresh.size() == 0) return failed("/time", "the new file has no rows");
  const double fresh_end = fresh[fresh.size() - 1];
  const double base_end = base[base.size() - 1];
  const double base_step = base.size() > 1 ? base_end - base[base.size() - 2] : 0;
  if (fresh_end < base_end - kSameInstant || fresh_end > base_end + base_step + kSameInstant)
    return failed("/time", fmt::format("the new run ends at {} s, the base at {} s", fresh_end, base_end));
  if (alignment.first_missing)
    return failed(
        "/time",
        fmt::format(
            "the new file has no row at {} s, where the base has one; nothing is interpolated: record "
            "at the instants of the base, or make the base anew with `wishbone extract`",
            *alignment.first_missing));
  return passed("/time", fmt::format("{} instants up to {} s", base.size(), base_end));
}

/// First entry, row after row, that is not finite.
std::optional<Eigen::Index> first_bad_row(const MatrixX& values) {
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    if (!values.row(i).allFinite()) return i;
  return std::nullopt;
}

/// Both matrices hold finite numbers at the instants `time`.
Verdict check_values(const Signal& signal, const MatrixX& fresh, const MatrixX& base, const VectorX& time,
                     const Tolerance& tolerance) {
  Verdict verdict;
  verdict.signal = signal.path;
  if (base.size() == 0) return verdict;
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  verdict.difference = (fresh - base).cwiseAbs().maxCoeff(&row, &column);
  verdict.allowed = tolerance.absolute + tolerance.relative * base.cwiseAbs().maxCoeff();
  verdict.time = time[row];
  verdict.passed = verdict.difference <= verdict.allowed;
  const std::string name = channels(signal)[static_cast<std::size_t>(column)].name;
  verdict.message = fmt::format("{}differs by {} {} at {:.6g} s (new {:.9g}, base {:.9g}); {} allowed",
                                name.empty() ? "" : name + " ", brief(verdict.difference), signal.units,
                                verdict.time, fresh(row, column), base(row, column), brief(verdict.allowed));
  return verdict;
}

Verdict check_signal(const Signal& signal, const ResultFile& fresh, const ResultFile& base,
                     const Alignment& alignment, const Tolerance& tolerance) {
  const Signal* found = fresh.find(signal.path);
  if (!found) return failed(signal.path, "missing from the new file");
  if (found->shape != signal.shape)
    return failed(signal.path, fmt::format("rows of shape [{}], in the base [{}]",
                                           fmt::join(found->shape, ", "), fmt::join(signal.shape, ", ")));
  if (found->units != signal.units)
    return failed(signal.path, fmt::format("unit '{}', in the base '{}'", found->units, signal.units));
  if (found->frame != signal.frame)
    return failed(signal.path, fmt::format("frame '{}', in the base '{}'", found->frame, signal.frame));

  const MatrixX all = fresh.read(signal.path);
  if (const auto row = first_bad_row(all))
    return failed(signal.path, fmt::format("not finite at {} s", fresh.time()[*row]));
  const MatrixX expected = base.read(signal.path);
  if (const auto row = first_bad_row(expected))
    return failed(signal.path, fmt::format("the base is not finite at {} s", base.time()[*row]));
  if (alignment.first_missing) return failed(signal.path, "not compared: the instants differ (see /time)");
  return check_values(signal, all(alignment.rows, Eigen::all), expected, base.time(), tolerance);
}

}  // namespace

double Verdict::share() const {
  if (difference == 0) return 0;
  return allowed > 0 ? difference / allowed : std::numeric_limits<double>::infinity();
}

std::vector<Verdict> check(const ResultFile& fresh, const ResultFile& base, const Tolerances& tolerances) {
  const Alignment alignment = align(fresh.time(), base.time());
  std::vector<Verdict> verdicts{check_status(fresh), check_time(fresh.time(), base.time(), alignment)};
  for (const Signal& signal : base.signals())
    verdicts.push_back(check_signal(signal, fresh, base, alignment, tolerances.of(signal.path)));
  return verdicts;
}

}  // namespace wishbone
