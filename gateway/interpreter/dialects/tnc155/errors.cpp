#include "gateway/interpreter/dialects/tnc155/errors.hpp"

#include <array>

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

using enum ErrorCode;

struct ErrorRow {
  ErrorCode code;
  DiagnosticRow row;
};

constexpr std::array<ErrorRow, static_cast<std::size_t>(Count)> kRows{{
    {None, {"", ""}},
    {AngleReferenceMissing, {"TNC-ANGLE-REFERENCE", "ANGLE REFERENCE MISSING"}},
    {BlankFormIncorrect, {"TNC-BLANK-FORM", "BLK FORM DEFINITION INCORRECT"}},
    {BlockFormatIncorrect, {"TNC-BLOCK-FORMAT", "BLOCK FORMAT INCORRECT"}},
    {CircleEndIncorrect, {"TNC-CIRCLE-END", "CIRCLE END POS. INCORRECT"}},
    {CycleIncomplete, {"TNC-CYCLE-INCOMPLETE", "CYCL INCOMPLETE"}},
    {ExcessiveSubprogramming, {"TNC-NESTING", "EXCESSIVE SUBPROGRAMMING"}},
    {GCodeGroupAssigned, {"TNC-G-GROUP", "G-CODE GROUP ALREADY ASSIGNED"}},
    {IllegalGCode, {"TNC-ILLEGAL-G", "ILLEGAL G-CODE"}},
    {JumpToLabelZero, {"TNC-LABEL-ZERO", "JUMP TO LABEL 0 NOT PERMITTED"}},
    {MirrorOnToolAxis, {"TNC-MIRROR-AXIS", "MIRROR IMAGE ON TOOL AXIS"}},
    {NumberAllocated, {"TNC-NUMBER-ALLOCATED", "NUMBER ALREADY ALLOCATED"}},
    {PathOffsetWronglyStarted, {"TNC-PATH-OFFSET", "PATH OFFSET WRONGLY STARTED"}},
    {ProgramUnavailable, {"TNC-PGM-UNAVAILABLE", "PGM UNAVAILABLE"}},
    {MemoryExceeded, {"TNC-MEMORY", "PROGRAM MEMORY EXCEEDED"}},
    {PlaneWronglyDefined, {"TNC-PLANE", "PLANE WRONGLY DEFINED"}},
    {ProgramStartUndefined, {"TNC-START-UNDEFINED", "PROGRAM START UNDEFINED"}},
    {RoundingRadiusTooLarge, {"TNC-ROUNDING", "ROUNDING RADIUS TOO LARGE"}},
    {BlockNotAddressed, {"TNC-NOT-ADDRESSED", "SELECTED BLOCK NOT ADDRESSED"}},
    {SpindleRotatesMissing, {"TNC-SPINDLE-MISSING", "SPINDLE ROTATES MISSING"}},
    {ToolCallMissing, {"TNC-TOOL-CALL-MISSING", "TOOL CALL MISSING"}},
    {ToolRadiusTooLarge, {"TNC-TOOL-RADIUS", "TOOL RADIUS TOO LARGE"}},
    {TouchPointInaccessible, {"TNC-TOUCH-POINT", "TOUCH POINT INACCESSIBLE"}},
    {WrongAxis, {"TNC-WRONG-AXIS", "WRONG AXIS PROGRAMMED"}},
    {WrongRpm, {"TNC-WRONG-RPM", "WRONG RPM"}},
    {FeedRateMissing, {"TNC-FEED-MISSING", "FEED RATE MISSING"}},
    {LabelNotFound, {"TNC-LABEL-MISSING", "LBL NUMBER NOT FOUND"}},
    {ToolDefMissing, {"TNC-TOOL-DEF-MISSING", "TOOL DEF MISSING"}},
    {ArithmeticalError, {"TNC-ARITHMETIC", "ARITHMETICAL ERROR"}},
    {WrongSign, {"TNC-WRONG-SIGN", "WRONG SIGN PROGRAMMED"}},
    {LimitSwitch, {"TNC-LIMIT-SWITCH", "LIMIT SWITCH"}},
    {EntryOutOfRange, {"TNC-ENTRY-RANGE", "ENTRY VALUE INCORRECT"}},
    {BlockTooLong, {"TNC-BLOCK-TOO-LONG", "BLOCK TOO LONG"}},
    {BlockNumberOrder, {"TNC-BLOCK-NUMBER", "BLOCK NUMBER INCORRECT"}},
    {TextFailed, {"TNC-TEXT", "PROGRAM TEXT MISSING"}},
    {NotInBlockwiseTransfer, {"TNC-BLOCKWISE", "NOT PERMITTED IN BLOCKWISE TRANSFER"}},
    {NotSupported, {"TNC-NOT-SUPPORTED", "NOT SUPPORTED"}},
    {PocketMissing, {"TNC-POCKET", "NO FREE POCKET"}},
    {LoopLimit, {"TNC-LOOP-LIMIT", "PROGRAM REPEATS WITHOUT END"}},
    {ProgramError, {"TNC-PROGRAM-ERROR", "ERROR OF THE PROGRAM"}},
    {OptionMissing, {"TNC-OPTION", "FUNCTION NOT ENABLED"}},
    {TiltFailed, {"TNC-TILT", "TILTED WORKING PLANE"}},
}};

constexpr bool are_errors_in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (static_cast<std::size_t>(kRows[i].code) != i) return false;
  }
  return true;
}
static_assert(are_errors_in_order());

}  // namespace

const DiagnosticRow& error_row(ErrorCode code) {
  invariant(code < Count, "an error code has a row");
  return kRows[static_cast<std::size_t>(code)].row;
}

std::string Fault::text() const {
  return diagnostic(error_row(code), detail, 0).text;
}

}  // namespace dripline::interpreter::tnc155
