#include "clients/cli/context.hpp"
#include "clients/cli/server/archive_commands.hpp"
#include "clients/cli/server/backup_commands.hpp"
#include "clients/cli/server/migrate_command.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

void add_health(Details& details, const client::ServerInfo::Health& health) {
  if (health.status.empty()) return;  // an older server
  details.add("health", health.status);
  for (const auto& reason : health.reasons) {
    details.add("", fmt::format("{}: {} ({})", reason.subject, printable(reason.message),
                                printable(reason.detail)));
  }
}

template <class Connection>
void add_connection(Details& details, const char* label, const std::string& name,
                    const Connection& connection) {
  details.add(
      label,
      fmt::format("{}, {}{}", printable(name), connection.connected ? "connected" : "not connected",
                  connection.since.empty() ? "" : " since " + time_text(connection.since)));
  if (!connection.fault.empty()) details.add("", printable(connection.fault));
}

void add_broker(Details& details, const client::ServerInfo::Mqtt& mqtt) {
  add_connection(details, "MQTT", mqtt.broker, mqtt);
  details.add("", fmt::format("{} records wait, {} published", mqtt.records_waiting,
                              mqtt.records_published));
  if (mqtt.records_missing > 0) {
    details.add("", fmt::format("{} records went into archives before they were published",
                                mqtt.records_missing));
  }
  if (!mqtt.sparkplug) return;
  add_connection(details, "Sparkplug", mqtt.sparkplug->node, *mqtt.sparkplug);
  details.add("", fmt::format("{} messages published", mqtt.sparkplug->messages_published));
}

void add_cache(Details& details, const client::ServerInfo::ProgramCache& cache) {
  details.add("text kept", fmt::format("{} of {}, {} hits, {} misses", bytes_text(cache.used_bytes),
                                       bytes_text(cache.size_bytes), cache.hits, cache.misses));
  if (!cache.fault.empty()) details.add("", printable(cache.fault));
}

void add_sharing(Details& details, const client::ServerInfo::Sharing& sharing) {
  std::string standbys;
  for (const auto& standby : sharing.standbys)
    standbys += (standbys.empty() ? "" : "; ") + printable(standby);
  details.add("shared", fmt::format("term {}, standby: {}", sharing.term,
                                    standbys.empty() ? "none" : standbys));
}

int show_status(Context& context, client::Client& client) {
  auto server = client.server();
  if (const auto status = finished(context, server)) return *status;
  Details details;
  details.add("server", client.address().url);
  details.add("name", server->name);
  add_health(details, server->health);
  details.add("version", server->version);
  details.add("started", time_text(server->started));
  details.add("up for", duration_text(server->uptime_s));
  details.add("data", server->data_dir);
  details.add("machines",
              fmt::format("{}, {} connected", server->machines, server->machines_connected));
  details.add("programs", std::to_string(server->programs));
  details.add("runs active", std::to_string(server->runs_active));
  details.add("DDS", fmt::format("domain {}, {} messages rejected", server->dds.domain,
                                 server->dds.rejected));
  if (server->sharing) add_sharing(details, *server->sharing);
  if (server->program_cache) add_cache(details, *server->program_cache);
  if (server->mqtt) add_broker(details, *server->mqtt);
  context.print(details);
  return kExitOk;
}

int drain(Context& context, client::Client& client) {
  const auto sharing = client.drain();
  if (const auto status = finished(context, sharing)) return *status;
  for (const auto& standby : sharing->standbys)
    context.print(fmt::format("handed over to {}\n", printable(standby)));
  return kExitOk;
}

}  // namespace

void add_server_commands(Command app, Context& context) {
  auto group = app.add_subcommand("server", "The server itself");
  group.require_subcommand(1);
  auto status = group.add_subcommand("status", "Show version, uptime and counts");
  add_json_flag(status, context);
  run_at_server(status, context, show_status);
  auto drained = group.add_subcommand(
      "drain", "Hand the library over to the server that stands by, and stand by or end");
  add_json_flag(drained, context);
  run_at_server(drained, context, drain);
  add_backup_commands(group, context);
  add_archive_commands(group, context);
  add_migrate_command(group, context);
}

}  // namespace dripline::cli
