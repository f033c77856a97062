#include "clients/cli/server/jog_commands.hpp"

#include <fmt/core.h>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>

#include "clients/cli/server/held_jog.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

struct JogCommand {
  std::string machine;
  client::JogToMake step;
  bool is_held = false;
};

bool is_rotary(const std::string& axis) {
  return axis.size() == 1 && std::string_view("ABC").find(axis[0]) != std::string_view::npos;
}

/// As the control shows positions.
client::Reply<std::string> shown_unit(client::Client& client, const std::string& machine) {
  auto found = client.machine(machine);
  if (!found) return tl::make_unexpected(found.error());
  const auto& display = found->display;
  return std::string(display && display->units == "inch" ? "in" : "mm");
}

/// In JSON it would be nothing, which means the highest feed.
bool is_number(const client::JogToMake& step) {
  return std::isfinite(step.distance) && std::isfinite(step.feed.value_or(0));
}

int jog(Context& context, client::Client& client, const JogCommand& given) {
  if (!is_number(given.step)) {
    print_error("dnc: distance and feed are numbers\n");
    return kExitUsage;
  }
  JogCommand command = given;
  if (command.step.unit.empty() && !is_rotary(command.step.axis)) {
    const auto unit = shown_unit(client, command.machine);
    if (!unit) return complain(unit.error());
    command.step.unit = *unit;
  }
  if (command.is_held) return hold_jog(context, client, command.machine, command.step);
  const auto done = client.jog(command.machine, command.step);
  if (!done) return complain(done.error());
  context.print(context.wants_json ? json_text(*done)
                                   : fmt::format("{}: {}\n", command.machine, done->text));
  return done->reached ? kExitOk : kExitNo;
}

int stop_jog(Context& context, client::Client& client, const std::string& machine) {
  const auto done =
      client.command_machine(machine, {.action = "stop_jog", .text = {}, .name = {}, .value = {}});
  if (!done) return complain(done.error());
  context.print(fmt::format("{} took stop_jog\n", machine));
  return kExitOk;
}

}  // namespace

void add_jog_verbs(Command group, Context& context) {
  auto command = group.add_subcommand("jog", "Move one axis by one step, without a program");
  auto options = std::make_shared<JogCommand>();
  command.add_option("MACHINE", options->machine, "The machine").required();
  command.add_option("AXIS", options->step.axis, "Letter of the axis").required();
  command
      .add_option("DISTANCE", options->step.distance,
                  "How far, with its sign, along the machine's axis; X of a lathe: of the diameter")
      .required();
  command
      .add_option("--unit", options->step.unit,
                  "Unit of DISTANCE and --feed; without it that of the control's display. Rotary "
                  "axes: degrees")
      .check(one_of({"mm", "in", "deg"}));
  command
      .add_option("--feed", options->step.feed,
                  "Feed per minute; without it the highest that the gateway takes")
      .check(positive_number());
  command.add_flag("--hold", options->is_held,
                   "Move only while a key is held down (its repeats are read from the input), "
                   "DISTANCE at most");
  add_json_flag(command, context);
  command.footer(
      "A click of a handwheel is such a step. It is refused while a run is active, another step "
      "moves, a hold or an alarm is there,\nthe position is not known, without the remote enable "
      "at "
      "an attended machine, beyond the travel and the control's own\nlimits, and where it is "
      "larger "
      "or quicker than the gateway allows (dncgw --jog-step, --jog-feed).\nIt begins within 2 s or "
      "never, and is answered when the axis rests; a lost connection neither lengthens nor repeats "
      "it.\ndnc machine stop-jog, a hold, an abort, the emergency stop and a feed override of 0 "
      "stop "
      "it. MDI after it begins with\nthe modes of power on, and without a tool.\n\nWith "
      "--hold the axis begins to move with the second repeat of the key, and stops when no "
      "repeat\nhas come for 250 ms; where dnc, the server or the network is lost, 300 ms after the "
      "gateway has heard\nthe last. DISTANCE and --feed have the same limits as a "
      "step's.\n\nExample:\n  dnc "
      "machine jog mill-1 X -0.1 --unit mm --feed 100");
  run_at_server(command, context, options, jog);

  auto stop = group.add_subcommand("stop-jog", "Stop the axis that dnc machine jog moves");
  auto machine = std::make_shared<std::string>();
  stop.add_option("MACHINE", *machine, "The machine").required();
  run_at_server(stop, context, machine, stop_jog);
}

}  // namespace dripline::cli
