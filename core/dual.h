#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace wishbone {

/// A number with its derivatives along kDirections directions at once (forward-mode differentiation): a + sum b_i e_i
/// with e_i e_j = 0. Every operation follows the rules of calculus, so derivatives are exact to rounding.
struct Dual {
  static constexpr int kDirections = 8;
  using Derivatives = std::array<double, kDirections>;

  double value = 0;
  Derivatives d{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // implicit: a number is constant along every direction

  Dual& operator+=(const Dual& b) {
    value += b.value;
    for (int i = 0; i < kDirections; ++i) d[i] += b.d[i];
    return *this;
  }
  Dual& operator-=(const Dual& b) {
    value -= b.value;
    for (int i = 0; i < kDirections; ++i) d[i] -= b.d[i];
    return *this;
  }
  Dual& operator*=(const Dual& b) {
    for (int i = 0; i < kDirections; ++i) d[i] = d[i] * b.value + value * b.d[i];
    value *= b.value;
    return *this;
  }
  Dual& operator/=(const Dual& b) {
    const double r = 1 / b.value;
    value *= r;
    for (int i = 0; i < kDirections; ++i) d[i] = (d[i] - value * b.d[i]) * r;
    return *this;
  }
};

/// f(a) given f and f' at a: (f o a)' = f' a'.
inline Dual chain(const Dual& a, double f, double f1) {
  Dual r(f);
  for (int i = 0; i < Dual::kDirections; ++i) r.d[i] = f1 * a.d[i];
  return r;
}
/// f(a, b) given f and its two partial derivatives.
inline Dual chain(const Dual& a, const Dual& b, double f, double f_a, double f_b) {
  Dual r(f);
  for (int i = 0; i < Dual::kDirections; ++i) r.d[i] = f_a * a.d[i] + f_b * b.d[i];
  return r;
}

inline Dual operator-(const Dual& a) {
  return chain(a, -a.value, -1);
}
inline Dual operator+(Dual a, const Dual& b) {
  return a += b;
}
inline Dual operator-(Dual a, const Dual& b) {
  return a -= b;
}
inline Dual operator*(Dual a, const Dual& b) {
  return a *= b;
}
inline Dual operator/(Dual a, const Dual& b) {
  return a /= b;
}
inline Dual operator+(double a, Dual b) {
  b.value += a;
  return b;
}
inline Dual operator+(Dual a, double b) {
  a.value += b;
  return a;
}
inline Dual operator-(double a, const Dual& b) {
  return chain(b, a - b.value, -1);
}
inline Dual operator-(Dual a, double b) {
  a.value -= b;
  return a;
}
inline Dual operator*(double a, const Dual& b) {
  return chain(b, a * b.value, a);
}
inline Dual operator*(const Dual& a, double b) {
  return b * a;
}
inline Dual operator/(const Dual& a, double b) {
  return (1 / b) * a;
}
inline Dual operator/(double a, const Dual& b) {
  const double f = a / b.value;
  return chain(b, f, -f / b.value);
}

// Comparisons are those of the values: a branch is taken as the value takes it.
inline bool operator<(const Dual& a, const Dual& b) {
  return a.value < b.value;
}
inline bool operator>(const Dual& a, const Dual& b) {
  return a.value > b.value;
}
inline bool operator<=(const Dual& a, const Dual& b) {
  return a.value <= b.value;
}
inline bool operator>=(const Dual& a, const Dual& b) {
  return a.value >= b.value;
}
inline bool operator==(const Dual& a, const Dual& b) {
  return a.value == b.value;
}
inline bool operator!=(const Dual& a, const Dual& b) {
  return a.value != b.value;
}

/// At the corner sqrt(0) the derivative is taken as zero.
inline Dual sqrt(const Dual& a) {
  const double f = std::sqrt(a.value);
  return chain(a, f, f > 0 ? 0.5 / f : 0.0);
}
/// At the corner (0, 0) the derivative is taken as zero.
inline Dual hypot(const Dual& a, const Dual& b) {
  const double f = std::hypot(a.value, b.value);
  const double r = f > 0 ? 1 / f : 0.0;
  return chain(a, b, f, a.value * r, b.value * r);
}
inline Dual sin(const Dual& a) {
  return chain(a, std::sin(a.value), std::cos(a.value));
}
inline Dual cos(const Dual& a) {
  return chain(a, std::cos(a.value), -std::sin(a.value));
}
inline Dual tan(const Dual& a) {
  const double f = std::tan(a.value);
  return chain(a, f, 1 + f * f);
}
inline Dual asin(const Dual& a) {
  return chain(a, std::asin(a.value), 1 / std::sqrt(1 - a.value * a.value));
}
inline Dual acos(const Dual& a) {
  return chain(a, std::acos(a.value), -1 / std::sqrt(1 - a.value * a.value));
}
inline Dual atan(const Dual& a) {
  return chain(a, std::atan(a.value), 1 / (1 + a.value * a.value));
}
inline Dual atan2(const Dual& y, const Dual& x) {
  const double rr = x.value * x.value + y.value * y.value;
  return chain(y, x, std::atan2(y.value, x.value), x.value / rr, -y.value / rr);
}
inline Dual exp(const Dual& a) {
  const double f = std::exp(a.value);
  return chain(a, f, f);
}
inline Dual log(const Dual& a) {
  return chain(a, std::log(a.value), 1 / a.value);
}
inline Dual log10(const Dual& a) {
  return chain(a, std::log10(a.value), 1 / (std::numbers::ln10 * a.value));
}
inline Dual sinh(const Dual& a) {
  return chain(a, std::sinh(a.value), std::cosh(a.value));
}
inline Dual cosh(const Dual& a) {
  return chain(a, std::cosh(a.value), std::sinh(a.value));
}
inline Dual tanh(const Dual& a) {
  const double f = std::tanh(a.value);
  return chain(a, f, 1 - f * f);
}
/// At the corner 0^n, n < 1, the derivative is taken as zero.
inline Dual pow(const Dual& a, double n) {
  const bool is_flat = n == 0 || (a.value == 0 && n < 1);
  return chain(a, std::pow(a.value, n), is_flat ? 0.0 : n * std::pow(a.value, n - 1));
}
/// a^b; with a constant exponent defined for a < 0 too.
inline Dual pow(const Dual& a, const Dual& b) {
  if (b.d == Dual::Derivatives{}) return pow(a, b.value);
  const double f = std::pow(a.value, b.value);
  const double f_b = f == 0 ? 0 : f * std::log(a.value);
  return chain(a, b, f, b.value * std::pow(a.value, b.value - 1), f_b);
}
inline Dual abs(const Dual& a) {
  return a.value < 0 ? -a : a;
}

/// x, but not above or below a limit.
template <class T>
T at_most(const T& x, double limit) {
  return x > limit ? T(limit) : x;
}
template <class T>
T at_least(const T& x, double limit) {
  return x < limit ? T(limit) : x;
}

/// The number without its derivatives.
inline double value_of(double a) {
  return a;
}
inline double value_of(const Dual& a) {
  return a.value;
}

}  // namespace wishbone

template <>
struct Eigen::NumTraits<wishbone::Dual> : Eigen::NumTraits<double> {
  using Real = wishbone::Dual;
  using NonInteger = wishbone::Dual;
  using Nested = wishbone::Dual;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 4,
    AddCost = 8,
    MulCost = 16
  };
};
template <class Op>
struct Eigen::ScalarBinaryOpTraits<wishbone::Dual, double, Op> {
  using ReturnType = wishbone::Dual;
};
template <class Op>
struct Eigen::ScalarBinaryOpTraits<double, wishbone::Dual, Op> {
  using ReturnType = wishbone::Dual;
};
