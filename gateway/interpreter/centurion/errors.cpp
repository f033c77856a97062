#include "gateway/interpreter/centurion/errors.hpp"

#include <algorithm>
#include <array>

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::centurion {
namespace {

using enum ErrorCode;

constexpr std::array kRows{
    ErrorRow{FileNotFound, "CEN0002", "file not found"},
    ErrorRow{DiskFull, "CEN0101", "disk write error, parts memory full"},
    ErrorRow{FileNotOpen, "CEN0103", "file not open"},
    ErrorRow{DivisionByZero, "CEN0200", "division by zero"},
    ErrorRow{FloatingOverflow, "CEN0205", "floating point overflow"},
    ErrorRow{InvalidFloating, "CEN0207", "invalid floating point operation"},
    ErrorRow{InvalidProgramNumber, "CEN0301", "invalid program number"},
    ErrorRow{OutOfPosition, "CEN0416", "out of position, arc end point is not on the arc"},
    ErrorRow{IllegalAddress, "CEN0501", "illegal address encountered"},
    ErrorRow{UndefinedCycle, "CEN0502", "undefined canned cycle"},
    ErrorRow{ReturnWithoutGosub, "CEN0503", "RETURN without GOSUB"},
    ErrorRow{CoincidentPoints, "CEN0504",
             "coincident points: start and end are the same on an arc without a center"},
    ErrorRow{RadiusTooSmall, "CEN0505", "radius too small to span the given points"},
    ErrorRow{ParameterOutOfRange, "CEN0517", "parameter out of range"},
    ErrorRow{IllegalStatement, "CEN0518", "illegal program statement"},
    ErrorRow{FeedOutOfRange, "CEN0519", "feedrate out of range"},
    ErrorRow{SpindleOutOfRange, "CEN0520", "spindle speed out of range"},
    ErrorRow{NegativeArcRadius, "CEN0521", "negative arc radius"},
    ErrorRow{NegativePolarRadius, "CEN0522", "negative polar radius"},
    ErrorRow{IllegalTool, "CEN0523", "illegal tool number"},
    ErrorRow{IllegalOffset, "CEN0524", "illegal offset number"},
    ErrorRow{DuplicateAddress, "CEN0529", "duplicate address encountered"},
    ErrorRow{LoopCounter, "CEN0538", "loop counter out of range"},
    ErrorRow{DwellOutOfRange, "CEN0539", "dwell time out of range"},
    ErrorRow{IllegalDwell, "CEN0540", "illegal dwell time encountered"},
    ErrorRow{IllegalG10, "CEN0543", "illegal G10 statement"},
    ErrorRow{TooManyDigits, "CEN0544", "too many digits in number"},
    ErrorRow{NestedTooDeep, "CEN0546", "nested calls or gosubs too deep"},
    ErrorRow{CommentNotClosed, "CEN0547", "comment not closed"},
    ErrorRow{UnknownGCode, "CEN0549", "unrecognized G code"},
    ErrorRow{BadNumber, "CEN0550", "bad numeric format"},
    ErrorRow{TwoPoints, "CEN0551", "multiple decimal points"},
    ErrorRow{MissingCloseBracket, "CEN0552", "missing \"]\""},
    ErrorRow{MissingOpenBracket, "CEN0553", "missing \"[\""},
    ErrorRow{TangentOverflow, "CEN0554", "tangent function overflow"},
    ErrorRow{MissingSlash, "CEN0555", "missing \"/\""},
    ErrorRow{NegativeRoot, "CEN0556", "negative SQRT argument"},
    ErrorRow{UnknownFunction, "CEN0557", "unknown function"},
    ErrorRow{IllegalRelation, "CEN0560", "illegal relational operator"},
    ErrorRow{UnresolvedCall, "CEN0567", "unresolved call"},
    ErrorRow{UnresolvedLabel, "CEN0568", "unresolved goto or gosub"},
    ErrorRow{InputAfterMove, "CEN0577", "input statements must precede axis moves"},
    ErrorRow{LogArgument, "CEN0580", "argument of LN is zero or negative"},
    ErrorRow{PowerBase, "CEN0581", "operand of ** is zero or negative"},
    ErrorRow{MissingWhile, "CEN0601", "missing WHILE statement"},
    ErrorRow{MissingWend, "CEN0602", "missing WEND statement"},
    ErrorRow{NoSuchProgram, "CEN0603", "program does not exist"},
    ErrorRow{EmptyProgram, "CEN0606", "program is empty"},
    ErrorRow{MissingP, "CEN0608", "\"P\" expected in M98 block"},
    ErrorRow{NotSupported, "CEN1001", "not supported yet"},
    ErrorRow{BlockTooLong, "CEN1002", "block too long"},
    ErrorRow{BadCharacter, "CEN1003", "character not allowed"},
    ErrorRow{TextFailed, "CEN1004", "program text can not be read"},
    ErrorRow{StatusParameter, "CEN1005", "status parameter can not be set here"},
    ErrorRow{ForcedError, "CEN1006", "error forced by the program"},
};

}  // namespace

const ErrorRow& error_row(ErrorCode code) {
  const auto* row = std::find_if(kRows.begin(), kRows.end(),
                                 [code](const ErrorRow& each) { return each.code == code; });
  invariant(row != kRows.end(), "every error code has a row");
  return *row;
}

const ErrorRow& error_row_of_number(int number) {
  const auto* row = std::find_if(kRows.begin(), kRows.end(), [number](const ErrorRow& each) {
    return static_cast<int>(each.code) == number;
  });
  return row != kRows.end() && number < 1000 ? *row : error_row(ForcedError);
}

}  // namespace dripline::interpreter::centurion
