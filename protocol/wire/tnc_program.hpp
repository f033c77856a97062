#pragma once

#include <optional>
#include <string>
#include <string_view>

/// The meaning of a line for its TNC program. Plain language:
/// "0 BEGIN PGM 7 MM" ... "12 END PGM 7 MM"; ISO: "%7 G71" ... "N9999 %7 G71". Pure; any thread.
namespace dripline::wire {

enum class TncLineKind { Begin, End, Other };

struct TncLine {
  TncLineKind kind = TncLineKind::Other;
  std::string program;  ///< its number, of Begin and End
  /// The block number of plain language.
  std::optional<unsigned> number;
};

/// `line` without its line end.
TncLine read_tnc_line(std::string_view line);

/// Whether the line has a number (plain language, or N): no two equal ones follow each other.
bool is_numbered(std::string_view line);

}  // namespace dripline::wire
