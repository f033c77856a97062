#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <filesystem>
#include <fstream>

#include "server/api/api.hpp"
#include "server/api/metrics_text.hpp"
#include "server/machines/machine_control.hpp"

namespace dripline::api {
namespace {

using machines::MachineView;

double seconds(UtcTime time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

double number(bool is_true) {
  return is_true ? 1 : 0;
}

void add_process(MetricsText& out) {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  constexpr double kMicro = 1e-6;
  const auto cpu = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + kMicro * static_cast<double>(time.tv_usec);
  };
  out.counter("process_cpu_seconds_total", "Processor time of dncd.",
              cpu(usage.ru_utime) + cpu(usage.ru_stime));
  std::uint64_t pages = 0, resident = 0;
  if (std::ifstream("/proc/self/statm") >> pages >> resident) {
    out.gauge("process_resident_memory_bytes", "Memory of dncd.",
              static_cast<double>(resident) * static_cast<double>(::sysconf(_SC_PAGESIZE)));
  }
  std::error_code ec;
  const std::filesystem::directory_iterator files("/proc/self/fd", ec);
  if (!ec) {
    out.gauge("process_open_fds", "Open files of dncd.",
              static_cast<double>(std::distance(begin(files), end(files))));
  }
}

void add_disk(MetricsText& out, const std::string& folder) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0) return;
  const auto block = static_cast<double>(disk.f_frsize);
  out.gauge("dripline_disk_size_bytes", "Size of the disk of the state folder.",
            block * static_cast<double>(disk.f_blocks));
  out.gauge("dripline_disk_free_bytes", "What is left of the disk of the state folder.",
            block * static_cast<double>(disk.f_bavail));
}

void add_health(MetricsText& out, const library::Health::State& state) {
  out.gauge("dripline_health", "0 ok, 1 degraded, 2 failed.", static_cast<double>(state.level));
  out.gauge("dripline_health_findings", "What is wrong, by subject.");
  std::map<std::string, int> subjects;
  for (const auto& finding : state.findings) ++subjects[finding.subject];
  for (const auto& [subject, count] : subjects) out.sample(count, {{"subject", subject}});
}

void add_backups(MetricsText& out, const library::Backups::State& state, UtcTime now) {
  const auto& known = state.list.backups;
  out.gauge("dripline_backups", "Backups in the folder.", static_cast<double>(known.size()));
  out.gauge("dripline_backups_damaged", "Backups that cannot be read.",
            static_cast<double>(state.list.damaged.size()));
  out.gauge("dripline_backup_overdue", "1: the newest backup is older than it should be.",
            number(state.is_overdue));
  const backup::Backup* const newest = backup::newest(known, now);
  if (newest == nullptr) return;
  out.gauge("dripline_backup_newest_timestamp_seconds", "When the newest backup was made.",
            seconds(newest->made));
}

void add_sharing(MetricsText& out, const SharedLibrary& shared) {
  out.gauge("dripline_server_term", "The number of this server's taking of the library.",
            static_cast<double>(shared.term));
  if (!shared.has_standby) return;
  if (const auto waiting = shared.waiting()) {
    out.gauge("dripline_server_standbys", "Servers that wait to take the library over.",
              static_cast<double>(waiting->size()));
  }
}

/// Nothing before the trail was verified once.
void add_audit(MetricsText& out, const library::AuditChain::State& state) {
  if (state.verification) {
    out.gauge("dripline_audit_chain_ok", "1: the audit trail is as it was written.",
              number(!state.verification->fault));
    out.gauge("dripline_audit_entries", "Entries of the audit trail.",
              static_cast<double>(state.verification->entries));
  }
  if (state.checkpoint) {
    out.gauge("dripline_audit_checkpoint_timestamp_seconds",
              "When the audit trail was signed last.", seconds(state.checkpoint->time));
  }
}

/// Nothing before the archives were checked once.
void add_archives(MetricsText& out, library::Retention& retention) {
  const auto state = retention.archive_check().state();
  if (!state) return;
  out.gauge("dripline_archives", "Archives that the audit trail has.",
            static_cast<double>(state->archives));
  out.gauge("dripline_archives_damaged", "Archives that are missing or were changed.",
            static_cast<double>(state->faults.size()));
}

void add_webhooks(MetricsText& out, webhooks::Webhooks& all) {
  const auto webhooks = all.list();
  if (!webhooks || webhooks->empty()) return;
  const auto each = [&](std::string_view name, std::string_view help, auto&& value) {
    out.gauge(name, help);
    for (const auto& webhook : *webhooks)
      out.sample(static_cast<double>(value(webhook)), {{"webhook", webhook.name}});
  };
  each("dripline_webhook_events_waiting", "Events that a webhook has not got.",
       [](const storage::Webhook& webhook) { return webhook.waiting; });
  each("dripline_webhook_failures", "Failed deliveries since the last success.",
       [](const storage::Webhook& webhook) { return webhook.failures; });
  each("dripline_webhook_events_lost", "Events dropped because a webhook failed too long.",
       [](const storage::Webhook& webhook) { return webhook.lost; });
}

void add_publisher(MetricsText& out, const mqtt::Publisher& publisher) {
  const auto state = publisher.state();
  if (!state) return;
  out.gauge("dripline_mqtt_connected", "1: records and states reach the broker.",
            number(state->is_connected));
  out.gauge("dripline_mqtt_records_waiting", "Records that the broker has not acknowledged.",
            static_cast<double>(state->waiting));
  out.counter("dripline_mqtt_records_total", "Records that the broker has acknowledged.",
              static_cast<double>(state->records));
  out.counter("dripline_mqtt_states_total", "States of machines that the broker has acknowledged.",
              static_cast<double>(state->states));
  out.counter("dripline_mqtt_connections_total", "Connections to the broker.",
              static_cast<double>(state->connections));
  out.counter("dripline_mqtt_records_missing_total",
              "Records that went into archives before they were published.",
              static_cast<double>(state->missing));
}

void add_sparkplug(MetricsText& out, const mqtt::SparkplugNode& node) {
  const auto state = node.state();
  out.gauge("dripline_sparkplug_connected", "1: the node of Sparkplug B reaches the broker.",
            number(state.is_connected));
  out.counter("dripline_sparkplug_messages_total", "Births, changes and deaths published.",
              static_cast<double>(state.messages));
}

void add_cache(MetricsText& out, const cache::DiskCache::State& state) {
  out.gauge("dripline_cache_size_bytes", "What program text on the server's own disk may take.",
            static_cast<double>(state.capacity));
  out.gauge("dripline_cache_used_bytes", "What it takes.", static_cast<double>(state.bytes));
  out.gauge("dripline_cache_ok", "1: text is kept there; 0: its disk is full or broken.",
            number(state.fault.empty()));
  out.counter("dripline_cache_hits_total", "Chunks of text that were on the server's own disk.",
              static_cast<double>(state.hits));
  out.counter("dripline_cache_misses_total", "Chunks of text that came from the database.",
              static_cast<double>(state.misses));
  out.counter("dripline_cache_fetched_total",
              "Chunks of text that were fetched before a machine asked for them.",
              static_cast<double>(state.ahead));
  out.counter("dripline_cache_damaged_total", "Files there that were damaged, and fetched again.",
              static_cast<double>(state.damaged));
}

void add_folders(MetricsText& out, const folders::Folders& all) {
  const auto states = all.states();
  if (states.empty()) return;
  const auto each = [&](std::string_view name, std::string_view help, auto&& value) {
    out.gauge(name, help);
    for (const auto& state : states)
      out.sample(static_cast<double>(value(state)), {{"folder", state.settings.name}});
  };
  each("dripline_folder_ok", "1: the hot folder can be read, and its files moved.",
       [](const folders::FolderState& state) { return state.fault.empty() ? 1 : 0; });
  each("dripline_folder_files_waiting", "Files that are not complete, or wait for another try.",
       [](const folders::FolderState& state) { return state.waiting; });
}

/// One family after the other, as the format demands, so the machines are gone through for each.
void add_machines(MetricsText& out, const std::vector<MachineView>& views) {
  const auto each = [&](std::string_view name, std::string_view help, auto&& value) {
    out.gauge(name, help);
    for (const auto& view : views) {
      if (const std::optional<double> sample = value(view))
        out.sample(*sample, {{"machine", view.machine.name}});
    }
  };
  const auto of_status = [&](std::string_view name, std::string_view help, auto&& value) {
    each(name, help, [&](const MachineView& view) -> std::optional<double> {
      if (!view.is_heard() || !view.status) return std::nullopt;
      return value(*view.status);
    });
  };
  each("dripline_machine_connected", "1: its gateway or line is connected.",
       [](const MachineView& view) { return std::optional(number(view.is_connected)); });
  each("dripline_machine_status_stale", "1: its gateway is connected, but no status arrives.",
       [](const MachineView& view) { return std::optional(number(view.is_stale)); });
  out.gauge("dripline_machine_execution", "1 for the state that the machine is in.");
  for (const auto& view : views) {
    if (!view.is_heard() || !view.status) continue;
    out.sample(1, {{"machine", view.machine.name},
                   {"state", dds::to_string(view.status->execution)},
                   {"control", view.machine.control}});
  }
  using dds::Status;
  of_status("dripline_machine_buffered_seconds", "Motion that the gateway has ahead.",
            [](const Status& status) { return status.buffered_seconds; });
  of_status("dripline_machine_outbox_records", "Records that the gateway has not delivered.",
            [](const Status& status) { return static_cast<double>(status.outbox); });
  of_status("dripline_machine_run_sent_blocks", "Blocks of the current run sent.",
            [](const Status& status) { return static_cast<double>(status.sent); });
  of_status("dripline_machine_run_executed_blocks", "Blocks of the current run executed.",
            [](const Status& status) { return static_cast<double>(status.executed); });
  each("dripline_machine_clock_ahead_seconds", "How far the gateway's clock is ahead.",
       [](const MachineView& view) -> std::optional<double> {
         if (!view.clock_ahead) return std::nullopt;
         return std::chrono::duration<double>(*view.clock_ahead).count();
       });
}

/// By what they are for: those of DDS belong to the server and to the gateways.
void add_certificates(MetricsText& out, const Services& services) {
  const auto& facts = services.facts;
  out.gauge("dripline_certificate_expiry_timestamp_seconds", "When a certificate expires.");
  if (facts.certificate_expires)
    out.sample(seconds(*facts.certificate_expires), {{"use", "https"}});
  if (facts.dds_certificate_expires)
    out.sample(seconds(*facts.dds_certificate_expires), {{"use", "dds"}});
  for (const auto& view : services.machines.machines()) {
    if (view.certificate_expires)
      out.sample(seconds(*view.certificate_expires),
                 {{"use", "gateway"}, {"machine", view.machine.name}});
  }
}

void add_ports(MetricsText& out, const std::vector<ports::PortView>& views) {
  out.gauge("dripline_port_open", "1: the serial line is open.");
  for (const auto& view : views) out.sample(number(view.is_open), {{"port", view.port.name}});
  out.gauge("dripline_port_sent_characters", "Sent since the line was opened.");
  for (const auto& view : views)
    out.sample(static_cast<double>(view.sent), {{"port", view.port.name}});
  out.gauge("dripline_port_received_characters", "Received since the line was opened.");
  for (const auto& view : views)
    out.sample(static_cast<double>(view.received), {{"port", view.port.name}});
}

void add_requests(MetricsText& out, const RequestTimes& times) {
  out.histogram("dripline_http_request_seconds", "How long answers took, without their bodies.");
  for (const auto& [route, taken] : times.all())
    out.distribution(RequestTimes::kBounds, taken.counts, taken.sum, "route", route);
}

Response list_metrics(Services& services, const RequestTimes& times, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto programs = services.programs.count();
  if (!programs) return error_response(programs.error());
  storage::RunFilter active_runs;
  active_runs.state = storage::RunState::Active;
  const auto active = services.runs.count(active_runs);
  if (!active) return error_response(active.error());

  MetricsText out;
  out.gauge("dripline_info", "The server's version.");
  out.sample(1, {{"version", services.facts.version}});
  out.gauge("dripline_start_timestamp_seconds", "When the server was started.",
            seconds(services.facts.started));
  out.gauge("dripline_server_active", "1: this server has its library; 0: it stands by.", 1);
  if (services.shared) add_sharing(out, *services.shared);
  if (services.health != nullptr) add_health(out, services.health->state());
  out.gauge("dripline_programs", "Programs in the library.", static_cast<double>(*programs));
  out.gauge("dripline_runs_active", "Runs in progress.", static_cast<double>(*active));
  out.counter("dripline_dds_rejected_messages_total", "DDS messages that were not accepted.",
              static_cast<double>(services.dds_rejected()));
  add_machines(out, services.machines.machines());
  if (services.ports != nullptr) add_ports(out, services.ports->ports());
  add_requests(out, times);
  add_certificates(out, services);
  if (services.backups != nullptr)
    add_backups(out, services.backups->state(), services.clock.now());
  add_audit(out, services.chain.state());
  if (services.retention != nullptr) add_archives(out, *services.retention);
  if (services.webhooks != nullptr) add_webhooks(out, *services.webhooks);
  if (services.publisher != nullptr) add_publisher(out, *services.publisher);
  if (services.sparkplug != nullptr) add_sparkplug(out, *services.sparkplug);
  if (services.cache != nullptr) add_cache(out, services.cache->state());
  if (services.folders != nullptr) add_folders(out, *services.folders);
  add_disk(out, services.facts.data_dir);
  add_process(out);

  Response response;
  response.content_type = MetricsText::kContentType;
  response.body = out.take();
  return response;
}

}  // namespace

void add_metrics_routes(Router& router, Services& services, const RequestTimes& times) {
  router.add("GET", "/api/v1/metrics", [&services, &times](const Request& request) {
    return list_metrics(services, times, request);
  });
}

}  // namespace dripline::api
