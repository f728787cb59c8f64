#pragma once

#include <cmath>

namespace wishbone {

/// Stumpff functions c_n(s) = sum_k (-s)^k/(2k + n)!, here for s >= 0: with x = sqrt(s)
///     c_0 = cos x,  c_1 = sin(x)/x,  c_2 = (1 - cos x)/s,  c_3 = (x - sin x)/x^3,   s c_(n+2) = 1/n! - c_n.
/// They carry the exponential of a rotation vector smoothly through the angle zero. Derivatives by s:
///     c_n' = (n c_(n+2) - c_(n+1))/2.
template <class T>
struct Stumpff {
  T c1, c2, c3, c4, c5;

  explicit Stumpff(const T& s) {
    if (s < 1.0) {
      c4 = series(s, 4);
      c5 = series(s, 5);
      c2 = 0.5 - s * c4;
      c3 = 1.0 / 6 - s * c5;
      c1 = 1.0 - s * c3;
    } else {
      using std::cos;
      using std::sin;
      using std::sqrt;
      const T x = sqrt(s);
      c1 = sin(x) / x;
      c2 = (1.0 - cos(x)) / s;
      c3 = (1.0 - c1) / s;
      c4 = (0.5 - c2) / s;
      c5 = (1.0 / 6 - c3) / s;
    }
  }
  T c2_rate() const { return c4 - 0.5 * c3; }          ///< dc_2/ds
  T c3_rate() const { return 0.5 * (3.0 * c5 - c4); }  ///< dc_3/ds

 private:
  // 1/n! (1 - s/((n+1)(n+2)) (1 - s/((n+3)(n+4)) (1 - ...))); ten factors leave less than 1e-20 below s = 1
  static T series(const T& s, int n) {
    constexpr int kTerms = 10;
    T sum(1.0);
    for (int k = kTerms; k > 0; --k) sum = 1.0 - s * sum / ((n + 2.0 * k - 1) * (n + 2.0 * k));
    return sum / std::tgamma(n + 1.0);
  }
};

}  // namespace wishbone
