#pragma once

#include <string_view>
#include <vector>

namespace wishbone {

/// A function given by points (x_i, y_i), x ascending, with values for double, Jet2 and Dual.
///
/// Linear: straight between the points; derivatives are those of the piece at hand. Spline: the cubic through
/// all points that is twice continuously differentiable, whose first two pieces are one cubic, and whose last
/// two are ("not-a-knot": no curvature is invented at the ends, and samples of a cubic give that cubic) [de
/// Boor, A Practical Guide to Splines, ch. IV]. Two points give a line, three a parabola. A spline overshoots
/// beside corners: those are for linear tables.
///
/// Outside the points the value of the nearest end is held.
class Table {
 public:
  enum class Interpolation { linear, spline };

  /// @throws InputError naming `element` unless there are two points or more, as many x as y, all finite, x
  ///   strictly ascending, and not so unevenly spaced that a derivative overflows
  Table(std::string_view element, std::vector<double> x, const std::vector<double>& y,
        Interpolation interpolation);

  template <class T>
  T operator()(const T& x) const;

  double first() const { return x_.front(); }
  double last() const { return x_.back(); }
  Interpolation interpolation() const { return interpolation_; }

  /// Where the slope jumps, ascending: at the ends, and where a linear table bends.
  std::vector<double> kinks() const;

 private:
  /// y + u (b + u (c + u d)), u = x - x_i, from x_i on.
  struct Piece {
    double y = 0, b = 0, c = 0, d = 0;
  };

  void join_lines(const std::vector<double>& y);
  void join_cubics(const std::vector<double>& y);

  std::vector<double> x_;
  std::vector<Piece> pieces_;  ///< one less than points
  double y_last_ = 0;
  Interpolation interpolation_;
};

}  // namespace wishbone
