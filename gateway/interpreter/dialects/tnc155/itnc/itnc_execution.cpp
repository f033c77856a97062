#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/execution.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/flow.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

/// M functions beside the path's own, as they act at the begin and at the end of the block.
struct Extras {
  std::array<int, ItncWords::kMaxM> codes{};
  std::size_t count = 0;
  bool calls_cycle = false;   ///< M99
  bool begins_calls = false;  ///< M89
  bool ends = false;          ///< M2, M30
};

bool is_without_effect(int m) {
  return m == 90 || m >= 100;
}

bool sort_m(Run& run, Extras& extras) {
  const ItncWords& words = run.parts.itnc;
  for (std::size_t i = 0; i < words.m_count; ++i) {
    const int m = words.m[i];
    if (m == 99) {
      extras.calls_cycle = true;
    } else if (m == 89 && run.options.m89_modal) {
      extras.begins_calls = true;
    } else if (m == 2 || m == 30) {
      extras.ends = true;
    } else if (is_without_effect(m)) {
      if (m == 126 || m == 127) run.state.takes_shorter_path = m == 126;
      if (m == 116 || m == 117) run.state.has_linear_rotary_feed = m == 116;
      if (m == 90 || m == 107 || m == 108 || m == 120) {
        run.warn("TNC-ACCEPTED", fmt::format("M{} says nothing about the path here", m));
      }
    } else {
      extras.codes[extras.count++] = m;
    }
  }
  return true;
}

bool begin_codes(Run& run, const Extras& extras) {
  for (std::size_t i = 0; i < extras.count; ++i) {
    if (!begin_m(run, extras.codes[i])) return false;
  }
  return true;
}

bool end_codes(Run& run, const Extras& extras) {
  for (std::size_t i = 0; i < extras.count; ++i) {
    if (!end_m(run, extras.codes[i])) return false;
  }
  return true;
}

/// M89 where its block says which position is meant, and nothing else calls the cycle.
bool check_modal_call(Run& run, const Extras& extras, bool moves) {
  if (!extras.begins_calls || (moves && !extras.calls_cycle)) return true;
  return run.fail(ErrorCode::NotSupported, extras.calls_cycle
                                               ? "M89 and M99 in one block"
                                               : "M89 in a block that positions nothing");
}

/// M89 calls the cycle at the end of its own block and of each positioning block after it, until
/// M99, CYCL CALL or the definition of another cycle.
bool call_by_m(Run& run, const Extras& extras, bool moves) {
  bool& is_modal = run.state.cycle.is_modal_call;
  if (extras.begins_calls) is_modal = true;
  if (!extras.calls_cycle && !(is_modal && moves)) return true;
  if (extras.calls_cycle) is_modal = false;
  return call_cycle(run);
}

/// The cycle, then the end of the program.
bool finish(Run& run, const Extras& extras, bool moves = false) {
  if (!end_codes(run, extras) || !call_by_m(run, extras, moves)) return false;
  if (run.parts.itnc.tip == TipWords::End && !end_tip_control(run)) return false;
  if (!extras.ends) return true;
  // A later control takes neither M2 nor M30 in a called program; as a return the rest would be
  // cut.
  if (!run.state.programs.empty())
    return run.fail(ErrorCode::ProgramUnavailable, "M2 or M30 in a called program");
  end_program(run, true);
  return true;
}

bool use_tool_feed(Run& run) {
  if (!run.parts.itnc.is_auto_feed) return true;
  if (!(run.state.tool_feed > 0)) {
    return run.fail(ErrorCode::FeedRateMissing, "F AUTO, and TOOL CALL had no F");
  }
  run.state.feed = run.state.tool_feed;
  run.state.rotary_feed = rotary_feed_of(run, run.state.feed);
  return true;
}

/// M126: rotary axes rotate in the shorter direction. Up to half a turn that is what they do
/// anyway; beyond it the turns of the axis would have to be known.
bool check_shorter_path(Run& run, const Block& block) {
  constexpr double kHalfTurn = 180;
  for (const Coordinate& word : block.words()) {
    if (!is_rotary(word.axis)) continue;
    const double value = run.number(word.value);
    const double travel = word.is_incremental ? value : value - run.state.nominal_of(word.axis);
    if (std::fabs(travel) <= kHalfTurn) continue;
    return run.fail(ErrorCode::NotSupported,
                    fmt::format("M126 with {} going {:+.3f}, more than half a turn",
                                letter(word.axis), travel));
  }
  return true;
}

/// M116: F of a rotary axis is millimeters a minute, which depends on how far the tool is from the
/// axis. In rapid traverse, and under M128 where F is that of the tip, it changes nothing.
bool check_linear_rotary_feed(Run& run, const Block& block) {
  if (block.is_rapid) return true;
  bool moves_tip = false;
  std::optional<Axis> rotary;
  for (const Coordinate& word : block.words()) {
    const double value = run.coordinate(word.axis, word.value);
    const bool moves = word.is_incremental ? value != 0 : value != run.state.nominal_of(word.axis);
    if (moves && is_rotary(word.axis)) rotary = word.axis;
    moves_tip |= moves && !is_rotary(word.axis);
  }
  const bool is_tip_feed = run.tilted.kind() == tilting::Tilt::Kind::TipControl && moves_tip;
  return !rotary || is_tip_feed ||
         run.fail(ErrorCode::NotSupported,
                  fmt::format("{} at a feed under M116, in millimeters a minute: M117 before it",
                              letter(*rotary)));
}

/// M140: back along the tool axis, in rapid traverse where the block has no F.
bool retract(Run& run, const Block& block) {
  State& state = run.state;
  const ItncWords& words = run.parts.itnc;
  const bool has_axis = state.tool.is_called || run.options.kept_tool_axis;
  const Axis axis =
      state.tool.is_called ? state.tool.axis : run.options.kept_tool_axis.value_or(Axis::Z);
  if (block.coordinate_count != 0 || block.kind != BlockKind::Line || block.m != Block::kNone) {
    return run.fail(ErrorCode::NotSupported, "M140 in a block that moves otherwise");
  }
  if (!has_axis || state.is_compensating() || state.is_parallel) {
    return run.fail(ErrorCode::NotSupported,
                    has_axis ? "M140 within a contour"
                             : "M140 before TOOL CALL has named an axis (option tool_axis)");
  }
  if (state.cycle.is_modal_call) {
    return run.fail(ErrorCode::NotSupported, "M140 while M89 calls the cycle: end it with M99");
  }
  if (run.tilted.is_on() && !check_tilted_cycle(run, "M140")) return false;
  if (!read_feed(run, block)) return false;
  Pace pace = kRapid;
  if (block.feed.is_programmed()) pace = {false, state.feed, state.rotary_feed};
  if (!pace.is_rapid && !(pace.feed > 0))
    return run.fail(ErrorCode::FeedRateMissing, "M140 with F0");
  Target target = here(state);
  interrupt_contour(run);
  if (words.retracts_to_limit) {
    if (!run.options.limit_high.has(axis)) {
      return run.fail(ErrorCode::NotSupported,
                      fmt::format("M140 MB MAX: the setup has no limit_high of {}", letter(axis)));
    }
    const double limit = run.options.limit_high.raw(axis);
    if (run.tilted.is_on()) {
      if (run.options.kinematics.type != tilting::KinematicType::TableTable)
        return run.fail(ErrorCode::TiltFailed, "M140 MB MAX on a machine with a head");
      const double free = std::max(0.0, limit - run.tilted.machine().raw(axis));
      target.set(axis, target.at[index(axis)] + free);
      line_to(run, target, pace);
    } else if (limit > state.machine.raw(axis)) {
      target.set(axis, limit);
      machine_line_to(run, target, pace);
    }
  } else {
    const double distance = run.length(words.retract);
    if (distance < 0) return run.fail(ErrorCode::EntryOutOfRange, fmt::format("MB {}", distance));
    target.set(axis, target.at[index(axis)] + distance);
    line_to(run, target, pace);
  }
  state.last = LastMove{};
  state.polar.is_current = false;
  return true;
}

}  // namespace

/// F of an inch program is tenths of an inch, of a rotary axis degrees.
double rotary_feed_of(const Run& run, double feed) {
  constexpr double kTenths = 10;
  const bool is_inch = run.state.units == Units::Inch;
  return is_inch ? feed * kTenths / Length::kMillimetersPerInch : feed;
}

bool position(Run& run, const Block& block, bool (*move)(Run&, const Block&)) {
  const ItncWords& words = run.parts.itnc;
  const bool moves = block.coordinate_count != 0 || block.kind == BlockKind::PolarLine ||
                     block.kind == BlockKind::PolarArc;
  if (moves && block.kind != BlockKind::Approach) run.state.is_rapid_next = block.is_rapid;
  if (words.is_auto_feed && block.kind != BlockKind::Approach && !use_tool_feed(run)) return false;
  const bool is_plain = !run.state.cycle.is_modal_call && !run.state.takes_shorter_path &&
                        !run.state.has_linear_rotary_feed && !words.retracts &&
                        words.tip == TipWords::None && !run.tilted.is_on() &&
                        run.state.doubtful_shift == std::array<bool, 3>{} &&
                        !run.state.has_open_place;
  if (words.m_count == 0 && block.m == Block::kNone && is_plain) [[likely]]
    return move(run, block);
  Extras extras;
  if (!sort_m(run, extras)) return false;
  if (run.state.takes_shorter_path && !check_shorter_path(run, block)) return false;
  if (!check_modal_call(run, extras, moves) || !begin_codes(run, extras)) return false;
  if (words.tip == TipWords::Begin && !begin_tip_control(run)) return false;
  if (words.retracts) return retract(run, block) && finish(run, extras, moves);
  bool is_made = false;
  if (run.state.has_linear_rotary_feed && !check_linear_rotary_feed(run, block)) return false;
  if (!check_shift_is_known(run, block) || !leave_open_place(run, block)) return false;
  if (run.tilted.is_on() && !check_tilted_move(run, block, is_made)) return false;
  return (is_made || move(run, block)) && finish(run, extras, moves);
}

bool set_pole(Run& run, const Block& block) {
  State& state = run.state;
  state.pole_plane.reset();
  const Plane working = state.plane;
  for (const Plane plane : {Plane::XY, Plane::ZX, Plane::YZ}) {
    const PlaneAxes axes = axes_of(plane);
    if (plane == working || !block.names(axes.first) || !block.names(axes.second)) continue;
    state.plane = plane;
    state.pole_plane = plane;
  }
  const bool is_set = tnc155::set_pole(run, block);
  state.plane = working;
  return is_set;
}

/// Only circles without compensation: what continues them would be in another plane.
bool move_in_pole_plane(Run& run, const Block& block, bool (*move)(Run&, const Block&)) {
  State& state = run.state;
  const bool is_circle = block.kind == BlockKind::Arc || block.kind == BlockKind::PolarArc;
  if (!is_circle && block.kind != BlockKind::PolarLine) return move(run, block);
  const bool is_plain = block.compensation <= Compensation::Off && !state.is_compensating() &&
                        !state.is_parallel && !state.joins && !run.blend_follows;
  if (!is_circle || !is_plain ||
      (block.kind == BlockKind::PolarArc && block.coordinate_count != 0)) {
    return run.fail(ErrorCode::PlaneWronglyDefined,
                    "CC with the tool axis is for C and CP without compensation and corners");
  }
  const Plane working = std::exchange(state.plane, *state.pole_plane);
  const bool is_made = move(run, block);
  state.plane = working;
  state.last = LastMove{};
  state.polar.is_current = false;
  return is_made;
}

/// Where M128 and M129 say nothing about a path.
bool refuse_tip_words(Run& run) {
  return run.parts.itnc.tip == TipWords::None ||
         run.fail(ErrorCode::NotSupported, "M128 or M129 in this block");
}

bool stop_block(Run& run, const Block& block) {
  Extras extras;
  if (!refuse_tip_words(run)) return false;
  if (block.m != Block::kNone) {
    return run.fail(ErrorCode::BlockFormatIncorrect, fmt::format("STOP with M{}", block.m));
  }
  if (!sort_m(run, extras) || !check_modal_call(run, extras, false)) return false;
  if (!begin_codes(run, extras)) return false;
  const auto codes = std::span(extras.codes).first(extras.count);
  const bool stops_itself = std::ranges::find(codes, 0) != codes.end();
  if (!finish(run, extras)) return false;
  if (!stops_itself && !extras.ends) stop(run, StopKind::Program);
  return true;
}

bool cycle_call(Run& run, const Block& block) {
  Extras extras;
  if (!refuse_tip_words(run)) return false;
  if (block.m != Block::kNone) {
    return run.fail(ErrorCode::BlockFormatIncorrect, fmt::format("CYCL CALL with M{}", block.m));
  }
  if (!sort_m(run, extras) || !check_modal_call(run, extras, false)) return false;
  if (!begin_codes(run, extras)) return false;
  extras.calls_cycle = false;  // the call itself
  run.state.cycle.is_modal_call = false;
  return call_cycle(run) && finish(run, extras);
}

/// In the plane at a height that is free, then the cycle. All three axes are programmed; the one of
/// the tool shifts the surface of the cycle (iTNC 530, User's Manual Cycles: calling a cycle).
bool cycle_call_at(Run& run, const Block& block) {
  State& state = run.state;
  if (state.cycle.machining.number < 200) {
    return run.fail(ErrorCode::CycleIncomplete, "CYCL CALL POS without a cycle from 200 on");
  }
  if (state.is_compensating()) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted, "CYCL CALL POS needs R0");
  }
  Extras extras;
  if (!refuse_tip_words(run) || !check_tilted_cycle(run, "CYCL CALL POS")) return false;
  Target target = here(state);
  read_coordinates(run, block, target);
  const PlaneAxes axes = axes_of(state.plane);
  const AxisMask wanted =
      static_cast<AxisMask>(bit(axes.first) | bit(axes.second) | bit(state.tool.axis));
  if (target.named != wanted) {
    return run.fail(ErrorCode::BlockFormatIncorrect,
                    "CYCL CALL POS names both axes of the plane and the tool axis");
  }
  const double shift = target.at[index(state.tool.axis)];
  if (shift != 0) {
    return run.fail(
        ErrorCode::NotSupported,
        fmt::format("CYCL CALL POS with {}{:+.4f}: give the surface as Q203, and 0 here",
                    letter(state.tool.axis), shift));
  }
  if (!sort_m(run, extras) || !check_modal_call(run, extras, false)) return false;
  if (!begin_codes(run, extras) || !use_tool_feed(run)) return false;
  Pace pace = kRapid;
  const Value& feed = run.parts.itnc.feed;
  if (feed.is_programmed()) {
    pace.is_rapid = false;
    if (!read_cycle_feed(run, feed, pace.feed)) return false;
  } else if (!block.is_rapid) {
    pace = {false, state.feed, state.rotary_feed};
  }
  if (!pace.is_rapid && !(pace.feed > 0)) {
    return run.fail(ErrorCode::FeedRateMissing, "no F above 0 before CYCL CALL POS");
  }
  interrupt_contour(run);
  const double free = clearance_height(run);
  Target up = here(state);
  up.set(state.tool.axis, std::max(free, up.at[index(state.tool.axis)]));
  line_to(run, up, pace);
  Target over = here(state);
  over.set(axes.first, target.at[index(axes.first)]);
  over.set(axes.second, target.at[index(axes.second)]);
  line_to(run, over, pace);
  state.has_positioned = true;
  state.has_open_place = false;
  state.cycle.is_modal_call = false;
  return call_cycle(run) && finish(run, extras);
}

bool corner(Run& run, const Block& block) {
  State& state = run.state;
  const double feed = state.feed;
  const Value& own = run.parts.itnc.feed;
  if (own.is_programmed() && !read_cycle_feed(run, own, state.feed)) return false;
  if (!use_tool_feed(run)) return false;
  const bool is_made = make_blend(run, block);
  state.feed = feed;
  return is_made;
}

bool fail_plane_angle(Run& run, std::int32_t parameter) {
  return run.fail(ErrorCode::NotSupported,
                  fmt::format("Q{} before a PLANE has computed it", parameter));
}

/// Q120 to Q122 in the words of a block.
bool check_plane_angles(Run& run, const Block& block) {
  if (run.state.has_plane_angles) return true;
  for (const Coordinate& word : block.words()) {
    if (word.value.is_q() && is_plane_angle(word.value.number)) {
      return fail_plane_angle(run, word.value.number);
    }
  }
  return true;
}

bool accept(Run& run, const Block&) {
  // The control ends the plane there.
  if (run.tilted.is_on() && run.parts.itnc.name.starts_with("CYCL DEF 19"))
    return run.fail(ErrorCode::TiltFailed, "CYCL DEF 19 before PLANE RESET or M129");
  run.warn("TNC-ACCEPTED", fmt::format("{} is not followed", run.parts.itnc.name));
  return true;
}

}  // namespace dripline::interpreter::tnc155::itnc
