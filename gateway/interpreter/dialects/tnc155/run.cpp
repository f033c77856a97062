#include "gateway/interpreter/dialects/tnc155/run.hpp"

#include <fmt/core.h>
#include <limits>

namespace dripline::interpreter::tnc155 {
namespace {

/// Transitional arcs at outside corners, any number of blocks between two moves.
compensation::Policy policy() {
  compensation::Policy policy;
  policy.outside = compensation::OutsideCorner::Arc;
  policy.sharpest = Angle::degrees(180);
  policy.resume = compensation::Resume::OwnNormal;
  policy.blocks_without_motion = std::numeric_limits<int>::max();
  policy.rounds_at_rapid = true;
  policy.arc_at_rapid = Feed::per_minute(Length::mm(15'999));  // the highest that can be entered
  return policy;
}

blending::Policy corner_policy() {
  blending::Policy policy;
  policy.blends_rapids = true;
  policy.refuses_straight_corner = false;
  return policy;
}

}  // namespace

Run::Run(ControlOptions control_options, ProgramSource& program_source, EventSink& event_sink)
    : options(std::move(control_options)),
      source(program_source),
      limits(event_sink, options.limit_low, options.limit_high),
      sink(limits.has_any() ? static_cast<EventSink&>(limits) : event_sink),
      tilt_rules(options),
      tilted(sink, tilt_rules),
      path(options.kinematics.exists() ? static_cast<EventSink&>(tilted) : sink),
      compensator(policy(), path),
      blender(corner_policy(), compensator),
      reader(program_source,
             ReaderOptions{options.iso_continuation, options.version, options.is_itnc}) {}

void Run::deliver_header() {
  state.has_header = true;
  ProgramHeader header;
  header.control = options.is_itnc ? "itnc" : "tnc155";
  const std::string name = fmt::format("{}", state.program_number);
  if (state.program_number >= 0) header.name = name;
  if (options.is_itnc) header.name = state.program_name;
  header.units = state.units;
  sink.on_program(header);
}

void Run::use_stages() {
  if (state.uses_stages) return;
  events();  // the header first
  compensator.reset(state.machine);
  state.uses_stages = true;
}

void Run::begin_blending() {
  use_stages();
  if (state.joins) return;
  blender.reset(state.machine);
  blender.set_plane(state.plane);
  state.joins = true;
}

void Run::reset_stages() {
  compensator.reset(state.machine);
  blender.reset(state.machine);
  if (!tilted.is_on()) {
    limits.place(state.machine);
    tilted.place(state.machine, state.mm_per_unit());
  }
}

std::string TiltRulesOfTnc::travel_fault(const Position&, const Position& to, Units) const {
  const tilting::Kinematics& machine = options_.kinematics;
  for (const tilting::RotaryAxis* rotary : {&machine.master, &machine.slave}) {
    const double at = to.raw(rotary->axis);
    if (at >= rotary->low && at <= rotary->high) continue;
    return fmt::format("{} {:.4f} is not {} to {}", letter(rotary->axis), at, rotary->low,
                       rotary->high);
  }
  return {};
}

bool Run::fail(ErrorCode code, std::string_view detail) {
  return BlockRun::fail(error_row(code), 0, detail);
}

bool Run::fail_as(ErrorCode code, std::string_view text) {
  return BlockRun::fail({error_row(code).id, text}, 0);
}

std::string text_of(const LimitReached& limit) {
  return fmt::format("{} {}{}", error_row(ErrorCode::LimitSwitch).text, letter(limit.axis),
                     limit.is_positive ? '+' : '-');
}

bool Run::fail_at_limit() {
  const LimitReached& limit = *limits.reached();
  origin = limit.origin;
  return fail_as(ErrorCode::LimitSwitch, text_of(limit));
}

bool Run::fail_in_tilt() {
  const auto& fault = *tilted.fault();
  origin = fault.origin;
  return fail(fault.is_travel ? ErrorCode::LimitSwitch : ErrorCode::TiltFailed, fault.text);
}

bool Run::ask(Question asked) {
  if (limits.reached()) return fail_at_limit();
  if (state.start.is_searching) {
    return fail(ErrorCode::ProgramStartUndefined,
                "a start after TCH PROBE would lose what the probe has measured");
  }
  loops.note_progress();
  pause = Pause::ForQuestion;
  question = std::move(asked);
  return false;
}

void Run::warn(std::string_view id, std::string_view text) {
  events().on_warning({origin, diagnostic({id, text}, {}, origin.line)});
}

}  // namespace dripline::interpreter::tnc155
