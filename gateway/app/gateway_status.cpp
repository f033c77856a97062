#include "gateway/app/gateway.hpp"

/// The part of the gateway that tells how it is.
namespace dripline::gateway {

using dds::Execution;
using interpreter::CoordinateFrame;
using machine::MachineState;

namespace {

Execution execution_of(MachineState state) {
  switch (state) {
    case MachineState::Idle:
    case MachineState::Running:
      return Execution::Active;
    case MachineState::Held:
      return Execution::FeedHold;
    case MachineState::ProgramStop:
      return Execution::ProgramStopped;
    case MachineState::OptionalStop:
      return Execution::OptionalStop;
    case MachineState::SingleBlock:
      return Execution::Interrupted;
    case MachineState::Completed:
      return Execution::ProgramCompleted;
    case MachineState::Alarmed:
    case MachineState::Aborted:
    case MachineState::EmergencyStop:
      return Execution::Stopped;
  }
  return Execution::Stopped;
}

static_assert(static_cast<int>(dds::MotionKind::Thread) ==
              static_cast<int>(machine::MotionKind::Thread));
static_assert(static_cast<int>(dds::CompensationSide::Right) ==
              static_cast<int>(interpreter::CompensationSide::Right));

dds::FeedUnit unit_of(Feed feed) {
  switch (feed.per()) {
    case Feed::Per::Minute:
      return dds::FeedUnit::PerMinute;
    case Feed::Per::Revolution:
      return dds::FeedUnit::PerRevolution;
    case Feed::Per::Move:
      return dds::FeedUnit::InverseTime;
  }
  return dds::FeedUnit::PerMinute;
}

/// "G54", "G59.3", "G54.1 P7"
std::string work_system_text(const interpreter::ActiveModes& modes) {
  if (modes.work_system == 0) return {};
  std::string text = fmt::format("G{}", modes.work_system / 10);
  if (modes.work_system % 10 != 0) text += fmt::format(".{}", modes.work_system % 10);
  if (modes.work_page != 0) text += fmt::format(" P{}", modes.work_page);
  return text;
}

/// What the interpreter knows of the block that is executed.
void show_program(dds::ActiveModes& shown, const interpreter::ActiveModes& modes) {
  shown.compensation = static_cast<dds::CompensationSide>(modes.compensation);
  shown.is_inch = modes.units == interpreter::Units::Inch;
  shown.is_incremental = modes.is_incremental;
  shown.feed_unit = unit_of(modes.feed);
  shown.feed = shown.feed_unit == dds::FeedUnit::InverseTime ? modes.feed.moves_per_minute()
                                                             : modes.feed.length().mm();
  shown.tool_length_x = modes.tool_length_x.mm();
  shown.tool_length_z = modes.tool_length_z.mm();
  shown.tool_radius = modes.tool_radius.mm();
  shown.work_system = work_system_text(modes);
  shown.cycle = modes.cycle.substr(0, dds::kMaxCycle);
  if (modes.tool_axis) shown.tool_axis = static_cast<std::uint8_t>(*modes.tool_axis);
}

dds::SpindleState spindle_of(interpreter::SpindleState state) {
  switch (state) {
    case interpreter::SpindleState::Off:
      return dds::SpindleState::Off;
    case interpreter::SpindleState::Clockwise:
      return dds::SpindleState::Clockwise;
    case interpreter::SpindleState::Counterclockwise:
      return dds::SpindleState::Counterclockwise;
    case interpreter::SpindleState::Oriented:
      return dds::SpindleState::Oriented;
  }
  return dds::SpindleState::Unknown;
}

CoordinateFrame::Values values_of(const interpreter::Position& position) {
  CoordinateFrame::Values values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = position.raw(static_cast<interpreter::Axis>(i));
  return values;
}

/// What the interpreter knew of the block that is executed, with the places the machine is at now.
dds::ProgramFrame shown_frame(const CoordinateFrame& frame, const machine::MachineStatus& now) {
  dds::ProgramFrame shown;
  shown.position = frame.to_program(values_of(now.position));
  shown.target = frame.to_program(values_of(now.target));
  shown.datum = frame.datum;
  shown.shift = frame.shift;
  shown.rotation = frame.rotation;
  shown.basic_rotation = frame.basic_rotation;
  shown.scale = frame.scale;
  for (unsigned i = 0; i < frame.mirrored.size(); ++i)
    shown.mirrored |= static_cast<std::uint8_t>(frame.mirrored[i] ? 1U << i : 0U);
  shown.pole = frame.pole;
  shown.pole_axes = frame.pole_axes;
  return shown;
}

}  // namespace

dds::ActiveModes Gateway::modes(const machine::MachineStatus& now) const {
  dds::ActiveModes shown;
  shown.motion = static_cast<dds::MotionKind>(now.motion);
  shown.is_feed_limited = now.is_feed_limited;
  shown.tool = now.tool;
  shown.next_tool = now.next_tool;
  shown.tool_offset = now.tool_offset;
  shown.dwell_seconds = now.dwell_left.count();
  shown.is_surface_speed = now.spindle.surface_speed.has_value();
  shown.spindle_speed =
      shown.is_surface_speed ? now.spindle.surface_speed->mm() : now.spindle.revolutions_per_minute;
  shown.spindle = spindle_of(now.spindle.state);
  shown.flood = now.flood;
  shown.mist = now.mist;
  if (session_) show_program(shown, session_->modes_at(now.origin.block));
  return shown;
}

/// The simulated axes follow without a trailing error.
dds::Coordinates Gateway::coordinates(const machine::MachineStatus& now) const {
  dds::Coordinates shown;
  shown.target = values_of(now.target);
  shown.lag.emplace();
  if (!session_) return shown;
  const auto& frame = session_->frame_at(now.origin.block);
  if (frame) shown.program = shown_frame(*frame, now);
  return shown;
}

dds::Status Gateway::status() const {
  dds::Status status;
  status.machine = parts_.options.machine;
  status.session = parts_.session;
  status.time = parts_.clock.now();
  status.steady = std::chrono::duration_cast<std::chrono::microseconds>(
      parts_.clock.steady_now().time_since_epoch());
  const machine::MachineStatus now = machine_.status();
  for (std::size_t i = 0; i < status.position.size(); ++i) {
    const auto axis = static_cast<interpreter::Axis>(i);
    status.position[i] = now.position.raw(axis);
    if (machine_.capabilities().axes.test(i)) status.axes |= static_cast<std::uint16_t>(1U << i);
  }
  status.feed_mm_per_min = now.feed_per_minute;
  status.spindle_rpm = now.spindle_rpm;
  status.feed_override = machine_.panel().feed_override;
  status.rapid_override = machine_.panel().rapid_override;
  status.spindle_override = machine_.panel().spindle_override;
  status.single_block = machine_.panel().single_block;
  status.outbox =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(outbox_.unacknowledged(), UINT32_MAX));
  status.modes = modes(now);
  status.coordinates = coordinates(now);
  status.emergency_stop = machine_.panel().emergency_stop;
  if (session_) {
    status.run = session_->run().run;
    status.program = session_->run().program;
    status.total_bytes = session_->run().size;
    status.sent = session_->feed().sent();
    status.accepted = session_->accepted();
    status.executed = recorder_.executed().executed;
    status.offset = now.origin.offset;
    status.line = now.origin.line;
    status.sequence = now.origin.sequence;
    status.buffered_seconds = now.buffered.count();
  }
  fill_execution(status);
  status.remote_enable = remote_enable();
  status.waits_for = waits_for(status);
  return status;
}

void Gateway::fill_execution(dds::Status& status) const {
  std::string message = last_message_;
  status.execution = session_ && !is_ending_ ? execution_of_run(message) : last_execution_;
  if (machine_.panel().emergency_stop) {
    status.execution = Execution::Stopped;
    message = "EMERGENCY STOP";
  } else if (!recorder_.trouble().empty()) {
    status.execution = Execution::Waiting;
    message = fmt::format("reports cannot be kept: {}", recorder_.trouble());
  } else if (message.empty()) {
    message = refused_by_server_.empty()
                  ? line_fault_
                  : fmt::format("the server does not command this gateway: {}", refused_by_server_);
  }
  status.message = valid_text(message, kMaxReason);
}

Execution Gateway::execution_of_run(std::string& message) const {
  const MachineState state = machine_.state();
  message.clear();
  if (consent_.is_awaited()) {
    message = kAwaitsCycleStart;
    return Execution::Waiting;
  }
  if (state == MachineState::Idle) {
    if (session_->waits() == RunSession::Waits::ForOperator) {
      message = "asks: " + session_->prompt();
      return Execution::Waiting;
    }
    if (session_->waits() == RunSession::Waits::ForText) {
      if (parts_.line != nullptr) {
        message = line_fault_.empty() ? "waiting for text from the line" : line_fault_;
        return Execution::Waiting;
      }
      message = is_connected_ ? "waiting for program text" : "waiting for program text: no server";
      return Execution::Waiting;
    }
  }
  if (state == MachineState::ProgramStop || state == MachineState::OptionalStop)
    message = recorder_.notice();
  if (state == MachineState::SingleBlock) message = "single block";
  if (state == MachineState::Running && machine_.panel().handwheel)
    message = "driven by the handwheel";
  return execution_of(state);
}

}  // namespace dripline::gateway
