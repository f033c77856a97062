#pragma once

#include <cstdint>
#include <string>

#include "gateway/interpreter/core/event.hpp"

/// The errors of this control. It has texts and no numbers, so the ids are ours and stable; texts
/// that are not in its manual are marked in the table.
namespace dripline::interpreter::tnc155 {

enum class ErrorCode : std::uint8_t {
  None,
  AngleReferenceMissing,
  BlankFormIncorrect,
  BlockFormatIncorrect,
  CircleEndIncorrect,
  CycleIncomplete,
  ExcessiveSubprogramming,
  GCodeGroupAssigned,
  IllegalGCode,
  JumpToLabelZero,
  MirrorOnToolAxis,
  NumberAllocated,
  PathOffsetWronglyStarted,
  ProgramUnavailable,
  MemoryExceeded,
  PlaneWronglyDefined,
  ProgramStartUndefined,
  RoundingRadiusTooLarge,
  BlockNotAddressed,
  SpindleRotatesMissing,
  ToolCallMissing,
  ToolRadiusTooLarge,
  TouchPointInaccessible,
  WrongAxis,
  WrongRpm,
  // not in the manual:
  FeedRateMissing,
  LabelNotFound,
  ToolDefMissing,
  ArithmeticalError,
  WrongSign,
  LimitSwitch,
  EntryOutOfRange,
  BlockTooLong,
  BlockNumberOrder,
  TextFailed,
  NotInBlockwiseTransfer,
  NotSupported,
  PocketMissing,
  LoopLimit,
  ProgramError,
  OptionMissing,
  TiltFailed,
  Count,
};

/// A stable id, as TNC-BLOCK-FORMAT, and the control's wording.
const DiagnosticRow& error_row(ErrorCode code);

/// Why a block cannot be read.
struct Fault {
  ErrorCode code = ErrorCode::None;
  std::uint32_t column = 0;  ///< 1-based, in the block's text as written in the program
  std::string detail;        ///< the word, its value and the limit

  explicit operator bool() const { return code != ErrorCode::None; }
  /// "BLOCK FORMAT INCORRECT: ...".
  std::string text() const;
};

}  // namespace dripline::interpreter::tnc155
