#include "server/app/impl/server_parts.hpp"

#include "protocol/process/log.hpp"
#include "server/app/shared_settings.hpp"
#include "server/identity/revoked_certificates.hpp"

namespace dripline::app {
namespace {

constexpr std::chrono::seconds kWebhookTimeout{5};

/// What is in these is no program of a hot folder's.
std::vector<std::filesystem::path> own_folders(const StateFolder& state, const Settings& settings) {
  std::vector<std::filesystem::path> folders{state.path()};
  for (const std::string& path : {settings.backups, settings.archives})
    if (!path.empty()) folders.emplace_back(path);
  return folders;
}

}  // namespace

ServerParts::ServerParts(StateFolder state_folder, KeptStore opened,
                         std::optional<backup::BackupFolder> backup_folder,
                         const Settings& settings, const Clock& system_clock, const Loaded& loaded,
                         const DdsNetwork& setup)
    : clock(system_clock),
      dds_certificate_expires(setup.certificate_expires),
      certificate_expires(https_certificate_expiry(settings)),
      revoked_file(settings.tls_client_revoked),
      folder(std::move(state_folder)),
      is_standby_expected(settings.standby),
      folder_lock(std::move(opened.folder_lock)),
      cache(std::move(opened.cache)),
      store(std::move(opened.store)),
      fetcher(make_fetcher()),
      health(clock),
      certificates(health, clock),
      lost_machines(health, clock),
      waiting_entries(folder.waiting_entries()),
      audit(store->audit, clock,
            library::AuditTrail::Late{.writer = late_writer, .kept = waiting_entries}),
      chain(
          {.store = store->audit, .clock = clock, .key = loaded.key, .database = loaded.identity}),
      backups(make_backups(std::move(backup_folder), settings)),
      retention(make_retention(settings, loaded)),
      accounts({.store = store->accounts, .audit = audit, .clock = clock}, {}, loaded.users),
      programs(*store, clock, catalog, audit),
      releases({.store = *store, .clock = clock, .key = loaded.key, .database = loaded.identity},
               loaded.policy),
      attachments(*store),
      search(*store),
      runs(*store),
      hold_reasons({.store = *store,
                    .clock = clock,
                    .on_change = [this](const std::string& machine) { show_machine(machine); },
                    .late =
                        [this](std::string what, std::function<Result<void>()> write) {
                          late_writer.write(std::move(what), std::move(write));
                        }}),
      jobs({.store = *store,
            .releases = releases,
            .clock = clock,
            .on_change = [this](const library::JobChange& change) { show_jobs(change); }}),
      paths({.store = *store, .releases = releases, .clock = clock}),
      imports({.store = *store,
               .paths = paths,
               .policy = releases.policy(),
               .clock = clock,
               .on_change = api::publish_imports_to(events)}),
      folders(
          {.programs = programs,
           .catalog = catalog,
           .sources = {.store = *store, .releases = releases, .clock = clock},
           .spool = folder.path(),
           .own_folders = own_folders(folder, settings),
           .on_fault = watch_faults("folders", "folder",
                                    "a hot folder cannot be read, or its files cannot be taken")},
          settings.folders),
      measurements(
          {.store = *store,
           .clock = clock,
           .on_part =
               [this, publish = api::publish_parts_to(events)](const auto& part) {
                 publish(part);
                 offsets.note(part.machine);
               },
           .on_derived = [this](const std::string& machine) { offsets.note(machine); },
           .hold_queue = [this](const storage::MeasuredPart& part,
                                const std::string& reason) { return hold_queue(part, reason); },
           .hold_machine = [this](
                               const storage::MeasuredPart& part,
                               const std::string& reason) { return hold_machine(part, reason); }}),
      setups(store->setups, catalog, audit),
      webhook_sender(webhooks::make_http_sender(kWebhookTimeout)),
      webhooks({.store = store->webhooks,
                .sender = *webhook_sender,
                .clock = clock,
                .server = loaded.identity,
                .on_fault = watch_faults("webhooks", "webhook",
                                         "a webhook has not been delivered for long")},
               {}),
      publisher(make_publisher(settings, loaded)),
      sparkplug(make_sparkplug(settings, loaded)),
      mtconnect(make_mtconnect(settings, loaded)),
      offsets({.store = *store,
               .setups = setups,
               .clock = clock,
               .on_change = api::publish_offsets_to(events)}),
      machine_service({.store = *store, .releases = releases, .clock = clock}, machine_options(),
                      machine_listener()),
      ports({.store = *store, .releases = releases, .clock = clock}, programs,
            {.recordings = folder.recordings(),
             .open = {},
             .host = settings.standby ? host_name() : "",
             .may_send =
                 settings.standby ? [this] { return store->has_place(); } : std::function<bool()>(),
             .on_fault = records_watch()},
            published()),
      gateway_lines({.store = *store,
                     .releases = releases,
                     .programs = programs,
                     .clock = clock,
                     .ask =
                         [this](dds::LineRequest request, std::chrono::milliseconds limit) {
                           return machine_service.ask_line(std::move(request), limit);
                         },
                     .machines = machine_service,
                     .resets = ports.resets()}),
      port_router(ports, gateway_lines),
      all_machines(store->runs, machine_service, ports.machines()),
      machines(store->runs, all_machines, hold_reasons),
      api({.programs = programs,
           .releases = releases,
           .attachments = attachments,
           .search = search,
           .setups = setups,
           .machines = machines,
           .runs = runs,
           .jobs = jobs,
           .paths = paths,
           .audit = audit,
           .chain = chain,
           .accounts = accounts,
           .events = events,
           .clock = clock,
           .facts = {.name = host_name(),
                     .version = DRIPLINE_VERSION,
                     .data_dir = folder.path().string(),
                     .started = clock.now(),
                     .dds_domain = settings.dds_domain,
                     .certificate_expires = certificate_expires,
                     .dds_certificate_expires = dds_certificate_expires},
           .dds_rejected = [this] { return machine_service.rejected().messages; },
           .ports = &port_router,
           .health = &health,
           .backups = backups.get(),
           .imports = &imports,
           .measurements = &measurements,
           .retention = retention.get(),
           .offsets = &offsets,
           .folders = &folders,
           .webhooks = &webhooks,
           .publisher = publisher.get(),
           .sparkplug = sparkplug.get(),
           .cache = cache.get(),
           .shared = shared_library(),
           .has_tls = !settings.tls_key.empty()}),
      signing_key(loaded.key.public_key().hex()),
      published_settings(shared_settings(settings)),
      tidied(clock.steady_now()) {
  setups.on_saved([this](const storage::SetupRevision& saved, const std::string& /*control*/) {
    machine_service.show_setup(saved.machine);
  });
}

machines::MachineService::Options ServerParts::machine_options() {
  machines::MachineService::Options options;
  options.on_fault = records_watch();
  options.on_line = [this](const dds::Status& status) {
    if (are_lines_handled) gateway_lines.on_status(status);
  };
  if (fetcher) {
    options.on_called = [this](const std::string& run, const Digest& content) {
      fetcher->add(run, content);
    };
  }
  return options;
}

/// A part of the cache is left to what is asked for now.
std::unique_ptr<machines::ProgramFetcher> ServerParts::make_fetcher() const {
  if (!cache) return nullptr;
  return std::make_unique<machines::ProgramFetcher>(*store, cache->state().capacity / 4 * 3);
}

std::unique_ptr<library::Backups> ServerParts::make_backups(std::optional<backup::BackupFolder> to,
                                                            const Settings& settings) {
  if (!to) return nullptr;
  library::Backups::Options options;
  options.every = std::chrono::hours(settings.backup_every_hours);
  options.retention = {.every = std::chrono::days(settings.backup_keep_days),
                       .weekly = std::chrono::weeks(settings.backup_keep_weeks)};
  backup::Source source{.folder = folder.path(),
                        .database = StateFolder::kDatabase,
                        .files = StateFolder::files(),
                        .made_by = fmt::format("dncd {}", DRIPLINE_VERSION),
                        .copy = [this](const std::filesystem::path& copy, const auto& proceed) {
                          return store->copy_to(copy, proceed);
                        }};
  return std::make_unique<library::Backups>(library::Backups::Parts{.folder = *std::move(to),
                                                                    .source = std::move(source),
                                                                    .audit = audit,
                                                                    .health = health,
                                                                    .clock = clock},
                                            options);
}

std::unique_ptr<library::Retention> ServerParts::make_retention(const Settings& settings,
                                                                const Loaded& loaded) {
  if (settings.archives.empty()) return nullptr;
  const auto rule = [](std::uint32_t days, std::uint32_t thousands) {
    constexpr std::uint64_t kThousand = 1000;
    library::RetentionRule made;
    if (days > 0) made.age = std::chrono::days(days);
    if (thousands > 0) made.rows = thousands * kThousand;
    return made;
  };
  const bool is_published = settings.mqtt.is_on() && settings.mqtt.has_records;
  library::Retention::Options options;
  options.records = rule(settings.archive_records_days, settings.archive_records_rows);
  options.measurements =
      rule(settings.archive_measurements_days, settings.archive_measurements_rows);
  return std::make_unique<library::Retention>(
      library::Retention::Parts{.store = *store,
                                .clock = clock,
                                .folder = settings.archives,
                                .database = loaded.identity,
                                .made_by = fmt::format("dncd {}", DRIPLINE_VERSION),
                                .reader = is_published ? mqtt::Publisher::kReader : ""},
      options);
}

FaultWatch ServerParts::watch_faults(const char* subject, const char* of, const char* what) {
  return [this, subject, of, what](const std::string& name, const std::string& fault) {
    using Level = library::Health::Level;
    health.report(name, {.level = fault.empty() ? Level::Ok : Level::Degraded,
                         .subject = subject,
                         .what = what,
                         .detail = fmt::format("{}={}: {}", of, name, fault)});
  };
}

FaultWatch ServerParts::records_watch() {
  return watch_faults("records", "machine", "records of a machine cannot be stored");
}

std::unique_ptr<mtconnect::Agent> ServerParts::make_mtconnect(const Settings& settings,
                                                              const Loaded& loaded) {
  if (settings.mtconnect.empty()) return nullptr;
  return std::make_unique<mtconnect::Agent>(
      mtconnect::Agent::Options{
          .sender = host_name(),
          .plant = loaded.identity,
          .instance = mtconnect::instance_of(clock.now()),
          .last_alarms = [this](const std::string& machine) { return last_alarms(machine); }},
      clock);
}

std::vector<storage::Record> ServerParts::last_alarms(const std::string& machine) const {
  constexpr std::uint64_t kMaxAlarms = 32;
  storage::RunFilter filter;
  filter.machine = machine;
  const auto last = store->runs.list(filter, {.limit = 1});
  if (!last || last->empty() || last->front().state != storage::RunState::Alarmed) return {};
  auto alarms = store->records.of_run(last->front().id, "alarm", {.limit = kMaxAlarms});
  return alarms ? *std::move(alarms) : std::vector<storage::Record>();
}

void ServerParts::announce() {
  const auto announced = folder.announce(announcement);
  const bool was_announced = is_announced.exchange(announced.has_value());
  if (announced || !was_announced) return;
  process::log_error("dnc on this computer needs --server {}: {}", url, announced.error().what);
}

Result<void> ServerParts::look() {
  folders.look();
  auto sound = store->probe();
  if (!sound) return sound;
  if (!is_announced) announce();
  ports.open_due();
  if (is_mtconnect_due) open_due_mtconnect();
  look_at_machines();
  accounts.store_uses();
  (void)revoke_certificates();
  certificates.look(watched_certificates());
  if (dds_certificate_expires && clock.now() >= *dds_certificate_expires)
    machine_service.lose_gateways();
  sound = chain.look();
  health.report("", chain.finding());
  if (retention && sound) {
    sound = retention->archive_check().look();
    health.report("", retention->archive_check().finding());
  }
  return sound;
}

void ServerParts::look_at_machines() {
  const auto views = machines.machines();
  if (mtconnect) mtconnect->observer().reconcile(views);
  std::vector<storage::Run> active;
  if (LostMachines::is_any_away(views)) {
    storage::RunFilter filter;
    filter.state = storage::RunState::Active;
    auto listed = store->runs.list(filter, {.limit = views.size()});
    if (!listed) return;  // the probe reports more
    active = *std::move(listed);
  }
  lost_machines.look(views, active);
}

void ServerParts::write_kept_audit() {
  const std::size_t failures = audit.write_kept();
  using Level = library::Health::Level;
  health.report("waiting", {.level = failures == 0 ? Level::Ok : Level::Degraded,
                            .subject = "audit",
                            .what = "entries of the audit trail that waited cannot be read",
                            .detail = fmt::format("{} in {}, see the log", failures,
                                                  folder.waiting_entries().string())});
}

Result<void> ServerParts::revoke_certificates() {
  if (revoked_file.empty()) return {};
  auto serials = identity::read_revoked(revoked_file);
  using Level = library::Health::Level;
  health.report("", {.level = serials ? Level::Ok : Level::Degraded,
                     .subject = "certificates",
                     .what = "the list of revoked certificates cannot be read",
                     .detail = serials ? "" : serials.error().what});
  if (!serials) return fail(Errc::Denied, "tls-client-revoked: {}", serials.error().what);
  accounts.revoke_certificates(*std::move(serials));
  return {};
}

std::vector<library::WatchedCertificate> ServerParts::watched_certificates() const {
  using Use = library::WatchedCertificate::Use;
  std::vector<library::WatchedCertificate> all;
  if (certificate_expires) all.push_back({.use = Use::Https, .expires = *certificate_expires});
  if (dds_certificate_expires)
    all.push_back({.use = Use::Dds, .expires = *dds_certificate_expires});
  for (const auto& view : machines.machines()) {
    if (view.certificate_expires)
      all.push_back({.use = Use::Gateway,
                     .machine = view.machine.name,
                     .expires = *view.certificate_expires});
  }
  return all;
}

void ServerParts::check_on() {
  process::log_info("the database is big: the search for damage continues beside the work");
  check = std::jthread([this](const std::stop_token& stop) {
    const auto done = store->check(std::chrono::hours(24), stop);
    if (!done) {
      process::log_error("the database is damaged, restore a backup: {}", done.error().what);
      health.report("", {.level = library::Health::Level::Failed,
                         .subject = "damage",
                         .what = "the database is damaged",
                         .detail = done.error().what});
    } else if (*done) {
      process::log_info("the database is sound");
    }
  });
}

}  // namespace dripline::app
