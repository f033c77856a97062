#pragma once

#include <cstdint>

#include "gateway/interpreter/core/diagnostic.hpp"

/// What can be wrong with a tape. The manual knows one lamp; ids and texts are decided here. From
/// TEK0401 on the manual forbids it but does not say what the control does: a warning.
namespace dripline::interpreter::tektronix1704 {

enum class Fault : std::uint8_t {
  Character,
  TooManyDigits,
  NoDigits,
  Sign,
  GCode,
  TwoDifferent,
  DwellNotAlone,
  BlockTooLong,
  NumberNotFound,
  TextFailed,
  EndWithoutM,
  Capacity,
  Travel,
  ThreeAxes,
  Radius,
  OffTheCircle,
  Quadrant,
  NoClearance,
  NoDepth,
  NoFeed,
  FeedOutOfRange,
  DwellTooLong,
  DwellWithoutF,
  Synchronization,
  Turn,
  TerminalMove,
  QuillAfterMove,
  MAfterMove,
  MissingEnd,
  NoArc,
  Point,
  Repeated,
  PresetValue,
  OddCount,
  NotFitted,
  Unused,
  ReaderLimited,
  Tape,
};

/// The same id for an alarm and a warning.
const DiagnosticRow& fault_row(Fault fault);

}  // namespace dripline::interpreter::tektronix1704
