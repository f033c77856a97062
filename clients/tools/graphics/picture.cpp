#include "clients/tools/graphics/picture.hpp"

#include <png.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace dripline::graphics {

namespace {

using Color = std::array<std::uint8_t, 3>;

Color color_of(Shade shade, Ink ink) {
  switch (ink) {
    case Ink::Red:
      return {shade, static_cast<std::uint8_t>(shade / 4), static_cast<std::uint8_t>(shade / 4)};
    case Ink::Green:
      return {static_cast<std::uint8_t>(shade / 4), shade, static_cast<std::uint8_t>(shade / 4)};
    case Ink::Yellow:
      return {shade, shade, static_cast<std::uint8_t>(shade / 4)};
    default:
      return {shade, shade, shade};
  }
}

/// The sRGB default of the library is what viewers expect; no colormap, tight rows.
Result<std::string> png_of(std::size_t width, std::size_t height, png_uint_32 format,
                           const std::uint8_t* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, pixels, 0, nullptr) == 0) {
    return fail(Errc::Io, "PNG: {}", image.message);
  }
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr) == 0) {
    return fail(Errc::Io, "PNG: {}", image.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace

void Picture::draw_line(double from_x, double from_y, double to_x, double to_y, Shade shade,
                        Ink ink) {
  if (ink != Ink::Gray && inks_.empty()) inks_.resize(shades_.size(), Ink::Gray);
  const double longest = std::max(std::fabs(to_x - from_x), std::fabs(to_y - from_y));
  const double steps = std::min(std::ceil(longest), 4.0 * static_cast<double>(width_ + height_));
  for (double step = 0; step <= steps; ++step) {
    const double part = steps == 0 ? 0 : step / steps;
    const double x = std::floor(from_x + (to_x - from_x) * part);
    const double y = std::floor(from_y + (to_y - from_y) * part);
    const bool is_inside =
        x >= 0 && y >= 0 && x < static_cast<double>(width_) && y < static_cast<double>(height_);
    if (!is_inside) continue;
    const std::size_t at = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
    shades_[at] = shade;
    if (!inks_.empty()) inks_[at] = ink;
  }
}

void Picture::place(const Picture& part, std::size_t x, std::size_t y) {
  if (!part.inks_.empty() && inks_.empty()) inks_.resize(shades_.size(), Ink::Gray);
  for (std::size_t row = 0; row < part.height_; ++row) {
    const auto to = static_cast<std::ptrdiff_t>((y + row) * width_ + x);
    std::copy_n(part.row(row), part.width_, shades_.begin() + to);
    for (std::size_t column = 0; !inks_.empty() && column < part.width_; ++column) {
      inks_[(y + row) * width_ + x + column] = part.ink_at(column, row);
    }
  }
}

Result<std::string> Picture::png() const {
  if (inks_.empty()) return png_of(width_, height_, PNG_FORMAT_GRAY, shades_.data());
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * shades_.size());
  for (std::size_t i = 0; i < shades_.size(); ++i) {
    const Color color = color_of(shades_[i], inks_[i]);
    pixels.insert(pixels.end(), color.begin(), color.end());
  }
  return png_of(width_, height_, PNG_FORMAT_RGB, pixels.data());
}

namespace {

/// Ordered dither, 4 x 4: which shades still print a dot here.
constexpr std::array<std::array<int, 4>, 4> kDither{
    {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}}};

bool prints_dot(Shade shade, std::size_t x, std::size_t y) {
  return shade < kDither[y % 4][x % 4] * 16 + 8;
}

struct PrinterRow {
  std::string_view name, title;
  std::uint16_t before_picture[4];
  std::uint16_t before_line[4];
};
constexpr std::array kPrinters{
    PrinterRow{"epson", "EPSON matrix printer", {1819, 17217, 6963, 5642}, {1290, 6987, 2, 0}},
    PrinterRow{"ti-850",
               "Texas Instruments OMNI 800, model 850",
               {1819, 17200, 6977, 2060},
               {1290, 6990, 2, 0}},
};

/// Dots a picture takes: as many columns as the paper has, never more than the picture's own.
struct Paper {
  std::size_t columns, rows;
  double step;  ///< pixels of the picture for one dot
};
Paper paper_for(const Picture& picture) {
  const double step = std::max(1.0, static_cast<double>(picture.width()) / kDotColumns);
  const auto dots = [step](std::size_t pixels) {
    return static_cast<std::size_t>(static_cast<double>(pixels) / step);
  };
  return {std::min(dots(picture.width()), kDotColumns), dots(picture.height()), step};
}

}  // namespace

Result<std::vector<std::uint8_t>> printer_bytes(const std::uint16_t (&words)[4]) {
  const std::size_t count = words[0] >> 8;
  constexpr std::size_t kMax = 7;
  if (count > kMax) {
    return fail(Errc::LimitExceeded, "{} bytes: a group of four words holds {}", count, kMax);
  }
  std::vector<std::uint8_t> bytes{static_cast<std::uint8_t>(words[0] & 0xff)};
  for (std::size_t i = 1; i < 4; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(words[i] >> 8));
    bytes.push_back(static_cast<std::uint8_t>(words[i] & 0xff));
  }
  bytes.resize(count);
  return bytes;
}

Result<Printer> find_printer(std::string_view name) {
  std::string known;
  for (const PrinterRow& row : kPrinters) {
    known += (known.empty() ? "" : ", ") + std::string(row.name);
    if (row.name != name) continue;
    auto picture = printer_bytes(row.before_picture);
    auto line = printer_bytes(row.before_line);
    if (!picture) return fail(picture.error());
    if (!line) return fail(line.error());
    return Printer{row.name, row.title, std::move(*picture), std::move(*line)};
  }
  return fail(Errc::NotFound, "printer {}: expected one of {}", name, known);
}

Result<Printer> printer_of_parameters(const std::array<std::uint16_t, 8>& words) {
  constexpr int kPicture = 226, kLine = 230;
  auto picture = printer_bytes({words[0], words[1], words[2], words[3]});
  if (!picture) return fail(picture.error().code, "MP{}: {}", kPicture, picture.error().what);
  auto line = printer_bytes({words[4], words[5], words[6], words[7]});
  if (!line) return fail(line.error().code, "MP{}: {}", kLine, line.error().what);
  return Printer{"setup", "MP 226 to 233", std::move(*picture), std::move(*line)};
}

std::string hardcopy(const Picture& picture, const Printer& printer) {
  const Paper paper = paper_for(picture);
  const auto dot = [&](std::size_t x, std::size_t y) {
    if (x >= paper.columns || y >= paper.rows) return false;
    const auto pixel = [&](std::size_t at, std::size_t most) {
      return std::min(static_cast<std::size_t>(static_cast<double>(at) * paper.step), most - 1);
    };
    return prints_dot(picture.at(pixel(x, picture.width()), pixel(y, picture.height())), x, y);
  };
  std::string bytes(printer.before_picture.begin(), printer.before_picture.end());
  for (std::size_t top = 0; top < paper.rows; top += 8) {
    bytes.append(printer.before_line.begin(), printer.before_line.end());
    for (std::size_t x = 0; x < kDotColumns; ++x) {
      unsigned pins = 0;
      for (std::size_t pin = 0; pin < 8; ++pin) pins = pins << 1 | (dot(x, top + pin) ? 1u : 0u);
      bytes.push_back(static_cast<char>(pins));
    }
  }
  return bytes;
}

}  // namespace dripline::graphics
