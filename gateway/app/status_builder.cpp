#include "gateway/app/status_builder.hpp"

#include <array>

#include "gateway/app/run/block_texts.hpp"
#include "gateway/app/run/run_texts.hpp"
#include "protocol/base/utf8.hpp"

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
    default:
      return Execution::Stopped;
  }
}

static_assert(static_cast<int>(dds::MotionKind::Thread) ==
              static_cast<int>(machine::MotionKind::Thread));
static_assert(static_cast<int>(dds::PositionDisplay::DistanceToGo) ==
              static_cast<int>(interpreter::ShownPosition::DistanceToGo));
static_assert(static_cast<int>(dds::CompensationSide::Right) ==
              static_cast<int>(interpreter::CompensationSide::Right));

dds::FeedUnit unit_of(Feed feed) {
  if (feed.per() == Feed::Per::Move) return dds::FeedUnit::InverseTime;
  return feed.per() == Feed::Per::Minute ? dds::FeedUnit::PerMinute : dds::FeedUnit::PerRevolution;
}

/// The interpreter's modes of the block that is executed.
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
  using enum dds::SpindleState;
  constexpr std::array kStates{Off, Clockwise, Counterclockwise, Oriented};
  return kStates[static_cast<std::size_t>(state)];
}

CoordinateFrame::Values values_of(const interpreter::Position& position) {
  CoordinateFrame::Values values{};
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = position.raw(static_cast<interpreter::Axis>(i));
  return values;
}

/// The interpreter's frame of the block that is executed, with the present position of the machine.
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

void StatusBuilder::take_settings(const interpreter::Setup& setup) {
  settings_ = parts_.dialect.screen ? parts_.dialect.screen(setup) : interpreter::ScreenSettings{};
}

/// Without a program the units are those of the control at power on.
dds::Screen StatusBuilder::screen(const machine::MachineStatus& now) const {
  const RunSession* session = parts_.run.session.get();
  const interpreter::Units of_program =
      session ? session->modes_at(now.origin.block).units : parts_.dialect.units;
  dds::Screen shown;
  shown.is_inch = settings_.units.value_or(of_program) == interpreter::Units::Inch;
  shown.position = static_cast<dds::PositionDisplay>(settings_.position);
  if (!session) return shown;
  BlockTexts blocks = block_texts(session->feed(), now.origin);
  shown.block = std::move(blocks.block);
  const bool is_large = !shown.block.empty() &&
                        settings_.large_blocks.find(shown.block.front()) != std::string_view::npos;
  if (is_large) return shown;
  shown.previous_block = std::move(blocks.previous);
  shown.next_block = std::move(blocks.next);
  shown.further_block = std::move(blocks.further);
  return shown;
}

dds::ActiveModes StatusBuilder::modes(const machine::MachineStatus& now) const {
  dds::ActiveModes shown;
  shown.is_inch = parts_.dialect.units == interpreter::Units::Inch;
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
  if (parts_.run.session) show_program(shown, parts_.run.session->modes_at(now.origin.block));
  return shown;
}

/// The axes are reported without a following error.
dds::Coordinates StatusBuilder::coordinates(const machine::MachineStatus& now) const {
  dds::Coordinates shown;
  shown.target = values_of(now.target);
  shown.following_error.emplace();
  const RunSession* session = parts_.run.session.get();
  const auto& frame =
      session != nullptr ? session->frame_at(now.origin.block) : parts_.run.frame_at_rest;
  if (frame) shown.program = shown_frame(*frame, now);
  return shown;
}

dds::Status StatusBuilder::build(const LinkState& links) const {
  dds::Status status;
  status.machine = parts_.run.machine;
  status.session = parts_.gateway_session;
  status.time = parts_.clock.now();
  status.steady = std::chrono::duration_cast<std::chrono::microseconds>(
      parts_.clock.steady_now().time_since_epoch());
  status.outbox = static_cast<std::uint32_t>(
      std::min<std::uint64_t>(parts_.outbox.unacknowledged(), UINT32_MAX));
  machine::MachineStatus now = parts_.machine.status();
  // A test run is at a place of its program, and the machine is not.
  if (const RunSession* run = parts_.run.session.get(); run != nullptr && run->is_test())
    now.origin = run->check()->origin();
  fill_machine(status, now);
  if (parts_.run.session) fill_run(status, now);
  fill_execution(status, links);
  status.remote_enable = remote_enable();
  status.waits_for = waits_for(status.execution);
  return status;
}

void StatusBuilder::fill_machine(dds::Status& status, const machine::MachineStatus& now) const {
  status.position = values_of(now.position);
  auto axes = parts_.machine.capabilities().axes;
  if (settings_.axes) axes &= *settings_.axes;
  status.axes = static_cast<std::uint16_t>(axes.to_ulong());
  status.feed_mm_per_min = now.feed_per_minute;
  status.spindle_rpm = now.spindle_rpm;
  const machine::OperatorPanel& panel = parts_.machine.panel();
  status.feed_override = panel.feed_override;
  status.rapid_override = panel.rapid_override;
  status.spindle_override = panel.spindle_override;
  status.single_block = panel.single_block;
  status.emergency_stop = panel.emergency_stop;
  status.modes = modes(now);
  status.coordinates = coordinates(now);
  status.screen = screen(now);
}

void StatusBuilder::fill_run(dds::Status& status, const machine::MachineStatus& now) const {
  const RunSession& session = *parts_.run.session;
  status.run = session.run().run;
  if (session.is_mdi()) status.mode = dds::ControllerMode::ManualDataInput;
  status.program = session.run().program;
  status.total_bytes = session.run().size;
  status.sent = session.feed().sent();
  status.accepted = session.accepted();
  status.executed = parts_.recorder.executed().executed;
  status.offset = now.origin.offset;
  status.line = now.origin.line;
  status.sequence = now.origin.sequence;
  status.buffered_seconds = now.buffered.count();
}

void StatusBuilder::fill_execution(dds::Status& status, const LinkState& links) const {
  std::string message = parts_.run.last_message;
  status.execution =
      parts_.run.is_active() ? execution_of_run(message, links) : parts_.run.last_execution;
  if (status.emergency_stop) {
    status.execution = Execution::Stopped;
    message = "EMERGENCY STOP";
  } else if (!parts_.recorder.fault().empty()) {
    status.execution = Execution::Waiting;
    message = fmt::format("reports cannot be kept: {}", parts_.recorder.fault());
  } else if (message.empty()) {
    message =
        links.refused_by_server.empty()
            ? links.line_fault
            : fmt::format("the server does not command this gateway: {}", links.refused_by_server);
  }
  // What the machine itself lacks is reported also after a run: nothing begins before it is there.
  if (!parts_.run.is_active() && !status.emergency_stop) {
    if (const std::string notice = parts_.machine.notice(); !notice.empty()) message = notice;
  }
  status.message = valid_text(message, kMaxReason);
}

Execution StatusBuilder::execution_of_run(std::string& message, const LinkState& links) const {
  const MachineState state = parts_.machine.state();
  const RunSession& session = *parts_.run.session;
  message.clear();
  if (session.is_rebuilding()) {
    message =
        fmt::format("restart: looking through the program, block {}", session.restart()->block());
    if (session.restart()->state() == Rebuild::State::NeedsText)
      message +=
          links.is_connected ? ": waiting for its text" : ": waiting for its text: no server";
    return Execution::Waiting;
  }
  if (const ProgramCheck* check = session.check()) {
    message = fmt::format(
        "{}, block {}",
        session.is_test() ? kTestRun : "looking through the program for what the machine cannot do",
        check->block());
    return Execution::Waiting;
  }
  if (parts_.consent.is_awaited()) {
    message = kAwaitsCycleStart;
    if (session.restart() != nullptr) {
      message +=
          fmt::format(": restart of run {} after block {}", session.restart()->original_run(),
                      session.restart()->report().after.block);
    }
    return Execution::Waiting;
  }
  if (state == MachineState::Idle && session.waits() == RunSession::Waits::ForOperator) {
    message = "asks: " + session.prompt();
    return Execution::Waiting;
  }
  if (state == MachineState::Idle && session.waits() == RunSession::Waits::ForText) {
    if (!links.line_fault.empty()) {
      message = links.line_fault;
    } else if (links.has_line) {
      message = "waiting for text from the line";
    } else {
      message =
          links.is_connected ? "waiting for program text" : "waiting for program text: no server";
    }
    return Execution::Waiting;
  }
  if (state == MachineState::ProgramStop || state == MachineState::OptionalStop)
    message = parts_.recorder.notice();
  if (state == MachineState::SingleBlock) message = "single block";
  if (state == MachineState::Held) message = parts_.machine.notice();
  if (state == MachineState::Running && parts_.machine.panel().handwheel)
    message = "driven by the handwheel";
  return execution_of(state);
}

dds::RemoteEnable StatusBuilder::remote_enable() const {
  if (parts_.consent.is_unattended()) return dds::RemoteEnable::Unattended;
  return parts_.consent.is_given() ? dds::RemoteEnable::Given : dds::RemoteEnable::NotGiven;
}

dds::WaitsFor StatusBuilder::waits_for(Execution execution) const {
  using dds::WaitsFor;
  if (!parts_.recorder.fault().empty()) return WaitsFor::Disk;
  if (!parts_.run.is_active() || parts_.machine.panel().emergency_stop) return WaitsFor::Nothing;
  if (parts_.consent.is_awaited()) return WaitsFor::CycleStart;
  switch (parts_.machine.state()) {
    case MachineState::Held:
    case MachineState::ProgramStop:
    case MachineState::OptionalStop:
    case MachineState::SingleBlock:
      return WaitsFor::CycleStart;
    default:
      break;
  }
  if (execution != Execution::Waiting) return WaitsFor::Nothing;
  if (const ProgramCheck* check = parts_.run.session->check())
    return check->state() == ProgramCheck::State::NeedsText ? WaitsFor::Text : WaitsFor::Nothing;
  return parts_.run.session->waits() == RunSession::Waits::ForOperator ? WaitsFor::Answer
                                                                       : WaitsFor::Text;
}

std::string panel_status(const dds::Status& status) {
  const std::uint64_t ahead = status.sent > status.offset ? status.sent - status.offset : 0;
  const std::string text = status.run.empty() ? "" : fmt::format(" text_bytes={}", ahead);
  return fmt::format("{} remote_enable={} waits_for={} emergency_stop={}{}{}{}",
                     dds::to_string(status.execution), dds::to_string(status.remote_enable),
                     dds::to_string(status.waits_for),
                     status.emergency_stop ? "pressed" : "released", text,
                     status.message.empty() ? "" : " message=", one_line(status.message));
}

}  // namespace dripline::gateway
