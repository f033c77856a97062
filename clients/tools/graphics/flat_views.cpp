#include <algorithm>
#include <cmath>

#include "clients/tools/graphics/views.hpp"

namespace dripline::graphics {
namespace {

constexpr Shade kMaterial = 200;
constexpr Shade kAir = 48;
constexpr Shade kMark = 255;
constexpr std::size_t kGap = 12;

/// The uncut top is the lightest step, cut through is black.
Shade shade_of_depth(double depth, double most, int shades) {
  if (depth <= 0) return kWhite;
  const double part = std::min(depth / most, 1.0);
  const double step = std::min(std::floor(part * shades), shades - 1.0);
  return static_cast<Shade>(std::lround(220.0 * (1.0 - (step + 1) / shades)));
}

std::size_t pixels_high(const HeightField& part) {
  const double cells = part.extent().height() / part.cell();
  return static_cast<std::size_t>(std::clamp(std::lround(cells), 8L, 4096L));
}

/// Upright material along a line of `count` cells.
template <class HeightAt>
Picture draw_section(const HeightField& part, std::size_t count, HeightAt height_at) {
  const std::size_t high = pixels_high(part);
  Picture picture(count, high, kAir);
  for (std::size_t x = 0; x < count; ++x) {
    const double filled = (height_at(x) - part.extent().low.w) / part.extent().height();
    const auto pixels = static_cast<std::size_t>(
        std::lround(std::clamp(filled, 0.0, 1.0) * static_cast<double>(high)));
    for (std::size_t y = high - pixels; y < high; ++y) picture.set(x, y, kMaterial);
  }
  return picture;
}

std::size_t cell_at(double part, std::size_t count) {
  const auto cell = static_cast<std::size_t>(std::max(part, 0.0) * static_cast<double>(count));
  return std::min(cell, count - 1);
}

void mark(Picture& picture, double from_x, double from_y, double to_x, double to_y) {
  picture.draw_line(from_x, from_y, to_x, to_y, kMark);
}

}  // namespace

Picture draw_plan(const HeightField& part, const PlanView& view) {
  const double top = part.extent().high.w;
  Picture picture(part.columns(), part.rows());
  for (std::size_t row = 0; row < part.rows(); ++row) {
    for (std::size_t column = 0; column < part.columns(); ++column) {
      picture.set(column, part.rows() - 1 - row,
                  shade_of_depth(top - part.at(column, row), part.extent().height(), view.shades));
    }
  }
  return picture;
}

Picture draw_planes(const HeightField& part, const PlanesView& view) {
  const std::size_t column = cell_at(view.section_u, part.columns());
  const std::size_t row = cell_at(view.section_v, part.rows());
  const bool is_din = view.arrangement == Arrangement::Din;
  Picture plan = draw_plan(part);
  Picture front =
      draw_section(part, part.columns(), [&](std::size_t x) { return part.at(x, row); });
  // Seen from the left, what is in front of the part lies to the right; from the right, to the
  // left.
  Picture side = draw_section(part, part.rows(), [&](std::size_t x) {
    return part.at(column, is_din ? part.rows() - 1 - x : x);
  });

  const std::size_t wide = plan.width() + side.width() + 3 * kGap;
  const std::size_t high = plan.height() + front.height() + 3 * kGap;
  Picture sheet(wide, high, kBackground);
  const std::size_t front_y = is_din ? kGap : plan.height() + 2 * kGap;
  const std::size_t plan_y = is_din ? front.height() + 2 * kGap : kGap;
  const std::size_t side_x = plan.width() + 2 * kGap;
  sheet.place(plan, kGap, plan_y);
  sheet.place(front, kGap, front_y);
  sheet.place(side, side_x, front_y);

  const auto line_x = static_cast<double>(kGap + column);
  const auto line_y = static_cast<double>(plan_y + part.rows() - 1 - row);
  constexpr double kTick = kGap - 2;
  const auto right = static_cast<double>(kGap + plan.width());
  const auto plan_top = static_cast<double>(plan_y);
  const auto plan_end = static_cast<double>(plan_y + plan.height());
  mark(sheet, line_x, plan_top - kTick, line_x, plan_top - 1);
  mark(sheet, line_x, plan_end, line_x, plan_end + kTick);
  mark(sheet, 1, line_y, kTick, line_y);
  mark(sheet, right, line_y, right + kTick, line_y);
  return sheet;
}

}  // namespace dripline::graphics
