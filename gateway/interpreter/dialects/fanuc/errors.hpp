#pragma once

#include <cstdint>
#include <string_view>

/// The alarms of this control by its own numbers, and ours.
namespace dripline::interpreter::fanuc {

enum class ErrorCode : std::uint16_t {
  TooManyDigits = 3,
  AddressNotFound = 4,
  NoData = 5,
  NegativeSign = 6,
  DecimalPoint = 7,
  IllegalAddress = 9,
  ImproperG = 10,
  NoFeed = 11,
  RadiusTolerance = 20,
  IllegalPlaneAxis = 21,
  NoRadius = 22,
  IllegalRadius = 23,
  NoLengthAxis = 27,
  IllegalPlane = 28,
  IllegalOffsetNumber = 30,
  IllegalPInG10 = 31,
  IllegalValueInG10 = 32,
  NoSolution = 33,
  ArcAtStartUp = 34,
  CornerMoveNotAllowed = 35,
  SkipInCompensation = 36,
  PlaneInCompensation = 37,
  Interference = 41,
  OffsetInCompensation = 42,
  HomeInCycle = 44,
  NoQ = 45,
  IllegalReference = 46,
  SequenceNotFound = 60,
  IllegalProgramNumber = 74,
  NoP = 76,
  Nesting = 77,
  NumberNotFound = 78,
  NotAtReference = 92,
  Overflow = 111,
  DivisionByZero = 112,
  ImproperCommand = 113,
  MacroFormat = 114,
  IllegalVariable = 115,
  WriteProtected = 116,
  Brackets = 118,
  IllegalArgument = 119,
  TooManyModalCalls = 122,
  MacroInDnc = 123,
  MissingEnd = 124,
  MacroFormat2 = 125,
  LoopNumber = 126,
  MixedStatement = 127,
  MacroSequence = 128,
  ArgumentAddress = 129,
  ScalingInCompensation = 141,
  IllegalScale = 142,
  ScaledOverflow = 143,
  RotationPlane = 144,
  NoSpeed = 200,
  IllegalAxis = 190,
  ExternalCall = 210,
  EndOfRecord = 5010,
  // Ours.
  OverTravel = 10001,
  RotationHome,
  RotationOffset,
  PositionUnderTransform,
  OffsetArc,
  UnusedAxis,
  LoopLimit,
  LineTooLong,
  TextFailed,
};

struct ErrorRow {
  ErrorCode code;
  std::string_view id;
  std::string_view text;
};
const ErrorRow& error_row(ErrorCode code);

/// PS3000 and up: the id of #3000 = `number`, which is 0 to kHighestUserAlarm.
inline constexpr int kHighestUserAlarm = 4095;
std::string_view user_alarm_id(int number);

/// What is told and does not stop the program.
enum class WarningCode : std::uint8_t {
  FeedWithoutPoint,
  ArgumentWithoutPoint,
  DuplicateWord,
  LowerCase,
  OpenComment,
  ReturnWithoutReference,
  SharedOffset,
  CycleInCompensation,
  PrintNotOpen,
  SeveralM,
  NoToolSelected,
  BackBoringLevel,
  NestedReference,
  UnusedWord,
  IgnoredG53,
  EndOfTapeByReturn,
  KeptPeck,
  LookAhead,
  SameGroup,
  ArcAsLine,
  ArcWithoutMove,
  CycleLevels,
  CycleWithoutShift,
  TapWithoutSpeed,
};
struct WarningRow {
  std::string_view id;
  std::string_view text;
};
const WarningRow& warning_row(WarningCode code);

}  // namespace dripline::interpreter::fanuc
