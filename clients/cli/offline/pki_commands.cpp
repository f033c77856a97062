#include <unistd.h>
#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/tools/authority/authority.hpp"
#include "protocol/base/private_folder.hpp"
#include "protocol/pki/certificate.hpp"

namespace dripline::cli {
namespace {

namespace fs = std::filesystem;
using authority::Authority;
using authority::Holder;
using authority::Issued;
using authority::Role;

constexpr const char* kServerFolder = "/etc/dripline/dds";  ///< as the packages propose it

struct PkiCommand {
  std::string folder;
  std::string shop = "dripline";
  std::string machine;
  bool is_server = false;
  int days = Authority::kDefaultDays;
};

/// Refusals of the authority are no wrong use.
int refuse(const Error& error) {
  const int status = complain(error);
  const bool is_usage =
      error.code == Errc::Syntax || error.code == Errc::LimitExceeded || error.code == Errc::Io;
  return is_usage ? status : kExitNo;
}

Result<fs::path> folder_of(const PkiCommand& command) {
  if (!command.folder.empty()) return fs::path(command.folder);
  const auto state = default_state_folder(process_environment, ::geteuid() == 0);
  if (!state) return fail(state.error());
  return fs::path(*state) / "pki";
}

Result<Authority> open(const PkiCommand& command) {
  static const SystemClock clock;
  const auto folder = folder_of(command);
  if (!folder) return fail(folder.error());
  return Authority::open(*folder, clock);
}

Result<Holder> holder_of(const PkiCommand& command) {
  if (command.is_server == !command.machine.empty())
    return fail(Errc::Syntax, "name a machine, or --server");
  if (command.is_server) return authority::the_server();
  return Holder{Role::Gateway, command.machine};
}

std::string date_text(UtcTime time) {
  constexpr std::size_t kDate = 10;
  return time_text(to_iso8601(time)).substr(0, kDate);
}

std::string certificate_state(const Authority& authority, const Issued& issued, UtcTime now) {
  if (issued.revoked) return "revoked";
  if (issued.validity.not_after <= now) return "expired";
  if (!authority.has_folder(issued.holder)) return "no folder";
  return pki::days_left(issued.validity.not_after, now) < pki::kExpiryWarning.count() ? "renew it"
                                                                                      : "valid";
}

/// Which folder goes to which computer, and which setting names it to the daemon there.
std::string next_step(const Authority& authority, const Issued& issued) {
  const auto folder = fs::absolute(authority.folder_of(issued.holder)).string();
  const bool is_server = issued.holder.role == Role::Server;
  const std::string where = is_server ? std::string(kServerFolder)
                                      : fmt::format("{}/{}", kServerFolder, issued.holder.name);
  return fmt::format(
      "{}: valid until {}\n\nCopy this folder to the {}, over a path that no one reads (key.pem is "
      "its secret),\nto {} for example, for the user of {} alone. Then set there\n\n    "
      "dds-security = \"{}\"\n\nand restart {}.\n",
      folder, date_text(issued.validity.not_after),
      is_server ? std::string("server's computer")
                : fmt::format("computer of the gateway of {}", issued.holder.name),
      where, is_server ? "dncd" : "dncgw", where,
      is_server ? std::string("dncd")
                : fmt::format("dncgw@{} when the machine is idle", issued.holder.name));
}

int init(Context& context, const PkiCommand& command) {
  const auto folder = folder_of(command);
  if (!folder) return refuse(folder.error());
  const SystemClock clock;
  if (auto made = Authority::create(*folder, command.shop, clock); !made)
    return refuse(made.error());
  context.print(fmt::format(
      "The authority of '{}' is in {}.\n\nIts keys, {}/authority/*.key, stay on this computer: "
      "anyone who has them can pose as the\nserver and command every machine. Keep a copy of the "
      "folder in a safe place; without it no\ncertificate can be renewed.\n\nNext: dnc pki "
      "server, and dnc pki gateway MACHINE for each machine.\n",
      command.shop, fs::absolute(*folder).string(), fs::absolute(*folder).string()));
  return kExitOk;
}

int print_issued(Context& context, const Authority& authority, const Result<Issued>& issued) {
  if (!issued) return refuse(issued.error());
  context.print(next_step(authority, *issued));
  return kExitOk;
}

int issue(Context& context, const PkiCommand& command, const Holder& holder) {
  auto authority = open(command);
  if (!authority) return refuse(authority.error());
  return print_issued(context, *authority, authority->issue(holder, command.days));
}

int renew(Context& context, const PkiCommand& command) {
  const auto holder = holder_of(command);
  if (!holder) return refuse(holder.error());
  auto authority = open(command);
  if (!authority) return refuse(authority.error());
  return print_issued(context, *authority, authority->renew(*holder, command.days));
}

int revoke(Context& context, const PkiCommand& command) {
  const auto holder = holder_of(command);
  if (!holder) return refuse(holder.error());
  auto authority = open(command);
  if (!authority) return refuse(authority.error());
  if (auto revoked = authority->revoke(*holder); !revoked) return refuse(revoked.error());
  if (holder->role == Role::Gateway) {
    const auto server = fs::absolute(authority->folder_of(authority::the_server()));
    context.print(fmt::format(
        "Revoked: machine {}. It is refused as soon as the server has the new list:\ncopy "
        "{}/revoked.pem to the folder of dds-security\non the server's computer, and restart "
        "dncd.\n",
        holder->name, server.string()));
  } else {
    context.print(
        "Revoked: the server. Every gateway needs the new list: copy revoked.pem of its folder to "
        "its\ncomputer and restart dncgw. Then dnc pki server makes the server another "
        "certificate.\n");
  }
  return kExitOk;
}

nlohmann::ordered_json json_of(const Authority& authority, const Issued& issued, UtcTime now) {
  nlohmann::ordered_json json{
      {"role", authority::to_string(issued.holder.role)},
      {"name", issued.holder.name},
      {"state", certificate_state(authority, issued, now)},
      {"not_before", to_iso8601(issued.validity.not_before)},
      {"not_after", to_iso8601(issued.validity.not_after)},
      {"serial", issued.serial},
      {"folder", fs::absolute(authority.folder_of(issued.holder)).string()}};
  json["revoked"] = nullptr;
  if (issued.revoked) json["revoked"] = to_iso8601(*issued.revoked);
  return json;
}

int list(Context& context, const PkiCommand& command) {
  const auto authority = open(command);
  if (!authority) return refuse(authority.error());
  const UtcTime now = SystemClock().now();
  const auto identities = authority->identities();
  if (context.wants_json) {
    auto array = nlohmann::ordered_json::array();
    for (const auto& issued : identities) array.push_back(json_of(*authority, issued, now));
    context.print(json_text(
        nlohmann::ordered_json{{"shop", authority->shop()}, {"certificates", std::move(array)}}));
    return kExitOk;
  }
  Table table({"FOR", "NAME", "UNTIL", "STATE"});
  for (const auto& issued : identities) {
    const auto state = certificate_state(*authority, issued, now);
    table.add({std::string(authority::to_string(issued.holder.role)), issued.holder.name,
               date_text(issued.validity.not_after),
               Cell(state, state == "valid" ? Style::Plain : Style::Bad)});
  }
  context.print(table);
  return kExitOk;
}

using PkiOptions = std::shared_ptr<PkiCommand>;

/// `--folder`, and what is done.
void finish_verb(Command verb, Context& context, const PkiOptions& options,
                 int (*action)(Context&, const PkiCommand&)) {
  verb.add_option("--folder", options->folder, "Folder of the authority [STATE/pki]")
      .type_name("DIR");
  verb.callback([&context, options, action] { context.status = action(context, *options); });
}

void add_days(Command verb, const PkiOptions& options) {
  verb.add_option("--days", options->days, "Days until it expires")
      .check(in_range(1, Authority::kMaxDays));
}

PkiOptions add_holder(Command verb) {
  auto options = std::make_shared<PkiCommand>();
  verb.add_option("MACHINE", options->machine, "The machine");
  verb.add_flag("--server", options->is_server, "The server instead of a machine");
  return options;
}

}  // namespace

void add_pki_commands(Command app, Context& context) {
  auto group = app.add_subcommand("pki", "Certificates of the server and the gateways, for DDS");
  group.require_subcommand(1);
  group.footer(
      "No server is needed: run this on a computer of the office that neither the server nor a "
      "gateway is on.\nThe server's folder and each gateway's go to dncd and dncgw with "
      "--dds-security.");

  auto init_options = std::make_shared<PkiCommand>();
  auto made = group.add_subcommand("init", "Make the shop's own authority");
  made.add_option("--shop", init_options->shop, "Name of the shop, in every certificate")
      .type_name("NAME");
  finish_verb(made, context, init_options, init);

  auto server_options = std::make_shared<PkiCommand>();
  auto server = group.add_subcommand("server", "Make the server's folder");
  add_days(server, server_options);
  finish_verb(server, context, server_options, [](Context& shown, const PkiCommand& command) {
    return issue(shown, command, authority::the_server());
  });

  auto gateway_options = std::make_shared<PkiCommand>();
  auto gateway = group.add_subcommand("gateway", "Make the folder of a machine's gateway");
  gateway.add_option("MACHINE", gateway_options->machine, "The machine").required();
  add_days(gateway, gateway_options);
  finish_verb(gateway, context, gateway_options, [](Context& shown, const PkiCommand& command) {
    return issue(shown, command, {Role::Gateway, command.machine});
  });

  auto renewed =
      group.add_subcommand("renew", "Make another key and certificate before one expires");
  const auto renew_options = add_holder(renewed);
  add_days(renewed, renew_options);
  renewed.footer(
      "The earlier certificate stays valid until it expires. Where a key may be in wrong hands, "
      "revoke it.");
  finish_verb(renewed, context, renew_options, renew);

  auto revoked = group.add_subcommand("revoke", "Revoke the certificates of a machine");
  finish_verb(revoked, context, add_holder(revoked), revoke);

  auto listed = group.add_subcommand("list", "List the certificates and when they expire");
  add_json_flag(listed, context);
  finish_verb(listed, context, std::make_shared<PkiCommand>(), list);
}

}  // namespace dripline::cli
