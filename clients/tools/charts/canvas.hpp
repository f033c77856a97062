#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// Pictures of measured values, drawn once for every form they are written in.
namespace dripline::charts {

/// In units of 1/96 inch from the top left.
struct Point {
  double x = 0, y = 0;
};
struct Box {
  double left = 0, top = 0, width = 0, height = 0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

struct Color {
  std::uint8_t red = 0, green = 0, blue = 0;
};
inline constexpr Color kInk{26, 26, 26};  ///< texts and axes
inline constexpr Color kGrid{225, 225, 225};
inline constexpr Color kData{31, 78, 140};
inline constexpr Color kCenter{46, 125, 50};
inline constexpr Color kLimit{179, 38, 30};
inline constexpr Color kFill{188, 208, 232};
inline constexpr Color kWhite{255, 255, 255};

enum class Dash : std::uint8_t { Solid, Dashed, Dotted };
struct Pen {
  Color color = kInk;
  double width = 1;
  Dash dash = Dash::Solid;
};

enum class Anchor : std::uint8_t { Start, Middle, End };
struct TextStyle {
  double size = 12;
  Anchor anchor = Anchor::Start;
  bool is_bold = false;
  bool is_upward = false;  ///< read from the right
  Color color = kInk;
};

/// Where a picture is drawn; the ground is white. One per format.
class Canvas {
 public:
  virtual ~Canvas() = default;
  virtual double width() const = 0;
  virtual double height() const = 0;
  virtual void polyline(std::span<const Point> points, const Pen& pen) = 0;
  /// Closed and filled.
  virtual void polygon(std::span<const Point> points, Color fill) = 0;
  virtual void circle(Point center, double radius, Color fill, const Pen& pen) = 0;
  /// `at` is on the base line.
  virtual void text(Point at, std::string_view text, const TextStyle& style) = 0;

  void line(Point from, Point to, const Pen& pen) {
    const Point points[]{from, to};
    polyline(points, pen);
  }
  void rectangle(const Box& box, Color fill) {
    const Point corners[]{{box.left, box.top},
                          {box.right(), box.top},
                          {box.right(), box.bottom()},
                          {box.left, box.bottom()}};
    polygon(corners, fill);
  }
};

/// About what a text takes: the widest of the usual fonts without serifs. For margins.
inline double text_width(std::string_view text, double size) {
  return 0.62 * size * static_cast<double>(text.size());
}

}  // namespace dripline::charts
