#include "gateway/machine/grbl/operator_tool_change.hpp"

#include "gateway/machine/streamed/command_writer.hpp"

namespace dripline::machine::grbl {

using interpreter::SpindleState;

void OperatorToolChange::begin() {
  spindle_ = {};
  tool_.reset();
  stopped_for_.reset();
  wants_tool_ = has_stopped_ = false;
}

void OperatorToolChange::turn_off(const interpreter::Origin& origin) {
  if (spindle_.state == SpindleState::Off) return;
  interpreter::Spindle off;
  off.origin = origin;
  out().on_spindle(off);
}

void OperatorToolChange::stop_for_tool(const interpreter::Origin& origin) {
  if (!std::exchange(wants_tool_, false)) return;
  turn_off(origin);
  out().on_stop({origin, interpreter::StopKind::ToolChange});
  has_stopped_ = true;
  stopped_for_ = tool_;
  if (spindle_.state != SpindleState::Off) out().on_spindle(spindle_);
}

void OperatorToolChange::before_motion(const interpreter::Origin& origin) {
  stop_for_tool(origin);
  has_stopped_ = false;
}

void OperatorToolChange::on_rapid(const interpreter::Rapid& event) {
  before_motion(event.origin);
  out().on_rapid(event);
}

void OperatorToolChange::on_line(const interpreter::Line& event) {
  before_motion(event.origin);
  out().on_line(event);
}

void OperatorToolChange::on_arc(const interpreter::Arc& event) {
  before_motion(event.origin);
  out().on_arc(event);
}

void OperatorToolChange::on_spindle(const interpreter::Spindle& event) {
  if (wants_tool_ && event.state != SpindleState::Off) {
    turn_off(event.origin);
    spindle_ = {};
    stop_for_tool(event.origin);
  }
  spindle_ = event;
  out().on_spindle(event);
}

void OperatorToolChange::on_tool(const interpreter::ToolChange& event) {
  out().on_tool(event);
  if (event.is_preselection || tool_ == event.number) return;
  tool_ = event.number;
  if (event.number != 0 && !event.is_in_spindle) want_tool();
}

void OperatorToolChange::on_miscellaneous(const interpreter::Miscellaneous& event) {
  out().on_miscellaneous(event);
  if (event.code == streamed::kToolChangeFunction) want_tool();
}

void OperatorToolChange::on_stop(const interpreter::Stop& event) {
  const bool is_for_tool = event.kind == interpreter::StopKind::ToolChange;
  if (is_for_tool && has_stopped_for_tool()) return;
  if (is_for_tool) {
    wants_tool_ = false;
    has_stopped_ = true;
    stopped_for_ = tool_;
  }
  out().on_stop(event);
}

void OperatorToolChange::on_block_end(const interpreter::Origin& origin) {
  stop_for_tool(origin);
  out().on_block_end(origin);
}

}  // namespace dripline::machine::grbl
