
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

bool check_probe(Run& run, const Target& target) {
  const State& state = run.state;
  const Words& words = run.block.words;
  if (!words.has_any(set_of("XYZ@^"))) return run.fail(ErrorCode::ProbeNoAxis, 0);
  if (state.compensation.side != Side::Off) return run.fail(ErrorCode::CompProbe, 0);
  if (state.modes.feed == FeedMode::InverseTime) return run.fail(ErrorCode::ProbeG93, 0);
  if (state.modes.feed == FeedMode::PerRevolution) return run.fail(ErrorCode::ProbeG95, 0);
  if (state.feed == 0) return run.fail(ErrorCode::ZeroFeedProbe, 0);
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    if (target.to[index_of(axis)] != state[axis]) return run.fail(ErrorCode::ProbeRotary, 0);
  }
  double squares = 0;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const double part = target.to[index_of(axis)] - state[axis];
    squares += part * part;
  }
  // the later program refuses only what is no move
  const double least = run.is_linuxcnc()            ? 1e-9
                       : state.units == Units::Inch ? 0.01 * Length::kMillimetersPerInch
                                                    : 0.254;
  if (std::sqrt(squares) < least) return run.fail(ErrorCode::ProbeTooClose, 0);
  return true;
}

Position marked(Position position, const Target& target) {
  for (const Axis axis : kAllAxes) {
    if ((target.named & bit_of(axis)) != 0) position.mark(axis);
  }
  return position;
}

bool ask_probe(Run& run, const Target& target, int g_code) {
  Probe probe;
  probe.origin = run.origin;
  probe.from = run.state.machine;
  probe.to = marked(to_machine(run, target.to), target);
  probe.until = g_code <= 383 ? ProbeUntil::Contact : ProbeUntil::Release;
  probe.feed = run.modal_feed();
  return run.ask(ProbeQuestion{probe});
}

/// 5061 on: where it tripped, in program coordinates and units.
void store_result(Run& run, bool tripped) {
  const State& state = run.state;
  const double unit = state.mm_per_unit();
  for (const Axis axis : kAllAxes) {
    const double value = state[axis] / (is_rotary(axis) ? 1.0 : unit);
    const auto at = static_cast<std::size_t>(kProbeResult) + index_of(axis);
    if (index_of(axis) < 6 || run.is_linuxcnc()) run.parameters[at] = value;
  }
  run.parameters[kProbeSuccess] = tripped ? 1 : 0;
  if (!run.is_linuxcnc()) run.parameters[5067] = tripped ? 1 : 0;
}

/// Less than any axis resolves.
bool is_same_point(const Axes& a, const Axes& b) {
  constexpr double kNear = 1e-4;
  for (std::size_t i = 0; i < kAxisCount; ++i)
    if (std::fabs(a[i] - b[i]) > kNear) return false;
  return true;
}

/// G38.2 is an error in contact, and G38.4 free. A move until contact leaves the tool just there
/// for one until release, and conversely.
bool must_begin_otherwise(const Run& run, int g_code) {
  if (g_code == 383 || g_code == 385) return false;
  const int before = run.state.modes.motion;
  const bool is_other_kind = is_probe(before) && (before <= 383) != (g_code <= 383);
  return !is_other_kind;
}

bool finish_probe(Run& run, const Target& target, int g_code) {
  const auto result = std::get<ProbeResult>(*run.answer);
  run.answer.reset();
  Probe probe = std::get<ProbeQuestion>(run.question).probe;
  Axes machine;
  for (const Axis axis : kAllAxes) {
    const bool is_known = result.at.has(axis) || probe.to.has(axis);
    machine[index_of(axis)] = is_known ? result.at.raw(axis) : run.state.machine.raw(axis);
  }
  const bool has_moved = !is_same_point(machine, values_of(run.state.machine));
  Target stop;
  stop.to = to_program(run, machine);
  stop.named = target.named;
  const Position& at = arrive(run, stop);
  probe.result = ProbeResult{result.tripped, marked(at, target)};
  run.events().on_probe(probe);
  store_result(run, result.tripped);
  if (result.tripped && !has_moved && must_begin_otherwise(run, g_code))
    return run.fail(ErrorCode::ProbeTripped, 0);
  if (result.tripped || g_code == 383 || g_code == 385) return true;
  return run.fail(ErrorCode::ProbeNotTripped, 0);
}

}  // namespace

bool probe_move(Run& run, int g_code) {
  Target target;
  if (!read_target(run, target)) return false;
  if (run.answer) return finish_probe(run, target, g_code);
  return check_probe(run, target) && ask_probe(run, target, g_code);
}

}  // namespace dripline::interpreter::rs274ngc
