#include <memory>

#include "clients/cli/accounts/account_text.hpp"
#include "clients/cli/context.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/password_prompt.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

int print_user(Context& context, const client::Reply<client::User>& user) {
  if (const auto status = finished(context, user)) return *status;
  context.print(user_details(*user));
  if (const auto shortfall = shortfall_text(*user); !shortfall.empty())
    print_error("dnc: {}\n", shortfall);
  return kExitOk;
}

struct AddUser {
  client::UserRequest user;
  bool has_password = false;
};

int add(Context& context, client::Client& client, const AddUser& command) {
  client::UserRequest user = command.user;
  if (command.has_password) {
    auto password = ask_new_password("password of " + user.name);
    if (!password) return complain(password.error());
    user.password = *std::move(password);
  }
  return print_user(context, client.add_user(user));
}

int list_users(Context& context, client::Client& client) {
  const auto users = client.users();
  if (const auto status = finished(context, users, "users")) return *status;
  context.print(user_table(*users));
  return kExitOk;
}

int show(Context& context, client::Client& client, const std::string& name) {
  return print_user(context, client.user(name));
}

struct UserRole {
  std::string name, role;
};

int set_role(Context& context, client::Client& client, const UserRole& command) {
  return print_user(context, client.change_user(
                                 command.name, {.role = command.role, .groups = {}, .locked = {}}));
}

struct UserGroups {
  std::string name;
  std::vector<std::string> groups;
};

int set_groups(Context& context, client::Client& client, const UserGroups& command) {
  return print_user(
      context,
      client.change_user(command.name, {.role = {}, .groups = command.groups, .locked = {}}));
}

int lock(Context& context, client::Client& client, const std::string& name) {
  return print_user(context, client.change_user(name, {.role = {}, .groups = {}, .locked = true}));
}

int unlock(Context& context, client::Client& client, const std::string& name) {
  return print_user(context, client.change_user(name, {.role = {}, .groups = {}, .locked = false}));
}

/// The own password needs the current one, if there is one; the server knows.
int set_password(Context& context, client::Client& client, const std::string& given) {
  const auto self = client.session();
  if (!self) return complain(self.error());
  const std::string name = given.empty() ? self->user : given;
  const auto user = client.user(name);
  if (!user) return complain(user.error());
  std::string current;
  if (name == self->user && user->has_password) {
    auto asked = ask_password("current password of " + name);
    if (!asked) return complain(asked.error());
    current = *std::move(asked);
  }
  auto password = ask_new_password("new password of " + name);
  if (!password) return complain(password.error());
  if (auto set = client.set_password(name, *password, current); !set) return complain(set.error());
  context.print(fmt::format("Set the password of {}; other sessions have ended.\n", name));
  return kExitOk;
}

int remove_user(Context& context, client::Client& client, const std::string& name) {
  if (auto removed = client.remove_user(name); !removed) return complain(removed.error());
  context.print(fmt::format("Removed user {} with all tokens and sessions.\n", name));
  return kExitOk;
}

using NamedAction = int (*)(Context&, client::Client&, const std::string&);
void add_named(Command group, Context& context, const char* verb, const char* help,
               NamedAction action) {
  auto command = group.add_subcommand(verb, help);
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "The user").required();
  add_json_flag(command, context);
  run_at_server(command, context, name, action);
}

void add_user_add(Command group, Context& context) {
  auto command = group.add_subcommand("add", "Add a user");
  auto options = std::make_shared<AddUser>();
  command.add_option("NAME", options->user.name, "Lower-case letters, digits, '.', '-', '_'")
      .required();
  command.add_option("--role", options->user.role, "What the user may do")
      .check(one_of(role_names()))
      .required();
  command.add_option("--group", options->user.groups, "A group whose machines the user may act on")
      .type_name("GROUP")
      .allow_extra_args(false);
  command.add_flag("--password", options->has_password,
                   "Ask for a password, or read it as a line from standard input");
  add_json_flag(command, context);
  command.footer(
      "Each role may do what those before it may:\n"
      "  viewer         read programs, machines, runs, reports\n"
      "  operator       start, hold, resume, answer on the machines of the user's groups\n"
      "  programmer     push, copy, rename, remove programs; setups of those machines\n"
      "  approver       accept and reject what machines sent; read the audit trail\n"
      "  administrator  users, groups, ports; every machine\n"
      "The group all has every machine. Without a password the user has tokens alone "
      "(dnc token add --user).");
  run_at_server(command, context, options, add);
}

void add_role(Command group, Context& context) {
  auto command = group.add_subcommand("role", "Change the role of a user");
  auto options = std::make_shared<UserRole>();
  command.add_option("NAME", options->name, "The user").required();
  command.add_option("ROLE", options->role, "The new role").check(one_of(role_names())).required();
  add_json_flag(command, context);
  command.footer("Tokens of the user never have more than this role from now on.");
  run_at_server(command, context, options, set_role);
}

void add_groups(Command group, Context& context) {
  auto command = group.add_subcommand("groups", "Replace the machine groups of a user");
  auto options = std::make_shared<UserGroups>();
  command.add_option("NAME", options->name, "The user").required();
  command.add_option("GROUP", options->groups, "The new groups (default: none)");
  add_json_flag(command, context);
  run_at_server(command, context, options, set_groups);
}

}  // namespace

void add_user_commands(Command app, Context& context) {
  auto group = app.add_subcommand("user", "People and programs that use the server");
  group.require_subcommand(1);
  add_user_add(group, context);
  auto listing = group.add_subcommand("list", "List all users");
  add_json_flag(listing, context);
  run_at_server(listing, context, list_users);
  add_named(group, context, "show", "Show a user", show);
  add_role(group, context);
  add_groups(group, context);
  auto password = group.add_subcommand("password", "Set a password");
  auto name = std::make_shared<std::string>();
  password.add_option("NAME", *name, "The user (default: yourself)");
  password.footer(
      "It is asked for, or read as a line from standard input; of your own the current one comes "
      "first.");
  run_at_server(password, context, name, set_password);
  add_named(group, context, "lock", "Refuse a user and all tokens until unlock", lock);
  add_named(group, context, "unlock", "Let a locked user in again", unlock);
  add_named(group, context, "remove", "Remove a user; the name is never used again", remove_user);
}

}  // namespace dripline::cli
