#pragma once

#include "gateway/interpreter/core/diagnostic.hpp"

/// What can be wrong with a tape. The manual knows one lamp; ids and texts are decided here. From
/// TEK0401 on the manual forbids it but does not say what the control does: a warning.
namespace dripline::interpreter::tektronix1704 {

// The rows are named as enumerators are, because they are used as such.
// NOLINTBEGIN(readability-identifier-naming): a row is named as an enumerator would be
struct Fault {
  static constexpr DiagnosticRow Character{"TEK0103", "invalid character"};
  static constexpr DiagnosticRow TooManyDigits{"TEK0104", "too many significant digits"};
  static constexpr DiagnosticRow NoDigits{"TEK0105", "letter without digits"};
  static constexpr DiagnosticRow Sign{"TEK0106", "sign where none is allowed"};
  static constexpr DiagnosticRow GCode{"TEK0107", "G code unknown or option not fitted"};
  static constexpr DiagnosticRow TwoDifferent{"TEK0108", "two different G or M words in one block"};
  static constexpr DiagnosticRow DwellNotAlone{"TEK0109", "G04 is not alone in its block"};
  static constexpr DiagnosticRow BlockTooLong{"TEK0110", "block too long"};
  static constexpr DiagnosticRow NumberNotFound{"TEK0111", "sequence number not found"};
  static constexpr DiagnosticRow TextFailed{"TEK0112", "tape cannot be read"};
  static constexpr DiagnosticRow EndWithoutM{"TEK0120", "end of tape without M02 or M30"};
  static constexpr DiagnosticRow Capacity{"TEK0201", "coordinate capacity exceeded"};
  static constexpr DiagnosticRow Travel{"TEK0202", "machine travel exceeded"};
  static constexpr DiagnosticRow ThreeAxes{"TEK0211", "arc with three end coordinates"};
  static constexpr DiagnosticRow Radius{"TEK0212", "arc radius out of range"};
  static constexpr DiagnosticRow OffTheCircle{"TEK0213", "end point is not on the arc"};
  static constexpr DiagnosticRow Quadrant{"TEK0214", "arc leaves its quadrant"};
  static constexpr DiagnosticRow NoClearance{"TEK0221", "fixed cycle without R"};
  static constexpr DiagnosticRow NoDepth{"TEK0222", "fixed cycle without Z"};
  static constexpr DiagnosticRow NoFeed{"TEK0301", "no feedrate, or zero"};
  static constexpr DiagnosticRow FeedOutOfRange{"TEK0302", "feedrate out of range"};
  static constexpr DiagnosticRow DwellTooLong{"TEK0303", "dwell out of range"};
  static constexpr DiagnosticRow DwellWithoutF{"TEK0304", "dwell without F"};
  static constexpr DiagnosticRow Synchronization{"TEK0402", "stop in a mode without deceleration"};
  static constexpr DiagnosticRow Turn{"TEK0401",
                                      "direction changes by more than 30 degrees without a stop"};
  static constexpr DiagnosticRow TerminalMove{"TEK0402",
                                              "last move before a stop has no deceleration"};
  static constexpr DiagnosticRow QuillAfterMove{"TEK0403",
                                                "quill moves after a block without deceleration"};
  static constexpr DiagnosticRow MAfterMove{"TEK0404",
                                            "M word in or after a block without deceleration"};
  static constexpr DiagnosticRow MissingEnd{"TEK0411",
                                            "end coordinate of an arc is missing and taken as 0"};
  static constexpr DiagnosticRow NoArc{"TEK0412", "arc ends where it begins: no motion"};
  static constexpr DiagnosticRow Point{"TEK0421", "decimal point has no meaning here"};
  static constexpr DiagnosticRow Repeated{"TEK0422", "word is repeated; the last one counts"};
  static constexpr DiagnosticRow PresetValue{"TEK0423", "G94 sets zero, whatever value is given"};
  static constexpr DiagnosticRow OddCount{"TEK0424", "odd count is rounded down to the resolution"};
  static constexpr DiagnosticRow NotFitted{"TEK0425",
                                           "word of an option that is not fitted is ignored"};
  static constexpr DiagnosticRow Unused{"TEK0426", "nothing in the block takes"};
  static constexpr DiagnosticRow ReaderLimited{"TEK0431", "reader is slower than the move"};
  static constexpr DiagnosticRow Tape{"TEK0441", "tape is not as the manual wants it"};
};
// NOLINTEND(readability-identifier-naming)

}  // namespace dripline::interpreter::tektronix1704
