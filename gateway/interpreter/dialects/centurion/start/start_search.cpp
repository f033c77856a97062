#include "gateway/interpreter/dialects/centurion/start/start_search.hpp"

#include <fmt/core.h>
#include <charconv>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/compensation/nose_compensation.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/cycle_words.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr std::uint8_t kHasX = 1;
constexpr std::uint8_t kHasZ = 2;
constexpr double kSamePlace = 1e-6;  // millimeters

std::optional<StartAt::Kind> kind_of_letter(char letter) {
  constexpr std::string_view kLetters = "NTLB+";  // in the order of the kinds
  const std::size_t kind = kLetters.find(letter);
  if (kind == std::string_view::npos) return std::nullopt;
  return static_cast<StartAt::Kind>(kind);
}

/// The clearance plane, machine millimeters. None where P140 has not been set: its 0 is then a
/// place that may be within the part.
std::optional<double> clearance_of(const Run& run) {
  const double given = run.parameters[kClearanceZ];
  const bool is_set = given != 0 || run.start.has_set(kClearanceZ);
  if (!is_set) return std::nullopt;
  return run.length(run.state.origin.z + given).mm();
}

Position place(const Point& millimeters) {
  Position position;
  position.set(Axis::X, Length::mm(millimeters.x));
  position.set(Axis::Z, Length::mm(millimeters.z));
  return position;
}

/// The last feed per minute; without one the feed per revolution, if the program has set it and the
/// spindle rotates; else the number of the power-on feed, per minute.
Feed approach_feed(const Run& run) {
  const ModalState& state = run.state;
  if (state.feed[0] > 0) return Feed::per_minute(run.length(state.feed[0]));
  constexpr double kSame = 1e-9;
  const Length per_revolution = run.length(state.feed[1]);
  const Length power_on = Length::mm(run.options.power_on_feed_mm);
  const bool is_programmed = std::fabs(per_revolution.mm() - power_on.mm()) > kSame;
  const bool is_running = state.spindle.state != SpindleState::Off;
  if (is_programmed && is_running && state.feed[1] > 0) return Feed::per_revolution(per_revolution);
  return Feed::per_minute(power_on);
}

}  // namespace

Result<StartAt> parse_start_at(std::string_view text) {
  StartAt start;
  start.text = text;
  const auto kind = text.empty() ? std::nullopt : kind_of_letter(text.front());
  const char* end = text.data() + text.size();
  const auto read = kind ? std::from_chars(text.data() + 1, end, start.number)
                         : std::from_chars_result{text.data(), std::errc::invalid_argument};
  if (read.ec != std::errc{} || read.ptr != end) {
    return fail(
        Errc::Syntax,
        "\"{}\" is no start: N120 (block), T3 (tool), L40 (line), B4096 (byte), +25 (blocks "
        "to skip)",
        text);
  }
  start.kind = *kind;
  return start;
}

bool StartSearch::is_same_place(const Run& run) {
  const StartNotes& notes = run.start;
  return !notes.has_place ||
         (run.origin.program == notes.program && run.origin.offset == notes.offset);
}

bool StartSearch::is_here(const Run& run, std::optional<std::uint32_t> sequence) const {
  const bool is_main = run.state.at.program == kMainProgram;
  if (!is_same_place(run)) return false;
  switch (start_.kind) {
    case StartAt::Kind::Block:
      return sequence && *sequence == start_.number;
    case StartAt::Kind::Line:
    case StartAt::Kind::Byte:
      return is_main && place_ && run.origin.offset == *place_;
    case StartAt::Kind::Count:
      return run.state.blocks >= start_.number;
    case StartAt::Kind::Tool:
      return false;
  }
  return false;
}

bool StartSearch::is_tool(const Run& run, int tool) const {
  return start_.kind == StartAt::Kind::Tool && static_cast<std::uint64_t>(tool) == start_.number &&
         is_same_place(run);
}

bool StartSearch::needs_jump_back(const Run& run) const {
  return start_.kind != StartAt::Kind::Count && !run.options.start_pass;
}

bool StartSearch::arrive(Run& run) {
  StartNotes& notes = run.start;
  if (!std::exchange(notes.has_place, true)) {
    notes.program = run.origin.program;
    notes.offset = run.origin.offset;
  }
  if (std::exchange(notes.arrival, run.origin.block) == run.origin.block) return true;
  ++notes.arrivals;
  if (run.options.start_pass && notes.arrivals < *run.options.start_pass) return true;
  return begin_here(run);
}

/// Why the state at this block is ambiguous or not known.
std::string StartSearch::refusal(const Run& run) const {
  std::string text;
  const auto add = [&text](const std::string& reason) {
    if (!text.empty()) text += "; ";
    text += reason;
  };
  if (run.state.pattern.phase != PatternPhase::None)
    add("it is in the pattern of a cycle: start at the cycle's block");
  if (const NoseUse& nose = run.state.nose; nose.code != 0 && nose.radius_mm != 0)
    add(
        fmt::format("it is within G{}, whose contour depends on the move before it: start before "
                    "that code",
                    40 + nose.code));
  if (const Origin* corner = run.blender.open_corner())
    add(fmt::format("the corner of line {} leads to it: start at that line or before it",
                    corner->line));
  if (needs_jump_back(run)) {
    std::string flow = open_flow_text(run);
    if (jump_back_) {
      flow +=
          fmt::format("{}line {}, which jumps back over it", flow.empty() ? "" : ", ", *jump_back_);
    }
    if (!flow.empty())
      add(fmt::format("it is in {}: which pass is meant (pass, start_pass)?", flow));
  }
  if (const std::string lost = lost_memory_text(run); !lost.empty() && !run.options.may_count_again)
    add(fmt::format(
        "the part before it reads {} and then sets it: is the memory meant as it was when "
        "the program began, or as it is now, so that this is applied twice (memory, "
        "start_memory)?",
        lost));
  return text;
}

bool StartSearch::begin_here(Run& run) {
  ModalState& state = run.state;
  if (const std::string why = refusal(run); !why.empty())
    return run.fail(ErrorCode::StartUndefined, 0, fmt::format("{}: {}", start_.text, why));
  if (!run.flush_path()) return false;  // moves that wait belong to the part before
  if (!is_at_program(run)) {
    return run.fail(ErrorCode::StartUndefined, 0,
                    fmt::format("{}: nose compensation has left the tool beside the program's "
                                "point: start after the next move of both axes",
                                start_.text));
  }
  const Approach approach = approach_of(run);
  if (!may_cross(run, approach)) return false;
  run.start.end();
  state.is_searching = false;
  (void)run.events();  // the header comes before what the start itself does
  const std::string withheld = withheld_text(run.start);
  if (!withheld.empty()) {
    run.scratch = fmt::format("{}: withheld before it: {}", start_.text, withheld);
    out().on_message({run.origin, run.scratch});
  }
  show_tool(run, approach.to);
  show_machine_state(run);
  if (!(approach.to == approach.from)) {
    make_approach(run, approach);
  } else if (!withheld.empty()) {
    out().on_stop({run.origin, StopKind::Operator});
  }
  return true;
}

/// Without a changer the operator is asked for the tool as at its M6, before anything moves.
void StartSearch::show_tool(Run& run, const Point& to) {
  const ToolModes& tool = run.state.tool;
  if (tool.active == 0) return;
  out().on_tool({run.origin, tool.active, false, tool.offset});
  if (has_tool_changer(run)) return;
  const LengthDisplay display{.units = run.state.units, .x_is_diameter = true};
  run.scratch = fmt::format(
      "{} (line {}): tool {} with offset {} has to be in position; the program is at X{} Z{} "
      "(machine coordinates)",
      start_.text, run.origin.line, tool.active, tool.offset,
      shown_axis_number(Axis::X, to.x, display), shown_axis_number(Axis::Z, to.z, display));
  out().on_message({run.origin, run.scratch});
  out().on_stop({run.origin, StopKind::ToolChange});
}

StartSearch::Approach StartSearch::approach_of(const Run& run) const {
  const ModalState& state = run.state;
  Approach approach{state.searched_from, state.searched_to, clearance_of(run)};
  if ((state.searched_axes & kHasX) == 0) approach.to.x = approach.from.x;
  if ((state.searched_axes & kHasZ) == 0) approach.to.z = approach.from.z;
  return approach;
}

/// Without a clearance X moves only where the tool is not beside the part: at the Z of the place or
/// before it, and before the program's zero; or where no Z has come yet, as the program itself did.
bool StartSearch::may_cross(Run& run, const Approach& approach) const {
  const Point &from = approach.from, &to = approach.to;
  const double zero = run.length(run.state.origin.z).mm();
  const bool is_in_front = from.z >= to.z - kSamePlace && from.z >= zero - kSamePlace;
  const bool has_z = (run.state.searched_axes & kHasZ) != 0;
  if (approach.clearance || from.x == to.x || is_in_front || !has_z) return true;
  const auto z_of = [&run](double mm) { return shown_length(Length::mm(mm), run.state.units); };
  return run.fail(
      ErrorCode::StartUndefined, 0,
      fmt::format(
          "{}: no clearance (P140) is set, and X cannot move at Z {}: the program is at Z {} "
          "and its zero at Z {} (machine coordinates). Set P140, or move the tool in front "
          "of the part",
          start_.text, z_of(from.z), z_of(to.z), z_of(zero)));
}

/// Below the clearance Z retracts first; above it X moves first, and Z goes to the clearance if
/// that is before the place. The last move is a feed, after the operator has agreed: all of it
/// where nothing is known to be clear at the tool's Z.
void StartSearch::make_approach(Run& run, const Approach& approach) {
  const Point &from = approach.from, &to = approach.to;
  Point at = from;
  const auto rapid = [&](const Point& next) {
    if (next == at) return;
    at = next;
    out().on_rapid({run.origin, place(at)});
  };
  const double clearance = approach.clearance.value_or(from.z);
  if (from.z < clearance) rapid({from.x, clearance});
  if (approach.clearance || from.z > to.z + kSamePlace) rapid({to.x, at.z});
  if (at.z > clearance && clearance >= to.z) rapid({to.x, clearance});
  out().on_stop({run.origin, StopKind::Operator});
  if (at == to) return;
  out().on_line({run.origin, place(to), approach_feed(run)});
}

bool StartSearch::needs_place() const {
  const bool is_place = start_.kind == StartAt::Kind::Line || start_.kind == StartAt::Kind::Byte;
  return is_place && !is_place_known_ && is_searching();
}

bool StartSearch::begin_at_first(Run& run) {
  if (run.start.arrivals > 0) {
    return run.fail(ErrorCode::StartUndefined, 0,
                    fmt::format("{}: the program reaches it {} times, not {}", start_.text,
                                run.start.arrivals, run.options.start_pass.value_or(1)));
  }
  if (place_) {
    return run.fail(
        ErrorCode::StartUndefined, 0,
        fmt::format(
            "{}: the program never comes to that block: it jumps over it, or ends before it",
            start_.text));
  }
  run.start.end();
  run.state.is_searching = false;
  run.scratch = fmt::format(
      "{} is not in the program, or the program never comes to it: it begins at its first block",
      start_.text);
  out().on_message({run.origin, run.scratch});
  out().on_stop({run.origin, StopKind::Operator});  // the operator asked for another start
  return true;
}

void StartSearch::on_miscellaneous(const Miscellaneous& event) {
  if (is_open()) return out().on_miscellaneous(event);
  notes_->withhold(static_cast<std::uint16_t>(event.code), true, event.origin.line);
}

/// A pulse leaves the output as it was.
void StartSearch::on_pin(const PinChange& event) {
  if (is_open()) return out().on_pin(event);
  if (event.pulse_ms) return;
  const int first = event.axis == Axis::X ? StartNotes::kOutputOfX : StartNotes::kOutputOfZ;
  notes_->withhold(static_cast<std::uint16_t>(first + event.output), event.state,
                   event.origin.line);
}

template <class Event>
void StartSearch::move(void (EventSink::*deliver)(const Event&), const Event& event) {
  if (!state_->is_searching) return (out().*deliver)(event);
  state_->searched_to = {event.to.linear(Axis::X).mm(), event.to.linear(Axis::Z).mm()};
  if (event.to.has(Axis::X)) state_->searched_axes |= kHasX;
  if (event.to.has(Axis::Z)) state_->searched_axes |= kHasZ;
}

void StartSearch::on_rapid(const Rapid& event) {
  move(&EventSink::on_rapid, event);
}
void StartSearch::on_line(const Line& event) {
  move(&EventSink::on_line, event);
}
void StartSearch::on_arc(const Arc& event) {
  move(&EventSink::on_arc, event);
}
void StartSearch::on_thread(const Thread& event) {
  move(&EventSink::on_thread, event);
}

}  // namespace dripline::interpreter::centurion
