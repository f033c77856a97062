#pragma once

#include <string>

#include "clients/tools/charts/canvas.hpp"

namespace dripline::charts {

/// A picture as SVG 1.1: texts stay texts, so that they can be searched and read aloud; no script,
/// no style sheet, nothing from outside, so that a page may embed it.
class SvgCanvas final : public Canvas {
 public:
  /// `title` is what a reader without the picture gets.
  SvgCanvas(double width, double height, std::string_view title);

  double width() const override { return width_; }
  double height() const override { return height_; }
  void polyline(std::span<const Point> points, const Pen& pen) override;
  void polygon(std::span<const Point> points, Color fill) override;
  void circle(Point center, double radius, Color fill, const Pen& pen) override;
  void text(Point at, std::string_view text, const TextStyle& style) override;

  /// The whole file; nothing can be drawn afterwards.
  std::string finish() &&;

 private:
  double width_, height_;
  std::string svg_;
};

}  // namespace dripline::charts
