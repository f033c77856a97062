#include <algorithm>
#include <memory>

#include "clients/cli/accounts/account_text.hpp"
#include "clients/cli/context.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

struct GroupCommand {
  std::string group;
  std::vector<std::string> machines;
};

std::string machines_text(const client::MachineGroup& group) {
  return group.name == "all" ? "every machine" : names_text(group.machines);
}

int print_group(Context& context, const client::Reply<client::MachineGroup>& group) {
  if (const auto status = finished(context, group)) return *status;
  context.print(fmt::format("Machine group {}: {}\n", group->name, machines_text(*group)));
  return kExitOk;
}

int list_groups(Context& context, client::Client& client) {
  const auto groups = client.machine_groups();
  if (const auto status = finished(context, groups, "groups")) return *status;
  Table table({"NAME", "MACHINES"});
  for (const auto& group : *groups) table.add({printable(group.name), machines_text(group)});
  context.print(table);
  return kExitOk;
}

using GroupChange = client::Reply<client::MachineGroup> (client::Client::*)(std::string_view,
                                                                            std::string_view);
int change_each(Context& context, client::Client& client, const GroupCommand& command,
                GroupChange change) {
  client::Reply<client::MachineGroup> group;
  for (const auto& machine : command.machines) {
    group = (client.*change)(command.group, machine);
    if (!group) break;
  }
  return print_group(context, group);
}

int add(Context& context, client::Client& client, const GroupCommand& command) {
  const auto group = client.add_group(command.group);
  if (!group || command.machines.empty()) return print_group(context, group);
  return change_each(context, client, command, &client::Client::add_to_group);
}

int add_machine(Context& context, client::Client& client, const GroupCommand& command) {
  return change_each(context, client, command, &client::Client::add_to_group);
}

int remove_machine(Context& context, client::Client& client, const GroupCommand& command) {
  return change_each(context, client, command, &client::Client::remove_from_group);
}

int remove(Context& context, client::Client& client, const GroupCommand& command) {
  if (auto removed = client.remove_group(command.group); !removed) return complain(removed.error());
  context.print(fmt::format("Removed machine group {}.\n", command.group));
  return kExitOk;
}

using GroupAction = int (*)(Context&, client::Client&, const GroupCommand&);
enum class Machines { None, Some, OneAtLeast };
void add_verb(Command parent, Context& context, const char* verb, const char* help,
              GroupAction action, Machines machines) {
  auto command = parent.add_subcommand(verb, help);
  auto options = std::make_shared<GroupCommand>();
  command.add_option("GROUP", options->group, "The group").required();
  if (machines != Machines::None) {
    const auto option = command.add_option("MACHINE", options->machines, "Names of machines");
    if (machines == Machines::OneAtLeast) (void)option.required();
  }
  add_json_flag(command, context);
  run_at_server(command, context, options, action);
}

}  // namespace

void add_group_commands(Command app, Context& context) {
  auto group = app.add_subcommand("group", "Groups of machines, by which users may act on them");
  group.require_subcommand(1);
  auto listing = group.add_subcommand("list", "List all groups with their machines");
  add_json_flag(listing, context);
  run_at_server(listing, context, list_groups);
  add_verb(group, context, "add", "Make a group, if it is not there, and add machines", add,
           Machines::Some);
  add_verb(group, context, "add-machine", "Add machines to a group", add_machine,
           Machines::OneAtLeast);
  add_verb(group, context, "remove-machine", "Take machines out of a group", remove_machine,
           Machines::OneAtLeast);
  add_verb(group, context, "remove", "Remove a group that no user and no token has", remove,
           Machines::None);
}

}  // namespace dripline::cli
