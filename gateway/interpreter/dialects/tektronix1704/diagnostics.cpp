#include "gateway/interpreter/dialects/tektronix1704/diagnostics.hpp"

#include <array>

namespace dripline::interpreter::tektronix1704 {
namespace {

using enum Fault;

struct FaultRow {
  Fault fault;
  DiagnosticRow row;
};

/// In the order of the enum.
constexpr std::array kRows{
    FaultRow{Character, {"TEK0103", "invalid character"}},
    FaultRow{TooManyDigits, {"TEK0104", "too many significant digits"}},
    FaultRow{NoDigits, {"TEK0105", "letter without digits"}},
    FaultRow{Sign, {"TEK0106", "sign where none is allowed"}},
    FaultRow{GCode, {"TEK0107", "G code unknown or option not fitted"}},
    FaultRow{TwoDifferent, {"TEK0108", "two different G or M words in one block"}},
    FaultRow{DwellNotAlone, {"TEK0109", "G04 is not alone in its block"}},
    FaultRow{BlockTooLong, {"TEK0110", "block too long"}},
    FaultRow{NumberNotFound, {"TEK0111", "sequence number not found"}},
    FaultRow{TextFailed, {"TEK0112", "tape cannot be read"}},
    FaultRow{EndWithoutM, {"TEK0120", "end of tape without M02 or M30"}},
    FaultRow{Capacity, {"TEK0201", "coordinate capacity exceeded"}},
    FaultRow{Travel, {"TEK0202", "machine travel exceeded"}},
    FaultRow{ThreeAxes, {"TEK0211", "arc with three end coordinates"}},
    FaultRow{Radius, {"TEK0212", "arc radius out of range"}},
    FaultRow{OffTheCircle, {"TEK0213", "end point is not on the arc"}},
    FaultRow{Quadrant, {"TEK0214", "arc leaves its quadrant"}},
    FaultRow{NoClearance, {"TEK0221", "fixed cycle without R"}},
    FaultRow{NoDepth, {"TEK0222", "fixed cycle without Z"}},
    FaultRow{NoFeed, {"TEK0301", "no feedrate, or zero"}},
    FaultRow{FeedOutOfRange, {"TEK0302", "feedrate out of range"}},
    FaultRow{DwellTooLong, {"TEK0303", "dwell out of range"}},
    FaultRow{DwellWithoutF, {"TEK0304", "dwell without F"}},
    FaultRow{Synchronization, {"TEK0402", "stop in a mode without deceleration"}},
    FaultRow{Turn, {"TEK0401", "direction changes by more than 30 degrees without a stop"}},
    FaultRow{TerminalMove, {"TEK0402", "last move before a stop has no deceleration"}},
    FaultRow{QuillAfterMove, {"TEK0403", "quill moves after a block without deceleration"}},
    FaultRow{MAfterMove, {"TEK0404", "M word in or after a block without deceleration"}},
    FaultRow{MissingEnd, {"TEK0411", "end coordinate of an arc is missing and taken as 0"}},
    FaultRow{NoArc, {"TEK0412", "arc ends where it begins: no motion"}},
    FaultRow{Point, {"TEK0421", "decimal point has no meaning here"}},
    FaultRow{Repeated, {"TEK0422", "word is repeated; the last one counts"}},
    FaultRow{PresetValue, {"TEK0423", "G94 sets zero, whatever value is given"}},
    FaultRow{OddCount, {"TEK0424", "odd count is rounded down to the resolution"}},
    FaultRow{NotFitted, {"TEK0425", "word of an option that is not fitted is ignored"}},
    FaultRow{Unused, {"TEK0426", "nothing in the block takes"}},
    FaultRow{ReaderLimited, {"TEK0431", "reader is slower than the move"}},
    FaultRow{Tape, {"TEK0441", "tape is not as the manual wants it"}},
};

constexpr bool are_rows_in_order() {
  for (std::size_t row = 0; row < kRows.size(); ++row) {
    if (static_cast<std::size_t>(kRows[row].fault) != row) return false;
  }
  return true;
}
static_assert(are_rows_in_order());

}  // namespace

const DiagnosticRow& fault_row(Fault fault) {
  return kRows[static_cast<std::size_t>(fault)].row;
}

}  // namespace dripline::interpreter::tektronix1704
