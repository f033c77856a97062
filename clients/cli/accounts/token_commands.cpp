#include <memory>

#include "clients/cli/accounts/account_text.hpp"
#include "clients/cli/context.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

struct TokenCommand {
  client::TokenRequest token;
  std::vector<std::string> groups;
  unsigned days = 90;
};

/// The user that was named, or the caller.
client::Reply<std::string> user_or_self(client::Client& client, const std::string& user) {
  if (!user.empty()) return user;
  auto self = client.session();
  if (!self) return client::failed(self.error());
  return self->user;
}

int add(Context& context, client::Client& client, const TokenCommand& command) {
  const auto user = user_or_self(client, command.token.user);
  if (!user) return complain(user.error());
  client::TokenRequest request = command.token;
  request.user = *user;
  request.days = command.days;
  if (!command.groups.empty()) request.groups = command.groups;
  const auto token = client.add_token(request);
  if (const auto status = finished(context, token)) return *status;
  print_error("Token {} of {}: role {}, machine groups {}, until {}. It is shown once:\n",
              token->name, token->user, token->role, groups_text(token->groups),
              expiry_text(token->expires));
  context.print(token->secret + "\n");
  return kExitOk;
}

int list(Context& context, client::Client& client, const TokenCommand& command) {
  const auto user = user_or_self(client, command.token.user);
  if (!user) return complain(user.error());
  const auto tokens = client.tokens(*user);
  if (const auto status = finished(context, tokens, "tokens")) return *status;
  context.print(token_table(*tokens));
  return kExitOk;
}

int revoke(Context& context, client::Client& client, const TokenCommand& command) {
  const auto user = user_or_self(client, command.token.user);
  if (!user) return complain(user.error());
  if (auto revoked = client.revoke_token(*user, command.token.name); !revoked)
    return complain(revoked.error());
  context.print(fmt::format("Revoked {} of {}.\n", command.token.name, *user));
  return kExitOk;
}

void add_user_option(Command command, const std::shared_ptr<TokenCommand>& options,
                     const std::string& names = "--user") {
  command.add_option(names, options->token.user, "The user it belongs to (default: yourself)")
      .type_name("NAME");
}

void add_token_add(Command group, Context& context) {
  auto command = group.add_subcommand("add", "Make a token for a program");
  auto options = std::make_shared<TokenCommand>();
  command.add_option("NAME", options->token.name, "Lower-case letters, digits, '.', '-', '_'")
      .required();
  add_user_option(command, options);
  command.add_option("--role", options->token.role, "At most this (default: as much as its user)")
      .check(one_of(role_names()));
  command
      .add_option("--group", options->groups,
                  "At most the machines of these groups (default: those of its user)")
      .type_name("GROUP")
      .allow_extra_args(false);
  command.add_option("--days", options->days, "How long it lasts (default: 90)")
      .check(in_range(1u, 730u));
  add_json_flag(command, context);
  command.footer(
      "The secret is the only line on standard output, and the server does not keep it. A token "
      "never\nhas more than its user has at the moment, nor more than the token by which it is "
      "made.\n\nExample:\n  dnc token add dashboard --role viewer > dashboard.token");
  run_at_server(command, context, options, add);
}

}  // namespace

void add_token_commands(Command app, Context& context) {
  auto group = app.add_subcommand("token", "Access for programs, with a name and an end");
  group.require_subcommand(1);
  add_token_add(group, context);
  auto listing = group.add_subcommand("list", "List the tokens and sessions of a user");
  auto whose = std::make_shared<TokenCommand>();
  add_user_option(listing, whose, "USER,--user");
  add_json_flag(listing, context);
  run_at_server(listing, context, whose, list);
  auto revoking = group.add_subcommand("revoke", "Revoke a token, or end a session");
  auto which = std::make_shared<TokenCommand>();
  revoking.add_option("NAME", which->token.name, "As list shows it").required();
  add_user_option(revoking, which);
  run_at_server(revoking, context, which, revoke);
}

}  // namespace dripline::cli
