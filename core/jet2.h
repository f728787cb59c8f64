#pragma once

#include <cmath>

namespace wishbone {

/// A function of one variable carried with its first two derivatives: exact to rounding, by the rules of
/// calculus.
struct Jet2 {
  double value = 0;
  double d1 = 0;
  double d2 = 0;

  Jet2() = default;
  Jet2(double constant) : value(constant) {}  // implicit: a number is a constant function
  Jet2(double v, double first, double second) : value(v), d1(first), d2(second) {}

  /// The variable itself, at t.
  static Jet2 variable(double t) { return {t, 1.0, 0.0}; }
};

/// f(g) given f, f', f'' at g: (f o g)' = f' g', (f o g)'' = f'' g'^2 + f' g''.
inline Jet2 chain(const Jet2& g, double f, double f1, double f2) {
  return {f, f1 * g.d1, f2 * g.d1 * g.d1 + f1 * g.d2};
}

inline Jet2 operator-(const Jet2& a) {
  return {-a.value, -a.d1, -a.d2};
}
inline Jet2 operator+(const Jet2& a, const Jet2& b) {
  return {a.value + b.value, a.d1 + b.d1, a.d2 + b.d2};
}
inline Jet2 operator-(const Jet2& a, const Jet2& b) {
  return a + (-b);
}
inline Jet2 operator*(const Jet2& a, const Jet2& b) {
  return {a.value * b.value, a.d1 * b.value + a.value * b.d1,
          a.d2 * b.value + 2 * a.d1 * b.d1 + a.value * b.d2};
}
inline Jet2 inverse(const Jet2& a) {
  const double r = 1 / a.value;
  return chain(a, r, -r * r, 2 * r * r * r);
}
inline Jet2 operator/(const Jet2& a, const Jet2& b) {
  return a * inverse(b);
}

inline Jet2 tan(const Jet2& a) {
  const double t = std::tan(a.value);
  const double t1 = 1 + t * t;
  return chain(a, t, t1, 2 * t * t1);
}
inline Jet2 atan(const Jet2& a) {
  const double t1 = 1 / (1 + a.value * a.value);
  return chain(a, std::atan(a.value), t1, -2 * a.value * t1 * t1);
}

}  // namespace wishbone
