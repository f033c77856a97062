#include "clients/tools/post/operator_stage.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/core/path_feed.hpp"

namespace dripline::post {
namespace {

using interpreter::Axis;
using interpreter::EventGate;
using interpreter::Origin;
using interpreter::Position;
using interpreter::SpindleState;
using interpreter::StopKind;

/// An axis that is named for the first time moves from any other place.
bool moves(Axis axis, const Position& from, const Position& to) {
  return to.has(axis) && (to.raw(axis) != from.raw(axis) || !from.has(axis));
}

std::string text_of(const interpreter::Spindle& spindle) {
  if (spindle.state == SpindleState::Off) return "SPINDLE OFF";
  if (spindle.state == SpindleState::Oriented) return "SPINDLE ORIENTED";
  const std::string_view sense = spindle.state == SpindleState::Clockwise ? "CW" : "CCW";
  if (spindle.surface_speed)
    return fmt::format("SPINDLE {} {:g} M/MIN", sense, spindle.surface_speed->mm() / 1000);
  if (spindle.revolutions_per_minute == 0) return fmt::format("SPINDLE {}", sense);
  return fmt::format("SPINDLE {} {:g} RPM", sense, spindle.revolutions_per_minute);
}

std::string text_of(const interpreter::Coolant& coolant) {
  if (!coolant.flood && !coolant.mist) return "COOLANT OFF";
  return coolant.flood && coolant.mist ? "FLOOD AND MIST COOLANT ON"
         : coolant.flood               ? "COOLANT ON"
                                       : "MIST COOLANT ON";
}

}  // namespace

void OperatorStage::refuse(const Origin& origin, std::string what) {
  if (!refusal_) refusal_ = Refusal{std::move(what), origin};
}

OperatorStage::Changes OperatorStage::changes_of(const Position& to) const {
  return {moves(Axis::X, at_, to) || moves(Axis::Y, at_, to), moves(Axis::Z, at_, to)};
}

/// Both at once are no motion that the operator could make.
std::optional<OperatorStage::Changes> OperatorStage::check(const Origin& origin, const Position& to,
                                                           std::string_view what) {
  const Changes changes = changes_of(to);
  if (!changes.moves_plane || !changes.moves_operator) return changes;
  refuse(origin, fmt::format("{} of Z together with X or Y: Z of {} is the operator's", what,
                             target().name));
  return std::nullopt;
}

Position OperatorStage::without_operator(Position position) const {
  position.set_raw(Axis::Z, start_.raw(Axis::Z));
  position.unmark(Axis::Z);
  return position;
}

/// Before the first event the target waits for its tool.
void OperatorStage::wait(const Origin& origin) {
  if (has_begun_) EventGate::on_stop({origin, StopKind::Operator});
  is_in_chain_ = false;
}

void OperatorStage::instruct(const Origin& origin, const std::string& text) {
  wait(origin);
  ++operator_actions_;
  if (!instructs_) return;
  ++instructions_;
  EventGate::on_message({origin, text});
}

std::string OperatorStage::place_text(const Position& to) const {
  const auto units = grid_.units();
  const int decimals = units == interpreter::Units::Inch ? 4 : 3;
  std::string text = "Z TO ";
  append_number(text, counts_of(to.raw(Axis::Z) / mm_per_unit(units), decimals), decimals,
                {.has_point = true});
  return text;
}

/// The target loads the tool of an event with it, and its first event has one in any case.
void OperatorStage::begin_event(const Origin& origin) {
  has_begun_ = true;
  is_tool_pending_ = false;
  if (tool_) return;
  tool_ = 1;
  has_assumed_tool_ = true;
  EventGate::on_tool({origin, 1, false, std::nullopt});
}

void OperatorStage::begin_cut(const Origin& origin) {
  begin_event(origin);
  if (!is_in_chain_) wait(origin);
  is_in_chain_ = true;
}

void OperatorStage::on_rapid(const interpreter::Rapid& event) {
  const auto changes = check(event.origin, event.to, "rapid move");
  if (!changes || !is_open()) return;
  if (changes->moves_operator) instruct(event.origin, place_text(event.to));
  at_ = event.to;
  if (changes->moves_operator) return;
  if (is_in_chain_) wait(event.origin);
  begin_event(event.origin);
  interpreter::Rapid rapid = event;
  rapid.to = without_operator(event.to);
  EventGate::on_rapid(rapid);
  wait(event.origin);
}

void OperatorStage::on_line(const interpreter::Line& event) {
  const auto changes = check(event.origin, event.to, "feed move");
  if (!changes || !is_open()) return;
  if (changes->moves_operator) {
    std::string text = place_text(event.to);
    if (event.feed.per() == Feed::Per::Minute) {
      const double feed = event.feed.length().mm() / mm_per_unit(grid_.units());
      text += fmt::format(" FEED {:.6g}", feed);
    }
    instruct(event.origin, text);
  }
  at_ = event.to;
  if (changes->moves_operator) return;
  begin_cut(event.origin);
  interpreter::Line line = event;
  line.to = without_operator(event.to);
  EventGate::on_line(line);
}

void OperatorStage::on_arc(const interpreter::Arc& event) {
  if (!is_open()) return;
  if (event.plane != interpreter::Plane::XY) {
    return refuse(event.origin, fmt::format("arc in the plane {}: {} has arcs in XY",
                                            word_of(event.plane), target().name));
  }
  if (changes_of(event.to).moves_operator) {
    return refuse(event.origin,
                  fmt::format("helix: Z of {} is the operator's, and its arcs lie in a plane",
                              target().name));
  }
  at_ = event.to;
  begin_cut(event.origin);
  interpreter::Arc arc = event;
  arc.to = without_operator(event.to);
  EventGate::on_arc(arc);
}

void OperatorStage::on_dwell(const interpreter::Dwell& event) {
  refuse(event.origin, fmt::format("dwell: {} has none", target().name));
}

void OperatorStage::on_spindle(const interpreter::Spindle& event) {
  if (!is_open()) return;
  const bool is_off = event.state == SpindleState::Off;
  const bool is_same =
      event.state == spindle_.state &&
      (is_off || (event.surface_speed == spindle_.surface_speed &&
                  event.revolutions_per_minute == spindle_.revolutions_per_minute));
  spindle_ = event;
  if (!is_same) instruct(event.origin, text_of(event));
}

void OperatorStage::on_coolant(const interpreter::Coolant& event) {
  if (!is_open()) return;
  const bool is_same = event.flood == coolant_.flood && event.mist == coolant_.mist;
  coolant_ = event;
  if (!is_same) instruct(event.origin, text_of(event));
}

/// The target changes the tool with its next event: of two there would be one change.
void OperatorStage::on_tool(const interpreter::ToolChange& event) {
  if (!is_open() || event.is_preselection) return;
  if (tool_ == event.number && !event.is_in_spindle) return;
  if (is_tool_pending_) {
    return refuse(event.origin,
                  fmt::format("tool {} after tool {} without a move of X or Y: {} changes a tool "
                              "with its next event",
                              event.number, *tool_, target().name));
  }
  if (is_in_chain_) wait(event.origin);
  tool_ = event.number;
  is_tool_pending_ = true;
  EventGate::on_tool(event);
}

void OperatorStage::on_stop(const interpreter::Stop& event) {
  if (event.kind == StopKind::Program) return instruct(event.origin, "STOP");
  if (event.kind == StopKind::Operator) return wait(event.origin);
  EventGate::on_stop(event);
}

void OperatorStage::on_end(const interpreter::End& event) {
  if (!is_open()) return;
  if (is_tool_pending_) {
    return refuse(event.origin, fmt::format("tool {} without a move of X or Y after it: {} changes "
                                            "a tool with its next event",
                                            *tool_, target().name));
  }
  if (!has_begun_ && operator_actions_ > 0) {
    return refuse(event.origin, fmt::format("no move of X or Y: {} has no event at which it waits",
                                            target().name));
  }
  if (is_in_chain_) wait(event.origin);
  EventGate::on_end(event);
}

}  // namespace dripline::post
