#include "gateway/interpreter/dialects/centurion/cycles/pattern_cycles.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/compensation/nose_compensation.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/roughing.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"

namespace dripline::interpreter::centurion {
namespace {

PlanePoint in_millimeters(const Run& run, const Point& point) {
  return {run.length(point.x).mm(), run.length(point.z).mm()};
}

bool refuse(Run& run, const Origin& at, std::string why) {
  run.origin = at;
  return run.fail(ErrorCode::IllegalStatement, 0, std::move(why));
}

BlockOutcome refuse_label(Run& run, TextSearch::Outcome outcome, std::uint32_t label) {
  if (outcome != TextSearch::Outcome::Missing) return refuse_search(run, outcome);
  run.fail(ErrorCode::UnresolvedLabel, 0, fmt::format("N{} of the pattern", label));
  return BlockOutcome::Paused;
}

bool begin_reading(Run& run) {
  PatternCycle& cycle = run.state.pattern;
  run.events();  // delivers the header
  if (!run.flush_path()) return false;
  run.state.before_pattern.clear();
  run.state.before_pattern.push_back(ModalState(run.state));
  cycle.phase = PatternPhase::Reading;
  run.connect_stages();
  return true;
}

bool check_pattern(Run& run) {
  switch (run.state.pattern.fault) {
    case PatternFault::None:
      return true;
    case PatternFault::TooManyMoves:
      return run.fail(ErrorCode::CycleTooLong, 0,
                      fmt::format("the pattern has more than {}", kMaxPatternMoves));
    case PatternFault::Thread:
      return run.fail(ErrorCode::IllegalStatement, 0, "a thread in a pattern that is roughed");
    case PatternFault::Probe:
      break;
  }
  return run.fail(ErrorCode::IllegalStatement, 0, "a probe move in a pattern that is roughed");
}

/// The pass along the contour uses the pattern's feeds and speeds, so they stay in force.
void keep_feeds(ModalState& before, const ModalState& now) {
  before.feed = now.feed;
  before.spindle = now.spindle;
  before.modes.is_feed_per_revolution = now.modes.is_feed_per_revolution;
  before.modes.is_surface_speed = now.modes.is_surface_speed;
}

bool has_contour_pass(const PatternCycle& cycle) {
  return cycle.code != 73 && cycle.rough != PlanePoint{};
}

/// The tool has not moved, so all modes are restored; what is not a mode stays.
void restore_modes(Run& run) {
  ModalState& now = run.state;
  ModalState before = std::move(now.before_pattern.front());
  if (has_contour_pass(now.pattern)) keep_feeds(before, now);
  before.blocks = now.blocks;
  before.at = now.at;
  before.random = now.random;
  before.cycle_feed_code = now.cycle_feed_code;
  before.open_device = now.open_device;
  before.has_header = now.has_header;
  before.uses_compensator = now.uses_compensator;
  before.calls = std::move(now.calls);
  before.gosubs = std::move(now.gosubs);
  before.loops = std::move(now.loops);
  before.files = std::move(now.files);
  before.pattern = std::move(now.pattern);
  now = std::move(before);
  run.update_origin();
  run.restart_stages();
}

/// The moves came out of the stages in machine coordinates; the passes are made in the program's.
bool undo_transformation(Run& run) {
  const Transformation& how = run.state.transformation;
  if (!how.is_on()) return true;
  const bool is_uneven = how.scales && std::fabs(how.factor.x) != std::fabs(how.factor.z);
  const auto undo = [&run, mm = run.state.mm_per_unit()](PlanePoint& point) {
    const Point at = programmed_of(run, {point.x / mm, point.z / mm});
    point = {at.x * mm, at.z * mm};
  };
  for (PatternMove& move : run.state.pattern.moves) {
    undo(move.to);
    undo(move.center);
    if (how.swaps_sides()) move.is_clockwise = !move.is_clockwise;
    if (is_uneven && move.kind == PatternMove::Kind::Arc) {
      return refuse(run, run.state.pattern.origin,
                    "an arc in a pattern, with different scale factors");
    }
  }
  return true;
}

/// The pattern's last block has been read: its passes follow.
bool end_reading(Run& run) {
  PatternCycle& cycle = run.state.pattern;
  if (!run.flush_path() || !check_pattern(run)) return false;
  if (run.state.units != run.state.before_pattern.front().units) {
    return refuse(run, cycle.origin, "the units change in the pattern");
  }
  const Origin origin = run.origin;
  restore_modes(run);
  if (!undo_transformation(run)) return false;
  run.origin = cycle.origin;
  if (run.options.draws_part_path) {
    cycle.finish = cycle.rough = {};
    cycle.passes = 1;
    cycle.phase = PatternPhase::Repeats;
  } else if (cycle.code == 73) {
    if (cycle.moves.empty()) return refuse(run, cycle.origin, "the pattern has no moves");
    cycle.phase = PatternPhase::Repeats;
  } else {
    if (!check_roughing(run)) return false;
    cycle.phase = PatternPhase::Levels;
  }
  cycle.done = 0;
  cycle.tool = cycle.start;
  run.origin = origin;
  run.connect_stages();
  return true;
}

/// The tool is at the start point again, exactly.
void end_passes(Run& run) {
  run.flush_path();  // a refusal is reported at the end of the pass
  run.state.position = run.state.pattern.home;
  take_length(run, kBothAxes);
  run.state.pattern = PatternCycle{};
  run.connect_stages();
}

void cut_next_level(Run& run) {
  PatternCycle& cycle = run.state.pattern;
  PassWriter writer(run);
  if (cut_level(writer, roughing_of(cycle), cycle.done)) {
    ++cycle.done;
    return;
  }
  if (has_contour_pass(cycle)) {
    cut_contour(run, writer);
  } else {
    writer.rapid(cycle.start);
  }
  end_passes(run);
}

/// G73: pass k of D leaves the finish stock and (D - k) / D of the rough stock.
void repeat_pattern(Run& run) {
  PatternCycle& cycle = run.state.pattern;
  PassWriter writer(run);
  const double part = static_cast<double>(cycle.passes - cycle.done - 1) / cycle.passes;
  const PlanePoint stock{cycle.finish.x + cycle.rough.x * part,
                         cycle.finish.z + cycle.rough.z * part};
  const Origin origin = run.origin;
  bool is_first = true;
  for (const PatternMove& move : cycle.moves) {
    if (move.kind == PatternMove::Kind::Spindle) continue;
    run.origin.line = move.line;
    run.origin.sequence = move.sequence;
    if (is_first && move.kind == PatternMove::Kind::Arc) {
      writer.rapid({cycle.start.x + stock.x, cycle.start.z + stock.z});
    }
    is_first = false;
    writer.follow(move, stock, cycle.feed);
  }
  run.origin = origin;
  writer.rapid(cycle.start);
  if (++cycle.done == cycle.passes) end_passes(run);
}

}  // namespace

bool plan_pattern_cycle(Run& run) {
  if (run.state.pattern.phase != PatternPhase::None) {
    return run.fail(ErrorCode::IllegalStatement, 0, "a cycle in the pattern of a cycle");
  }
  PatternCycle cycle;
  cycle.code = static_cast<std::uint8_t>(run.axis_code());
  std::uint32_t first_label = 0;
  if (!read_pattern_words(run, cycle, first_label)) return false;
  cycle.phase = PatternPhase::Searching;
  cycle.origin = run.origin;
  cycle.home = run.state.position;
  cycle.start = in_millimeters(run, run.state.position);
  cycle.calls = static_cast<std::uint8_t>(run.state.calls.size());
  run.state.pattern = std::move(cycle);
  run.block.parts.jump = JumpKind::Pattern;
  run.block.parts.jump_number = first_label;
  return true;
}

namespace {

/// After the passes the text goes on after the pattern. One before its cycle would be cut without
/// end, and a block between the two never executed.
BlockOutcome check_place(Run& run, TextSearch& search, const TextPosition& first) {
  const PatternCycle& cycle = run.state.pattern;
  const TextPosition& after_cycle = run.state.at;
  if (first.offset < after_cycle.offset) {
    refuse(run, cycle.origin, fmt::format("the pattern of G{} is before it", cycle.code));
    return BlockOutcome::Paused;
  }
  std::uint64_t line = 0;
  const TextSearch::Outcome outcome = search.find_content(after_cycle, first.offset, line);
  if (outcome == TextSearch::Outcome::Missing) return BlockOutcome::NoBlock;
  if (outcome != TextSearch::Outcome::Found) return refuse_search(run, outcome);
  refuse(run, cycle.origin,
         fmt::format("line {} is between G{} and its pattern: it would never be executed", line,
                     cycle.code));
  return BlockOutcome::Paused;
}

}  // namespace

BlockOutcome enter_pattern(Run& run, TextSearch& search) {
  ModalState& state = run.state;
  PatternCycle& cycle = state.pattern;
  TextPosition first;
  TextPosition last;
  TextSearch::Outcome outcome = search.find_label(state.at, state.jump.number, first);
  if (outcome != TextSearch::Outcome::Found) {
    return refuse_label(run, outcome, state.jump.number);
  }
  outcome = search.find_label(state.at, cycle.last_label, last);
  if (outcome != TextSearch::Outcome::Found) return refuse_label(run, outcome, cycle.last_label);
  if (last.offset < first.offset) {
    refuse(run, cycle.origin, "the pattern's last block is before its first");
    return BlockOutcome::Paused;
  }
  if (cycle.code != 70) {
    const BlockOutcome checked = check_place(run, search, first);
    if (checked != BlockOutcome::NoBlock) return checked;
  }
  cycle.program = last.program;
  cycle.end_offset = last.offset;
  cycle.back = state.at;
  state.jump = Jump{};
  state.at = first;
  if (cycle.code != 70) {
    return begin_reading(run) ? BlockOutcome::NoBlock : BlockOutcome::Paused;
  }
  cycle.phase = PatternPhase::Finishing;
  return BlockOutcome::NoBlock;
}

bool leave_pattern_block(Run& run) {
  ModalState& state = run.state;
  PatternCycle& cycle = state.pattern;
  if (cycle.phase != PatternPhase::Finishing && cycle.phase != PatternPhase::Reading) return true;
  if (!check_pattern(run)) return false;
  if (state.calls.size() < cycle.calls) {
    if (cycle.phase == PatternPhase::Reading) {
      return refuse(run, run.origin, "the program returns out of the pattern");
    }
    cycle = PatternCycle{};
    return true;
  }
  if (run.origin.offset != cycle.end_offset || run.origin.program != cycle.program ||
      state.calls.size() != cycle.calls) {
    return true;
  }
  if (state.jump.kind != JumpKind::None) {
    return refuse(run, run.origin, "a jump in the last block of a pattern");
  }
  if (cycle.phase == PatternPhase::Reading) return end_reading(run);
  state.at = cycle.back;
  cycle = PatternCycle{};
  return true;
}

void make_pattern_pass(Run& run) {
  run.origin = run.state.pattern.origin;
  run.origin.block = run.state.blocks + 1;
  run.events();
  if (run.state.pattern.phase == PatternPhase::Repeats) return repeat_pattern(run);
  cut_next_level(run);
}

}  // namespace dripline::interpreter::centurion
