#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::graphics {

using Shade = std::uint8_t;  ///< 0 black, 255 white
inline constexpr Shade kBlack = 0;
inline constexpr Shade kWhite = 255;
inline constexpr Shade kBackground = 24;  ///< of views

/// What a pixel is drawn with; shades of gray print, colors are for screens alone.
enum class Ink : std::uint8_t { Gray, Red, Green, Yellow };

/// A gray picture with colored lines, row by row from the top left.
class Picture {
 public:
  Picture(std::size_t width, std::size_t height, Shade shade = kBlack)
      : width_(width), height_(height), shades_(width * height, shade) {}

  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  Shade at(std::size_t x, std::size_t y) const { return shades_[y * width_ + x]; }
  Ink ink_at(std::size_t x, std::size_t y) const {
    return inks_.empty() ? Ink::Gray : inks_[y * width_ + x];
  }
  void set(std::size_t x, std::size_t y, Shade shade) { shades_[y * width_ + x] = shade; }
  const Shade* row(std::size_t y) const { return shades_.data() + y * width_; }

  /// A straight line; what lies outside of the picture is left out.
  void draw_line(double from_x, double from_y, double to_x, double to_y, Shade shade,
                 Ink ink = Ink::Gray);
  /// Puts `part` with its top left at (x, y); it must fit.
  void place(const Picture& part, std::size_t x, std::size_t y);

  /// The bytes of a PNG file: gray, or with colors where there are any. Errors: Io.
  Result<std::string> png() const;

 private:
  std::size_t width_, height_;
  std::vector<Shade> shades_;
  std::vector<Ink> inks_;  ///< empty: all gray
};

/// A dot matrix printer as the TNC's machine parameters 226 to 233 describe it: bytes before the
/// picture, and before each of its lines.
struct Printer {
  std::string_view name;   ///< as users choose it
  std::string_view title;  ///< for people
  std::vector<std::uint8_t> before_picture, before_line;
};

/// Both groups of four 16-bit words: the upper byte of a group's first word counts its bytes, which
/// follow from that word's lower byte on, each further word upper byte first. Errors: LimitExceeded
/// (more than the seven bytes a group holds).
Result<std::vector<std::uint8_t>> printer_bytes(const std::uint16_t (&words)[4]);

/// Errors: NotFound, naming the known ones (epson, ti-850).
Result<Printer> find_printer(std::string_view name);

/// The printer of the control's machine parameters 226 to 233, in order; its name is "setup".
/// Errors: LimitExceeded, naming the first parameter of the group.
Result<Printer> printer_of_parameters(const std::array<std::uint16_t, 8>& words);

/// Columns of dots a line has: the bytes before a line set it at both printers.
inline constexpr std::size_t kDotColumns = 512;

/// The picture in black dots on white paper, eight rows a line, the upper row in the highest bit.
/// Gray becomes a pattern of dots; a wider picture is made smaller.
std::string hardcopy(const Picture& picture, const Printer& printer);

}  // namespace dripline::graphics
