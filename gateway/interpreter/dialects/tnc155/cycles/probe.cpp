#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

bool define_probe(Run& run, const Block& block) {
  ProbeState& probe = run.state.cycle.probe;
  probe = {true, block.target, block.axis.value_or(Axis::Z), block.direction};
  if (probe.axis <= Axis::Z) return true;
  return run.fail(ErrorCode::WrongAxis, fmt::format("no probing along {}", letter(probe.axis)));
}

double sign_of(const ProbeState& probe) {
  return probe.direction == ProbeDirection::Positive ? 1 : -1;
}

/// Moves by a distance of the machine: clearance and travel are machine parameters and not scaled.
Target moved(const Run& run, Target target, double by) {
  const ProbeState& probe = run.state.cycle.probe;
  const double distance = sign_of(probe) * by / run.state.transformation.factor(probe.axis);
  target.set(probe.axis, target.at[static_cast<std::size_t>(probe.axis)] + distance);
  return target;
}

/// The point that is expected, in program coordinates.
Target nominal_point(Run& run, const Block& block) {
  Target point = here(run.state);
  read_coordinates(run, block, point);
  point.named = static_cast<AxisMask>(point.named | bit(run.state.cycle.probe.axis));
  return point;
}

/// In rapid to the clearance in front of the point, then at probing feed until contact.
bool begin_probing(Run& run, const Block& block) {
  const ControlOptions& options = run.options;
  const Target before = moved(run, nominal_point(run, block), -options.probe_clearance);
  line_to(run, before, kRapid);
  ProbeQuestion question;
  question.probe.origin = run.origin;
  question.probe.from = run.state.machine;
  question.probe.to = machine_position(run.state, moved(run, before, options.probe_travel));
  question.probe.feed = Feed::per_minute(Length::mm(options.probe_feed));
  return run.ask(question);
}

/// The probed coordinate: at the tip of the stylus along the tool axis, at the rim of its ball
/// across it.
double measured(const Run& run, const Position& at) {
  const State& state = run.state;
  const ProbeState& probe = state.cycle.probe;
  const AxisValues probed = state.transformation.to_program(values_of(at));
  const double value = probed[static_cast<std::size_t>(probe.axis)];
  if (probe.axis == state.tool.axis) return value;
  return value + sign_of(probe) * state.tool.data.radius / state.transformation.factor(probe.axis);
}

bool finish_probing(Run& run, const ProbeResult& result) {
  State& state = run.state;
  Probe event = std::get<ProbeQuestion>(run.question).probe;
  event.origin = run.origin;
  event.result = result;
  run.events().on_probe(event);
  const AxisValues before = state.nominal;
  state.machine = result.at;
  state.stand_at(state.transformation.to_program(values_of(result.at)));
  if (!result.tripped) {
    return run.fail(ErrorCode::TouchPointInaccessible,
                    fmt::format("no contact within {}",
                                shown_length(Length::mm(run.options.probe_travel), state.units)));
  }
  if (result.at.same_point(event.from)) {
    return run.fail(ErrorCode::TouchPointInaccessible, "the stylus is deflected at the start");
  }
  run.set_q(state.cycle.probe.q, measured(run, result.at) / state.mm_per_unit());
  Target back = here(state);
  back.set(state.cycle.probe.axis, before[static_cast<std::size_t>(state.cycle.probe.axis)]);
  line_to(run, back, kRapid);
  return true;
}

}  // namespace

bool probe(Run& run, const Block& block) {
  if (block.part == 0) return define_probe(run, block);
  if (run.answer) {
    run.ledger.take_all();  // of the question that is answered
    const bool went_well = finish_probing(run, std::get<ProbeResult>(*run.answer));
    run.state.last = LastMove{};
    resume_contour(run);
    return went_well;
  }
  if (!run.state.cycle.probe.is_defined) {
    return run.fail(ErrorCode::CycleIncomplete, "TCH PROBE 0.1 without 0.0");
  }
  if (!run.state.tool.is_called) {
    return run.fail(ErrorCode::ToolCallMissing, "the probe's axis is not known");
  }
  if (!refuse_before_positioning(run, "TCH PROBE")) return false;
  interrupt_contour(run);
  return begin_probing(run, block);
}

}  // namespace dripline::interpreter::tnc155
