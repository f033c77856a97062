#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/language/loop_guard.hpp"
#include "gateway/interpreter/core/language/word_ledger.hpp"
#include "gateway/interpreter/dialects/tnc155/errors.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/travel_limits.hpp"
#include "gateway/interpreter/dialects/tnc155/options.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/state.hpp"
#include "gateway/interpreter/stages/blending/corner_blender.hpp"
#include "gateway/interpreter/stages/compensation/compensator.hpp"
#include "gateway/interpreter/stages/tilting/tilted_path.hpp"

namespace dripline::interpreter::tnc155 {

/// A TOOL DEF the run has not come to, and the units of its program.
struct DefinitionAhead {
  Block block;
  Units units = Units::Millimeter;
};

/// The rotary axes' travel for the stage of tilted planes.
class TiltRulesOfTnc final : public tilting::TiltRules {
 public:
  explicit TiltRulesOfTnc(const ControlOptions& options) : options_(options) {}
  const tilting::Kinematics& kinematics() const override { return options_.kinematics; }
  bool checks_travel() const override { return options_.kinematics.has_limits; }
  std::string travel_fault(const Position& from, const Position& to, Units units) const override;

 private:
  const ControlOptions& options_;
};

/// The mask that FN 16 is being read into.
struct MaskText {
  ProgramIndex program = kMainProgram;
  std::string text;
  bool is_whole = false;
};

/// TOOL CALL "NAME" of a later control.
struct ToolName {
  std::string name;
  std::int32_t number = 0;
};

struct Run;
/// A Q parameter that the search for a start reads (start_search.hpp).
[[gnu::cold]] void note_use(Run& run, std::int32_t parameter);

/// One run: the state that the files of this folder work on. Functions that cannot continue return
/// false and leave the reason in `pause`. Only the last action of a block may ask a question; that
/// action is executed again once the answer is there.
struct Run : BlockRun {
  Run(ControlOptions control_options, ProgramSource& program_source, EventSink& event_sink);

  /// Where events go, after the header has been delivered.
  EventSink& events() {
    if (!state.has_header) [[unlikely]]
      deliver_header();
    if (state.uses_stages) [[unlikely]]
      return stages();
    return path;
  }
  /// From now on events pass the stage for compensation.
  void use_stages();
  /// And the one for corners in front of it, from the next move on.
  void begin_blending();
  /// Places both stages at the position of the state, with nothing waiting.
  void reset_stages();
  void end_block() {
    if (state.uses_stages) [[unlikely]] {
      stages().on_block_end(origin);
    } else {
      path.on_block_end(origin);
    }
  }

  /// All return false. `detail` is appended to the control's text: the value, the limit.
  [[gnu::cold]] bool fail(ErrorCode code, std::string_view detail = {});
  /// With a text in place of the control's.
  [[gnu::cold]] bool fail_as(ErrorCode code, std::string_view text);
  [[gnu::cold]] bool fail_at_limit();
  [[gnu::cold]] bool fail_in_tilt();  ///< of `tilted`
  [[gnu::cold]] bool ask(Question asked);
  [[gnu::cold]] void warn(std::string_view id, std::string_view text);

  void set_q(std::int32_t parameter, double value) {
    state.q[static_cast<std::size_t>(parameter)] = value;
    if (parameter >= kFirstRetained)
      state.known_retained.set(static_cast<std::size_t>(parameter - kFirstRetained));
    ++q_changes;
  }
  /// The number of a word, or the value of its Q parameter; 0 for none. Every Q word is read here.
  double number(const Value& value) {
    if (!value.is_q()) [[likely]]
      return value.amount();
    if (state.start.is_searching) [[unlikely]]
      note_use(*this, value.number);
    const double held = state.q[static_cast<std::size_t>(value.number)];
    return value.is_negated ? -held : held;
  }
  /// As millimeters, a rotary axis's as degrees.
  double coordinate(Axis axis, const Value& value) {
    return is_rotary(axis) ? number(value) : number(value) * state.mm_per_unit();
  }
  double length(const Value& value) { return number(value) * state.mm_per_unit(); }

  const ControlOptions options;
  ProgramSource& source;
  TravelLimits limits;
  EventSink& sink;  ///< after the limits, where there are any
  TiltRulesOfTnc tilt_rules;
  tilting::TiltedPath tilted;  ///< PLANE and M128; in use only where there are kinematics
  EventSink& path;             ///< `tilted`, or the sink
  compensation::Compensator compensator;
  blending::CornerBlender blender;
  BlockReader reader;
  State state;
  std::vector<ToolDefinition> tools;                ///< of the setup: the central tool file
  std::vector<ToolName> tool_names;                 ///< of the setup's tools that have one
  std::optional<DefinitionAhead> definition_ahead;  ///< for the TOOL CALL being executed

  std::uint64_t q_changes = 0;         ///< how often a Q parameter was set
  std::optional<MaskText> mask;        ///< of the FN 16 being executed
  std::optional<ProgramIndex> called;  ///< by the jump that is being taken: it was found

  BlockParts parts;  ///< of the block being executed
  language::LoopGuard loops;
  language::WordLedger ledger;  ///< of the part being executed: its coordinates, by their place
  bool is_in_block = false;     ///< read, and not finished
  /// Machine coordinates (M91, M92) were named along the tool axis with a length in force: until
  /// the next tool. A machine that adds lengths has ended the program there.
  bool is_length_doubtful = false;
  bool is_measuring = false;           ///< moves are checked against the limits and not made
  std::optional<Block> contour_begin;  ///< the block after Approach, where it can be read
  bool blend_follows = false;          ///< RND or a chamfer follows the current part
  bool starts_contour = false;         ///< the part being executed is the first with RL or RR
  std::optional<Answer> answer;        ///< to the question of the part being executed

 private:
  EventSink& stages() {
    if (state.joins) return blender;
    return compensator;
  }
  [[gnu::cold]] void deliver_header();
};

/// As its alarm states it: "limit switch X+".
std::string text_of(const LimitReached& limit);

/// The state between two blocks; snapshot.cpp.
Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (another dialect or version), Corrupt. `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::tnc155
