#pragma once

#include <cstdint>

#include "gateway/interpreter/core/event.hpp"

/// The errors of this control with its own numbers (manual: appendix), and from 1001 on those that
/// only this software has. The ids are stable: CEN0549 is the control's error 549.
namespace dripline::interpreter::centurion {

enum class ErrorCode : std::uint16_t {
  FileNotFound = 2,
  DiskFull = 101,
  FileNotOpen = 103,
  DivisionByZero = 200,
  FloatingOverflow = 205,
  InvalidFloating = 207,
  InvalidProgramNumber = 301,
  TravelOfX = 401,
  TravelOfZ = 403,
  SafeZone = 413,
  OutOfPosition = 416,
  ToolNotFound = 452,
  IllegalAddress = 501,
  UndefinedCycle = 502,
  ReturnWithoutGosub = 503,
  CoincidentPoints = 504,
  RadiusTooSmall = 505,
  CompensatedLineArcApart = 507,
  ArcsApart = 509,
  ParameterOutOfRange = 517,
  IllegalStatement = 518,
  FeedOutOfRange = 519,
  SpindleOutOfRange = 520,
  NegativeArcRadius = 521,
  NegativePolarRadius = 522,
  IllegalTool = 523,
  IllegalOffset = 524,
  DuplicateAddress = 529,
  StraightLineToLine = 530,
  StraightLineToArc = 531,
  StraightArcToLine = 532,
  StraightArcToArc = 533,
  NegativeChamfer = 535,
  ChamferAndRound = 536,
  ChamferAtArc = 537,
  LoopCounter = 538,
  DwellOutOfRange = 539,
  IllegalDwell = 540,
  IllegalReference = 542,
  IllegalG10 = 543,
  TooManyDigits = 544,
  NestedTooDeep = 546,
  CommentNotClosed = 547,
  UnknownGCode = 549,
  BadNumber = 550,
  TwoPoints = 551,
  MissingCloseBracket = 552,
  MissingOpenBracket = 553,
  TangentOverflow = 554,
  MissingSlash = 555,
  NegativeRoot = 556,
  UnknownFunction = 557,
  IllegalRelation = 560,
  UnresolvedCall = 567,
  UnresolvedLabel = 568,
  ArcTooSmall = 569,
  FirstArcTooSmall = 570,
  SecondArcTooSmall = 571,
  InputAfterMove = 577,
  CompensatedArcsApart = 579,
  LogArgument = 580,
  PowerBase = 581,
  TurningDepthReverses = 582,
  TurningAlongReverses = 583,
  TurningExceedsStart = 584,
  FacingDepthReverses = 585,
  FacingAlongReverses = 586,
  FacingExceedsStart = 587,
  MissingWhile = 601,
  MissingWend = 602,
  NoSuchProgram = 603,
  EmptyProgram = 606,
  MissingP = 608,
  UnitsInFast = 609,

  NotSupported = 1001,  ///< of this control, but not of this version of the interpreter
  BlockTooLong = 1002,
  BadCharacter = 1003,
  TextFailed = 1004,  ///< the source cannot give the program's text
  StatusParameter = 1005,
  ForcedError = 1006,   ///< G997 with a number that has no text
  CycleTooLong = 1007,  ///< more moves than one block may cause
  NotInDnc = 1008,      ///< with the option `dnc_refusals`
  SpindleNeeded = 1009,
  InputMissing = 1010,
  ProbeBeforeStart = 1011,
  LoopLimit = 1012,       ///< the program repeats without a move or a wait
  StartUndefined = 1013,  ///< the state at a start in the middle is not known

  CompensationNotStraight = 1020,  ///< an arc where compensation begins or ends
  TooMuchBetween = 1021,           ///< between two compensated moves
  CornerDoesNotFit = 1030,         ///< a rounding or chamfer takes more than there is
  ContourTooNarrow = 1022,         ///< the compensated move would run backwards
};

struct ErrorRow : DiagnosticRow {
  ErrorCode code;
};

/// The row of `code`; its text is the control's wording, shortened.
const ErrorRow& error_row(ErrorCode code);
/// For G997, which forces any number: its row, or that of ForcedError.
const ErrorRow& error_row_of_number(int number);

}  // namespace dripline::interpreter::centurion
