#pragma once

#include <string_view>

#include "gateway/interpreter/core/event.hpp"

/// The alarms of this control with its own numbers and wording, and ours; and the warnings.
namespace dripline::interpreter::fanuc {

// The rows are named as enumerators are, because they are used as such.
// NOLINTBEGIN(readability-identifier-naming): a row is named as an enumerator would be
struct ErrorCode {
  static constexpr DiagnosticRow TooManyDigits{"PS003", "TOO MANY DIGITS"};
  static constexpr DiagnosticRow AddressNotFound{"PS004", "ADDRESS NOT FOUND"};
  static constexpr DiagnosticRow NoData{"PS005", "NO DATA AFTER ADDRESS"};
  static constexpr DiagnosticRow NegativeSign{"PS006", "ILLEGAL USE OF NEGATIVE SIGN"};
  static constexpr DiagnosticRow DecimalPoint{"PS007", "ILLEGAL USE OF DECIMAL POINT"};
  static constexpr DiagnosticRow IllegalAddress{"PS009", "ILLEGAL ADDRESS INPUT"};
  static constexpr DiagnosticRow ImproperG{"PS010", "IMPROPER G-CODE"};
  static constexpr DiagnosticRow NoFeed{"PS011", "NO FEEDRATE COMMANDED"};
  static constexpr DiagnosticRow RadiusTolerance{"PS020", "OVER TOLERANCE OF RADIUS"};
  static constexpr DiagnosticRow IllegalPlaneAxis{"PS021", "ILLEGAL PLANE AXIS COMMANDED"};
  static constexpr DiagnosticRow NoRadius{"PS022", "NO CIRCLE RADIUS"};
  static constexpr DiagnosticRow IllegalRadius{"PS023", "ILLEGAL RADIUS COMMAND"};
  static constexpr DiagnosticRow NoLengthAxis{"PS027", "NO AXES COMMANDED IN G43/G44"};
  static constexpr DiagnosticRow IllegalPlane{"PS028", "ILLEGAL PLANE SELECT"};
  static constexpr DiagnosticRow IllegalOffsetNumber{"PS030", "ILLEGAL OFFSET NUMBER"};
  static constexpr DiagnosticRow IllegalPInG10{"PS031", "ILLEGAL P COMMAND IN G10"};
  static constexpr DiagnosticRow IllegalValueInG10{"PS032", "ILLEGAL OFFSET VALUE IN G10"};
  static constexpr DiagnosticRow NoSolution{"PS033", "NO SOLUTION AT CRC"};
  static constexpr DiagnosticRow ArcAtStartUp{"PS034", "NO CIRC ALLOWED IN ST-UP/EXT BLK"};
  static constexpr DiagnosticRow CornerMoveNotAllowed{"PS035", "CAN NOT COMMANDED G39"};
  static constexpr DiagnosticRow SkipInCompensation{"PS036", "CAN NOT COMMANDED G31"};
  static constexpr DiagnosticRow PlaneInCompensation{"PS037", "CAN NOT CHANGE PLANE IN CRC"};
  static constexpr DiagnosticRow Interference{"PS041", "INTERFERENCE IN CRC"};
  static constexpr DiagnosticRow OffsetInCompensation{"PS042", "G45/G48 NOT ALLOWED IN CRC"};
  static constexpr DiagnosticRow HomeInCycle{"PS044", "G27-G30 NOT ALLOWED IN FIXED CYC"};
  static constexpr DiagnosticRow NoQ{"PS045", "ADDRESS Q NOT FOUND (G73/G83)"};
  static constexpr DiagnosticRow IllegalReference{"PS046", "ILLEGAL REFERENCE RETURN COMMAND"};
  static constexpr DiagnosticRow CornerOfNoMove{"PS050", "CHF/CNR NOT ALLOWED IN 3RD BLK"};
  static constexpr DiagnosticRow MissingAfterCorner{"PS051", "MISSING MOVE AFTER CHF/CNR"};
  static constexpr DiagnosticRow NotStraightCorner{"PS052", "CODE IS NOT G01 AFTER CHF/CNR"};
  static constexpr DiagnosticRow CornerTooLarge{"PS055", "MISSING MOVE VALUE IN CHF/CNR"};
  static constexpr DiagnosticRow NotMonotonic{"PS064", "SHAPE PROGRAM NOT MONOTONOUSLY"};
  static constexpr DiagnosticRow IllegalContour{"PS065", "ILLEGAL COMMAND IN G70-G76"};
  static constexpr DiagnosticRow TooManyPockets{"PS068", "TEN OR MORE POCKETS"};
  static constexpr DiagnosticRow SequenceNotFound{"PS060", "SEQUENCE NUMBER NOT FOUND"};
  static constexpr DiagnosticRow IllegalProgramNumber{"PS074", "ILLEGAL PROGRAM NUMBER"};
  static constexpr DiagnosticRow NoP{"PS076", "ADDRESS P NOT DEFINED"};
  static constexpr DiagnosticRow Nesting{"PS077", "SUB PROGRAM NESTING ERROR"};
  static constexpr DiagnosticRow NumberNotFound{"PS078", "NUMBER NOT FOUND"};
  static constexpr DiagnosticRow NotMeasured{"PS080",
                                             "G37 MEASURING POSITION REACHED SIGNAL NOT INPUT"};
  static constexpr DiagnosticRow MeasuringAxis{"PS081", "OFFSET NUMBER NOT FOUND IN G37"};
  static constexpr DiagnosticRow MeasuringWords{"PS082", "H-CODE NOT ALLOWED IN G37"};
  static constexpr DiagnosticRow MeasuringFormat{"PS083", "ILLEGAL AXIS COMMAND IN G37"};
  static constexpr DiagnosticRow NotAtReference{"PS092", "AXES NOT ON THE REFERENCE POINT"};
  static constexpr DiagnosticRow Overflow{"PS111", "CALCULATED DATA OVERFLOW"};
  static constexpr DiagnosticRow DivisionByZero{"PS112", "DIVIDED BY ZERO"};
  static constexpr DiagnosticRow ImproperCommand{"PS113", "IMPROPER COMMAND"};
  static constexpr DiagnosticRow MacroFormat{"PS114", "FORMAT ERROR IN MACRO"};
  static constexpr DiagnosticRow IllegalVariable{"PS115", "ILLEGAL VARIABLE NUMBER"};
  static constexpr DiagnosticRow WriteProtected{"PS116", "WRITE PROTECTED VARIABLE"};
  static constexpr DiagnosticRow Brackets{"PS118", "PARENTHESIS NESTING ERROR"};
  static constexpr DiagnosticRow IllegalArgument{"PS119", "ILLEGAL ARGUMENT"};
  static constexpr DiagnosticRow TooManyModalCalls{"PS122", "QUADRUPLE MACRO MODAL-CALL"};
  static constexpr DiagnosticRow MacroInDnc{"PS123", "CAN NOT USE MACRO COMMAND IN DNC"};
  static constexpr DiagnosticRow MissingEnd{"PS124", "MISSING END STATEMENT"};
  static constexpr DiagnosticRow MacroFormat2{"PS125", "FORMAT ERROR IN MACRO"};
  static constexpr DiagnosticRow LoopNumber{"PS126", "ILLEGAL LOOP NUMBER"};
  static constexpr DiagnosticRow MixedStatement{"PS127", "NC, MACRO STATEMENT IN SAME BLOCK"};
  static constexpr DiagnosticRow MacroSequence{"PS128", "ILLEGAL MACRO SEQUENCE NUMBER"};
  static constexpr DiagnosticRow ArgumentAddress{"PS129", "ILLEGAL ARGUMENT ADDRESS"};
  static constexpr DiagnosticRow ScalingInCompensation{"PS141", "CAN NOT COMMAND G51 IN CRC"};
  static constexpr DiagnosticRow IllegalScale{"PS142", "ILLEGAL SCALE RATE"};
  static constexpr DiagnosticRow ScaledOverflow{"PS143", "SCALED MOTION DATA OVERFLOW"};
  static constexpr DiagnosticRow RotationPlane{"PS144", "ILLEGAL PLANE SELECTED"};
  static constexpr DiagnosticRow IllegalAxis{"PS190", "ILLEGAL AXIS SELECT"};
  static constexpr DiagnosticRow NoSpeed{"PS200", "ILLEGAL S CODE COMMAND"};
  static constexpr DiagnosticRow ExternalCall{"PS210", "CAN NOT COMMAND M198/M199"};
  static constexpr DiagnosticRow ParameterNumber{"PS231", "ILLEGAL FORMAT IN G10 L50"};
  static constexpr DiagnosticRow ShapeCommand{"PS325", "UNAVAILABLE COMMAND IS IN SHAPE PROGRAM"};
  static constexpr DiagnosticRow NoInverseFeed{"PS1202", "NO F COMMAND AT G93"};
  static constexpr DiagnosticRow EndOfRecord{"PS5010", "END OF RECORD"};
  static constexpr DiagnosticRow TipControl{"PS5421", "ILLEGAL COMMAND IN G43.4/G43.5"};
  static constexpr DiagnosticRow PlaneFormat{"PS5457", "G68.2 FORMAT ERROR"};
  static constexpr DiagnosticRow AxisDirection{"PS5458", "ILLEGAL USE OF G53.1"};
  // Ours.
  static constexpr DiagnosticRow OverTravel{"OT500", "OVER TRAVEL"};
  static constexpr DiagnosticRow RotationHome{"PS-rotation-home",
                                              "reference return while scaling or rotation is on"};
  static constexpr DiagnosticRow RotationOffset{
      "PS-rotation-offset", "a change of coordinates while scaling or rotation is on"};
  static constexpr DiagnosticRow PositionUnderTransform{"PS-g92-transform",
                                                        "G92 while scaling or rotation is on"};
  static constexpr DiagnosticRow OffsetArc{"PS-g45-arc", "G45 to G48 on an arc that is no quarter"};
  static constexpr DiagnosticRow UnusedAxis{"unused-axis", "nothing in the block takes"};
  static constexpr DiagnosticRow LoopLimit{"loop-limit", "the program repeats without end"};
  static constexpr DiagnosticRow LineTooLong{"line-too-long", "line too long"};
  static constexpr DiagnosticRow TextFailed{"text-failed", "program text cannot be read"};
};

/// What does not stop the program.
struct WarningCode {
  static constexpr DiagnosticRow FeedWithoutPoint{
      "feed-without-point", "F without a decimal point counts least increments"};
  static constexpr DiagnosticRow ArgumentWithoutPoint{
      "argument-without-point",
      "an argument without a decimal point counts least increments or units, by its letter"};
  static constexpr DiagnosticRow DuplicateWord{"duplicate-word",
                                               "a word is written twice; the last one counts"};
  static constexpr DiagnosticRow LowerCase{"lower-case", "small letters are read as capitals"};
  static constexpr DiagnosticRow OpenComment{"open-comment",
                                             "a comment is not closed; it ends with its line"};
  static constexpr DiagnosticRow ReturnWithoutReference{
      "g29-without-return", "G29 without a return to a reference point before"};
  static constexpr DiagnosticRow SharedOffset{
      "shared-offset", "a program writes an offset that serves as length and as radius"};
  static constexpr DiagnosticRow CycleInCompensation{
      "cycle-in-compensation", "a hole cycle while cutter compensation is on"};
  static constexpr DiagnosticRow PrintNotOpen{"print-not-open", "output without POPEN"};
  static constexpr DiagnosticRow SeveralM{"several-m",
                                          "several M codes in one block; all of them act"};
  static constexpr DiagnosticRow NoToolSelected{"no-tool-selected",
                                                "M06 without a T word before; the tool stays"};
  static constexpr DiagnosticRow BackBoringLevel{
      "g87-level", "G87 returns to the initial level; G99 means nothing to it"};
  static constexpr DiagnosticRow NestedReference{"nested-reference", "##1 is read as #[#1]"};
  static constexpr DiagnosticRow UnusedWord{"unused-word", "nothing in the block takes"};
  static constexpr DiagnosticRow IgnoredG53{"g53-in-g91", "G53 is ignored in G91"};
  static constexpr DiagnosticRow EndOfTapeByReturn{
      "m99-ends-tape", "M99 in a program from the line ends it; a line does not rewind"};
  static constexpr DiagnosticRow KeptPeck{"kept-peck",
                                          "the tap pecks by the Q of an earlier cycle block"};
  static constexpr DiagnosticRow LookAhead{
      "look-ahead", "the codes of look-ahead are read and change nothing here"};
  static constexpr DiagnosticRow ParameterOfRun{
      "parameter-of-run", "a parameter is in force to the end of the run; the setup keeps its own"};
  static constexpr DiagnosticRow SameGroup{
      "same-group", "two G codes of one group in a block; the last one is in force"};
  static constexpr DiagnosticRow ArcAsLine{"arc-as-line",
                                           "G02 or G03 without I, J, K and R is a straight line"};
  static constexpr DiagnosticRow ArcWithoutMove{
      "arc-without-move", "an arc by R that ends where it begins does not move"};
  static constexpr DiagnosticRow CycleLevels{"cycle-levels",
                                             "R is not between the initial level and the bottom"};
  static constexpr DiagnosticRow CycleWithoutShift{
      "cycle-without-shift", "G76 without Q retracts along the wall of the bore"};
  static constexpr DiagnosticRow TapWithoutSpeed{
      "tap-without-speed", "a tapping cycle while no spindle speed is commanded"};
};
// NOLINTEND(readability-identifier-naming)

/// PS3000 and up: the id of #3000 = `number`, which is 0 to kHighestUserAlarm.
inline constexpr int kHighestUserAlarm = 4095;
std::string_view user_alarm_id(int number);

}  // namespace dripline::interpreter::fanuc
