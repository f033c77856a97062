#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/graphics/picture.hpp"
#include "protocol/base/result.hpp"

namespace dripline::graphics {

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
