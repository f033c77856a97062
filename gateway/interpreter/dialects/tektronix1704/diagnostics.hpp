#pragma once

#include <cstdint>
#include <string_view>

/// What can be wrong with a tape. The manual knows one lamp; the numbers are ours (spec 19). W: the
/// manual forbids it but does not say what the control does; told, and the tape runs on.
namespace dripline::interpreter::tektronix1704 {

enum class Fault : std::uint8_t {
  Character,        // T103
  TooManyDigits,    // T104
  NoDigits,         // T105
  Sign,             // T106
  GCode,            // T107
  TwoDifferent,     // T108
  DwellNotAlone,    // T109
  BlockTooLong,     // T110
  NumberNotFound,   // T111
  TextFailed,       // T112
  EndWithoutM,      // T120, W120
  Capacity,         // T201
  Travel,           // T202
  ThreeAxes,        // T211
  Radius,           // T212
  OffTheCircle,     // T213
  Quadrant,         // T214
  NoClearance,      // T221
  NoDepth,          // T222
  NoFeed,           // T301
  FeedOutOfRange,   // T302
  DwellTooLong,     // T303
  DwellWithoutF,    // T304
  Synchronisation,  // T402
  Turn,             // W401
  TerminalMove,     // W402
  QuillAfterMove,   // W403
  MAfterMove,       // W404
  MissingEnd,       // W411
  NoArc,            // W412
  Point,            // W421
  Repeated,         // W422
  PresetValue,      // W423
  OddCount,         // W424
  NotFitted,        // W425
  Unused,           // T426, W426
  ReaderLimited,    // W431
  Tape,             // W441
};

struct FaultRow {
  Fault fault;
  std::string_view id;          ///< as an alarm
  std::string_view warning_id;  ///< when it only warns; empty: it never does by itself
  std::string_view text;
};
const FaultRow& fault_row(Fault fault);

}  // namespace dripline::interpreter::tektronix1704
