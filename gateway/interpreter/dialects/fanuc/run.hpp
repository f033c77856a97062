#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/interpreter/core/interpreter.hpp"
#include "gateway/interpreter/core/language/word_ledger.hpp"
#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/errors.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/rotary_path.hpp"
#include "gateway/interpreter/dialects/fanuc/options.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/block.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/text_cursor.hpp"
#include "gateway/interpreter/dialects/fanuc/state.hpp"
#include "gateway/interpreter/dialects/fanuc/tilting/tilt_rules.hpp"
#include "gateway/interpreter/stages/blending/corner_blender.hpp"
#include "gateway/interpreter/stages/compensation/compensator.hpp"

namespace dripline::interpreter::fanuc {

/// What numbers without a decimal point count, and how fine lengths are, in the units in force.
struct Increments {
  double mm_per_unit = 1;
  double per_unit = 1000;  ///< least increments of a length in one unit
  double per_degree = 1000;
  int decimals = 3;
  int angle_decimals = 3;
  double x_factor = 1;  ///< 0.5 where X is a diameter
};

/// One run: what the files of this folder work on. Functions that cannot go on give false and
/// leave the reason in `pause`.
struct Run : BlockRun {
  Run(ControlOptions control_options, ProgramSource& program_source, EventSink& event_sink)
      : options(std::move(control_options)),
        source(program_source),
        sink(event_sink),
        rotary(event_sink, options.helix_feed_is_path),
        compensator(policy_of(options), event_sink),
        blender(corner_policy(), compensator),
        text(program_source, options.comment_over_eob) {}

  /// Where events go, after the header has been delivered.
  EventSink& events() {
    if (!state.has_header) [[unlikely]]
      deliver_header();
    return *front;
  }
  /// The contour of a cycle is being recorded.
  bool is_recording() const { return state.contour.code > kTurningCycles; }
  /// From the first G41, G42 or corner word on.
  compensation::CompensationSink& path() {
    if (state.uses_blender) return blender;
    return compensator;
  }

  /// After the state has another stage: `rotary`, `tilted`, the compensator, the blender, the
  /// recorder.
  void lead_stages();
  /// The same, and the stages continue from the state's position: that of the flat path or the
  /// tilted plane, or the machine's.
  void place_stages();

  /// Offset of `at` in the block, and its 1-based column.
  std::uint32_t offset(const char* at) const {
    return static_cast<std::uint32_t>(at - text.begin());
  }
  std::uint32_t column(const char* at) const { return offset(at) + 1; }

  /// Returns false, as `fail` does.
  [[gnu::cold]] bool ask(Question asked);
  [[gnu::cold]] void warn(const DiagnosticRow& row, std::uint32_t at_column,
                          std::string_view detail = {});
  /// The answer to the next question of the block in hand, or nullptr when it has yet to be asked.
  const Answer* next_answer() {
    return answers_used < answers.size() ? &answers[answers_used++] : nullptr;
  }

  /// After a change of units, offsets or anything that decides what a plain block means.
  void update_increments();
  void update_origin();
  std::size_t work_system() const;  ///< index of Coordinates::work
  void update_special();

  /// A word's number as millimeters; finer than the least increment is cut, computed is rounded.
  double length(const Word& word) const {
    const Increments& in = increments;
    double value = word.value;
    if (word.form == WordForm::Whole) {
      if (!options.calculator_point) value /= in.per_unit;
    } else if (word.form == WordForm::Computed) {
      value = std::round(value * in.per_unit) / in.per_unit;
    } else if (word.decimals > in.decimals) {
      value = cut(value, in.per_unit);
    }
    return value * in.mm_per_unit;
  }
  /// As degrees.
  double angle(const Word& word) const;
  /// Of a coordinate: millimeters or degrees.
  double coordinate(Axis axis, const Word& word) const {
    if (is_rotary(axis)) return angle(word);
    const double value = length(word);
    return axis == Axis::X ? value * increments.x_factor : value;
  }
  /// As a whole number, computed values rounded.
  double whole(const Word& word) const {
    return word.form == WordForm::Computed ? std::round(word.value) : word.value;
  }
  Feed active_feed() const {
    if (state.is_inverse_time()) [[unlikely]]
      return Feed::inverse_time(state.inverse_feed);
    const Length per = Length::mm(state.feed[state.is_per_revolution()]);
    return state.is_per_revolution() ? Feed::per_revolution(per) : Feed::per_minute(per);
  }
  /// An alarm at the G code of the block.
  bool fail_at_g(const DiagnosticRow& row, std::string_view why) {
    return fail(row, block.parts.g_column, why);
  }
  /// G09 of the block, G61 in force: a cutting feed comes to rest at its end.
  bool rests_at_end() const { return block.parts.one_shot == 9 || state.g[kPathGroup] == 61; }
  /// Millimeters to program units, for macro variables.
  double in_units(Axis axis, double raw) const {
    if (is_rotary(axis)) return raw;
    const double value = raw / increments.mm_per_unit;
    return axis == Axis::X ? value / increments.x_factor : value;
  }
  /// How texts for people show lengths.
  LengthDisplay length_display() const {
    return {.units = state.units, .x_is_diameter = options.x_is_diameter};
  }
  double in_length_units(double raw) const { return raw / increments.mm_per_unit; }
  double from_units(Axis axis, double value) const {
    if (is_rotary(axis)) return value;
    const double raw = value * increments.mm_per_unit;
    return axis == Axis::X ? raw * increments.x_factor : raw;
  }
  /// The present place in program coordinates before scaling and rotation; motion.cpp.
  double work_position(Axis axis) const {
    return state.position.raw(axis) - state.origin[static_cast<std::size_t>(axis)];
  }

  static double cut(double value, double per_unit) {
    // Decimal fractions are rarely exact in binary: what is written as a whole count must stay one.
    constexpr double kNudge = 1e-6;
    return std::trunc(value * per_unit + std::copysign(kNudge, value)) / per_unit;
  }

  const ControlOptions options;
  std::uint16_t skip_levels = options.skip_levels;  ///< the panel's switches
  ProgramSource& source;
  EventSink& sink;
  RotaryPath rotary;
  /// Where the moves of the path go: `rotary`, `tilted`, or the sink. `tilted` also checks the
  /// strokes of compensated moves.
  EventSink* last = &sink;
  compensation::Compensator compensator;
  blending::CornerBlender blender;  ///< in front of it
  TextCursor text;
  ModalState state;
  FanucTiltRules tilt_rules{options, state.zone};
  TiltedPath tilted{sink, tilt_rules};  ///< never with `rotary`
  ContourRecorder recorder{state.contour.moves, sink};
  EventSink* front = &sink;  ///< the first stage that the state has, or the sink
  Memory memory;
  Increments increments;
  std::string name;  ///< as the program calls itself; empty when it does not
  bool name_is_settled = false;

  Block block;
  language::WordLedger ledger;  ///< of the block in hand, unless it is a plain move
  std::vector<Answer> answers;  ///< of the block in hand, in the order asked
  std::size_t answers_used = 0;
  std::string scratch;  ///< output text being made

 private:
  [[gnu::cold]] void deliver_header();
};

/// The state between two blocks; snapshot.cpp.
Snapshot take_snapshot(const Run& run);
/// Errors: Unsupported (another dialect or version), Corrupt. `run` is then unchanged.
Result<void> restore_snapshot(Run& run, const Snapshot& snapshot);

}  // namespace dripline::interpreter::fanuc
