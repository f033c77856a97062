#include "clients/tools/charts/svg_canvas.hpp"

#include <fmt/format.h>
#include <iterator>

#include "clients/tools/charts/text.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::charts {
namespace {

/// Two decimals are 1/9600 inch; zeros at the end go.
std::string number(double value) {
  return decimal_text(value, 2);
}

std::string hex(Color color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue);
}

std::string stroke(const Pen& pen) {
  std::string text =
      fmt::format("stroke=\"{}\" stroke-width=\"{}\"", hex(pen.color), number(pen.width));
  if (pen.dash == Dash::Dashed) text += " stroke-dasharray=\"6 4\"";
  if (pen.dash == Dash::Dotted) text += " stroke-dasharray=\"2 3\"";
  return text;
}

std::string list(std::span<const Point> points) {
  std::string text;
  for (const Point& point : points) {
    if (!text.empty()) text += ' ';
    text += number(point.x) + ',' + number(point.y);
  }
  return text;
}

}  // namespace

SvgCanvas::SvgCanvas(double width, double height, std::string_view title)
    : width_(width), height_(height) {
  svg_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "role=\"img\" font-family=\"'DejaVu Sans', Verdana, Arial, "
      "sans-serif\">\n<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
      number(width), number(height), xml_text(title));
}

void SvgCanvas::polyline(std::span<const Point> points, const Pen& pen) {
  if (points.size() < 2) return;
  fmt::format_to(std::back_inserter(svg_),
                 "<polyline points=\"{}\" fill=\"none\" {} stroke-linejoin=\"round\"/>\n",
                 list(points), stroke(pen));
}

void SvgCanvas::polygon(std::span<const Point> points, Color fill) {
  fmt::format_to(std::back_inserter(svg_), "<polygon points=\"{}\" fill=\"{}\"/>\n", list(points),
                 hex(fill));
}

void SvgCanvas::circle(Point center, double radius, Color fill, const Pen& pen) {
  fmt::format_to(std::back_inserter(svg_),
                 "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\" {}/>\n", number(center.x),
                 number(center.y), number(radius), hex(fill), stroke(pen));
}

void SvgCanvas::text(Point at, std::string_view text, const TextStyle& style) {
  constexpr std::string_view kAnchors[]{"start", "middle", "end"};
  std::string attributes =
      fmt::format("x=\"{0}\" y=\"{1}\" font-size=\"{2}\" fill=\"{3}\"", number(at.x), number(at.y),
                  number(style.size), hex(style.color));
  if (style.anchor != Anchor::Start) {
    attributes +=
        fmt::format(" text-anchor=\"{}\"", kAnchors[static_cast<std::size_t>(style.anchor)]);
  }
  if (style.is_bold) attributes += " font-weight=\"bold\"";
  if (style.is_upward) {
    attributes += fmt::format(" transform=\"rotate(-90 {} {})\"", number(at.x), number(at.y));
  }
  fmt::format_to(std::back_inserter(svg_), "<text {}>{}</text>\n", attributes, xml_text(text));
}

std::string SvgCanvas::finish() && {
  svg_ += "</svg>\n";
  return std::move(svg_);
}

}  // namespace dripline::charts
