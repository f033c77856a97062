#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::graphics {

using Shade = std::uint8_t;  ///< 0 black, 255 white
inline constexpr Shade kBlack = 0;
inline constexpr Shade kWhite = 255;

/// A gray picture, row by row from the top left.
class Picture {
 public:
  Picture(std::size_t width, std::size_t height, Shade shade = kBlack)
      : width_(width), height_(height), shades_(width * height, shade) {}

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  Shade at(std::size_t x, std::size_t y) const { return shades_[y * width_ + x]; }
  void set(std::size_t x, std::size_t y, Shade shade) { shades_[y * width_ + x] = shade; }
  const Shade* row(std::size_t y) const { return shades_.data() + y * width_; }

  /// A straight line; what lies outside of the picture is left out.
  void draw_line(double from_x, double from_y, double to_x, double to_y, Shade shade);
  /// Puts `part` with its top left at (x, y); it must fit.
  void place(const Picture& part, std::size_t x, std::size_t y);

  /// The bytes of a PNG file. Errors: Io.
  Result<std::string> png() const;

 private:
  std::size_t width_, height_;
  std::vector<Shade> shades_;
};

}  // namespace dripline::graphics
