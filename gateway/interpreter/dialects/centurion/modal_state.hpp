#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "gateway/interpreter/core/block_interpreter.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/pattern.hpp"
#include "gateway/interpreter/dialects/centurion/motion/transform_stage.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"

/// Everything that stays from one block to the next. Lengths are in program units (`units` says
/// which), X is a radius, positions are machine coordinates with the tool length left out, unless
/// a comment states otherwise. `visit` (snapshot.cpp) lists the members of ModalState: add new ones
/// there.
namespace dripline::interpreter::centurion {

enum class MotionMode : std::uint8_t { Rapid, Line, Clockwise, Counterclockwise };
/// How cutting moves end; tapping mode also inhibits overrides and feed hold (manual: G63).
enum class PathMode : std::uint8_t { Cutting, ExactStop, Tapping };

inline constexpr std::size_t kMaxNesting = 50;  ///< calls, subroutines and loops, each
inline constexpr int kOffsetCount = 24;

/// Words that a later block may omit (manual: arcs, retained words).
struct RetainedWords {
  double radius = 0;
  double start_angle = 0;
  double end_angle = 0;
  double center_x = 0;  ///< I
  double center_z = 0;  ///< K
  bool has_radius = false;
  bool arc_has_radius = false;  ///< the last arc had R: the next one without R and center uses it
};

struct Modes {
  MotionMode motion = MotionMode::Line;
  bool is_incremental = false;
  bool is_feed_per_revolution = false;
  bool is_surface_speed = false;
  bool returns_to_clearance = false;  ///< G39
  bool takes_data = false;            ///< between G10 and G11
  std::uint8_t work_system = 0;       ///< 0 is G54
  std::uint8_t compensation = 0;      ///< 1 G41, 2 G42
  PathMode path = PathMode::Cutting;
  bool checks_zone = false;  ///< G22
};

struct SpindleModes {
  SpindleState state = SpindleState::Off;
  double revolutions = 0;  ///< last S under G97
  double surface = 0;      ///< last S under G96, feet or meters per minute
  double limit = 0;        ///< G50 S; 0 = none
};

struct ToolModes {
  int pending = 0;
  int pending_offset = -1;  ///< -1: the T word named none
  int active = 0;
  int offset = 0;
  bool has_no_length = false;  ///< G49, until a T word brings an offset
};

/// What the compensation stage was last set to.
struct NoseUse {
  std::uint8_t code = 0;  ///< 1 left, 2 right, 0 off
  double radius_mm = 0;
  double tip = 0;  ///< the tool type
  bool is_mirrored = false;
  friend bool operator==(const NoseUse&, const NoseUse&) = default;
};

/// Where the last G28 or G30 went first, in machine coordinates, and the axes it named.
struct ReferenceVia {
  Point at;
  bool x = false;
  bool z = false;
};

/// M98, CALL, and programs called with arguments.
struct CallFrame {
  TextPosition back;
  TextPosition entry;
  Point floating_zero;
  std::uint32_t passes_left = 0;
  std::uint8_t gosub_base = 0;  ///< subroutines and loops of the caller are out of reach
  std::uint8_t loop_base = 0;
  std::uint16_t custom = 0;   ///< the program, when a code of the machine called it
  bool changes_tool = false;  ///< in the place of M6
};
struct GosubFrame {
  TextPosition back;
  TextPosition entry;
  Point floating_zero;
  std::uint32_t passes_left = 0;
  std::uint8_t loop_base = 0;
};
struct LoopFrame {
  TextPosition head;  ///< before the WHILE block
  TextPosition next;  ///< after the WEND block
  std::uint64_t wend_offset = 0;
};

/// A jump that a block asked for and that needs text of another place; taken before the next block.
enum class JumpKind : std::uint8_t { None, Goto, Gosub, Call, While, Pattern };
struct Jump {
  JumpKind kind = JumpKind::None;
  bool is_call_word = false;  ///< CALL, not M98: its own error number
  bool condition = false;     ///< of WHILE
  std::uint32_t number = 0;
  std::uint32_t passes = 1;
  TextPosition from;         ///< WHILE: before its block
  std::uint16_t custom = 0;  ///< as of CallFrame
  bool changes_tool = false;
  bool is_not_in_ram = false;  ///< the RAM directory has been asked
};

/// What a P n = value between G10 and G11 will be.
struct DataChange {
  std::uint16_t number = 0;
  double value = 0;
};

/// What G990 wrote: a file Qnnnn of the control's RAM drive, for as long as the run lasts.
struct ParameterFile {
  std::uint32_t number = 0;
  std::vector<double> values;
};
inline constexpr std::size_t kMaxParameterFiles = 64;
inline constexpr int kUserParameters = 100;

/// Where the rest of the data is: parameters.hpp.
struct ModalState {
  RunPhase phase = RunPhase::Running;
  bool has_header = false;
  std::uint8_t moved_axes = 0;  ///< bit 0 X, bit 1 Z
  Units units = Units::Inch;
  std::uint64_t blocks = 0;
  TextPosition at;

  Point position;
  Point previous;
  /// Of the tool, as the last move took it in: 0 in an axis that machine coordinates have placed.
  Point length_taken;
  Point previous_machine;  ///< the machine before the last move, with that length
  Point origin;            ///< of the active coordinates: work system + floating zero + local zero
  Point floating_zero;     ///< G50
  Point local_zero;        ///< G52
  Transformation transformation;
  ReferenceVia reference_via;
  Point last_arc_center;
  double last_arc_radius = 0;
  double dwell_seconds = 0;
  std::array<double, 2> feed{};  ///< per minute, per revolution
  /// 98 or 99, in force when a cycle left its feed in P145; 0: the program has set it since.
  std::uint8_t cycle_feed_code = 0;
  Modes modes;
  RetainedWords retained;
  SpindleModes spindle;
  Coolant coolant;
  ToolModes tool;
  NoseUse nose;
  bool nose_is_stale = false;     ///< something that `nose` depends on may have changed
  bool uses_compensator = false;  ///< from the first G41, G42 or G65 on
  /// A start elsewhere than at the first block (start_search.hpp): where the machine is, where
  /// the program would have moved it (machine millimeters, X a radius), and the axes it moved.
  bool is_searching = false;
  Point searched_from;
  Point searched_to;
  std::uint8_t searched_axes = 0;
  bool wants_flood = false;   ///< M8 is in force; with the interlock that is not yet coolant
  std::uint32_t outputs = 0;  ///< a bit for each output pin: Z 1-12, then X 1-12 (pins.cpp)
  std::optional<OutputDevice> open_device;
  std::uint64_t random = 0x853c49e6748fea9bu;

  std::vector<CallFrame> calls;
  std::vector<GosubFrame> gosubs;
  std::vector<LoopFrame> loops;
  std::vector<ParameterFile> files;
  std::vector<DataChange> data_changes;  ///< each number once; G11 puts them into force
  Jump jump;
  PatternCycle pattern;                    ///< of G70-G73, while one runs
  std::vector<ModalState> before_pattern;  ///< one while a pattern is read: what it must not change

  double mm_per_unit() const { return interpreter::mm_per_unit(units); }
  double active_feed() const { return feed[modes.is_feed_per_revolution]; }
};

}  // namespace dripline::interpreter::centurion
