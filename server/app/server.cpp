#include "server/app/server.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"
#include "server/app/impl/server_parts.hpp"

namespace dripline::app {
namespace {

constexpr auto kUploadLife = std::chrono::hours(24);
/// Of the database, for damage; what a bigger one needs longer for is looked at beside the work.
constexpr std::chrono::seconds kCheckBeforeStart{10};
/// From the begin of the server's end on; what a hot folder takes then is stored by the next server
/// otherwise.
constexpr std::chrono::seconds kFolderEnd{5};

/// The page is asked first: it needs no token.
api::HttpHandlers http_handlers(const api::Api& api, const web::Page& page) {
  return {
      .handle = [&api](api::Request request) { return api.handle(std::move(request)); },
      .judge =
          [&api, &page](api::Request& head) {
            auto answer = page.answer(head);
            return answer ? answer : api.judge(head);
          },
      .waits_for_machine = [&api](const api::Request& head) { return api.waits_for_machine(head); },
      .may_stop = [&api](const api::Request& head) { return api.may_stop(head); },
      .finds_run = [&api](const api::Request& head) { return api.finds_run(head); },
      .max_body = [&api](const api::Request& head) { return api.max_body(head); }};
}

/// What a folder stores has one author for all who post there: then four eyes may be those of one.
void warn_of_authors(const library::ReleasePolicy& policy,
                     const std::vector<folders::FolderSettings>& folders) {
  if (std::ranges::none_of(policy.rules, &library::StepRule::needs_four_eyes)) return;
  for (const auto& folder : folders) {
    if (folder.author.find("{owner}") != std::string::npos) continue;
    process::log_warning(
        "folder={}: the policy asks for four eyes, but its author is '{}' for everybody; with "
        "author = \"{{owner}}\" it is the account of the file",
        folder.name, folder.author.empty() ? "folder " + folder.name : folder.author);
  }
}

}  // namespace

Server::Server(std::unique_ptr<ServerParts> parts) : parts_(std::move(parts)) {}

Server::~Server() {
  if (!end()) static_cast<void>(parts_.release());
}

Result<void> Server::end() {
  if (ended_) return *ended_;
  const auto until = std::chrono::steady_clock::now() + kFolderEnd;
  parts_->folders.request_end();
  parts_->check.request_stop();
  parts_->cut_off.reset();
  parts_->watch.reset();  // it may announce
  parts_->folder.withdraw();
  if (parts_->fetcher) parts_->fetcher->end();
  parts_->machine_service.stop_waiting();
  parts_->measurements.end();  // it may hold a machine
  parts_->webhooks.stop();     // before the requests: one may wait for a test
  if (parts_->retention) parts_->retention->end();
  parts_->offsets.end();
  if (parts_->publisher) parts_->publisher->end();
  if (parts_->sparkplug) parts_->sparkplug->end();
  parts_->events.close();
  parts_->http.reset();
  parts_->mtconnect_http.reset();
  parts_->gateway_lines.end();
  parts_->ports.end();
  parts_->machine_service.end();
  parts_->late_writer.end();
  parts_->store->stop_renewing();
  // Last: a folder on a share that hangs is waited for in vain.
  ended_ = parts_->folders.end(until);
  if (!*ended_) parts_->store->give_back();
  return *ended_;
}

Result<std::unique_ptr<Server>> Server::start(const Settings& settings, const Clock& clock,
                                              PlaceUse place,
                                              std::function<void()> on_handed_over) {
  const auto options = http_options(settings);
  if (!options) return fail(options.error());
  const auto agent = mtconnect_options(settings);
  if (!agent) return fail(agent.error());
  const auto network = dds_network(settings, clock.now());
  if (!network) return fail(network.error());
  if (auto safe = mqtt::check_exposure(settings.mqtt); !safe) return fail(safe.error());
  const auto policy = library::ReleasePolicy::read(settings.policy);
  if (!policy) return fail(policy.error());
  warn_of_authors(*policy, settings.folders);
  auto folder = StateFolder::open(settings.state);
  if (!folder) return fail(folder.error());
  if (!settings.archives.empty()) {
    std::error_code ec;
    std::filesystem::create_directories(settings.archives, ec);
    if (!std::filesystem::is_directory(settings.archives, ec))
      return fail(Errc::Io, "archives: {} is no folder and cannot be made", settings.archives);
  }
  auto kept = open_store(*folder, settings, clock, std::move(place));
  if (!kept) return fail(kept.error());
  const std::string identity = kept->identity;
  const auto is_checked = kept->store->check(kCheckBeforeStart);
  if (!is_checked) return fail(is_checked.error());
  const auto token = folder->token();
  if (!token) return fail(token.error());
  const auto users = kept->store->accounts.load();
  if (!users) return fail(users.error());
  const auto key = signing_key(*folder);
  if (!key) return fail(key.error());
  std::optional<backup::BackupFolder> backups;
  if (!settings.backups.empty()) {
    auto opened = backup::BackupFolder::open(settings.backups);
    if (!opened) return fail(opened.error());
    backups = *std::move(opened);
  }
  const Loaded loaded{*users, *policy, *key, identity};
  std::unique_ptr<Server> server(new Server(std::make_unique<ServerParts>(
      *folder, *std::move(kept), std::move(backups), settings, clock, loaded, *network)));
  ServerParts& parts = *server->parts_;
  parts.on_handed_over = std::move(on_handed_over);
  if (auto used = parts.accounts.use_local_secret(*token, settings.recover_admin); !used)
    return fail(used.error());
  if (auto read = parts.revoke_certificates(); !read) return fail(read.error());
  parts.programs.on_held([&parts](const auto& revision) { parts.imports.note(revision); });
  if (auto loaded_holds = parts.hold_reasons.load(); !loaded_holds)
    return fail(loaded_holds.error());
  parts.write_kept_audit();
  parts.imports.begin();
  parts.webhooks.begin();
  parts.measurements.begin();
  if (parts.retention) parts.retention->begin();
  parts.offsets.begin();
  parts.ports.on_traffic(api::publish_traffic_to(parts.events));
  parts.gateway_lines.on_traffic(
      api::publish_traffic_to(parts.events),
      [&parts](const std::string& port) { return parts.events.has_port_listeners(port); });
  parts.are_lines_handled = true;
  if (auto begun = parts.ports.begin(settings.ports); !begun) return fail(begun.error());
  dds::NetworkOptions dds_options = network->options;
  dds_options.term = parts.store->term();
  if (dds_options.term == 0) {
    const auto term = parts.folder.term();
    if (!term) return fail(term.error());
    dds_options.term = *term;
  }
  auto endpoint = dds::ServerEndpoint::open(dds_options, parts.machine_service.handlers());
  if (!endpoint) return fail(endpoint.error());
  if (auto begun = parts.machine_service.begin(*std::move(endpoint)); !begun)
    return fail(begun.error());
  if (parts.fetcher) {
    if (auto begun = parts.fetcher->begin(); !begun) return fail(begun.error());
  }
  server->tidy();
  parts.watch = std::make_unique<library::HealthWatch>(
      library::HealthWatch::Parts{.health = parts.health,
                                  .probe = [&parts] { return parts.look(); },
                                  .folder = parts.folder.path(),
                                  .clock = parts.clock,
                                  .store_time = [&parts] { return parts.store->time(); }});
  if (!*is_checked) parts.check_on();
  if (*agent) {
    if (auto opened = parts.open_mtconnect(**agent); !opened) {
      if (!settings.standby) return fail(opened.error());
      parts.await_mtconnect(**agent, opened.error());
    }
  }
  if (parts.publisher) parts.publisher->begin();
  if (parts.sparkplug) parts.sparkplug->begin();
  auto http = api::HttpServer::start(*options, http_handlers(parts.api, parts.page));
  if (!http) return fail(http.error());
  parts.http = *std::move(http);
  api::HttpAddress bound = options->address;
  bound.port = parts.http->port();
  parts.url = fmt::format("{}://{}", options->tls ? "https" : "http", bound.text());
  parts.announcement = {
      .url = parts.url, .dds_domain = settings.dds_domain, .dds_tag = settings.dds_tag};
  parts.announce();
  parts.publish();
  if (auto begun = parts.watch_gateways(settings); !begun) return fail(begun.error());
  parts.folders.begin();  // last: a start that fails waits for no share
  return server;
}

std::uint64_t Server::term() const {
  return parts_->store->term();
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
