#include "joints/motion_jump.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace wishbone {
namespace {

constexpr int kIntervals = 4096;
constexpr int kMostSearches = 64;  // of a motion that is steep everywhere

/// One end of an interval.
struct End {
  double t = 0;
  MotionValue u;
};

End end_at(const Motion& motion, double t) {
  return {t, motion.at(t)};
}

/// What the mean of the ends leaves unexplained of an increment of the position, or of the rate.
double position_defect(const End& a, const End& b) {
  const double h = b.t - a.t;
  return std::abs(b.u.position - a.u.position - 0.5 * h * (a.u.rate + b.u.rate) +
                  h * h / 12 * (b.u.acceleration - a.u.acceleration));
}
double rate_defect(const End& a, const End& b) {
  return std::abs(b.u.rate - a.u.rate - 0.5 * (b.t - a.t) * (a.u.acceleration + b.u.acceleration));
}

/// Narrows [a, b] towards the larger defect until its ends are neighbouring numbers.
template <class Defect>
void narrow(const Motion& motion, End& a, End& b, Defect defect) {
  for (;;) {
    const double middle = 0.5 * (a.t + b.t);
    if (!(a.t < middle && middle < b.t)) return;
    const End m = end_at(motion, middle);
    (defect(a, m) > defect(m, b) ? b : a) = m;
  }
}

std::vector<double> grid(const Motion& motion, double duration) {
  std::vector<double> times = motion.switch_times();
  std::erase_if(times, [&](double t) { return !(t > 0 && t < duration); });
  // just beside each place, so that a value that holds at one time only is found as well
  const std::size_t places = times.size();
  for (std::size_t i = 0; i < places; ++i)
    for (const double towards : {0.0, duration}) times.push_back(std::nextafter(times[i], towards));
  for (int i = 0; i <= kIntervals; ++i) times.push_back(duration * i / kIntervals);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// One quantity of a motion, position or rate: its value, its slope and its defect.
struct Quantity {
  double (*value)(const MotionValue&);
  double (*slope)(const MotionValue&);
  double (*defect)(const End&, const End&);
};
constexpr Quantity kPosition{[](const MotionValue& u) { return u.position; },
                             [](const MotionValue& u) { return u.rate; }, position_defect};
constexpr Quantity kRateOf{[](const MotionValue& u) { return u.rate; },
                           [](const MotionValue& u) { return u.acceleration; }, rate_defect};

class Search {
 public:
  Search(const Motion& motion, const Quantity& quantity, double rtol, double atol)
      : motion_(motion), quantity_(quantity), rtol_(rtol), atol_(atol) {}

  void look(End a, End b) {
    if (found || searches_ >= kMostSearches) return;
    if (!(quantity_.defect(a, b) > tolerance(a, b))) return;
    ++searches_;
    narrow(motion_, a, b, quantity_.defect);
    const double before = quantity_.value(a.u), after = quantity_.value(b.u);
    const double steepest = std::max(std::abs(quantity_.slope(a.u)), std::abs(quantity_.slope(b.u)));
    const double jump = std::abs(after - before);
    if (jump > tolerance(a, b) && jump > 2 * steepest * (b.t - a.t)) found = MotionJump{b.t, before, after};
  }

  std::optional<MotionJump> found;

 private:
  double tolerance(const End& a, const End& b) const {
    constexpr double kRounding = 1e-12;
    const double size = std::max(std::abs(quantity_.value(a.u)), std::abs(quantity_.value(b.u)));
    return atol_ + std::max(rtol_, kRounding) * size;
  }

  const Motion& motion_;
  const Quantity& quantity_;
  double rtol_, atol_;
  int searches_ = 0;
};

}  // namespace

MotionJumps find_jumps(const Motion& motion, double duration, double rtol, double atol) {
  if (!motion.may_jump()) return {};
  Search position(motion, kPosition, rtol, atol), rate(motion, kRateOf, rtol, atol);
  try {
    const std::vector<double> times = grid(motion, duration);
    End a = end_at(motion, times.front());
    for (std::size_t i = 1; i < times.size(); ++i) {
      const End b = end_at(motion, times[i]);
      position.look(a, b);
      rate.look(a, b);
      a = b;
    }
  } catch (const NumericsError&) {
    // undefined there: the run will say so when it comes to this time
  }
  return {position.found, rate.found};
}

}  // namespace wishbone
