// What is asked of a machine besides runs, and what an operator does with its axes at rest.
#include <utility>

#include "gateway/interpreter/core/jog_move.hpp"
#include "protocol/process/log.hpp"
#include "server/machines/machine_service.hpp"

namespace dripline::machines {

Result<void> MachineService::check_knows(const MachineView& view, dds::CommandAction action) {
  if (view.commands > static_cast<std::uint32_t>(action)) return {};
  return fail(Errc::Unsupported, "machine {}: its gateway {} is older and does not know {}",
              view.machine.name, view.machine.gateway_version, dds::to_string(action));
}

Result<dds::Command> MachineService::command_with_setup(const MachineView& view,
                                                        dds::CommandAction action) {
  const auto setup = setup_of(view);
  if (!setup) return fail(setup.error());
  dds::Command command;
  command.machine = view.machine.name;
  command.action = action;
  if (*setup) command.setup = (*setup)->text;
  return command;
}

Result<std::string> MachineService::values(const ValueQuery& query) {
  Parts* parts = this->parts();
  if (parts == nullptr) return fail(Errc::Io, "the server is stopping");
  const auto view = connected_machine(query.machine);
  if (!view) return fail(view.error());
  if (view->has_serial_line()) {
    return fail(Errc::Unsupported,
                "machine {}: its control is at the end of a line, and its values are there",
                query.machine);
  }
  if (view->status && !view->status->screen) {
    return fail(Errc::Unsupported,
                "machine {}: its gateway {} is older and answers no questions for values",
                query.machine, view->machine.gateway_version);
  }
  // Before its first run the gateway shows what this would give the control.
  auto command = command_with_setup(*view, dds::CommandAction::Query);
  if (!command) return fail(command.error());
  command->argument = query.beginning;
  command->value = static_cast<double>(query.passed_over);
  return parts->commands.ask(*std::move(command));
}

/// What a control's screen shows is the setup's, also before the first program of a gateway.
bool MachineService::is_new_screen(const dds::Status& status) {
  if (!status.screen || status.serial_line || status.session == 0) return false;
  const std::lock_guard lock(screens_mutex_);
  return std::exchange(screens_[status.machine], status.session) != status.session;
}

void MachineService::show_setup(const std::string& machine) {
  pool_.post([this, machine] { give_setup(machine); });
}

/// A query brings the setup; this one asks for no values. A machine that cannot get it yet (its
/// status came before its announcement was taken, or two gateways have its name) gets it at its
/// next status.
void MachineService::give_setup(const std::string& machine) {
  constexpr double kPastTheLast = 1e9;
  Parts* parts = this->parts();
  const auto view = connected_machine(machine);
  if (parts == nullptr || !view || !view->status || view->is_contested) {
    const std::lock_guard lock(screens_mutex_);
    screens_.erase(machine);
    return;
  }
  if (!view->status->screen || view->has_serial_line()) return;
  auto command = command_with_setup(*view, dds::CommandAction::Query);
  if (!command) return;  // it goes with the next start
  command->value = kPastTheLast;
  if (const auto sent = parts->commands.send(*std::move(command)); !sent)
    process::log_warning("setup not shown machine={}: {}", machine, sent.error().what);
}

/// With the setup that a start would get: what it gives is the base of what the memory keeps.
Result<dds::Command> MachineService::command_at_rest(const std::string& machine,
                                                     dds::CommandAction action) {
  const auto view = machine_for_work(machine);
  if (!view) return fail(view.error());
  if (view->has_serial_line()) {
    return fail(Errc::Unsupported,
                "machine {}: its control is at the end of a line: do it there, where the axes are",
                machine);
  }
  if (auto knows = check_knows(*view, action); !knows) return fail(knows.error());
  return command_with_setup(*view, action);
}

Result<PositionAnswer> MachineService::position(const PositionRequest& request) {
  Parts* parts = this->parts();
  if (parts == nullptr) return fail(Errc::Io, "the server is stopping");
  using dds::CommandAction;
  auto command = command_at_rest(
      request.machine, request.is_playback ? CommandAction::Playback : CommandAction::SetPosition);
  if (!command) return fail(command.error());
  command->argument = request.argument;
  if (!request.is_playback) command->program = request.who;
  auto result = parts->commands.result_of(*std::move(command), {.given = request.given});
  if (!result) return fail(result.error());
  const std::string change = std::string(dds::kChangePrefix) + result->id;
  return PositionAnswer{request.is_playback ? "" : change, std::move(result->reason),
                        std::move(result->values)};
}

Result<JogAnswer> MachineService::jog(const JogRequest& request) {
  Parts* parts = this->parts();
  if (parts == nullptr) return fail(Errc::Io, "the server is stopping");
  auto command = command_at_rest(request.machine, dds::CommandAction::Jog);
  if (!command) return fail(command.error());
  command->argument = request.move;
  if (!interpreter::parse_jog_keep(request.move))
    process::log_info("command jog machine={} {}", request.machine, request.move);
  auto result = parts->commands.result_of(*std::move(command), {.given = request.given});
  if (!result) return fail(result.error());
  return JogAnswer{std::move(result->reason), std::move(result->values)};
}

}  // namespace dripline::machines
