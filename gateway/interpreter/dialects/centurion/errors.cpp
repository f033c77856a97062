#include "gateway/interpreter/dialects/centurion/errors.hpp"

#include <algorithm>
#include <array>

#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::centurion {
namespace {

struct ErrorText {
  std::uint16_t number;
  std::string_view text;
};

/// Every number the control has, in its order, with its wording, shortened. The manual prints 401
/// to 412 as ranges over the axes; X is first, since it uses 408 for Y.
constexpr std::array kTexts{
    ErrorText{1, "invalid function number"},
    ErrorText{2, "file not found"},
    ErrorText{3, "path not found"},
    ErrorText{4, "too many open files"},
    ErrorText{5, "file access denied"},
    ErrorText{6, "invalid file handle"},
    ErrorText{7, "memory control blocks destroyed"},
    ErrorText{8, "insufficient memory"},
    ErrorText{9, "invalid memory block address"},
    ErrorText{10, "invalid environment"},
    ErrorText{11, "invalid format"},
    ErrorText{12, "invalid file access code"},
    ErrorText{13, "invalid data"},
    ErrorText{15, "invalid drive specified"},
    ErrorText{16, "cannot remove current directory"},
    ErrorText{17, "cannot rename across drives"},
    ErrorText{18, "no more files"},
    ErrorText{100, "disk read error"},
    ErrorText{101, "disk write error, parts memory full"},
    ErrorText{102, "file not assigned"},
    ErrorText{103, "file not open"},
    ErrorText{104, "file not open for input"},
    ErrorText{105, "file not open for output"},
    ErrorText{106, "invalid numeric format"},
    ErrorText{150, "disk write-protected"},
    ErrorText{151, "unknown unit"},
    ErrorText{152, "drive not ready"},
    ErrorText{153, "unknown command"},
    ErrorText{154, "CRC error in data"},
    ErrorText{155, "bad drive request structure length"},
    ErrorText{156, "disk seek error"},
    ErrorText{157, "unknown media type"},
    ErrorText{158, "sector not found"},
    ErrorText{159, "printer out of paper"},
    ErrorText{160, "device write fault"},
    ErrorText{161, "device read fault"},
    ErrorText{162, "hardware failure"},
    ErrorText{163, "sharing violation"},
    ErrorText{200, "division by zero"},
    ErrorText{201, "range check error"},
    ErrorText{202, "stack overflow"},
    ErrorText{203, "heap overflow, insufficient RAM"},
    ErrorText{204, "invalid pointer operation"},
    ErrorText{205, "floating point overflow"},
    ErrorText{206, "floating point underflow"},
    ErrorText{207, "invalid floating point operation"},
    ErrorText{208, "overlay error"},
    ErrorText{209, "overlay error"},
    ErrorText{210, "object error"},
    ErrorText{211, "object error"},
    ErrorText{212, "object error"},
    ErrorText{213, "object error"},
    ErrorText{214, "object error"},
    ErrorText{300, "program already exists"},
    ErrorText{301, "invalid program number"},
    ErrorText{302, "no programs to select from"},
    ErrorText{303, "problem saving program(s) to disk"},
    ErrorText{304, "problem loading program(s) from disk"},
    ErrorText{305, "not formatted for conversational"},
    ErrorText{306, "conversational system has been corrupted"},
    ErrorText{307, "illegal event number"},
    ErrorText{308, "invalid tool number"},
    ErrorText{309, "can't copy or rename a file to itself"},
    ErrorText{310, "file not formatted for conversational or parameters"},
    ErrorText{311, "parameter file not valid"},
    ErrorText{312, "insufficient parts storage"},
    ErrorText{313, "insufficient storage for compression, file not posted"},
    ErrorText{314, "insufficient storage, post aborted"},
    ErrorText{315, "out of storage space on the floppy"},
    ErrorText{316, "not enough storage to create a new file"},
    ErrorText{319, "send file aborted"},
    ErrorText{400, "home required"},
    ErrorText{401, "software limit overtravel, X axis"},
    ErrorText{402, "software limit overtravel, Y axis"},
    ErrorText{403, "software limit overtravel, Z axis"},
    ErrorText{404, "software limit overtravel, A axis"},
    ErrorText{405, "software limit overtravel, B axis"},
    ErrorText{406, "software limit overtravel, C axis"},
    ErrorText{407, "excess error condition, X axis"},
    ErrorText{408, "excess error condition, Y axis"},
    ErrorText{409, "excess error condition, Z axis"},
    ErrorText{410, "excess error condition, A axis"},
    ErrorText{411, "excess error condition, B axis"},
    ErrorText{412, "excess error condition, C axis"},
    ErrorText{413, "attempted to move into safe zone"},
    ErrorText{415, "can't establish DNC link while program is running"},
    ErrorText{416, "out of position, arc end point is not on the arc"},
    ErrorText{417, "can't edit parameters while program is running"},
    ErrorText{418, "controller card error"},
    ErrorText{451, "lube fault, check the way lube level"},
    ErrorText{452, "tool not found in auto tool sequence"},
    ErrorText{453, "tool pot not up during turret movement"},
    ErrorText{454, "not at tool change position"},
    ErrorText{455, "ATC arm not out, axis movement not allowed"},
    ErrorText{456, "can't process auto tool change after switching to manual"},
    ErrorText{457, "move length too great for the control"},
    ErrorText{500, "last softkey not supported at this time"},
    ErrorText{501, "illegal address encountered"},
    ErrorText{502, "undefined canned cycle"},
    ErrorText{503, "RETURN without GOSUB"},
    ErrorText{504, "coincident points: start and end are the same on an arc without a center"},
    ErrorText{505, "radius too small to span the given points"},
    ErrorText{507, "after compensation line to arc lacks intersection"},
    ErrorText{509, "arcs lack intersection"},
    ErrorText{517, "parameter out of range"},
    ErrorText{518, "illegal program statement"},
    ErrorText{519, "feedrate out of range"},
    ErrorText{520, "spindle speed out of range"},
    ErrorText{521, "negative arc radius"},
    ErrorText{522, "negative polar radius"},
    ErrorText{523, "illegal tool number"},
    ErrorText{524, "illegal offset number"},
    ErrorText{526, "invalid access code"},
    ErrorText{527, "invalid access level"},
    ErrorText{529, "duplicate address encountered"},
    ErrorText{530, "colinear line to line in round corner"},
    ErrorText{531, "colinear line to arc in round corner"},
    ErrorText{532, "colinear arc to line in round corner"},
    ErrorText{533, "colinear arc to arc in round corner"},
    ErrorText{535, "chamfer length is < 0"},
    ErrorText{536, "can't chamfer and round the same corner"},
    ErrorText{537, "can't chamfer to or from arcs"},
    ErrorText{538, "loop counter out of range"},
    ErrorText{539, "dwell time out of range"},
    ErrorText{540, "illegal dwell time encountered"},
    ErrorText{541, "no axis moves are allowed on a G31 or G32 block"},
    ErrorText{542, "G30: illegal return to reference parameter"},
    ErrorText{543, "illegal G10 statement"},
    ErrorText{544, "too many digits in number"},
    ErrorText{545, "illegal K value for number of holes"},
    ErrorText{546, "nested calls or gosubs too deep"},
    ErrorText{547, "comment not closed"},
    ErrorText{549, "unrecognized G code"},
    ErrorText{550, "bad numeric format"},
    ErrorText{551, "multiple decimal points"},
    ErrorText{552, "missing \"]\""},
    ErrorText{553, "missing \"[\""},
    ErrorText{554, "tangent function overflow"},
    ErrorText{555, "missing \"/\""},
    ErrorText{556, "negative SQRT argument"},
    ErrorText{557, "unknown function"},
    ErrorText{560, "illegal relational operator"},
    ErrorText{567, "unresolved call"},
    ErrorText{568, "unresolved goto or gosub"},
    ErrorText{569, "tool too large to cut inside the arc"},
    ErrorText{570, "tool too large to cut inside the arc, first of two arcs"},
    ErrorText{571, "tool too large to cut inside the arc, second of two arcs"},
    ErrorText{577, "input statements must precede axis moves"},
    ErrorText{578, "undefined text cycle"},
    ErrorText{579, "compensated arcs do not intersect"},
    ErrorText{580, "argument of LN is zero or negative"},
    ErrorText{581, "operand of ** is zero or negative"},
    ErrorText{582, "X not monotonous in G71 with 45 degree relief"},
    ErrorText{583, "z not monotonous in G71"},
    ErrorText{584, "x value exceeds starting X in G71"},
    ErrorText{585, "Z not monotonous in G72 with 45 degree relief"},
    ErrorText{586, "x not monotonous in G72"},
    ErrorText{587, "z value exceeds starting Z in G72"},
    ErrorText{599, "syntax error"},
    ErrorText{600, "can't nest WHILE WEND loops"},
    ErrorText{601, "missing WHILE statement"},
    ErrorText{602, "missing WEND statement"},
    ErrorText{603, "program does not exist"},
    ErrorText{605, "can't modify dry run status while running"},
    ErrorText{606, "program is empty"},
    ErrorText{607, "can't exit DNC run mode while running"},
    ErrorText{608, "\"P\" expected in M98 block"},
    ErrorText{609, "G20 and G21 are not allowed in DNC FAST"},
    ErrorText{900, "RS232 overrun error"},
    ErrorText{901, "RS232 parity error"},
    ErrorText{902, "RS232 framing error"},
    ErrorText{903, "RS232 break detected"},
    ErrorText{950, "obsolete controller software"},
    ErrorText{951, "obsolete acroloop software"},
    ErrorText{952, "obsolete keyboard software"},
    // Of this software only.
    ErrorText{1001, "not supported yet"},
    ErrorText{1002, "block too long"},
    ErrorText{1003, "character not allowed"},
    ErrorText{1004, "program text cannot be read"},
    ErrorText{1005, "status parameter cannot be set here"},
    ErrorText{1006, "error forced by the program"},
    ErrorText{1007, "the cycle needs too many moves"},
    ErrorText{1008, "not allowed in DNC on this control"},
    ErrorText{1009, "the spindle must turn before the cycle"},
    ErrorText{1010, "the input waited for does not come"},
    ErrorText{1011, "probe move before the start"},
    ErrorText{1012, "the program repeats without end"},
    ErrorText{1013, "the start in the middle is not defined"},
    ErrorText{1020, "compensation begins and ends on straight moves"},
    ErrorText{1021, "too much between two compensated moves"},
    ErrorText{1022, "contour too narrow for the tool nose, where the control would back it up"},
    ErrorText{1030, "the corner does not fit"},
};

constexpr std::size_t kIdLength = 7;  // CEN0549
using IdText = std::array<char, kIdLength>;

constexpr IdText id_of(unsigned number) {
  IdText id{'C', 'E', 'N', '0', '0', '0', '0'};
  for (std::size_t i = kIdLength; number > 0; number /= 10) {
    id[--i] = static_cast<char>('0' + number % 10);
  }
  return id;
}

constexpr auto kIds = [] {
  std::array<IdText, kTexts.size()> ids{};
  for (std::size_t i = 0; i < kTexts.size(); ++i) ids[i] = id_of(kTexts[i].number);
  return ids;
}();

constexpr auto kErrorRows = [] {
  std::array<ErrorRow, kTexts.size()> rows{};
  for (std::size_t i = 0; i < kTexts.size(); ++i) {
    rows[i] = {{{kIds[i].data(), kIdLength}, kTexts[i].text},
               static_cast<ErrorCode>(kTexts[i].number)};
  }
  return rows;
}();

static_assert(std::adjacent_find(kTexts.begin(), kTexts.end(),
                                 [](const ErrorText& a, const ErrorText& b) {
                                   return a.number >= b.number;
                                 }) == kTexts.end(),
              "find_row needs every number once, in order");

const ErrorRow* find_row(unsigned number) {
  const auto* row = std::lower_bound(
      kErrorRows.begin(), kErrorRows.end(), number,
      [](const ErrorRow& each, unsigned key) { return static_cast<unsigned>(each.code) < key; });
  const bool is_found = row != kErrorRows.end() && static_cast<unsigned>(row->code) == number;
  return is_found ? row : nullptr;
}

}  // namespace

const ErrorRow& error_row(ErrorCode code) {
  const ErrorRow* row = find_row(static_cast<unsigned>(code));
  invariant(row != nullptr, "every error code has a row");
  return *row;
}

const ErrorRow& error_row_of_number(int number) {
  const ErrorRow* row =
      number > 0 && number < 1000 ? find_row(static_cast<unsigned>(number)) : nullptr;
  return row != nullptr ? *row : error_row(ErrorCode::ForcedError);
}

}  // namespace dripline::interpreter::centurion
