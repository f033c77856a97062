#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

#include <fmt/core.h>
#include <bit>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/path_feed.hpp"
#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/polar_coordinates.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/rotary_plane.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/length_in_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/tilting/tilting.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr double kMaxMillimeters = 99999.999;
constexpr double kMaxInches = 9999.9999 * Length::kMillimetersPerInch;

bool refuse_range(Run& run, Axis axis, double value) {
  return run.fail(ErrorCode::TooManyDigits, run.block.words.first_column(set_of_axis(axis)),
                  fmt::format("{}{} is beyond the range", letter(axis), run.in_units(axis, value)));
}

/// With scaling, rotation or polar coordinates.
bool read_transformed_target(Run& run, Position& to) {
  const Words& words = run.block.words;
  Point3 point = program_position(run);
  const Point3 before = point;
  const double most = run.state.units == Units::Inch ? kMaxInches : kMaxMillimeters;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!words.has(kWordOfAxis[i]) || is_polar_word(run.state, i)) continue;
    const double value = run.coordinate(static_cast<Axis>(i), words[kWordOfAxis[i]]);
    if (!(std::fabs(value) <= most)) return refuse_range(run, static_cast<Axis>(i), value);
    point[i] = run.state.is_incremental() ? before[i] + value : value;
  }
  if (run.state.is_polar() && !place_by_angle(run, point)) return false;
  const Point3 work = run.state.is_transformed ? transform(run.state, point) : point;
  for (std::size_t i = 0; i < 3; ++i) {
    const double raw = run.state.origin[i] + work[i];
    if (!(std::fabs(raw) <= kMaxMillimeters * 10)) {
      return run.fail(ErrorCode::ScaledOverflow, words.first_column(kAxisWords));
    }
    const auto axis = static_cast<Axis>(i);
    // What going there and back leaves of a place is no move.
    if (std::fabs(raw - to.raw(axis)) > 1e-9) to.set_raw(axis, raw);
    if (words.has(kWordOfAxis[i])) to.mark(axis);
  }
  return true;
}

bool single_direction(Run& run, const Position& to) {
  Position first = to;
  for (const Axis axis : kAllAxes) {
    const double overrun = run.options.single_direction[static_cast<std::size_t>(axis)];
    if (overrun == 0 || to.raw(axis) == run.state.position.raw(axis)) continue;
    first.set_raw(axis, to.raw(axis) + overrun);
  }
  return rapid_to(run, first) && rapid_to(run, to);
}

/// What #5061 and up show: of the axes, with the tool's offset.
void note_skip(Run& run) {
  for (const Axis axis : kAllAxes) {
    run.state.skip[static_cast<std::size_t>(axis)] =
        run.work_position(axis) + length_in_work_position(run, axis);
  }
}

bool cut_thread(Run& run, const Position& to) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  if (!(state.feed[1] > 0)) return run.fail(ErrorCode::NoFeed, words.first_column(kAxisWords));
  std::optional<Angle> start;
  if (words.has(Q)) start = Angle::degrees(run.angle(words[Q]));
  run.ledger.take(set_of(Q));
  return thread_to(run, to, Length::mm(state.feed[1]), start);
}

}  // namespace

bool read_target(Run& run, Position& to) {
  const ModalState& state = run.state;
  const Words& words = run.block.words;
  to = state.position;
  if (state.open_axes != 0 && !check_open_axes(run)) [[unlikely]]
    return false;
  if (run.rotary.is_on()) [[unlikely]]
    return read_rotary_target(run, to);
  const bool is_incremental = state.is_incremental();
  AddressSet left = words.present() & kAxisWords;
  if (state.is_transformed || state.is_polar()) [[unlikely]] {
    if (!read_transformed_target(run, to)) return false;
    left &= ~set_of(X, Y, Z);
  }
  const double most = state.units == Units::Inch ? kMaxInches : kMaxMillimeters;
  const auto take = [&](Axis axis, Address address) {
    const double value = run.coordinate(axis, words[address]);
    if (!(std::fabs(value) <= most)) [[unlikely]]
      return refuse_range(run, axis, value);
    const double base =
        is_incremental ? to.raw(axis) : state.origin[static_cast<std::size_t>(axis)];
    to.set_raw(axis, base + value);
    return true;
  };
  if ((left & set_of(X)) != 0 && !take(Axis::X, X)) return false;
  if ((left & set_of(Y)) != 0 && !take(Axis::Y, Y)) return false;
  if ((left & set_of(Z)) != 0 && !take(Axis::Z, Z)) return false;
  left &= ~set_of(X, Y, Z);
  if (left == 0) [[likely]]
    return true;
  for (std::size_t i = 3; i < kAxisCount; ++i) {
    if ((left & set_of(kWordOfAxis[i])) == 0) continue;
    if (!take(static_cast<Axis>(i), kWordOfAxis[i])) return false;
  }
  return true;
}

Position machine_point(const Run& run, const Point3& point) {
  const Point3 work = run.state.is_transformed ? transform(run.state, point) : point;
  Position to = run.state.position;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Axis>(i);
    const double raw = work[i] + run.state.origin[i];
    if (std::fabs(raw - to.raw(axis)) > 1e-9) to.set_raw(axis, raw);
  }
  return to;
}

namespace {

/// What F without a point counts per revolution. Lathes differ in it by powers of ten.
bool read_turn_unit(Run& run, const Word& word, double& unit) {
  if (!run.options.is_lathe || word.value == 0) return true;
  unit = run.options.feed_unit_turn;
  if (unit > 0) return true;
  return run.fail(ErrorCode::DecimalPoint, word.column,
                  fmt::format("F{} per revolution has no point, and the setup no "
                              "feed_unit_revolution",
                              word.value));
}

/// G93: so many of these moves in a minute; a number of its own, in either unit.
bool read_inverse_feed(Run& run, const Word& word) {
  constexpr double kMaxMoves = 99'999;
  if (!(word.value >= 0 && word.value <= kMaxMoves)) {
    return run.fail(ErrorCode::TooManyDigits, word.column,
                    fmt::format("F{} is not 0 to {}", word.value, kMaxMoves));
  }
  run.state.last.f = run.state.inverse_feed = word.value;
  return true;
}

}  // namespace

bool apply_feed(Run& run) {
  const Words& words = run.block.words;
  if (!words.has(F)) return true;
  ModalState& state = run.state;
  const Word& word = words[F];
  const bool is_inch = state.units == Units::Inch;
  double value = word.value;
  if (state.is_inverse_time()) [[unlikely]]
    return read_inverse_feed(run, word);
  if (word.form == WordForm::Whole && !run.options.calculator_point) {
    if (state.is_per_revolution()) {
      double unit = is_inch ? 0.0001 : 0.01;
      if (!read_turn_unit(run, word, unit)) return false;
      value *= unit;
    } else if (is_inch) {
      value *= run.options.feed_unit_inch;
    }
    if (is_inch) run.warn(WarningCode::FeedWithoutPoint, word.column);
  }
  const double most = state.is_per_revolution() ? (is_inch ? 9.9999 : 500)
                      : is_inch                 ? 9600
                                                : 240'000;
  if (!(value >= 0 && value <= most)) {
    return run.fail(ErrorCode::TooManyDigits, word.column,
                    fmt::format("F{} is above {}", value, most));
  }
  state.last.f = value;
  state.feed[state.is_per_revolution()] = value * run.increments.mm_per_unit;
  return true;
}

bool apply_lead(Run& run) {
  const Words& words = run.block.words;
  if (!words.has(F)) return true;
  const Word& word = words[F];
  double unit = run.state.units == Units::Inch ? 0.0001 : 0.01;
  const bool is_plain = word.form == WordForm::Whole && !run.options.calculator_point;
  if (is_plain && !read_turn_unit(run, word, unit)) return false;
  run.state.feed[1] = word.value * (is_plain ? unit : 1) * run.increments.mm_per_unit;
  return true;
}

bool check_feed(Run& run) {
  if (run.state.is_inverse_time()) [[unlikely]] {
    if (run.state.inverse_feed > 0) return true;
    return run.fail(ErrorCode::NoInverseFeed,
                    run.block.words.first_column(kAxisWords | kCenterWords));
  }
  if (run.state.feed[run.state.is_per_revolution()] > 0) [[likely]]
    return true;
  return run.fail(ErrorCode::NoFeed, run.block.words.first_column(kAxisWords | set_of(F)));
}

bool execute_plain(Run& run) {
  if (run.options.is_lathe && !resolve_increments(run)) [[unlikely]]
    return false;
  const Words& words = run.block.words;
  if (run.block.names(kMotionGroup)) {
    run.state.g[kMotionGroup] = run.block.g[kMotionGroup];
    run.state.box.code = 0;
  }
  if (words.has(F) && !apply_feed(run)) return false;
  if (run.state.g[kMotionGroup] > 1) {
    if (!words.has_any(kAxisWords | kCenterWords) && words.has(R)) [[unlikely]]
      run.warn(WarningCode::UnusedWord, words.column(R), "R");
    if (!run.state.length_in_axes.is_even) [[unlikely]]
      note_programmed_axes(run);
    return move_on_arc(run);
  }
  if (!words.has_any(kAxisWords)) return true;
  if (!run.state.length_in_axes.is_even) [[unlikely]]
    note_programmed_axes(run);
  Line line{run.origin, run.state.position, {}};
  if (!read_target(run, line.to)) return false;
  if (run.state.position.same_point(line.to)) return true;
  if (run.state.g[kMotionGroup] == 0) {
    run.events().on_rapid({run.origin, line.to});
  } else {
    if (!check_feed(run)) return false;
    line.feed = feed_into_stages(run, line.to, run.active_feed());
    line.rests = run.rests_at_end();
    run.events().on_line(line);
  }
  arrive(run, line.to);
  return true;
}

bool offset_target(Run& run, Position& to) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const std::uint8_t code = run.block.parts.one_shot;
  if (state.is_compensating()) {
    return run.fail(ErrorCode::OffsetInCompensation, run.block.parts.g_column);
  }
  if (words.has(H) && !words.has(D)) {
    if (!read_offset_number(run, H, state.d_number)) return false;
  }
  double value = radius_of_offset(run, state.d_number);
  if (run.options.offset_memory != OffsetMemory::C && value == 0) {
    value = length_of_offset(run, state.d_number);
  }
  const double change =
      (code == 45 || code == 46 ? value : 2 * value) * (code == 45 || code == 47 ? 1 : -1);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (!words.has(kWordOfAxis[i])) continue;
    const auto axis = static_cast<Axis>(i);
    const double travel = to.raw(axis) - state.position.raw(axis);
    double sign = travel > 0 ? 1 : -1;
    if (travel == 0) {
      if (!state.is_incremental()) continue;
      sign = words[kWordOfAxis[i]].is_negative ? -1 : 1;
    }
    to.set_raw(axis, to.raw(axis) + sign * change);
  }
  return true;
}

bool position_to(Run& run, const Position& to) {
  if (run.block.parts.one_shot == 60) return single_direction(run, to);
  return rapid_to(run, to);
}

bool move(Run& run) {
  const Words& words = run.block.words;
  const ModalState& state = run.state;
  const std::uint8_t mode = state.g[kMotionGroup];
  if (run.block.parts.one_shot != 60 && (mode == 2 || mode == 3)) return move_on_arc(run);
  const bool is_aimed = state.g[kLengthGroup] == kTipVector && words.has_any(kCenterWords);
  if (!words.has_any(kAxisWords) && !is_aimed) return true;
  if (mode >= kBoxTurning && mode <= kBoxFacing) return cut_box(run);
  run.ledger.take(kAxisWords);
  Position to;
  if (!read_target(run, to) || (is_aimed && !aim_tool(run, to))) return false;
  const std::uint8_t one_shot = run.block.parts.one_shot;
  if (one_shot >= 45 && one_shot <= 48 && !offset_target(run, to)) return false;
  if (mode == 0 || one_shot == 60) return position_to(run, to);
  if ((mode == 33 || mode == kVariableThread) && travel_between(state.position, to).rotary != 0) {
    return run.fail(ErrorCode::ImproperCommand, words.first_column(kRotaryWords),
                    "a thread that moves a rotary axis is not supported");
  }
  if (run.options.is_lathe && (mode == 33 || mode == kVariableThread)) {
    return cut_turned_thread(run, to);
  }
  if (mode == 33) return cut_thread(run, to);
  return check_feed(run) && line_to(run, to, run.active_feed());
}

bool move_in_machine_coordinates(Run& run) {
  const Words& words = run.block.words;
  run.ledger.take(kAxisWords);
  if (run.state.is_incremental()) {
    run.warn(WarningCode::IgnoredG53, run.block.parts.g_column);
    return true;
  }
  Position to = run.state.position;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (!words.has(kWordOfAxis[i])) continue;
    const auto axis = static_cast<Axis>(i);
    to.set_raw(axis, run.coordinate(axis, words[kWordOfAxis[i]]));
    run.state.placed.set_raw(axis, to.raw(axis));
  }
  note_machine_axes(run);
  return rapid_to(run, to);
}

bool start_skip(Run& run) {
  if (run.state.is_compensating()) {
    return run.fail(ErrorCode::SkipInCompensation, run.block.parts.g_column);
  }
  run.ledger.take(kAxisWords);
  Position to;
  if (!check_feed(run) || !read_target(run, to) || !check_stroke(run, to)) return false;
  if (run.state.position.same_point(to)) {
    note_skip(run);
    return true;
  }
  if (run.state.is_inverse_time()) {
    return run.fail(ErrorCode::ImproperCommand, run.block.parts.g_column, "G31 in G93");
  }
  if (!end_waiting(run)) return false;
  ProbeQuestion question;
  const Feed feed = feed_on_line(run, run.state.position, to, run.active_feed());
  question.probe = {run.origin, run.state.position, to, ProbeUntil::Contact, feed, {}};
  question.probe.from.mark_all_of(to);
  run.events();  // the header comes before anything the question brings about
  return run.ask(question);
}

Position finish_probe(Run& run, const ProbeResult& result) {
  Probe probe = std::get<ProbeQuestion>(run.question).probe;
  probe.origin = run.origin;
  Position at = probe.to;
  for (const Axis axis : kAllAxes) {
    if (result.at.raw(axis) != at.raw(axis) && probe.to.raw(axis) != run.state.position.raw(axis)) {
      at.set_raw(axis, result.at.raw(axis));
    }
  }
  probe.result = ProbeResult{result.tripped, at};
  run.events().on_probe(probe);
  arrive(run, at);
  return at;
}

void finish_skip(Run& run, const ProbeResult& result) {
  finish_probe(run, result);
  note_skip(run);
}

}  // namespace dripline::interpreter::fanuc
