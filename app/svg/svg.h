#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace wishbone {

/// A number as pictures write it: two decimals at most, no trailing zeros, no exponent, no "-0". Throws
/// NumericsError when it is not finite.
std::string svg_number(double value);

/// Value of an attribute.
struct SvgValue {
  std::string text;

  template <class Number>
  requires std::is_arithmetic_v<Number> SvgValue(Number number)
      : text(svg_number(static_cast<double>(number))) {}
  SvgValue(const char* value) : text(value) {}
  SvgValue(std::string value) : text(std::move(value)) {}
};

using SvgAttributes = std::vector<std::pair<std::string_view, SvgValue>>;

/// An element of a vector graphic (W3C, Scalable Vector Graphics 1.1). Text and attributes are escaped; equal
/// calls give equal bytes.
class SvgElement {
 public:
  explicit SvgElement(std::string name, const SvgAttributes& attributes = {});

  SvgElement& add(const SvgElement& child);
  SvgElement& add_text(std::string_view text);
  bool empty() const { return content_.empty(); }

  std::string markup() const;

 private:
  std::string name_;
  std::string attributes_;  ///< as they stand in the tag
  std::string content_;
};

/// Points on paper: x to the right, y downwards, in pixels.
using Point = Eigen::Vector2d;

/// A picture of that size, to stand by itself in a file or inside a page; `title` is for readers that cannot
/// see it.
SvgElement svg_picture(double width, double height, const std::string& title);
SvgElement svg_group(const SvgAttributes& attributes = {});
SvgElement svg_line(const Point& from, const Point& to, const SvgAttributes& attributes = {});
SvgElement svg_rectangle(const Point& corner, const Point& size, const SvgAttributes& attributes = {});
SvgElement svg_circle(const Point& centre, double radius, const SvgAttributes& attributes = {});
SvgElement svg_path(const std::string& data, const SvgAttributes& attributes = {});
SvgElement svg_text(const Point& at, std::string_view text, const SvgAttributes& attributes = {});

/// Path data: "M x y L x y ..." through the points.
std::string path_through(const std::vector<Point>& points);

}  // namespace wishbone
