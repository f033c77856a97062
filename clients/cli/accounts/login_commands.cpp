#include <memory>
#include <set>

#include "clients/cli/accounts/account_text.hpp"
#include "clients/cli/context.hpp"
#include "clients/cli/text/password_prompt.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/lib/saved_logins.hpp"

namespace dripline::cli {
namespace {

struct LoginCommand {
  std::string user;
  unsigned hours = 12;
};

/// The file of logins; without a home it complains and gives nothing.
std::optional<client::SavedLogins> saved_logins(int& status) {
  const auto file = client::login_file(process_environment);
  if (file) return client::SavedLogins(*file);
  status = complain(Error{Errc::NotFound,
                          "neither XDG_CONFIG_HOME nor HOME is set: there is no place for a "
                          "login"});
  return std::nullopt;
}

/// As --server takes them.
std::string urls_of(const client::Client& client) {
  std::string text;
  for (const auto& server : client.servers()) text += (text.empty() ? "" : ",") + server.url;
  return text;
}

int login(Context& context, client::Client& client, const LoginCommand& command) {
  int status = kExitOk;
  const auto logins = saved_logins(status);
  if (!logins) return status;
  auto user = command.user.empty() ? process_environment("USER") : command.user;
  if (!user) return complain(Error{Errc::Syntax, "name a user: USER is not set"});
  auto password = ask_password("password of " + *user);
  if (!password) return complain(password.error());
  const auto session =
      client.sign_in({.user = *user, .password = *password, .hours = command.hours});
  if (!session) return complain(session.error());
  // Servers of one library have the same sessions.
  for (const auto& server : client.servers()) {
    if (auto saved = logins->save(server.url, session->secret, session->expires); !saved)
      return complain(saved.error());
  }
  context.print(fmt::format("Logged in at {} as {} ({}) until {}.\n", urls_of(client),
                            printable(session->user), printable(session->role),
                            expiry_text(session->expires)));
  return kExitOk;
}

/// Ends the saved session and no other token that options or environment may name.
int logout(Context& context, client::Client& client) {
  int status = kExitOk;
  const auto logins = saved_logins(status);
  if (!logins) return status;
  auto servers = client.servers();
  std::set<std::string> secrets;
  for (const auto& server : servers) {
    const auto secret = logins->find(server.url);
    if (!secret) return complain(secret.error());
    if (*secret) secrets.insert(**secret);
  }
  for (const auto& secret : secrets) {
    for (auto& server : servers) server.token = secret;
    const auto ended = client::Client(servers).sign_out();
    // One that the server does not know any more has ended as well.
    if (!ended && ended.error().kind != client::Failure::Kind::Denied)
      return complain(ended.error());
  }
  for (const auto& server : servers) {
    if (auto removed = logins->remove(server.url); !removed) return complain(removed.error());
  }
  context.print(secrets.empty() ? fmt::format("There was no login at {}.\n", urls_of(client))
                                : fmt::format("Logged out at {}.\n", urls_of(client)));
  return kExitOk;
}

int whoami(Context& context, client::Client& client) {
  const auto session = client.session();
  if (const auto status = finished(context, session)) return *status;
  Details details;
  details.add("server", client.address().url);
  details.add("user", printable(session->user));
  details.add("role", printable(session->role));
  details.add("groups", names_text(session->groups));
  details.add("by", fmt::format("{} {}", printable(session->kind), printable(session->credential)));
  details.add("expires", expiry_text(session->expires));
  details.add("from", printable(session->address));
  context.print(details);
  return kExitOk;
}

}  // namespace

void add_login_commands(Command app, Context& context) {
  auto in = app.add_subcommand("login", "Sign in at a server and keep the session for later calls");
  auto options = std::make_shared<LoginCommand>();
  in.add_option("USER", options->user, "Who signs in (default: the USER of this computer)");
  in.add_option("--hours", options->hours, "How long the login lasts (default: 12)")
      .check(in_range(1u, 720u));
  in.footer(
      "The password is asked for, or read as a line from standard input. The session is kept in\n"
      "$XDG_CONFIG_HOME/dripline/logins.json or ~/.config/dripline/logins.json, one for each "
      "server.");
  run_at_server(in, context, options, login);
  auto out = app.add_subcommand("logout", "End the session that login keeps for this server");
  run_at_server(out, context, logout);
  auto who = app.add_subcommand("whoami", "Show the user, role and machine groups of these calls");
  add_json_flag(who, context);
  run_at_server(who, context, whoami);
}

}  // namespace dripline::cli
