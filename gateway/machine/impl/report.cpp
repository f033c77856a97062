#include "gateway/machine/impl/executor.hpp"

#include "protocol/base/invariant.hpp"

namespace dripline::machine::impl {

using interpreter::Origin;

namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace

/// A zero-time action: done as soon as it is reported.
void Executor::report(const Action& action) {
  const Origin origin = action.origin;
  bool is_finished = false;
  std::visit(Overloaded{
                 [&](const Text& text) { report_text(origin, text); },
                 [&](const CloseDevice& close) {
                   sink_.on_close({origin, close.device});
                 },
                 [&](const CoolantChange& coolant) {
                   if (is_emergency_) return;
                   shown_.flood = coolant.flood;
                   shown_.mist = coolant.mist;
                   sink_.on_coolant({origin, coolant.flood, coolant.mist});
                 },
                 [&](const interpreter::Spindle& spindle) {
                   if (!is_emergency_) set_spindle(spindle);
                 },
                 [&](const interpreter::ToolChange& tool) {
                   show(tool);
                   sink_.on_tool(tool);
                 },
                 [&](const interpreter::Miscellaneous& code) { sink_.on_miscellaneous(code); },
                 [&](const interpreter::PinChange& pin) { sink_.on_pin(pin); },
                 [&](const interpreter::Stop& stop) { report_stop(stop); },
                 [&](const interpreter::End& end) {
                   stop_ = MachineState::Completed;
                   const interpreter::End copy = end;
                   finish_action();  // the counter is complete when the end is reported
                   sink_.on_end(copy);
                   is_finished = true;
                 },
                 [&](const AlarmMarker&) {
                   report_alarm(origin);
                   is_finished = true;
                 },
                 [](const BlockEnd&) {},
                 [](const auto&) { invariant(false, "moves, dwells and probes take time"); },
             },
             action.body);
  if (!is_finished) finish_action();
}

void Executor::set_spindle(const interpreter::Spindle& spindle) {
  const bool is_off = spindle.state == interpreter::SpindleState::Off;
  withheld_spindle_.reset();
  if (!is_off && panel_.dry_run && !panel_.dry_run_spindle) {
    withheld_spindle_ = spindle;
    return;
  }
  spindle_.set(spindle);
  sink_.on_spindle(spindle);
}

void Executor::show(const interpreter::ToolChange& tool) {
  shown_.next_tool.reset();
  (tool.is_preselection ? shown_.next_tool : shown_.tool) = tool.number;
  if (tool.offset) shown_.tool_offset = tool.offset;
}

void Executor::report_text(const Origin& origin, const Text& text) {
  const std::string_view content = queue_.texts().text(text.piece);
  switch (text.kind) {
    case Text::Kind::Output:
      return sink_.on_output({origin, text.device, content});
    case Text::Kind::Open:
      return sink_.on_open({origin, text.device, std::nullopt});
    case Text::Kind::OpenNamed:
      return sink_.on_open({origin, text.device, content});
    case Text::Kind::Message:
      return sink_.on_message({origin, content});
    case Text::Kind::Warning:
      return sink_.on_warning({origin, {text.id, std::string(content), text.line, text.column}});
  }
}

/// Ends everything: nothing that is queued after it is executed.
void Executor::report_alarm(const Origin& origin) {
  const interpreter::Alarm alarm{origin, std::move(*queue_.alarm)};
  is_held_ = false;
  discard();
  stop_ = MachineState::Alarmed;
  sink_.on_alarm(alarm);
}

void Executor::report_stop(const interpreter::Stop& stop) {
  const bool is_optional = stop.kind == interpreter::StopKind::Optional;
  if (is_optional && !panel_.optional_stop) return;
  stopped_at_ = stop.kind;
  if (is_optional)
    stop_ = MachineState::OptionalStop;
  else if (stop.kind != interpreter::StopKind::ToolChange || limits_.waits_at_tool_change)
    stop_ = MachineState::ProgramStop;
  sink_.on_stop(stop);
}

}  // namespace dripline::machine::impl
