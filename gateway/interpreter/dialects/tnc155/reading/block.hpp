#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "gateway/interpreter/core/event.hpp"

/// A program of the TNC 151/155 as data, the same for both of its forms. What executes a program
/// sees only this: a plain-language block is one `Block`; an ISO block, which may do several
/// things, becomes the plain-language blocks that do the same, in the control's order.
namespace dripline::interpreter::tnc155 {

/// A number as programmed, in steps of 1/10000 of its unit (mm, inch, degree, second, 1/min), or a
/// Q parameter with its sign, or nothing. Numbers of a metric program are multiples of 10.
struct Value {
  enum class Kind : std::uint8_t { None, Number, Q };
  static constexpr std::int32_t kStepsPerUnit = 10'000;

  static constexpr Value steps(std::int32_t steps) { return {steps, Kind::Number, false}; }
  static constexpr Value q(std::int32_t parameter, bool is_negated = false) {
    return {parameter, Kind::Q, is_negated};
  }
  constexpr bool is_programmed() const { return kind != Kind::None; }
  constexpr bool is_q() const { return kind == Kind::Q; }
  /// Of a number.
  constexpr double amount() const { return static_cast<double>(number) / kStepsPerUnit; }
  friend bool operator==(const Value&, const Value&) = default;

  std::int32_t number = 0;  ///< steps, or the number of the Q parameter (0-99)
  Kind kind = Kind::None;
  bool is_negated = false;  ///< of a Q parameter: -Q7
};

struct Coordinate {
  Value value;  ///< None only in the mirror cycle, which names axes
  Axis axis = Axis::X;
  bool is_incremental = false;
  friend bool operator==(const Coordinate&, const Coordinate&) = default;
};

enum class BlockKind : std::uint8_t {
  Begin,            ///< BEGIN PGM, %
  End,              ///< END PGM, the last %
  ToolDefinition,   ///< TOOL DEF, G99; without length and radius the next tool: G51
  ToolCall,         ///< TOOL CALL; T, S, G17-G20. Without a number no tool is changed
  Stop,             ///< STOP, G38
  Line,             ///< L; without coordinates only its tail applies (an ISO block of M and F)
  PolarLine,        ///< LP
  Chamfer,          ///< L and a length, G24
  Center,           ///< CC; without coordinates the last position: G29
  Arc,              ///< C
  PolarArc,         ///< CP; with a coordinate a helix
  TangentArc,       ///< CT
  Rounding,         ///< RND, G25-G27
  SingleAxis,       ///< an axis word at the start of the block, G07
  Label,            ///< LBL, G98
  LabelCall,        ///< CALL LBL, L
  ProgramCall,      ///< CALL PGM, %
  Function,         ///< FN, D
  CycleDefinition,  ///< one sub-block of CYCL DEF
  CycleCall,        ///< CYCL CALL, G79
  BlankForm,        ///< DEF BLK FORM, G30, G31
  Probe,            ///< TCH PROBE 0.0 and 0.1; G55 is both
  // of later controls alone (itnc/)
  RadiusArc,    ///< CR
  Assignment,   ///< Q1 = formula, FN 0 to FN 8, FN 13
  Comparison,   ///< FN 9 to FN 12
  Error,        ///< FN 14
  SystemRead,   ///< FN 18
  CycleTable,   ///< CYCL DEF 200 and above
  CycleCallAt,  ///< CYCL CALL POS
  Print,        ///< FN 15, FN 16
  Approach,     ///< APPR LT, LN, CT, LCT
  Departure,    ///< DEP LT, LN, CT, LCT
  Accepted,     ///< what says nothing about the path: a warning names it
  Plane,        ///< PLANE: a tilted working plane
  TipControl,   ///< FUNCTION TCPM
};

enum class Compensation : std::uint8_t {
  NotProgrammed,  ///< what was in force stays
  Off,            ///< R0, G40
  Left,           ///< RL, G41
  Right,          ///< RR, G42
  Longer,         ///< R+, G43: of single-axis blocks
  Shorter,        ///< R-, G44
};

/// Purpose of a rounding. Plain language does not state it: it follows from the adjacent blocks.
enum class RoundingUse : std::uint8_t { Unstated, Corner, TangentialApproach, TangentialDeparture };

enum class ProbeDirection : std::uint8_t { Negative, Positive };

/// One block. The comments name the kinds that use a member; all other members are as after
/// `clear`.
struct Block {
  static constexpr std::size_t kMaxCoordinates = 5;
  static constexpr std::int32_t kNone = -1;

  /// Everything not programmed.
  void clear(BlockKind new_kind);
  void add(Coordinate coordinate) { coordinates[coordinate_count++] = coordinate; }
  std::span<const Coordinate> words() const { return {coordinates.data(), coordinate_count}; }
  bool names(Axis wanted) const {
    return std::ranges::any_of(words(),
                               [=](const Coordinate& word) { return word.axis == wanted; });
  }
  friend bool operator==(const Block&, const Block&) = default;

  BlockKind kind = BlockKind::Line;

  // The tail. Line, PolarLine, Arc, PolarArc, TangentArc, SingleAxis: all of it; Stop, CycleCall:
  // m; CycleDefinition: feed.
  Compensation compensation = Compensation::NotProgrammed;
  bool is_rapid = false;  ///< F MAX, G00, G10: this block only
  std::int8_t m = kNone;

  std::uint8_t coordinate_count = 0;
  bool is_radius_incremental = false;  ///< IPR
  bool is_angle_incremental = false;   ///< IPA; IROT of cycle 10
  /// Arc, PolarArc, cycles 4 and 5. DR+ is counterclockwise. A reader always sets it.
  std::optional<Turn> turn;

  RoundingUse rounding = RoundingUse::Unstated;
  Units units = Units::Millimeter;  ///< Begin, End
  bool is_protected = false;        ///< Begin, End
  bool is_maximum = false;          ///< BlankForm

  std::uint8_t function = 0;    ///< of Function: 0-12
  std::uint16_t cycle = 0;      ///< CycleDefinition: 1-5, 7-12
  std::uint8_t part = 0;        ///< CycleDefinition: the digit after the point; Probe: 0, 1;
                                ///< Approach, Departure: LT, LN, CT, LCT
  std::optional<Axis> axis;     ///< ToolCall (see is_fourth), BlankForm: spindle axis; Probe 0: its
                                ///< axis; CycleDefinition 10: that of the plane an ISO block names
  bool is_fourth_axis = false;  ///< ToolCall: axis IV, whichever the machine has
  ProbeDirection direction = ProbeDirection::Negative;  ///< Probe 0

  /// The block number; kNone where it was omitted. All parts of one ISO block have the same
  /// number.
  std::int32_t number = kNone;

  /// ToolDefinition, ToolCall: tool. Label, LabelCall, Function 9-12: label. Begin, End,
  /// ProgramCall, cycle 12: program. Function 0-8, Probe 0: Q parameter of the result.
  std::int32_t target = kNone;
  std::int32_t repeats = kNone;  ///< LabelCall; kNone: a subprogram
  std::int32_t repeats_left =
      kNone;  ///< LabelCall: as the text shows it; a run begins with repeats

  Value feed;  ///< without decimals; in an inch program 0.1 inch/min
  /// PolarLine: PR. Rounding, Chamfer: R. ToolDefinition: R. Cycle 5.4: the circle's.
  Value radius;
  Value angle;    ///< PolarLine, PolarArc: PA. Cycle 10: ROT.
  Value length;   ///< ToolDefinition: L
  Value spindle;  ///< ToolCall: S; always a number
  /// CycleDefinition: set-up, depth, pecking, dwell. Function: first operand.
  Value first;
  Value second;             ///< Function: second operand
  std::int32_t factor = 0;  ///< cycle 11: SCL in millionths

  /// Line: 0-3; Arc: 1-2; TangentArc: 2; PolarArc: 0-1; Center: 0-2; SingleAxis: 1; BlankForm: 3;
  /// Probe 1: 1-3; cycles 3, 4: a side; cycle 7: a shift; cycle 8: axes without values.
  std::array<Coordinate, kMaxCoordinates> coordinates{};
};

/// The initial content of every block that is read. It is defined in another file on purpose: a
/// compiler that sees the zeros fills them in with one slow instruction instead of copying.
extern const Block kEmptyBlock;

inline void Block::clear(BlockKind new_kind) {
  *this = kEmptyBlock;
  kind = new_kind;
}

}  // namespace dripline::interpreter::tnc155
