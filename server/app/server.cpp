#include "server/app/server.hpp"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/security_folder.hpp"
#include "protocol/pki/certificate.hpp"
#include "protocol/process/log.hpp"
#include "server/api/api.hpp"
#include "server/api/http_server.hpp"
#include "server/identity/accounts.hpp"
#include "server/imports/imports.hpp"
#include "server/library/audit_chain.hpp"
#include "server/library/audit_trail.hpp"
#include "server/library/backups.hpp"
#include "server/library/certificate_watch.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/health.hpp"
#include "server/library/programs.hpp"
#include "server/library/releases.hpp"
#include "server/machines/machine_registry.hpp"
#include "server/machines/machine_service.hpp"
#include "server/mtconnect/agent.hpp"
#include "server/ports/gateway_lines.hpp"
#include "server/ports/line_machines.hpp"
#include "server/ports/port_service.hpp"
#include "server/web/page.hpp"
#include "storage/sqlite_store.hpp"

namespace dripline::app {
namespace {

constexpr auto kUploadLife = std::chrono::hours(24);
/// Of the database, for damage; what a bigger one needs longer for is looked at beside the work.
constexpr std::chrono::seconds kCheckBeforeStart{10};

std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "dncd";
  return name.data();
}

/// How DDS is opened, and until when that is possible.
struct DdsNetwork {
  dds::NetworkOptions options;
  std::optional<UtcTime> certificate_expires = {};  ///< nullopt: without dds-security
};

Result<DdsNetwork> dds_network(const Settings& settings, UtcTime now) {
  DdsNetwork result;
  auto& network = result.options;
  network.domain = settings.dds_domain;
  network.interface = settings.dds_interface;
  network.tag = settings.dds_tag;
  network.discovery_interval_ms = settings.discovery_interval_ms;
  network.lease_ms = settings.lease_ms;
  network.is_open_network_allowed = settings.dds_open_network;
  if (!settings.dds_security.empty()) {
    auto folder =
        dds::open_security_folder(settings.dds_security, {.role = dds::Role::Server}, now);
    if (!folder) return fail(folder.error());
    network.security = folder->files;
    result.certificate_expires = folder->certificate.not_after;
  }
  if (auto safe = dds::check_exposure(network); !safe) return fail(safe.error());
  if (network.is_open_network_allowed && !network.security)
    process::log_warning("DDS on {} has no authentication: keep its network to server and gateways",
                         network.interface);
  return result;
}

Result<api::HttpOptions> http_options(const Settings& settings) {
  const auto address = api::parse_http_address(settings.http);
  if (!address) return fail(Errc::Denied, "http: {}", address.error().what);
  if (settings.tls_certificate.empty() != settings.tls_key.empty()) {
    return fail(Errc::Denied, "tls-certificate and tls-key belong together: give both or none");
  }
  api::HttpOptions options;
  options.address = *address;
  options.max_body = api::Api::kMaxBody;
  options.limits.connections = settings.http_connections;
  options.limits.per_address = settings.http_connections_per_address;
  options.limits.event_streams = settings.http_event_streams;
  if (!settings.tls_key.empty()) {
    options.tls = api::TlsFiles{.certificate = settings.tls_certificate, .key = settings.tls_key};
  }
  if (auto safe = api::check_exposure(*address, options.tls.has_value()); !safe) {
    return fail(safe.error());
  }
  return options;
}

/// nullopt: there is no MTConnect agent.
Result<std::optional<api::HttpOptions>> mtconnect_options(const Settings& settings) {
  if (settings.mtconnect.empty()) return std::nullopt;
  const auto address = api::parse_http_address(settings.mtconnect);
  if (!address) return fail(Errc::Denied, "mtconnect: {}", address.error().what);
  if (!address->is_loopback && !settings.mtconnect_open_network) {
    return fail(Errc::Denied,
                "mtconnect: anybody who reaches {} reads what all machines do; allow it with "
                "mtconnect-open-network yes, on a network of your own, or listen at 127.0.0.1",
                address->text());
  }
  api::HttpOptions options;
  options.address = *address;
  options.is_open = true;
  constexpr unsigned kHandlers = 4;  // they wait for nothing
  options.handler_threads = kHandlers;
  // DDS waits with select(): with those of the REST API below 1,000 files.
  constexpr std::uint32_t kBoth = 830, kWanted = 256;
  const std::uint32_t left = kBoth - std::min(settings.http_connections, kBoth);
  options.limits.connections = std::min(std::max(left, 16U), kWanted);
  return options;
}

api::HttpHandlers mtconnect_handlers(mtconnect::Agent& agent) {
  return {
      .handle = [&agent](const api::Request& request) { return agent.handle(request); },
      .judge = [&agent](api::Request& head) { return agent.judge(head); },
  };
}

/// Without TLS, and where the server will refuse to start anyway: nullopt.
std::optional<UtcTime> expiry_of(const Settings& settings) {
  if (settings.tls_certificate.empty()) return std::nullopt;
  const auto certificate = pki::read_certificate(settings.tls_certificate);
  return certificate ? std::optional(certificate->not_after) : std::nullopt;
}

/// The page is asked first: it needs no token.
api::HttpHandlers http_handlers(const api::Api& api, const web::Page& page) {
  return {.handle = [&api](api::Request request) { return api.handle(std::move(request)); },
          .judge =
              [&api, &page](api::Request& head) {
                auto answer = page.answer(head);
                return answer ? answer : api.judge(head);
              },
          .waits_for_machine =
              [&api](const api::Request& head) { return api.waits_for_machine(head); }};
}

}  // namespace

/// What is read before anything is made.
struct Server::Loaded {
  storage::AccountData users;
  library::ReleasePolicy policy;
  SigningKey key;
  std::string identity;  ///< of the database
};

/// In the order of their making; each may use those above it.
struct Server::Parts {
  Parts(StateFolder state_folder, std::unique_ptr<storage::SqliteStore> opened,
        std::optional<backup::BackupFolder> backup_folder, const Settings& settings,
        const Clock& system_clock, const Loaded& loaded, const DdsNetwork& setup)
      : clock(system_clock),
        dds_certificate_expires(setup.certificate_expires),
        certificate_expires(expiry_of(settings)),
        folder(std::move(state_folder)),
        store(std::move(opened)),
        health(clock),
        certificates(health, clock),
        audit(store->audit, clock),
        chain({.store = store->audit,
               .clock = clock,
               .key = loaded.key,
               .database = loaded.identity}),
        backups(make_backups(std::move(backup_folder), settings)),
        accounts({.store = store->accounts, .audit = audit, .clock = clock}, {}, loaded.users),
        programs(*store, clock, catalog, audit),
        releases({.decisions = store->releases,
                  .programs = store->programs,
                  .clock = clock,
                  .key = loaded.key,
                  .database = loaded.identity},
                 loaded.policy),
        runs(*store),
        paths({.store = *store, .releases = releases, .clock = clock}),
        imports({.store = *store,
                 .paths = paths,
                 .policy = releases.policy(),
                 .clock = clock,
                 .on_change = api::publish_imports_to(events)}),
        setups(store->setups, catalog, audit),
        mtconnect(make_mtconnect(settings, loaded)),
        machine_service({.store = *store, .releases = releases, .clock = clock}, machine_options(),
                        machine_listener()),
        ports({.store = *store, .releases = releases, .clock = clock}, programs,
              {.recordings = folder.recordings(), .open = {}, .on_fault = records_watch()},
              published()),
        gateway_lines({.store = *store,
                       .releases = releases,
                       .programs = programs,
                       .clock = clock,
                       .ask =
                           [this](dds::LineRequest request, std::chrono::milliseconds limit) {
                             return machine_service.ask_line(std::move(request), limit);
                           },
                       .machines = machine_service}),
        port_router(ports, gateway_lines),
        machines(store->runs, machine_service, ports.machines()),
        api({.programs = programs,
             .releases = releases,
             .setups = setups,
             .machines = machines,
             .runs = runs,
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
             .has_tls = !settings.tls_key.empty()}),
        tidied(clock.steady_now()) {}

  machines::MachineService::Options machine_options() {
    machines::MachineService::Options options;
    options.on_fault = records_watch();
    options.on_line = [this](const dds::Status& status) {
      if (are_lines_handled) gateway_lines.on_status(status);
    };
    return options;
  }

  std::unique_ptr<library::Backups> make_backups(std::optional<backup::BackupFolder> to,
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

  /// Of machines with gateways and of those at the ends of lines.
  std::function<void(const std::string& machine, const std::string& fault)> records_watch() {
    return [this](const std::string& machine, const std::string& fault) {
      using Level = library::Health::Level;
      health.report(machine, {.level = fault.empty() ? Level::Ok : Level::Degraded,
                              .subject = "records",
                              .what = "records of a machine cannot be stored",
                              .detail = fmt::format("machine={}: {}", machine, fault)});
    };
  }

  std::unique_ptr<mtconnect::Agent> make_mtconnect(const Settings& settings, const Loaded& loaded) {
    if (settings.mtconnect.empty()) return nullptr;
    return std::make_unique<mtconnect::Agent>(
        mtconnect::Agent::Options{
            .sender = host_name(),
            .plant = loaded.identity,
            .instance = mtconnect::instance_of(clock.now()),
            .last_alarms = [this](const std::string& machine) { return last_alarms(machine); }},
        clock);
  }

  /// Of the machine's last run, if it ended with an alarm.
  std::vector<storage::Record> last_alarms(const std::string& machine) const {
    constexpr std::uint64_t kMaxAlarms = 32;
    storage::RunFilter filter;
    filter.machine = machine;
    const auto last = store->runs.list(filter, {.limit = 1});
    if (!last || last->empty() || last->front().state != storage::RunState::Alarmed) return {};
    auto alarms = store->records.of_run(last->front().id, "alarm", {.limit = kMaxAlarms});
    return alarms ? *std::move(alarms) : std::vector<storage::Record>();
  }

  /// To the listeners of events and to the MTConnect agent.
  machines::MachineListener published() {
    machines::MachineListener listener = api::publish_to(events);
    if (!mtconnect) return listener;
    auto& observer = mtconnect->observer();
    listener.on_machine = [&observer, publish = listener.on_machine](const auto& view) {
      observer.observe(view);
      publish(view);
    };
    listener.on_record = [&observer, publish = listener.on_record](const auto& record) {
      observer.observe(record);
      publish(record);
    };
    return listener;
  }

  machines::MachineListener machine_listener() {
    machines::MachineListener listener = published();
    listener.on_machine = [this, publish = listener.on_machine](const machines::MachineView& view) {
      using Level = library::Health::Level;
      const auto notices = machines::notices_of(view);
      health.report(view.machine.name, {.level = notices.empty() ? Level::Ok : Level::Degraded,
                                        .subject = "gateway",
                                        .what = "server and a gateway do not agree",
                                        .detail = fmt::format("machine={}: {}", view.machine.name,
                                                              fmt::join(notices, "; "))});
      publish(view);
    };
    return listener;
  }

  const Clock& clock;
  std::optional<UtcTime> dds_certificate_expires;  ///< nullopt: without DDS Security
  std::optional<UtcTime> certificate_expires;      ///< nullopt: without TLS
  StateFolder folder;
  std::unique_ptr<storage::SqliteStore> store;
  library::Health health;
  library::CertificateWatch certificates;
  library::DialectCatalog catalog;
  library::AuditTrail audit;
  library::AuditChain chain;
  std::unique_ptr<library::Backups> backups;  ///< null: none are made
  identity::Accounts accounts;
  library::Programs programs;
  library::Releases releases;
  library::RunHistory runs;
  paths::ProgramPaths paths;
  api::EventHub events;
  imports::Imports imports;
  library::Setups setups;
  std::unique_ptr<mtconnect::Agent> mtconnect;  ///< null: there is none
  machines::MachineService machine_service;
  std::atomic<bool> are_lines_handled = false;  ///< by gateway_lines
  ports::PortService ports;
  ports::GatewayLines gateway_lines;
  ports::PortRouter port_router;
  ports::MachineRouter machines;
  api::Api api;
  web::Page page{web::embedded_assets()};
  std::unique_ptr<library::HealthWatch> watch;
  std::unique_ptr<api::HttpServer> http;
  std::unique_ptr<api::HttpServer> mtconnect_http;
  std::string url, mtconnect_url;
  StateFolder::Announcement announcement;
  std::atomic<bool> is_announced = true;  ///< or not yet tried
  SteadyTime tidied;
  std::jthread check;  ///< of a database too big to be looked through before the start

  /// A full disk only keeps the server from storing: clients should still find it.
  void announce() {
    const auto announced = folder.announce(announcement);
    const bool was_announced = is_announced.exchange(announced.has_value());
    if (announced || !was_announced) return;
    process::log_error("dnc on this computer needs --server {}: {}", url, announced.error().what);
  }

  /// Every few seconds, on the watch's thread: what a full disk has kept from being done is tried
  /// again.
  Result<void> look() {
    auto sound = store->probe();
    if (!sound) return sound;
    if (!is_announced) announce();
    ports.open_due();
    if (mtconnect) mtconnect->observer().reconcile(machines.machines());
    accounts.store_uses();
    certificates.look(watched_certificates());
    if (dds_certificate_expires && clock.now() >= *dds_certificate_expires)
      machine_service.lose_gateways();
    sound = chain.look();
    health.report("", chain.finding());
    return sound;
  }

  /// The machines that are known and their tools, then the sockets.
  Result<void> open_mtconnect(const api::HttpOptions& options) {
    const auto views = machines.machines();
    mtconnect->observer().reconcile(views);
    setups.on_saved([this](const storage::SetupRevision& setup, const std::string& control) {
      mtconnect->use_setup(setup, control, false);
    });
    for (const auto& view : views) {
      const auto setup = setups.find(view.machine.name, std::nullopt);
      if (setup) mtconnect->use_setup(*setup, view.machine.control, true);
    }
    auto opened = api::HttpServer::start(options, mtconnect_handlers(*mtconnect));
    if (!opened) return fail(opened.error().code, "mtconnect: {}", opened.error().what);
    mtconnect_http = *std::move(opened);
    api::HttpAddress bound = options.address;
    bound.port = mtconnect_http->port();
    mtconnect_url = "http://" + bound.text();
    if (!bound.is_loopback)
      process::log_warning("MTConnect at {}: anybody who reaches it may read", bound.text());
    return {};
  }

  std::vector<library::WatchedCertificate> watched_certificates() const {
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

  void check_on() {
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
};

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Server::~Server() {
  parts_->check.request_stop();
  parts_->watch.reset();  // it may announce
  parts_->folder.withdraw();
  parts_->machine_service.stop_waiting();
  parts_->events.close();
  parts_->http.reset();
  parts_->mtconnect_http.reset();
  parts_->gateway_lines.end();
  parts_->ports.end();
  parts_->machine_service.end();
}

Result<std::unique_ptr<Server>> Server::start(const Settings& settings, const Clock& clock) {
  const auto options = http_options(settings);
  if (!options) return fail(options.error());
  const auto agent = mtconnect_options(settings);
  if (!agent) return fail(agent.error());
  const auto network = dds_network(settings, clock.now());
  if (!network) return fail(network.error());
  const auto policy = library::ReleasePolicy::read(settings.policy);
  if (!policy) return fail(policy.error());
  auto folder = StateFolder::open(settings.state);
  if (!folder) return fail(folder.error());
  if (auto is_there = folder->expect_database(settings.begin_empty); !is_there)
    return fail(is_there.error());
  auto store = storage::SqliteStore::open({.file = folder->database()}, clock);
  if (!store) return fail(store.error());
  const auto identity = (*store)->identity();
  if (!identity) return fail(identity.error());
  if (auto known = folder->remember_database(*identity); !known) return fail(known.error());
  const auto is_checked = (*store)->check(kCheckBeforeStart);
  if (!is_checked) return fail(is_checked.error());
  const auto token = folder->token();
  if (!token) return fail(token.error());
  const auto users = (*store)->accounts.load();
  if (!users) return fail(users.error());
  const auto seed = folder->signing_seed();
  if (!seed) return fail(seed.error());
  const auto key = SigningKey::of(*seed);
  if (!key) return fail(Errc::Denied, "{}: {}", folder->signing_file().string(), key.error().what);
  std::optional<backup::BackupFolder> backups;
  if (!settings.backups.empty()) {
    auto opened = backup::BackupFolder::open(settings.backups);
    if (!opened) return fail(opened.error());
    backups = *std::move(opened);
  }
  const Loaded loaded{*users, *policy, *key, *identity};
  std::unique_ptr<Server> server(new Server(std::make_unique<Parts>(
      *folder, *std::move(store), std::move(backups), settings, clock, loaded, *network)));
  Parts& parts = *server->parts_;
  if (auto used = parts.accounts.use_local_secret(*token, settings.recover_admin); !used)
    return fail(used.error());
  parts.programs.on_held([&parts](const auto& revision) { parts.imports.note(revision); });
  parts.imports.begin();
  parts.ports.on_traffic(api::publish_traffic_to(parts.events));
  parts.gateway_lines.on_traffic(
      api::publish_traffic_to(parts.events),
      [&parts](const std::string& port) { return parts.events.has_port_listeners(port); });
  parts.are_lines_handled = true;
  if (auto begun = parts.ports.begin(settings.ports); !begun) return fail(begun.error());
  auto endpoint = dds::ServerEndpoint::open(network->options, parts.machine_service.handlers());
  if (!endpoint) return fail(endpoint.error());
  if (auto begun = parts.machine_service.begin(*std::move(endpoint)); !begun)
    return fail(begun.error());
  server->tidy();
  parts.watch = std::make_unique<library::HealthWatch>(
      library::HealthWatch::Parts{.health = parts.health,
                                  .probe = [&parts] { return parts.look(); },
                                  .folder = parts.folder.path()});
  if (!*is_checked) parts.check_on();
  if (*agent) {
    if (auto opened = parts.open_mtconnect(**agent); !opened) return fail(opened.error());
  }
  auto http = api::HttpServer::start(*options, http_handlers(parts.api, parts.page));
  if (!http) return fail(http.error());
  parts.http = *std::move(http);
  api::HttpAddress bound = options->address;
  bound.port = parts.http->port();
  parts.url = fmt::format("{}://{}", options->tls ? "https" : "http", bound.text());
  parts.announcement = {
      .url = parts.url, .dds_domain = settings.dds_domain, .dds_tag = settings.dds_tag};
  parts.announce();
  return server;
}

const std::string& Server::url() const {
  return parts_->url;
}

const std::string& Server::mtconnect_url() const {
  return parts_->mtconnect_url;
}

std::string Server::status() const {
  const auto machines = parts_->machines.machines();
  const auto connected = std::ranges::count_if(
      machines, [](const machines::MachineView& view) { return view.is_connected; });
  return fmt::format("{}: {} of {} machines connected, {}", parts_->url, connected, machines.size(),
                     to_string(parts_->health.state().level));
}

void Server::tidy() {
  // By the steady clock: the time of day may jump by years. While the server is away no time
  // counts.
  const SteadyTime now = parts_->clock.steady_now();
  const auto passed = std::chrono::duration_cast<std::chrono::seconds>(now - parts_->tidied);
  const auto dropped = parts_->store->uploads.drop_idle(passed, kUploadLife);
  if (dropped) parts_->tidied = now;
  if (!dropped) {
    process::log_warning("abandoned uploads not dropped: {}", dropped.error().what);
  } else if (*dropped > 0) {
    process::log_info("dropped {} abandoned uploads", *dropped);
  }
  parts_->accounts.sessions().tidy();
}

}  // namespace dripline::app
