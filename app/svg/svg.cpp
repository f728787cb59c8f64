#include "app/svg/svg.h"

#include <fmt/core.h>

#include <cmath>

#include "app/markup.h"
#include "core/error.h"

namespace wishbone {
namespace {

/// Attributes of the caller behind those that the shape needs.
SvgAttributes joined(SvgAttributes own, const SvgAttributes& more) {
  own.insert(own.end(), more.begin(), more.end());
  return own;
}

/// Text without the control characters that XML forbids.
std::string printable(std::string_view text) {
  std::string out = escape_markup(text);
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return out;
}

}  // namespace

std::string svg_number(double value) {
  if (!std::isfinite(value))
    throw NumericsError({"picture", "a length in a picture is not a finite number", fmt::format("{}", value),
                         "check the numbers that are drawn"});
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

SvgElement::SvgElement(std::string name, const SvgAttributes& attributes) : name_(std::move(name)) {
  for (const auto& [key, value] : attributes) {
    attributes_ += ' ';
    attributes_ += key;
    attributes_ += "=\"" + printable(value.text) + '"';
  }
}

SvgElement& SvgElement::add(const SvgElement& child) {
  content_ += child.markup() + '\n';
  return *this;
}

SvgElement& SvgElement::add_text(std::string_view text) {
  content_ += printable(text);
  return *this;
}

std::string SvgElement::markup() const {
  const std::string tag = '<' + name_ + attributes_;
  return content_.empty() ? tag + "/>" : tag + '>' + content_ + "</" + name_ + '>';
}

SvgElement svg_picture(double width, double height, const std::string& title) {
  SvgElement picture(
      "svg", {{"xmlns", "http://www.w3.org/2000/svg"},
              {"viewBox", "0 0 " + svg_number(width) + ' ' + svg_number(height)},
              {"width", width},
              {"height", height},
              {"role", "img"},
              {"font-family", "'Segoe UI', Roboto, 'Helvetica Neue', 'Liberation Sans', Arial, sans-serif"},
              {"font-size", 12},
              {"fill", "#1c2430"},
              {"style", "background:#fff"}});
  picture.add(SvgElement("title").add_text(title));
  return picture;
}

SvgElement svg_group(const SvgAttributes& attributes) {
  return SvgElement("g", attributes);
}

SvgElement svg_line(const Point& from, const Point& to, const SvgAttributes& attributes) {
  return SvgElement("line",
                    joined({{"x1", from.x()}, {"y1", from.y()}, {"x2", to.x()}, {"y2", to.y()}}, attributes));
}

SvgElement svg_rectangle(const Point& corner, const Point& size, const SvgAttributes& attributes) {
  return SvgElement(
      "rect",
      joined({{"x", corner.x()}, {"y", corner.y()}, {"width", size.x()}, {"height", size.y()}}, attributes));
}

SvgElement svg_circle(const Point& centre, double radius, const SvgAttributes& attributes) {
  return SvgElement("circle", joined({{"cx", centre.x()}, {"cy", centre.y()}, {"r", radius}}, attributes));
}

SvgElement svg_path(const std::string& data, const SvgAttributes& attributes) {
  return SvgElement("path", joined({{"d", data}}, attributes));
}

SvgElement svg_text(const Point& at, std::string_view text, const SvgAttributes& attributes) {
  SvgElement element("text", joined({{"x", at.x()}, {"y", at.y()}}, attributes));
  element.add_text(text);
  return element;
}

std::string path_through(const std::vector<Point>& points) {
  std::string data;
  for (const Point& p : points)
    data += (data.empty() ? 'M' : 'L') + svg_number(p.x()) + ' ' + svg_number(p.y());
  return data;
}

}  // namespace wishbone
