#include "gateway/interpreter/dialects/prototrak/executor.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace dripline::interpreter::prototrak {
namespace {

compensation::Policy policy() {
  compensation::Policy policy;
  policy.outside = compensation::OutsideCorner::Arc;
  policy.inside = compensation::InsideCorner::Intersect;
  policy.cancel = compensation::Cancel::OwnNormal;
  policy.resume = compensation::Resume::OwnNormal;
  // events without length, as many as there can be, do not end the look-ahead
  policy.blocks_without_motion = kMaxEvents;
  return policy;
}

/// One compensated path has one radius.
bool has_same_offset(const ProgramEvent& event, const ProgramEvent& next) {
  return event.side == ToolSide::Center || next.diameter == event.diameter;
}

}  // namespace

Executor::Executor(const ControlOptions& options, const StoredProgram& program, EventSink& sink,
                   const Position& start)
    : options_(options), program_(program), path_(policy(), sink, start), position_(start) {
  state_.at = {start.linear(Axis::X).mm(), start.linear(Axis::Y).mm()};
}

void Executor::begin() {
  state_.is_metric = program_.is_metric;
  state_.frames.clear();
  if (program_.events.empty()) return;
  Frame whole;
  whole.last = static_cast<std::uint16_t>(program_.events.size());
  whole.index = options_.start_event;
  state_.frames.push_back(whole);
}

std::uint16_t Executor::first_to_begin_with(std::uint16_t number) const {
  for (; number > 1; --number) {
    const ProgramEvent& previous = program_.events[number - 2U];
    const ProgramEvent& event = program_.events[number - 1U];
    if (!previous.is_cut() || !is_connected(previous, event)) break;
    const bool is_beside = previous.side != ToolSide::Center && previous.diameter > 0;
    if (!is_beside && previous.conrad <= 0) break;
  }
  return number;
}

Result<void> Executor::restore(ExecutionState state, const std::vector<std::byte>& path) {
  if (const auto done = path_.restore(path); !done) return done;
  state_ = std::move(state);
  position_ = path_.sent();
  for (const Axis axis : {Axis::X, Axis::Y}) {
    if (!path_.sent().has(axis)) position_.unmark(axis);
  }
  return {};
}

// Which event, and as what.

ProgramEvent Executor::effective(std::uint16_t number) const {
  ProgramEvent event = program_.events[number - 1U];
  XY shift;
  for (auto frame = state_.frames.rbegin(); frame != state_.frames.rend(); ++frame) {
    shift.x += frame->pass * frame->step.x;
    shift.y += frame->pass * frame->step.y;
    if (event.kind == EventKind::Repeat) continue;
    if (frame->has_diameter) event.diameter = frame->diameter;
    if (frame->has_tool) event.tool = frame->tool;
  }
  if (event.kind == EventKind::Repeat) return event;
  for (XY* point : {&event.begin, &event.end, &event.center}) {
    point->x += shift.x;
    point->y += shift.y;
  }
  return event;
}

std::optional<ProgramEvent> Executor::next_in_range() const {
  const Frame& frame = state_.frames.back();
  if (frame.index >= frame.last) return std::nullopt;
  return effective(static_cast<std::uint16_t>(frame.index + 1));
}

std::optional<ProgramEvent> Executor::previous_in_chain() const {
  if (!state_.is_in_chain) return std::nullopt;
  return effective(static_cast<std::uint16_t>(state_.frames.back().index - 1));
}

bool Executor::is_connected(const ProgramEvent& event, std::optional<ProgramEvent> next) const {
  return event.is_connected && next && next->is_cut() && next->tool == event.tool &&
         next->side == event.side && has_same_offset(event, *next) &&
         distance(event.end, next->begin) <= join_tolerance(event.is_metric);
}

/// False: repeats within repeats, and nothing moves.
bool Executor::advance() {
  while (!state_.frames.empty()) {
    Frame& frame = state_.frames.back();
    if (++frame.index <= frame.last) return true;
    if (frame.pass < frame.passes) {
      ++frame.pass;
      frame.index = frame.first;
      return loops_.count_pass() ||
             fail(Fault::LoopLimit, fmt::format("more than {} passes without a move or a wait",
                                                language::LoopGuard::kMaxIdlePasses));
    }
    state_.frames.pop_back();
  }
  return true;
}

bool Executor::step() {
  const std::uint16_t number = state_.frames.back().index;
  const ProgramEvent event = effective(number);
  origin_ = {state_.blocks + 1, event.offset, event.line, event.sequence, kMainProgram};
  tell_units(event);
  shown_ = {event.side, event.diameter / 2, event.feed};
  const std::size_t depth = state_.frames.size();
  if (!execute(event)) return false;
  ++state_.blocks;
  path_.on_block_end(origin_);
  return state_.frames.size() != depth || advance();  // a repeat has begun its first pass otherwise
}

bool Executor::execute(const ProgramEvent& event) {
  switch (event.kind) {
    case EventKind::Position:
      load_tool(event);
      rapid(event.begin);
      wait(StopKind::Operator);
      return true;
    case EventKind::Mill:
    case EventKind::Arc:
      return execute_cut(event);
    case EventKind::BoltHole:
      return drill_circle(event);
    case EventKind::Repeat:
      return begin_repeat(event);
    case EventKind::CircularPocket:
      return clear_circle(event);
    case EventKind::RectangularPocket:
      return clear_rectangle(event);
    case EventKind::CircularFrame:
    case EventKind::RectangularFrame:
      break;
  }
  return run_frame(event);
}

bool Executor::begin_repeat(const ProgramEvent& event) {
  const std::uint16_t number = state_.frames.back().index;
  if (event.from_event < 1 || event.from_event > event.to_event || event.to_event >= number) {
    return fail(Fault::RepeatRange,
                fmt::format("event {} repeats {} to {}", number, event.from_event, event.to_event));
  }
  if (state_.frames.size() > kMaxNesting) {
    return fail(Fault::RepeatRange, fmt::format("more than {} within each other", kMaxNesting));
  }
  Frame frame;
  frame.first = frame.index = event.from_event;
  frame.last = event.to_event;
  frame.passes = event.passes;
  frame.step = event.end;
  frame.has_diameter = event.has_diameter;
  frame.diameter = event.diameter;
  frame.has_tool = event.has_tool;
  frame.tool = event.tool;
  state_.frames.push_back(frame);
  return true;
}

// Cuts and their chains.

bool Executor::check_arc(const ProgramEvent& event) {
  if (event.kind != EventKind::Arc) return true;
  const double tolerance = event.is_metric ? 0.02 : 0.001 * Length::kMillimetersPerInch;
  const double last = distance(event.end, event.center);
  if (event.radius > kNoise && std::fabs(event.radius - last) <= tolerance) return true;
  return fail(Fault::ArcRadii,
              fmt::format("{:.4f} and {:.4f}", event.shown(event.radius), event.shown(last)));
}

/// The arc between two connected cuts, if the first one's conrad asks for one (manual: connective
/// events). A tool inside the turn that is larger makes the corner by itself.
bool Executor::join(const Element& first, const Element& second, const ProgramEvent& event,
                    std::optional<Element>& corner) {
  constexpr double kStraight = 1e-9;
  if (event.conrad <= 0) return true;
  const double turn = turn_at(first, second);
  if (std::fabs(turn) < kStraight) return true;
  const bool is_inside =
      (turn > 0 && event.side == ToolSide::Left) || (turn < 0 && event.side == ToolSide::Right);
  if (is_inside && event.conrad < event.diameter / 2) return true;
  corner = conrad(first, second, event.conrad);
  if (corner) return true;
  return fail(Fault::Join, fmt::format("conrad of {:.4f}", event.shown(event.conrad)));
}

bool Executor::execute_cut(const ProgramEvent& event) {
  if (!check_arc(event)) return false;
  Element element = element_of(event);
  if (const auto previous = previous_in_chain()) {
    std::optional<Element> corner;
    if (!join(element_of(*previous), element, *previous, corner)) return false;
    if (corner) element.from = corner->to;
  } else {
    begin_chain(event);
  }
  const auto next = next_in_range();
  const bool goes_on = is_connected(event, next);
  std::optional<Element> corner;
  if (goes_on && (!check_arc(*next) || !join(element, element_of(*next), event, corner))) {
    return false;
  }
  if (event.is_connected && next && !goes_on) {
    const bool is_other_tool = next->is_cut() && !has_same_offset(event, *next);
    warn(Fault::NotConnectable,
         is_other_tool ? fmt::format("D{:.4f} and D{:.4f}", event.shown(event.diameter),
                                     event.shown(next->diameter))
                       : "");
  }
  if (corner) element.to = corner->from;
  cut(element, event.feed);
  if (corner) cut(*corner, event.feed);
  if (!goes_on) end_chain();
  state_.is_in_chain = goes_on;
  return meets_no_fault();
}

/// Rapid to the offset begin point (README, "Decided here"), from wherever the tool is: a rapid to
/// the programmed point as a start-up move has no length where the tool is there already.
void Executor::begin_chain(const ProgramEvent& event) {
  load_tool(event);
  const bool is_offset = event.side != ToolSide::Center && event.diameter > 0;
  if (!is_offset) {
    rapid(event.begin);
    return wait(StopKind::Operator);
  }
  const bool is_left = event.side == ToolSide::Left;
  rapid(beside(event.begin, direction_of_chain(event), (is_left ? 0.5 : -0.5) * event.diameter));
  state_.at = event.begin;
  wait(StopKind::Operator);
  const compensation::Cutter cutter{Plane::XY,
                                    is_left ? compensation::Side::Left : compensation::Side::Right,
                                    Length::mm(event.diameter / 2),
                                    {},
                                    {}};
  path_.begin_contour(cutter, {event.begin.x, event.begin.y});
}

/// At its begin: of its first cut that has a length.
XY Executor::direction_of_chain(ProgramEvent cut) const {
  const Frame& frame = state_.frames.back();
  for (std::uint16_t number = frame.index;; ++number) {
    const Element element = element_of(cut);
    if (element.is_arc || distance(element.from, element.to) > kNoise)
      return direction_at_start(element);
    if (number >= frame.last) return {};
    const ProgramEvent next = effective(static_cast<std::uint16_t>(number + 1));
    if (!is_connected(cut, next)) return {};
    cut = next;
  }
}

/// The tool stays beside the edge: a position that follows is one even where the edge ends.
void Executor::end_chain() {
  path_.flush();
  state_.at = {path_.sent().linear(Axis::X).mm(), path_.sent().linear(Axis::Y).mm()};
  path_.cancel({state_.at.x, state_.at.y});
  wait(StopKind::Operator);
}

bool Executor::meets_no_fault() {
  if (!path_.fault()) return true;
  return fail(Fault::Join, compensation::describe(
                               *path_.fault(), state_.is_metric ? Units::Millimeter : Units::Inch));
}

// Holes.

bool Executor::drill_circle(const ProgramEvent& event) {
  load_tool(event);
  for (int hole = 0; hole < event.holes; ++hole) {
    const double angle = Angle::degrees(event.angle + hole * 360.0 / event.holes).radians();
    rapid({event.begin.x + event.radius * std::cos(angle),
           event.begin.y + event.radius * std::sin(angle)});
    wait(StopKind::Operator);
  }
  return true;
}

// What reaches the machine.

void Executor::load_tool(const ProgramEvent& event) {
  if (state_.loaded_tool == event.tool) return;
  state_.loaded_tool = event.tool;
  path_.on_tool({origin_, event.tool, false, std::nullopt});
  wait(StopKind::ToolChange);
}

void Executor::wait(StopKind kind) {
  if (!options_.waits) return;
  loops_.note_progress();
  path_.on_stop({origin_, kind});
}

void Executor::rapid(XY to) {
  if (distance(to, state_.at) >= kNoise) loops_.note_progress();
  state_.at = to;
  position_.set(Axis::X, Length::mm(to.x));
  position_.set(Axis::Y, Length::mm(to.y));
  path_.on_rapid({origin_, position_});
}

void Executor::line(XY to, double feed) {
  if (distance(to, state_.at) < kNoise) return;
  loops_.note_progress();
  state_.at = to;
  position_.set(Axis::X, Length::mm(to.x));
  position_.set(Axis::Y, Length::mm(to.y));
  path_.on_line({origin_, position_, Feed::per_minute(Length::mm(feed))});
}

void Executor::cut(const Element& element, double feed) {
  if (!element.is_arc) return line(element.to, feed);
  loops_.note_progress();
  Arc arc;
  arc.origin = origin_;
  arc.center_first = Length::mm(element.center.x);
  arc.center_second = Length::mm(element.center.y);
  arc.turn = element.is_counterclockwise ? Turn::Counterclockwise : Turn::Clockwise;
  const double begin =
      std::atan2(element.from.y - element.center.y, element.from.x - element.center.x);
  const double end = std::atan2(element.to.y - element.center.y, element.to.x - element.center.x);
  double sweep = Angle::radians(element.is_counterclockwise ? end - begin : begin - end).degrees();
  if (distance(element.from, element.to) < kNoise) sweep = 360;
  while (sweep <= 0) sweep += 360;
  while (sweep > 360) sweep -= 360;
  arc.sweep = Angle::degrees(sweep);
  arc.feed = Feed::per_minute(Length::mm(feed));
  position_.set(Axis::X, Length::mm(element.to.x));
  position_.set(Axis::Y, Length::mm(element.to.y));
  state_.at = element.to;
  arc.to = position_;
  path_.on_arc(arc);
}

void Executor::tell_units(const ProgramEvent& event) {
  if (event.is_metric == state_.is_metric) return;
  state_.is_metric = event.is_metric;
  path_.on_units({origin_, event.is_metric ? Units::Millimeter : Units::Inch});
}

bool Executor::fail(const DiagnosticRow& fault, std::string_view detail) {
  alarm_ = diagnostic(fault, detail, origin_.line);
  return false;
}

void Executor::warn(const DiagnosticRow& fault, std::string_view detail) {
  path_.on_warning({origin_, diagnostic(fault, detail, origin_.line)});
}

}  // namespace dripline::interpreter::prototrak
