#include "gateway/interpreter/dialects/centurion/run.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"

namespace dripline::interpreter::centurion {

void Run::connect_stages() {
  if (!state.has_header) deliver_header();
  EventSink* last = guards_travel() ? static_cast<EventSink*>(&guard) : &sink;
  if (state.pattern.phase == PatternPhase::Reading) last = &recorder;
  if (passes_compensator()) {
    blender.lead_to(compensator);
  } else {
    blender.lead_to(*last);
  }
  front = state.transformation.is_on() ? static_cast<EventSink*>(&transform) : &blender;
  has_stages = passes_compensator() || last != &sink || front != &blender;
}

/// The passes of a cycle are made from moves that are compensated already.
bool Run::passes_compensator() const {
  return state.uses_compensator && !is_making_passes(state.pattern);
}

void Run::restart_stages() {
  if (state.uses_compensator) {
    compensator.cancel();
    compensator.place(present_position());
  }
  blender.place(present_position());
  resume_compensation(*this);
  connect_stages();
}

/// Brings the guard up to date. True when it has a limit, a zone or a feed to watch.
bool Run::guards_travel() {
  const auto area = [this](int positive, int negative) {
    const Point a = parameters.point(positive);
    const Point b = parameters.point(negative);
    return TravelArea{length(b.x).mm(), length(a.x).mm(), length(b.z).mm(), length(a.z).mm()};
  };
  const TravelArea limits = area(kPositiveLimit, kNegativeLimit);
  std::optional<TravelArea> zone;
  if (state.modes.checks_zone) {
    zone = area(kPositiveZone, kNegativeZone);
    if (zone->min_x > zone->max_x) std::swap(zone->min_x, zone->max_x);
    if (zone->min_z > zone->max_z) std::swap(zone->min_z, zone->max_z);
  }
  const Point maximum = parameters.point(kMaximumFeed);
  guard.set_maximum_feed({length(maximum.x).mm(), length(maximum.z).mm()});
  guard.set_units(state.units);
  guard.set_limits(limits);
  guard.set_zone(zone);
  guard.place(sent());
  const bool is_active = zone || maximum.x > 0 || maximum.z > 0 || limits.min_x < limits.max_x ||
                         limits.min_z < limits.max_z;
  guard.set_active(is_active);
  return is_active;
}

/// Every block reports its end, even one that does nothing, before the header or after it.
void Run::end_block() {
  if (front != nullptr) return blender.on_block_end(origin);
  sink.on_block_end(origin);
}

std::string Run::travel_fault(const Position& from, const Position& to) {
  if (!guards_travel()) return {};
  const auto fault = guard.fault_on_line(from, to);
  return fault ? fmt::format("{}: {}", error_row(fault->code).text, fault->detail) : std::string();
}

Position Run::present_position() const {
  Position at;
  const Point machine = machine_of(*this, state.position);
  at.set(Axis::X, length(machine.x));
  at.set(Axis::Z, length(machine.z));
  if (!(state.moved_axes & 1)) at.unmark(Axis::X);
  if (!(state.moved_axes & 2)) at.unmark(Axis::Z);
  return at;
}

void Run::deliver_header() {
  state.has_header = true;
  ProgramHeader header;
  header.control = "centurion";
  if (!name.empty()) header.name = name;
  header.units = state.units;
  header.x_is_diameter = true;
  sink.on_program(header);
  if (state.modes.path == PathMode::Tapping) sink.on_override_inhibit(override_inhibit(*this));
  report_blank();
}

/// The bar reaches from the face at Z0 toward the chuck, about the program's X0 (manual:
/// graphics).
void Run::report_blank() {
  const double size = parameters[kMaterialLength], diameter = parameters[kMaterialDiameter];
  if (!(size > 0 && diameter > 0)) return;
  Blank blank{.origin = origin, .spindle_axis = Axis::Z, .min = {}, .max = {}};
  blank.min.set(Axis::X, length(state.origin.x - diameter / 2));
  blank.max.set(Axis::X, length(state.origin.x + diameter / 2));
  blank.min.set(Axis::Y, length(-diameter / 2));
  blank.max.set(Axis::Y, length(diameter / 2));
  blank.min.set(Axis::Z, length(state.origin.z - size));
  blank.max.set(Axis::Z, length(state.origin.z));
  sink.on_blank(blank);
}

bool Run::flush_path() {
  blender.flush();
  if (state.uses_compensator) compensator.flush();
  return !may_have_failed() || check_path(*this);
}

bool Run::ask(Question asked) {
  // for an operator or a probe the tool must have arrived
  const bool meets_tool =
      std::holds_alternative<ProbeQuestion>(asked) || std::holds_alternative<PromptQuestion>(asked);
  if (meets_tool && !flush_path()) return false;
  if (state.is_searching && std::holds_alternative<ProbeQuestion>(asked))
    return fail(ErrorCode::ProbeBeforeStart, 0, "a start after it cannot be looked for");
  loops.note_progress();
  pause = Pause::ForQuestion;
  question = std::move(asked);
  if (block.parts.stage == Stage::Items) state.random = random_at_item;
  return false;
}

const Answer* Run::next_answer() {
  if (answers_used >= answers.size()) return nullptr;
  return &answers[answers_used++];
}

void Run::update_origin() {
  const Point work = parameters.work_offset(state.modes.work_system);
  const Point home = parameters.point(kHomePosition);
  const Point machine = machine_of(*this, state.position);
  state.origin = {home.x + work.x + state.floating_zero.x + state.local_zero.x,
                  home.z + work.z + state.floating_zero.z + state.local_zero.z};
  if (state.transformation.is_on()) [[unlikely]]
    state.position = programmed_of(*this, machine);
}

}  // namespace dripline::interpreter::centurion
