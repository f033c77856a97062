#include "gateway/interpreter/dialects/centurion/motion/probe_moves.hpp"

#include <fmt/core.h>
#include <algorithm>

namespace dripline::interpreter::centurion {
namespace {

/// The G code of the block that moves the machine otherwise, or gives axis words another meaning.
unsigned other_code(const Run& run) {
  const Block& block = run.block;
  if (const unsigned code = run.axis_code(); code != 0) return code;
  if (block.parts.thread_code != 0) return block.parts.thread_code;
  const auto end = block.g.begin() + block.parts.g_count;
  const auto retract = std::find_if(block.g.begin(), end, [](std::uint8_t row) {
    return g_row(row).code >= 45 && g_row(row).code <= 48;
  });
  return retract == end ? 0 : g_row(*retract).code;
}

bool refuse(Run& run, std::string_view why) {
  return run.fail(ErrorCode::IllegalStatement, motion_column(run), why);
}

/// Where the moves before it have led: with compensation on before, beside the program's point.
Position start_of(Run& run, AxesNamed named) {
  const Point at = machine_of(run, run.state.position);
  Position from = marked_position(run, at, at, named);
  for (const Axis axis : {Axis::X, Axis::Z})
    if (from.has(axis)) from.set(axis, run.sent().linear(axis));
  return from;
}

bool ask(Run& run, Probe& probe) {
  probe.origin = run.origin;
  probe.until = *run.block.parts.probe;
  if (!run.guard.allows(probe)) return check_path(run);
  return run.ask(ProbeQuestion{probe});
}

}  // namespace

bool check_probe(Run& run) {
  if (run.state.pattern.phase == PatternPhase::Reading)
    return refuse(run, "a probe move in a pattern that is roughed");
  if (const unsigned code = other_code(run); code != 0)
    return refuse(run, fmt::format("PROBE with G{}: it belongs to a move of G0 to G3", code));
  if (run.block.parts.macro != 0 || !run.block.words.has_any(kEndWords | kPolarWords))
    return refuse(run, "PROBE without a move in its block");
  return check_uncompensated(run, "PROBE");
}

bool probe_line(Run& run, const Target& target) {
  Probe probe;
  probe.is_rapid = run.state.modes.motion == MotionMode::Rapid;
  if (probe.is_rapid && run.parameters.point(kRapidOverrun) != Point{})
    return refuse(run, "PROBE with a G0 that approaches from one side (G00 unidirectional)");
  if (!probe.is_rapid && !check_feed(run)) return false;
  if (target.to == run.state.position) return true;
  run.events();  // the header comes before anything that follows the question
  if (!run.flush_path()) return false;
  const Point from = machine_of(run, run.state.position);
  probe.to = marked_position(run, from, machine_of(run, target.to), target.named);
  probe.from = start_of(run, {probe.to.has(Axis::X), probe.to.has(Axis::Z)});
  if (!probe.is_rapid) probe.feed = run.active_feed();
  return ask(run, probe);
}

bool probe_arc(Run& run, const Arc& programmed) {
  run.events();
  if (!run.flush_path()) return false;
  Arc arc = programmed;
  if (!run.transform.transform(arc)) return refuse_misfit(run);
  Probe probe;
  probe.from = start_of(run, kBothAxes);
  probe.to = arc.to;
  probe.feed = arc.feed;
  probe.arc = PathArc{arc.center_first, arc.center_second, arc.plane, arc.turn, arc.sweep};
  if (!is_at_program(run)) return run.fail(ErrorCode::CompensationNotStraight, motion_column(run));
  return ask(run, probe);
}

void finish_probe(Run& run, const ProbeResult& result) {
  Probe probe = std::get<ProbeQuestion>(run.question).probe;
  probe.origin = run.origin;
  probe.result = result;
  const double mm = run.state.mm_per_unit();
  const Point at{result.at.linear(Axis::X).mm() / mm, result.at.linear(Axis::Z).mm() / mm};
  const Point from = machine_of(run, run.state.position);
  probe.result->at = marked_position(run, from, at, {probe.to.has(Axis::X), probe.to.has(Axis::Z)});
  run.machine_events().on_probe(probe);
  arrive(run, programmed_of(run, at), {probe.to.has(Axis::X), probe.to.has(Axis::Z)});
}

}  // namespace dripline::interpreter::centurion
