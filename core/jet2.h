#pragma once

#include <cmath>
#include <numbers>

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

/// f(g) given f, f', f'' at g: (f o g)' = f' g', (f o g)'' = f'' g'^2 + f' g''. A constant g gives a
/// constant, also where f has no slope.
inline Jet2 chain(const Jet2& g, double f, double f1, double f2) {
  if (g.d1 == 0 && g.d2 == 0) return f;
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

inline Jet2 sin(const Jet2& a) {
  const double s = std::sin(a.value);
  return chain(a, s, std::cos(a.value), -s);
}
inline Jet2 cos(const Jet2& a) {
  const double c = std::cos(a.value);
  return chain(a, c, -std::sin(a.value), -c);
}
inline Jet2 tan(const Jet2& a) {
  const double t = std::tan(a.value);
  const double t1 = 1 + t * t;
  return chain(a, t, t1, 2 * t * t1);
}
inline Jet2 asin(const Jet2& a) {
  const double f1 = 1 / std::sqrt(1 - a.value * a.value);
  return chain(a, std::asin(a.value), f1, a.value * f1 * f1 * f1);
}
inline Jet2 acos(const Jet2& a) {
  const double f1 = -1 / std::sqrt(1 - a.value * a.value);
  return chain(a, std::acos(a.value), f1, a.value * f1 * f1 * f1);
}
inline Jet2 atan(const Jet2& a) {
  const double t1 = 1 / (1 + a.value * a.value);
  return chain(a, std::atan(a.value), t1, -2 * a.value * t1 * t1);
}
inline Jet2 atan2(const Jet2& y, const Jet2& x) {
  // r^2 phi' = x y' - y x';   r^2 phi'' = x y'' - y x'' - 2 (x x' + y y') phi'
  const double rr = x.value * x.value + y.value * y.value;
  const double d1 = (x.value * y.d1 - y.value * x.d1) / rr;
  const double turning = 2 * (x.value * x.d1 + y.value * y.d1) * d1;
  return {std::atan2(y.value, x.value), d1, (x.value * y.d2 - y.value * x.d2 - turning) / rr};
}
inline Jet2 sinh(const Jet2& a) {
  const double f = std::sinh(a.value);
  return chain(a, f, std::cosh(a.value), f);
}
inline Jet2 cosh(const Jet2& a) {
  const double f = std::cosh(a.value);
  return chain(a, f, std::sinh(a.value), f);
}
inline Jet2 tanh(const Jet2& a) {
  const double f = std::tanh(a.value);
  const double f1 = 1 - f * f;
  return chain(a, f, f1, -2 * f * f1);
}
inline Jet2 exp(const Jet2& a) {
  const double f = std::exp(a.value);
  return chain(a, f, f, f);
}
inline Jet2 log(const Jet2& a) {
  const double r = 1 / a.value;
  return chain(a, std::log(a.value), r, -r * r);
}
inline Jet2 log10(const Jet2& a) {
  const double r = 1 / a.value;
  return chain(a, std::log10(a.value), r / std::numbers::ln10, -r * r / std::numbers::ln10);
}
inline Jet2 sqrt(const Jet2& a) {
  const double f = std::sqrt(a.value);
  return chain(a, f, 0.5 / f, -0.25 / (f * a.value));
}
inline Jet2 abs(const Jet2& a) {
  return a.value < 0 ? -a : a;
}
inline Jet2 pow(const Jet2& a, double n) {
  const double f1 = n == 0 ? 0 : n * std::pow(a.value, n - 1);
  const double f2 = n == 0 || n == 1 ? 0 : n * (n - 1) * std::pow(a.value, n - 2);
  return chain(a, std::pow(a.value, n), f1, f2);
}
/// a^b = exp(b ln a); with a constant exponent defined for a <= 0 too.
inline Jet2 pow(const Jet2& a, const Jet2& b) {
  if (b.d1 == 0 && b.d2 == 0) return pow(a, b.value);
  Jet2 power = exp(b * log(a));
  power.value = std::pow(a.value, b.value);
  return power;
}

/// The number without its derivatives.
inline double value_of(const Jet2& a) {
  return a.value;
}

}  // namespace wishbone
