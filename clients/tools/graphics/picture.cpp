#include "clients/tools/graphics/picture.hpp"

#include <png.h>
#include <algorithm>
#include <cmath>

namespace dripline::graphics {

void Picture::draw_line(double from_x, double from_y, double to_x, double to_y, Shade shade) {
  const double longest = std::max(std::fabs(to_x - from_x), std::fabs(to_y - from_y));
  const double steps = std::min(std::ceil(longest), 4.0 * static_cast<double>(width_ + height_));
  for (double step = 0; step <= steps; ++step) {
    const double part = steps == 0 ? 0 : step / steps;
    const double x = std::floor(from_x + (to_x - from_x) * part);
    const double y = std::floor(from_y + (to_y - from_y) * part);
    const bool is_inside =
        x >= 0 && y >= 0 && x < static_cast<double>(width_) && y < static_cast<double>(height_);
    if (is_inside) set(static_cast<std::size_t>(x), static_cast<std::size_t>(y), shade);
  }
}

void Picture::place(const Picture& part, std::size_t x, std::size_t y) {
  for (std::size_t row = 0; row < part.height_; ++row) {
    std::copy_n(part.row(row), part.width_,
                shades_.begin() + static_cast<std::ptrdiff_t>((y + row) * width_ + x));
  }
}

Result<std::string> Picture::png() const {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_GRAY;
  // The sRGB default of the library is what viewers expect; no colormap, tight rows.
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, shades_.data(), 0, nullptr) == 0) {
    return fail(Errc::Io, "PNG: {}", image.message);
  }
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, shades_.data(), 0, nullptr) == 0) {
    return fail(Errc::Io, "PNG: {}", image.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace dripline::graphics
