#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/language/loop_guard.hpp"
#include "gateway/interpreter/core/language/word_ledger.hpp"
#include "gateway/interpreter/dialects/centurion/compensation/nose_compensation.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/pattern_recorder.hpp"
#include "gateway/interpreter/dialects/centurion/errors.hpp"
#include "gateway/interpreter/dialects/centurion/memory/parameters.hpp"
#include "gateway/interpreter/dialects/centurion/modal_state.hpp"
#include "gateway/interpreter/dialects/centurion/motion/transform_stage.hpp"
#include "gateway/interpreter/dialects/centurion/motion/travel_guard.hpp"
#include "gateway/interpreter/dialects/centurion/options.hpp"
#include "gateway/interpreter/dialects/centurion/reading/block.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"
#include "gateway/interpreter/dialects/centurion/start/start_notes.hpp"
#include "gateway/interpreter/stages/blending/corner_blender.hpp"
#include "gateway/interpreter/stages/compensation/compensator.hpp"

namespace dripline::interpreter::centurion {

/// One run: what the files of this folder work on. A function that cannot continue returns false
/// and leaves the reason in `pause`. A question undoes the item that asked it; the item is read
/// again from its start when the answer has come.
struct Run : BlockRun {
  Run(ControlOptions control_options, ProgramSource& program_source, EventSink& event_sink)
      : options(std::move(control_options)),
        source(program_source),
        sink(event_sink),
        guard(event_sink),
        recorder(guard, state),
        compensator(compensation_policy(), recorder),
        blender({}, event_sink),
        transform(*this, blender),
        text(program_source) {}

  /// The first stage in use. The header is delivered before the first event.
  EventSink& events() {
    if (front == nullptr) [[unlikely]]
      connect_stages();
    return *front;
  }
  /// Connects the stages that the state needs between the program's events and the sink. To be
  /// called when that or the state as a whole has changed.
  void connect_stages();
  /// Does the same once there has been an event; until then the first event will do it.
  void update_stages() {
    if (front == nullptr) return;
    // a move that waits is made under the rules it was read under
    if (guard.has_zone() != state.modes.checks_zone) blender.flush();
    connect_stages();
  }
  /// Whether a stage may have refused an event; `check_path` reports which and why.
  bool may_have_failed() const { return has_stages || blender.fault(); }
  /// Where moves in machine coordinates go, which are not transformed.
  EventSink& machine_events() {
    if (front == nullptr) [[unlikely]]
      connect_stages();
    return blender;
  }
  /// Reports the bar that the program cuts (P156 and P157), for graphics, if neither is 0.
  void report_blank();
  /// Restarts all stages at the program's position, compensation included if it is on.
  void restart_stages();
  void end_block();
  /// Ends the moves that wait in the stages as they are programmed. False: one was refused.
  bool flush_path();
  /// Where the moves given out by the stages have led.
  const Position& sent() const {
    return passes_compensator() ? compensator.sent() : blender.sent();
  }
  /// Whether the move of the block ends at rest (G9, G61).
  bool rests() const { return block.parts.rests || state.modes.path == PathMode::ExactStop; }

  /// Offset of `at` in the block, and its 1-based column.
  std::uint32_t offset(const char* at) const {
    return static_cast<std::uint32_t>(at - text.begin());
  }
  std::uint32_t column(const char* at) const { return offset(at) + 1; }

  using BlockRun::fail;
  [[gnu::cold]] bool fail(ErrorCode code, std::uint32_t at_column, std::string_view detail = {}) {
    return fail(error_row(code), at_column, detail);
  }
  [[gnu::cold]] bool ask(Question asked);
  /// The answer to the next question of the item in hand, or nullptr when it has yet to be asked.
  const Answer* next_answer();
  void begin_item(const char* at) {
    block.parts.resume = offset(at);
    answers_used = 0;
    random_at_item = state.random;
  }
  void item_done() {
    if (!answers.empty()) [[unlikely]]
      answers.clear();
    answers_used = 0;
  }

  /// The machine's position, as an event shows it.
  Position present_position() const;
  /// What the control has against the straight path between two places of the machine; empty:
  /// nothing.
  std::string travel_fault(const Position& from, const Position& to);
  /// To be called when anything has changed that the active coordinates are the sum of.
  void update_origin();
  /// The G code that decides what the axis words of the block mean; 0: they are a move's.
  unsigned axis_code() const {
    const std::uint8_t row = block.parts.axis_row;
    return row == kNoRow ? 0 : g_row(row).code;
  }
  Length length(double program_units) const {
    return Length::mm(program_units * state.mm_per_unit());
  }
  Feed active_feed() const {
    const Length per = length(state.active_feed());
    return state.modes.is_feed_per_revolution ? Feed::per_revolution(per) : Feed::per_minute(per);
  }

  const ControlOptions options;
  ProgramSource& source;
  EventSink& sink;
  TravelGuard guard;
  PatternRecorder recorder;
  compensation::Compensator compensator;
  blending::CornerBlender blender;
  TransformStage transform;
  TextCursor text;
  ModalState state;
  Parameters parameters;
  StartNotes start;  ///< used while a start is searched for
  std::string name;  ///< that the program gives itself, or empty
  bool is_name_final = false;

  Block block;
  language::LoopGuard loops;
  language::WordLedger ledger;  ///< the line words of this block
  std::vector<Answer> answers;  ///< to the questions of this item, in order
  std::size_t answers_used = 0;
  std::uint64_t random_at_item = 0;  ///< `state.random` when this item began
  std::string scratch;               ///< buffer for output text

  EventSink* front = nullptr;  ///< the first stage; none before the header
  bool has_stages = false;     ///< besides the blending stage

 private:
  bool guards_travel();
  bool passes_compensator() const;
  [[gnu::cold]] void deliver_header();
};

/// The state between two blocks; snapshot.cpp.
Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (another dialect or version), Corrupt. `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::centurion
