#include "clients/tools/graphics/turned_views.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dripline::graphics {
namespace {

constexpr Shade kHatch = 110, kSolid = 75, kEdge = 235, kBore = 30;
constexpr Shade kAxis = 130, kFeedLine = 255, kRapidLine = 240, kLimitLine = 160, kZoneLine = 120;
constexpr std::size_t kHatchStep = 9, kDash = 6, kAxisDash = 14;
constexpr double kMargin = 0.04;

/// From millimeters to pixels.
class Screen {
 public:
  Screen(const Frame& window, std::size_t width, bool is_upside_down)
      : window_(window),
        scale_(static_cast<double>(width) / (window.high.z - window.low.z)),
        sign_(is_upside_down ? -1 : 1) {}

  std::size_t height(std::size_t width) const {
    const double wanted = std::ceil((window_.high.x - window_.low.x) * scale_);
    return static_cast<std::size_t>(std::clamp(wanted, 16.0, 2.0 * static_cast<double>(width)));
  }
  double left(double z) const { return (z - window_.low.z) * scale_; }
  double top(double x) const {
    return sign_ > 0 ? (window_.high.x - x) * scale_ : (x - window_.low.x) * scale_;
  }
  double z_of(std::size_t column) const {
    return window_.low.z + (static_cast<double>(column) + 0.5) / scale_;
  }
  double x_of(std::size_t row) const {
    const double down = (static_cast<double>(row) + 0.5) / scale_;
    return sign_ > 0 ? window_.high.x - down : window_.low.x + down;
  }
  double pixel() const { return 1 / scale_; }

 private:
  Frame window_;
  double scale_, sign_;
};

bool is_shown(const PathPiece& piece, const TurnedView& view) {
  if (piece.kind == PathKind::Part) return view.shows_part_path;
  if (piece.kind == PathKind::FinishPattern) return view.shows_path || view.shows_part_path;
  return view.shows_path;
}

Frame frame_around(const TurnedSection* part, std::span<const PathPiece> path,
                   const TurnedView& view) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Frame frame{{kFar, kFar}, {-kFar, -kFar}};
  const auto add = [&frame](double z, double x) {
    frame.low = {std::min(frame.low.z, z), std::min(frame.low.x, x)};
    frame.high = {std::max(frame.high.z, z), std::max(frame.high.x, x)};
  };
  if (part != nullptr) {
    const SectionExtent& bar = part->bar();
    add(bar.z_low, bar.x_high);
    add(bar.z_high, -bar.x_high);
  }
  // without a part the feeds decide: rapid moves come from far away
  for (const PathPiece& piece : path) {
    if (part != nullptr || !is_shown(piece, view) || piece.kind == PathKind::Rapid) continue;
    add(piece.from.z, piece.from.x);
    add(piece.to.z, piece.to.x);
  }
  const double margin = kMargin * std::max(frame.high.z - frame.low.z, frame.high.x - frame.low.x);
  return {{frame.low.z - margin, frame.low.x - margin},
          {frame.high.z + margin, frame.high.x + margin}};
}

/// Light from the upper left, a little from the front.
Shade shade_of(double slope, double height) {
  const double front = std::sqrt(std::max(0.0, 1 - height * height));
  const double size = std::sqrt(1 + slope * slope);
  const double light = (-0.35 * -slope + 0.6 * height + 0.72 * front) / size;
  return static_cast<Shade>(45 + 155 * std::clamp(light, 0.0, 1.0));
}

/// The outside of the part, column by column: a body of revolution seen from the side.
class Outside {
 public:
  explicit Outside(const TurnedSection& part) : cell_(part.cell()) {
    radii_.reserve(part.columns());
    for (std::size_t column = 0; column < part.columns(); ++column)
      radii_.push_back(part.outer(column));
  }
  Shade at(std::size_t column, double x) const {
    const double radius = radii_[column], away = std::fabs(x);
    const double before = radii_[column > 0 ? column - 1 : 0];
    const double after = radii_[std::min(column + 1, radii_.size() - 1)];
    // a shoulder is seen as a line
    if (std::fabs(after - radius) > kShoulder * cell_ && away <= std::max(after, radius))
      return kEdge;
    if (away > radius) return kBlack;
    return shade_of((after - before) / (2 * cell_), x / radius);
  }

 private:
  static constexpr double kShoulder = 4;  ///< cells from one column to the next
  double cell_;
  std::vector<double> radii_;
};

class Section {
 public:
  explicit Section(const TurnedSection& part) : part_(part) {}
  Shade at(std::size_t column, double x, std::size_t diagonal) const {
    const auto row = static_cast<std::size_t>(std::fabs(x) / part_.cell());
    if (row >= part_.rows()) return kBlack;
    if (!part_.has(column, row)) return row < inner_row(column) ? kBore : kBlack;
    if (is_edge(column, row)) return kEdge;
    return diagonal % kHatchStep == 0 ? kHatch : kSolid;
  }

 private:
  /// Nearer to the axis than any material: the wall of a bore is seen after.
  std::size_t inner_row(std::size_t column) const {
    return static_cast<std::size_t>(part_.inner(column) / part_.cell());
  }
  bool is_edge(std::size_t column, std::size_t row) const {
    const bool is_border = column == 0 || column + 1 == part_.columns() || row + 1 == part_.rows();
    return is_border || !part_.has(column - 1, row) || !part_.has(column + 1, row) ||
           !part_.has(column, row + 1) || (row > 0 && !part_.has(column, row - 1));
  }
  const TurnedSection& part_;
};

void draw_part(Picture& picture, const Screen& screen, const TurnedSection& part,
               const TurnedView& view) {
  const Outside outside(part);
  const Section section(part);
  for (std::size_t left = 0; left < picture.width(); ++left) {
    const double place = (screen.z_of(left) - part.bar().z_low) / part.cell();
    if (place < 0 || place >= static_cast<double>(part.columns())) continue;
    const auto column = static_cast<std::size_t>(place);
    for (std::size_t top = 0; top < picture.height(); ++top) {
      const double x = screen.x_of(top);
      const TurnedSide side = x >= 0 ? view.above : view.below;
      if (side == TurnedSide::Outside) picture.set(left, top, outside.at(column, x));
      if (side == TurnedSide::Section) picture.set(left, top, section.at(column, x, left + top));
    }
  }
}

void draw_dashed(Picture& picture, const SectionPoint& from, const SectionPoint& to, Shade shade,
                 double dash, Ink ink = Ink::Gray) {
  const double length = std::hypot(to.z - from.z, to.x - from.x);
  const double reach = 4.0 * static_cast<double>(picture.width() + picture.height());
  for (double at = 0; at < std::min(length, reach); at += 2 * dash) {
    const double a = at / length, b = std::min(1.0, (at + dash) / length);
    picture.draw_line(from.z + (to.z - from.z) * a, from.x + (to.x - from.x) * a,
                      from.z + (to.z - from.z) * b, from.x + (to.x - from.x) * b, shade, ink);
  }
}

SectionPoint on(const Screen& screen, const SectionPoint& point) {
  return {screen.left(point.z), screen.top(point.x)};
}

void draw_path(Picture& picture, const Screen& screen, std::span<const PathPiece> path,
               const TurnedView& view) {
  for (const PathPiece& piece : path) {
    if (!is_shown(piece, view)) continue;
    const SectionPoint from = on(screen, piece.from), to = on(screen, piece.to);
    if (piece.kind == PathKind::Rapid) {
      draw_dashed(picture, from, to, kRapidLine, kDash, Ink::Red);
    } else {
      const Ink ink = piece.kind == PathKind::Feed ? Ink::Green : Ink::Yellow;
      picture.draw_line(from.z, from.x, to.z, to.x, kFeedLine, ink);
    }
  }
}

void draw_frame(Picture& picture, const Screen& screen, const Frame& frame, Shade shade) {
  const SectionPoint corners[] = {{frame.low.z, frame.low.x},
                                  {frame.high.z, frame.low.x},
                                  {frame.high.z, frame.high.x},
                                  {frame.low.z, frame.high.x}};
  for (std::size_t i = 0; i < std::size(corners); ++i) {
    const SectionPoint from = on(screen, corners[i]), to = on(screen, corners[(i + 1) % 4]);
    picture.draw_line(from.z, from.x, to.z, to.x, shade);
  }
}

}  // namespace

Result<Picture> draw_turned(const TurnedSection* part, std::span<const PathPiece> path,
                            const TurnedView& view) {
  const Frame window = view.window.value_or(frame_around(part, path, view));
  const double length = window.high.z - window.low.z, height = window.high.x - window.low.x;
  if (!(length > 0) || !(height > 0) || !std::isfinite(length) || !std::isfinite(height)) {
    return fail(Errc::LimitExceeded, "a window of {} by {} mm shows nothing", length, height);
  }
  const Screen screen(window, view.width, view.has_front_turret);
  Picture picture(view.width, screen.height(view.width));
  if (part != nullptr) draw_part(picture, screen, *part, view);
  draw_dashed(picture, on(screen, {window.low.z, 0}), on(screen, {window.high.z, 0}), kAxis,
              kAxisDash);
  if (view.limits) draw_frame(picture, screen, *view.limits, kLimitLine);
  if (view.zone) draw_frame(picture, screen, *view.zone, kZoneLine);
  draw_path(picture, screen, path, view);
  return picture;
}

}  // namespace dripline::graphics
