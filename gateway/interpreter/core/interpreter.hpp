#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gateway/interpreter/core/active_modes.hpp"
#include "gateway/interpreter/core/coordinate_frame.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter {

/// A question about something that the interpreter cannot know by itself. The step that asks
/// returns NeedsAnswer; `answer` resumes it.
struct ProbeQuestion {
  Probe probe;
};  ///< answered by ProbeResult
struct PromptQuestion {
  std::string text;
  std::string variable;
};  ///< answered by PromptAnswer
struct InputQuestion {
  int pin = 0;
};                       ///< state of an input pin; answered by bool
struct TimeQuestion {};  ///< the control's clock; answered by LocalTime
using Question = std::variant<ProbeQuestion, PromptQuestion, InputQuestion, TimeQuestion>;

struct PromptAnswer {
  std::optional<std::string> text;
};  ///< nullopt: the operator refused (ESC)
struct LocalTime {
  int year = 0, month = 1, day = 1, hour = 0, minute = 0, second = 0;
};
using Answer = std::variant<ProbeResult, PromptAnswer, bool, LocalTime>;
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

  /// Blocks finished so far: the *accepted* counter.
  virtual std::uint64_t blocks() const = 0;
  /// The block being executed, or the last one finished.
  virtual const Origin& origin() const = 0;
  /// The modes under which the block finished last was executed.
  virtual ActiveModes modes() const { return {}; }
  /// How program coordinates lie after that block; none where a control does not show it. Costs
  /// more than modes(): ask for it when modes().frame_changes has another value.
  virtual std::optional<CoordinateFrame> frame() const { return std::nullopt; }

  /// Both only at a block boundary, that is, not while a question is open.
  virtual Snapshot snapshot() const = 0;
  /// Continues from a snapshot of the same dialect and version. Errors: Unsupported, Corrupt; state
  /// is then unchanged.
  virtual Result<void> restore(const Snapshot& snapshot) = 0;
};

}  // namespace dripline::interpreter
