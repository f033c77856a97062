#include "gateway/interpreter/dialects/fanuc/errors.hpp"

#include <algorithm>
#include <array>

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::fanuc {
namespace {

using enum ErrorCode;

constexpr std::array kRows{
    ErrorRow{TooManyDigits, "PS003", "TOO MANY DIGITS"},
    ErrorRow{AddressNotFound, "PS004", "ADDRESS NOT FOUND"},
    ErrorRow{NoData, "PS005", "NO DATA AFTER ADDRESS"},
    ErrorRow{NegativeSign, "PS006", "ILLEGAL USE OF NEGATIVE SIGN"},
    ErrorRow{DecimalPoint, "PS007", "ILLEGAL USE OF DECIMAL POINT"},
    ErrorRow{IllegalAddress, "PS009", "ILLEGAL ADDRESS INPUT"},
    ErrorRow{ImproperG, "PS010", "IMPROPER G-CODE"},
    ErrorRow{NoFeed, "PS011", "NO FEEDRATE COMMANDED"},
    ErrorRow{RadiusTolerance, "PS020", "OVER TOLERANCE OF RADIUS"},
    ErrorRow{IllegalPlaneAxis, "PS021", "ILLEGAL PLANE AXIS COMMANDED"},
    ErrorRow{NoRadius, "PS022", "NO CIRCLE RADIUS"},
    ErrorRow{IllegalRadius, "PS023", "ILLEGAL RADIUS COMMAND"},
    ErrorRow{NoLengthAxis, "PS027", "NO AXES COMMANDED IN G43/G44"},
    ErrorRow{IllegalPlane, "PS028", "ILLEGAL PLANE SELECT"},
    ErrorRow{IllegalOffsetNumber, "PS030", "ILLEGAL OFFSET NUMBER"},
    ErrorRow{IllegalPInG10, "PS031", "ILLEGAL P COMMAND IN G10"},
    ErrorRow{IllegalValueInG10, "PS032", "ILLEGAL OFFSET VALUE IN G10"},
    ErrorRow{NoSolution, "PS033", "NO SOLUTION AT CRC"},
    ErrorRow{ArcAtStartUp, "PS034", "NO CIRC ALLOWED IN ST-UP/EXT BLK"},
    ErrorRow{CornerMoveNotAllowed, "PS035", "CAN NOT COMMANDED G39"},
    ErrorRow{SkipInCompensation, "PS036", "CAN NOT COMMANDED G31"},
    ErrorRow{PlaneInCompensation, "PS037", "CAN NOT CHANGE PLANE IN CRC"},
    ErrorRow{Interference, "PS041", "INTERFERENCE IN CRC"},
    ErrorRow{OffsetInCompensation, "PS042", "G45/G48 NOT ALLOWED IN CRC"},
    ErrorRow{HomeInCycle, "PS044", "G27-G30 NOT ALLOWED IN FIXED CYC"},
    ErrorRow{NoQ, "PS045", "ADDRESS Q NOT FOUND (G73/G83)"},
    ErrorRow{IllegalReference, "PS046", "ILLEGAL REFERENCE RETURN COMMAND"},
    ErrorRow{SequenceNotFound, "PS060", "SEQUENCE NUMBER NOT FOUND"},
    ErrorRow{IllegalProgramNumber, "PS074", "ILLEGAL PROGRAM NUMBER"},
    ErrorRow{NoP, "PS076", "ADDRESS P NOT DEFINED"},
    ErrorRow{Nesting, "PS077", "SUB PROGRAM NESTING ERROR"},
    ErrorRow{NumberNotFound, "PS078", "NUMBER NOT FOUND"},
    ErrorRow{NotAtReference, "PS092", "AXES NOT ON THE REFERENCE POINT"},
    ErrorRow{Overflow, "PS111", "CALCULATED DATA OVERFLOW"},
    ErrorRow{DivisionByZero, "PS112", "DIVIDED BY ZERO"},
    ErrorRow{ImproperCommand, "PS113", "IMPROPER COMMAND"},
    ErrorRow{MacroFormat, "PS114", "FORMAT ERROR IN MACRO"},
    ErrorRow{IllegalVariable, "PS115", "ILLEGAL VARIABLE NUMBER"},
    ErrorRow{WriteProtected, "PS116", "WRITE PROTECTED VARIABLE"},
    ErrorRow{Brackets, "PS118", "PARENTHESIS NESTING ERROR"},
    ErrorRow{IllegalArgument, "PS119", "ILLEGAL ARGUMENT"},
    ErrorRow{TooManyModalCalls, "PS122", "QUADRUPLE MACRO MODAL-CALL"},
    ErrorRow{MacroInDnc, "PS123", "CAN NOT USE MACRO COMMAND IN DNC"},
    ErrorRow{MissingEnd, "PS124", "MISSING END STATEMENT"},
    ErrorRow{MacroFormat2, "PS125", "FORMAT ERROR IN MACRO"},
    ErrorRow{LoopNumber, "PS126", "ILLEGAL LOOP NUMBER"},
    ErrorRow{MixedStatement, "PS127", "NC, MACRO STATEMENT IN SAME BLOCK"},
    ErrorRow{MacroSequence, "PS128", "ILLEGAL MACRO SEQUENCE NUMBER"},
    ErrorRow{ArgumentAddress, "PS129", "ILLEGAL ARGUMENT ADDRESS"},
    ErrorRow{ScalingInCompensation, "PS141", "CAN NOT COMMAND G51 IN CRC"},
    ErrorRow{IllegalScale, "PS142", "ILLEGAL SCALE RATE"},
    ErrorRow{ScaledOverflow, "PS143", "SCALED MOTION DATA OVERFLOW"},
    ErrorRow{RotationPlane, "PS144", "ILLEGAL PLANE SELECTED"},
    ErrorRow{IllegalAxis, "PS190", "ILLEGAL AXIS SELECT"},
    ErrorRow{NoSpeed, "PS200", "ILLEGAL S CODE COMMAND"},
    ErrorRow{ExternalCall, "PS210", "CAN NOT COMMAND M198/M199"},
    ErrorRow{EndOfRecord, "PS5010", "END OF RECORD"},
    ErrorRow{OverTravel, "OT500", "OVER TRAVEL"},
    ErrorRow{RotationHome, "PS-rotation-home", "reference return while scaling or rotation is on"},
    ErrorRow{RotationOffset, "PS-rotation-offset",
             "a change of coordinates while scaling or rotation is on"},
    ErrorRow{PositionUnderTransform, "PS-g92-transform", "G92 while scaling or rotation is on"},
    ErrorRow{OffsetArc, "PS-g45-arc", "G45 to G48 on an arc that is no quarter"},
    ErrorRow{UnusedAxis, "unused-axis", "nothing in the block takes"},
    ErrorRow{LoopLimit, "loop-limit", "the program repeats without end"},
    ErrorRow{LineTooLong, "line-too-long", "line too long"},
    ErrorRow{TextFailed, "text-failed", "program text cannot be read"},
};

/// In the order of WarningCode.
constexpr std::array kWarnings{
    WarningRow{"feed-without-point", "F without a decimal point counts least increments"},
    WarningRow{
        "argument-without-point",
        "an argument without a decimal point counts least increments or units, by its letter"},
    WarningRow{"duplicate-word", "a word is written twice; the last one counts"},
    WarningRow{"lower-case", "small letters are read as capitals"},
    WarningRow{"open-comment", "a comment is not closed; it ends with its line"},
    WarningRow{"g29-without-return", "G29 without a return to a reference point before"},
    WarningRow{"shared-offset", "a program writes an offset that serves as length and as radius"},
    WarningRow{"cycle-in-compensation", "a hole cycle while cutter compensation is on"},
    WarningRow{"print-not-open", "output without POPEN"},
    WarningRow{"several-m", "several M codes in one block; all of them act"},
    WarningRow{"no-tool-selected", "M06 without a T word before; the tool stays"},
    WarningRow{"g87-level", "G87 returns to the initial level; G99 means nothing to it"},
    WarningRow{"nested-reference", "##1 is read as #[#1]"},
    WarningRow{"unused-word", "nothing in the block takes"},
    WarningRow{"g53-in-g91", "G53 is ignored in G91"},
    WarningRow{"m99-ends-tape", "M99 in a program from the line ends it; a line does not rewind"},
    WarningRow{"kept-peck", "the tap pecks by the Q of an earlier cycle block"},
    WarningRow{"look-ahead", "the codes of look-ahead are read and change nothing here"},
    WarningRow{"same-group", "two G codes of one group in a block; the last one is in force"},
    WarningRow{"arc-as-line", "G02 or G03 without I, J, K and R is a straight line"},
    WarningRow{"arc-without-move", "an arc by R that ends where it begins does not move"},
    WarningRow{"cycle-levels", "R is not between the initial level and the bottom"},
    WarningRow{"cycle-without-shift", "G76 without Q retracts along the wall of the bore"},
    WarningRow{"tap-without-speed", "a tapping cycle while no spindle speed is commanded"},
};

constexpr std::size_t kIdLength = 6;
constexpr auto user_alarm_ids() {
  std::array<char, kIdLength*(kHighestUserAlarm + 1)> ids{};
  for (int number = 0; number <= kHighestUserAlarm; ++number) {
    char* at = ids.data() + kIdLength * static_cast<std::size_t>(number);
    at[0] = 'P';
    at[1] = 'S';
    int rest = 3000 + number;
    for (std::size_t place = kIdLength - 1; place >= 2; --place, rest /= 10) {
      at[place] = static_cast<char>('0' + rest % 10);
    }
  }
  return ids;
}
constexpr auto kUserAlarmIds = user_alarm_ids();

}  // namespace

const ErrorRow& error_row(ErrorCode code) {
  const auto* row = std::find_if(kRows.begin(), kRows.end(),
                                 [code](const ErrorRow& each) { return each.code == code; });
  invariant(row != kRows.end(), "every error code has a row");
  return *row;
}

std::string_view user_alarm_id(int number) {
  invariant(number >= 0 && number <= kHighestUserAlarm, "#3000 was checked");
  return {kUserAlarmIds.data() + kIdLength * static_cast<std::size_t>(number), kIdLength};
}

const WarningRow& warning_row(WarningCode code) {
  return kWarnings[static_cast<std::size_t>(code)];
}

}  // namespace dripline::interpreter::fanuc
