#include <algorithm>
#include <array>
#include <cmath>

#include "clients/tools/graphics/views.hpp"

namespace dripline::graphics {
namespace {

constexpr double kBodyShare = 0.94;  ///< of the picture that the body may fill

struct Vector {
  double u = 0, v = 0, w = 0;
};
double dot(const Vector& a, const Vector& b) {
  return a.u * b.u + a.v * b.v + a.w * b.w;
}

/// Position of the eye, far away: unit vectors to the right and up in the picture, and into it.
struct Camera {
  Vector right, up, forward;

  static Camera of(const SolidView& view) {
    const double rotation = view.rotation.radians();
    const double tilt = Angle::degrees(std::clamp(view.tilt.degrees(), 5.0, 90.0)).radians();
    const double c = std::cos(rotation), s = std::sin(rotation);
    const Vector away{-s, c, 0};  // level, from the front to the back
    return {{c, s, 0},
            {away.u * std::sin(tilt), away.v * std::sin(tilt), std::cos(tilt)},
            {away.u * std::cos(tilt), away.v * std::cos(tilt), -std::sin(tilt)}};
  }
};

/// Brightness of the surface a ray met.
Shade lit(const Vector& normal, double depth_part) {
  constexpr Vector kLight{-0.36, -0.48, 0.80};
  const double facing = std::max(0.0, dot(normal, kLight));
  const double deep = 1.0 - 0.35 * std::clamp(depth_part, 0.0, 1.0);
  return static_cast<Shade>(std::lround(std::clamp((45 + 200 * facing) * deep, 0.0, 255.0)));
}

/// Walks one ray over the cells, as through the grid of a plan: exact for a field of columns.
class Ray {
 public:
  Ray(const HeightField& part, const Vector& from, const Vector& along)
      : part_(part), from_(from), along_(along) {}

  Shade look() {
    if (!enter()) return kBackground;
    while (is_inside()) {
      const double leave = std::min(next_u_, next_v_);
      const double height =
          part_.at(static_cast<std::size_t>(column_), static_cast<std::size_t>(row_));
      const double w_in = from_.w + along_.w * at_, w_out = from_.w + along_.w * leave;
      const double low = part_.extent().low.w;
      if (height > low) {  // where it is cut through, there is no material
        if (w_in <= height && w_in >= low) {
          const bool is_step_of_slope = height - w_in < part_.cell();
          return lit(is_step_of_slope ? normal_at() : wall_normal(), depth_of(w_in));
        }
        if (w_out <= height && w_in > height) return lit(normal_at(), depth_of(height));
      }
      if (w_out < low) return kBackground;
      step();
    }
    return kBackground;
  }

 private:
  double depth_of(double w) const { return (part_.extent().high.w - w) / part_.extent().height(); }
  bool is_inside() const {
    return column_ >= 0 && row_ >= 0 && column_ < static_cast<std::ptrdiff_t>(part_.columns()) &&
           row_ < static_cast<std::ptrdiff_t>(part_.rows());
  }

  /// To the cuboid's face that the ray meets first; false when it misses.
  bool enter() {
    const FramePoint low = part_.extent().low;
    const double cell = part_.cell();
    const FramePoint high{low.u + cell * static_cast<double>(part_.columns()),
                          low.v + cell * static_cast<double>(part_.rows()), part_.extent().high.w};
    double first = -1e300, last = 1e300;
    const auto clip = [&](double from, double along, double lo, double hi, const Vector& side) {
      if (std::fabs(along) < 1e-12) return from >= lo && from <= hi;
      const double a = (lo - from) / along, b = (hi - from) / along;
      if (std::min(a, b) > first) {
        first = std::min(a, b);
        side_ = side;
      }
      last = std::min(last, std::max(a, b));
      return first <= last;
    };
    const bool meets = clip(from_.u, along_.u, low.u, high.u, {along_.u > 0 ? -1.0 : 1.0, 0, 0}) &&
                       clip(from_.v, along_.v, low.v, high.v, {0, along_.v > 0 ? -1.0 : 1.0, 0}) &&
                       clip(from_.w, along_.w, low.w, high.w, {0, 0, 1});
    if (!meets) return false;
    at_ = first;
    column_ = cell_of((from_.u + along_.u * at_ - low.u) / cell, part_.columns());
    row_ = cell_of((from_.v + along_.v * at_ - low.v) / cell, part_.rows());
    const auto border = [&](std::ptrdiff_t index, double along, double start, double origin) {
      if (std::fabs(along) < 1e-12) return 1e300;
      const double edge = origin + cell * static_cast<double>(index + (along > 0 ? 1 : 0));
      return (edge - start) / along;
    };
    next_u_ = border(column_, along_.u, from_.u, low.u);
    next_v_ = border(row_, along_.v, from_.v, low.v);
    each_u_ = std::fabs(along_.u) < 1e-12 ? 1e300 : cell / std::fabs(along_.u);
    each_v_ = std::fabs(along_.v) < 1e-12 ? 1e300 : cell / std::fabs(along_.v);
    return true;
  }

  static std::ptrdiff_t cell_of(double cells, std::size_t count) {
    return static_cast<std::ptrdiff_t>(
        std::clamp(std::floor(cells), 0.0, static_cast<double>(count) - 1));
  }

  void step() {
    if (next_u_ < next_v_) {
      at_ = next_u_;
      next_u_ += each_u_;
      column_ += along_.u > 0 ? 1 : -1;
      side_ = {along_.u > 0 ? -1.0 : 1.0, 0, 0};
    } else {
      at_ = next_v_;
      next_v_ += each_v_;
      row_ += along_.v > 0 ? 1 : -1;
      side_ = {0, along_.v > 0 ? -1.0 : 1.0, 0};
    }
  }

  /// Normal of the top, smooth where neighbors are about as high: a slope, not a step.
  Vector normal_at() const {
    const auto column = static_cast<std::size_t>(column_), row = static_cast<std::size_t>(row_);
    const double here = part_.at(column, row), cell = part_.cell();
    const auto slope = [&](double before, double after) {
      const double a = here - before, b = after - here;
      const bool is_slope = std::fabs(a) < 2 * cell && std::fabs(b) < 2 * cell;
      return is_slope ? (a + b) / (2 * cell) : 0.0;
    };
    const bool has_u = column > 0 && column + 1 < part_.columns();
    const bool has_v = row > 0 && row + 1 < part_.rows();
    const double du = has_u ? slope(part_.at(column - 1, row), part_.at(column + 1, row)) : 0;
    const double dv = has_v ? slope(part_.at(column, row - 1), part_.at(column, row + 1)) : 0;
    const double length = std::sqrt(du * du + dv * dv + 1);
    return {-du / length, -dv / length, 1 / length};
  }

  /// Normal of a wall: away from where its surroundings are higher, so that round walls look round.
  Vector wall_normal() const {
    constexpr std::ptrdiff_t kReach = 3;
    double u = 0, v = 0;
    for (std::ptrdiff_t i = -kReach; i <= kReach; ++i) {
      for (std::ptrdiff_t j = -kReach; j <= kReach; ++j) {
        const std::ptrdiff_t column = column_ + i, row = row_ + j;
        const bool is_on_part = column >= 0 && row >= 0 &&
                                column < static_cast<std::ptrdiff_t>(part_.columns()) &&
                                row < static_cast<std::ptrdiff_t>(part_.rows());
        if (!is_on_part) return side_;
        const double height =
            part_.at(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
        u -= static_cast<double>(i) * height;
        v -= static_cast<double>(j) * height;
      }
    }
    const double length = std::hypot(u, v);
    return length > 0 ? Vector{u / length, v / length, 0} : side_;
  }

  const HeightField& part_;
  Vector from_, along_, side_;
  double at_ = 0, next_u_ = 0, next_v_ = 0, each_u_ = 0, each_v_ = 0;
  std::ptrdiff_t column_ = 0, row_ = 0;
};

/// How much of the picture's plane the cuboid covers, from its middle.
struct Reach {
  double right = 0, up = 0;
};
Reach reach_of(const Camera& camera, const Cuboid& extent) {
  const auto reach = [&](const Vector& axis) {
    return (std::fabs(axis.u) * extent.width() + std::fabs(axis.v) * extent.depth() +
            std::fabs(axis.w) * extent.height()) /
           2;
  };
  return {reach(camera.right), reach(camera.up)};
}

/// Three short lines in the top left corner, the axes' directions as they are seen.
void draw_symbol(Picture& picture, const Camera& camera) {
  constexpr double kLength = 32, kX = 52, kY = 52;
  constexpr std::array kAxes{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  constexpr std::array<Shade, 3> kShades{255, 190, 130};
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    const double x = kX + kLength * dot(kAxes[i], camera.right);
    const double y = kY - kLength * dot(kAxes[i], camera.up);
    picture.draw_line(kX, kY, x, y, kShades[i]);
    for (const double offset : {-1.0, 1.0})
      picture.draw_line(x - 1, y + offset, x + 1, y + offset, kShades[i]);
  }
}

}  // namespace

Picture draw_solid(const HeightField& part, const SolidView& view) {
  const Camera camera = Camera::of(view);
  const Cuboid& extent = part.extent();
  const Reach reach = reach_of(camera, extent);
  const auto width = static_cast<double>(view.width), height = static_cast<double>(view.height);
  const double scale = std::max(2 * reach.right / width, 2 * reach.up / height) / kBodyShare;
  const double far = extent.width() + extent.depth() + extent.height();
  const Vector middle{(extent.low.u + extent.high.u) / 2, (extent.low.v + extent.high.v) / 2,
                      (extent.low.w + extent.high.w) / 2};
  Picture picture(view.width, view.height, kBackground);
  for (std::size_t y = 0; y < view.height; ++y) {
    const double up = (height / 2 - static_cast<double>(y) - 0.5) * scale;
    for (std::size_t x = 0; x < view.width; ++x) {
      const double right = (static_cast<double>(x) + 0.5 - width / 2) * scale;
      const auto start = [&](double m, double r, double u, double f) {
        return m + r * right + u * up - f * far;
      };
      const Vector from{start(middle.u, camera.right.u, camera.up.u, camera.forward.u),
                        start(middle.v, camera.right.v, camera.up.v, camera.forward.v),
                        start(middle.w, camera.right.w, camera.up.w, camera.forward.w)};
      picture.set(x, y, Ray(part, from, camera.forward).look());
    }
  }
  draw_symbol(picture, camera);
  return picture;
}

}  // namespace dripline::graphics
