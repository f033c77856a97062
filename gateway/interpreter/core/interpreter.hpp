#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/local_time.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "protocol/base/units.hpp"

namespace dripline::interpreter {

/// How program coordinates lie on the machine when a block has been executed: datum, shift, ROT,
/// SCL, mirrored axes and CC of a control's screen. For the position display, not for a trace.
/// Millimeters and degrees; index as in kAllAxes. A control fills the members it has, the rest
/// keeps its default.
struct CoordinateFrame {
  using Values = std::array<double, kAxisCount>;

  Values datum{};                        ///< machine coordinates: set by hand, or the work offset
  Values shift{};                        ///< added by the program: cycle 7, G52, G92
  double rotation = 0;                   ///< by the program or the work offset
  double basic_rotation = 0;             ///< that of the workpiece, as probed; not in `rotation`
  std::array<double, 3> scale{1, 1, 1};  ///< X, Y, Z; above 0
  std::array<bool, 3> mirrored{};
  std::array<double, 3> pole{};  ///< program coordinates of X, Y, Z
  std::uint8_t pole_axes = 0;    ///< which of them it has, bit 0 = X; 0: there is no pole

  /// The program coordinates of a machine position, both without tool length.
  Values to_program(const Values& machine) const;

  /// Derives the matrix from the control's own computation, which must be linear and leave all axes
  /// but X, Y and Z unchanged. `program_of` gives the program coordinates of machine coordinates.
  template <class ProgramOf>
  void learn(ProgramOf program_of) {
    constexpr double kFar = 1000;  // millimeters: far apart, cancellation costs fewer digits
    base_ = program_of(Values{});
    for (std::size_t column = 0; column < 3; ++column) {
      Values at{};
      at[column] = kFar;
      const Values moved = program_of(at);
      for (std::size_t row = 0; row < 3; ++row)
        turn_[3 * row + column] = (moved[row] - base_[row]) / kFar;
    }
  }
  /// The same for coordinates that are only shifted.
  void learn_offset(const Values& zero) {
    for (std::size_t i = 0; i < kAxisCount; ++i) base_[i] = -zero[i];
  }

 private:
  Values base_{};  ///< program coordinates of machine zero
  std::array<double, 9> turn_{1, 0, 0, 0, 1, 0, 0, 0, 1};
};

enum class CompensationSide : std::uint8_t { Off, Left, Right };

/// The modes that a control shows with the block in hand and that no event carries: for the
/// display, not for a trace. Every dialect fills those it has; the rest keeps its default.
struct ActiveModes {
  Units units = Units::Millimeter;
  bool is_incremental = false;
  CompensationSide compensation = CompensationSide::Off;
  std::uint16_t work_system = 0;  ///< its code in tenths: 540 is G54; 0: the control has none
  std::uint16_t work_page = 0;    ///< the P of G54.1; 0: none
  Length tool_length_x;           ///< wear included, a radius
  Length tool_length_y;           ///< wear included
  Length tool_length_z;           ///< wear included; along `length_axis`
  Axis length_axis = Axis::Z;     ///< of a mill that takes its length along another axis too
  bool is_length_plain = true;    ///< an axis is at position + length; false: not so simple
  /// For axes of a real machine, which are at position + length but for those that were brought to
  /// machine coordinates, bit 0 = X: these are without. False: tilted, of other axes, in doubt.
  bool is_length_certain = true;
  std::uint8_t bare_axes = 0;
  bool is_shifted = false;  ///< coordinates are not those of the datum; where no frame says so
  Length tool_radius;
  Feed feed;                        ///< as programmed
  std::string_view cycle;           ///< static storage; empty: no cycle
  std::optional<Axis> tool_axis;    ///< the spindle's, where programs choose it
  std::uint32_t frame_changes = 0;  ///< another number: Interpreter::frame has changed
  /// Of the tool, along X (a lathe's as a radius), Y and Z, mm.
  std::array<double, 3> lengths() const {
    std::array<double, 3> lengths{tool_length_x.mm(), tool_length_y.mm(), 0};
    const auto axis = static_cast<std::size_t>(length_axis);
    if (axis < lengths.size()) lengths[axis] += tool_length_z.mm();
    return lengths;
  }
  friend bool operator==(const ActiveModes&, const ActiveModes&) = default;
};

/// The name of G73, G74, G76 and G81 to G89 on a mill; empty for any other code.
std::string_view hole_cycle_name(int g_code);

/// A question about something that the interpreter cannot know by itself. The step that asks
/// returns NeedsAnswer; `answer` resumes it.
struct ProbeQuestion {
  Probe probe;
};  ///< answered by ProbeResult
struct PromptQuestion {
  std::string text;
  std::string variable;
};  ///< answered by PromptAnswer
/// What a program waits for at an input pin: that it changes, or is so. LinuxCNC's numbers.
enum class InputWait : std::uint8_t { Nothing, Rise, Fall, High, Low };
struct InputQuestion {
  int pin = 0;
  InputWait wait = InputWait::Nothing;
  double seconds = 0;  ///< that it waits at most
};  ///< answered by bool: the pin's state; of a wait, whether it was fulfilled in time
struct TimeQuestion {};  ///< the control's clock; answered by LocalTime
struct SignalQuestion {
  std::string name;
};  ///< a signal of the machine's own, a HAL pin of LinuxCNC; answered by SignalValue
using Question =
    std::variant<ProbeQuestion, PromptQuestion, InputQuestion, TimeQuestion, SignalQuestion>;

struct PromptAnswer {
  std::optional<std::string> text;
};  ///< nullopt: the operator refused (ESC)
struct SignalValue {
  std::optional<double> value;  ///< nullopt: there is none,
  std::string reason;           ///< and why
};
using Answer = std::variant<ProbeResult, PromptAnswer, bool, LocalTime, SignalValue>;
/// Whether `answer` is of the kind that `question` asks for.
bool fits(const Question& question, const Answer& answer);

enum class StepState {
  Ran,          ///< the budget is used up; more blocks follow
  NeedsText,    ///< the source gave NotYet; step again when it has more
  NeedsAnswer,  ///< see `question()`
  Ended,        ///< an End event was delivered
  Alarmed,      ///< an Alarm event was delivered; it is the last one
};

/// The whole state that decides what the rest of the program does, at a block boundary. The bytes
/// are private to a dialect and its version; equal digests mean equal states. README.md,
/// "Snapshots", names the users.
struct Snapshot {
  std::string dialect;
  std::uint32_t version = 0;
  std::vector<std::byte> bytes;
  Digest digest() const;

  /// Errors: Unsupported (another dialect or version).
  Result<void> check_kind(std::string_view expected_dialect, std::uint32_t expected_version) const;
  /// The error of bytes that do not read back.
  tl::unexpected<Error> damage() const;
};

/// One run of one program on one control. Pure: text, answers and setup come in, events go out; no
/// file, socket, clock, thread or global. Not thread-safe; any single thread may own it. Memory is
/// bounded by the dialect's limits, not by the program. The source and the sink must outlive it.
class Interpreter {
 public:
  virtual ~Interpreter() = default;

  /// Executes up to `max_blocks` blocks. Never blocks, and delivers a bounded number of events per
  /// block.
  virtual StepState step(std::uint64_t max_blocks) = 0;

  /// The open question; only after step() returned NeedsAnswer.
  virtual const Question& question() const = 0;
  /// Answers it. Errors: Syntax (an answer of the wrong kind; the question stays open).
  virtual Result<void> answer(const Answer& answer) = 0;

  /// The panel's switches for blocks that begin with a slash, from the next block on that is begun:
  /// bit n for /n, bit 1 also for / alone. No part of the state: a snapshot does not hold it.
  /// False: this control skips no blocks.
  virtual bool set_block_skip(std::uint16_t /*levels*/) { return false; }

  /// After the end of a program or of an MDI text: makes the state that of the control before it is
  /// given another text, from its first byte on. What its end leaves in force stays: modes, tool,
  /// offsets, variables. For a snapshot, which another interpreter restores. Errors: Unsupported
  /// (the control has no MDI; cutter compensation is on).
  virtual Result<void> begin_next_text() {
    return fail(Errc::Unsupported, "this control keeps no modes between texts");
  }

  /// After the end of a program: which program of its text the control reads when it is started
  /// again, counted from 1; a tape can hold several, and the reader is where it has stopped. May
  /// read on in the source.
  virtual std::uint32_t next_part() { return 1; }
  /// After the end of a program: continues with that one, if it comes after this one. Modes,
  /// position and counters go on too. False: nothing follows.
  virtual bool read_on() { return false; }

  /// Blocks finished so far: the *accepted* counter.
  virtual std::uint64_t blocks() const = 0;
  /// The block being executed, or the last one finished.
  virtual const Origin& origin() const = 0;
  /// The modes under which the block finished last was executed.
  virtual ActiveModes modes() const { return {}; }
  /// How program coordinates lie after that block; none where a control does not show it. Costs
  /// more than modes(): ask for it when modes().frame_changes has another value.
  virtual std::optional<CoordinateFrame> frame() const { return std::nullopt; }

  /// Whether rotary axes at `machine` tilt the tool against its axis, so that a move along that
  /// axis does not draw it straight out of a cut.
  virtual bool tilts_tool(const Position& /*machine*/) const { return false; }

  /// Why the control would not let its axes go straight from one place of the machine to another:
  /// its own limits of travel and zones; empty: it has nothing against it. Before the first block.
  virtual std::string travel_fault(const Position& /*from*/, const Position& /*to*/) { return {}; }

  /// Both only at a block boundary, that is, not while a question is open.
  virtual Snapshot snapshot() const = 0;
  /// Continues from a snapshot of the same dialect and version. Errors: Unsupported, Corrupt; state
  /// is then unchanged.
  virtual Result<void> restore(const Snapshot& snapshot) = 0;
};

}  // namespace dripline::interpreter
