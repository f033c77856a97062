#include "server/app/standby.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "protocol/process/log.hpp"
#include "server/api/metrics_text.hpp"
#include "server/app/networks.hpp"
#include "server/app/open_store.hpp"
#include "server/app/shared_settings.hpp"
#include "server/app/standby_page.hpp"
#include "server/app/standby_ports.hpp"
#include "server/identity/accounts.hpp"
#include "server/identity/revoked_certificates.hpp"
#include "server/library/health.hpp"
#include "server/library/release_policy.hpp"

namespace dripline::app {
namespace {

using View = storage::PostgresqlStandby::View;

constexpr int kUnavailable = 503;
/// After a hand-over another server is waited for; when none has come, this one may have it again.
constexpr std::chrono::seconds kForOthers{10};
constexpr std::chrono::seconds kForHearers{5};
constexpr std::chrono::seconds kPortsEvery{1};
/// After a try to take over that was in vain: times the number of them, up to so many.
constexpr std::chrono::milliseconds kLatePause{500};
constexpr int kMaxLatePauses = 20;
/// So long after the last of them it is reported.
constexpr std::chrono::minutes kLateShown{1};

/// What a start would refuse is refused now, and not at the moment of need. Returns the DDS
/// network.
Result<dds::NetworkOptions> check_settings(const Settings& settings, const Clock& clock) {
  if (settings.store.empty()) {
    return fail(Errc::Unsupported,
                "standby: servers share a PostgreSQL database (store = \"postgresql://...\"); the "
                "SQLite file of a state folder is one server's");
  }
  auto network = dds_network(settings, clock.now());
  if (!network) return fail(network.error());
  if (auto safe = mqtt::check_exposure(settings.mqtt); !safe) return fail(safe.error());
  if (auto policy = library::ReleasePolicy::read(settings.policy); !policy)
    return fail(policy.error());
  if (!settings.tls_client_revoked.empty()) {
    const auto revoked = identity::read_revoked(settings.tls_client_revoked);
    if (!revoked) return fail(Errc::Denied, "tls-client-revoked: {}", revoked.error().what);
  }
  return std::move(network->options);
}

std::string name_of(const View& view) {
  const std::string name = view.described.empty() ? "another server" : view.described;
  return view.url.empty() ? name : fmt::format("{} at {}", name, view.url);
}

}  // namespace

struct Standby::Parts {
  const Settings settings;
  const Clock& clock;
  Options options;
  StateFolder folder;
  FileLock lock;
  std::string signing_key;  ///< public
  api::HttpOptions http;
  std::optional<api::HttpOptions> agent;  ///< of MTConnect
  StandbyPorts ports;
  const std::uint32_t cells;
  std::string published_settings;
  storage::PostgresqlStandby database;
  SteadyTime began;
};

Standby::Standby(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Standby::~Standby() {
  if (http_) parts_->folder.withdraw();
  http_.reset();
}

Result<std::unique_ptr<Standby>> Standby::open(const Settings& settings, const Clock& clock,
                                               const Options& options) {
  auto network = check_settings(settings, clock);
  if (!network) return fail(network.error());
  const auto http = http_options(settings);
  if (!http) return fail(http.error());
  auto agent = mtconnect_options(settings);
  if (!agent) return fail(agent.error());
  auto folder = StateFolder::open(settings.state);
  if (!folder) return fail(folder.error());
  if (auto can = check_postgresql(*folder, settings); !can) return fail(can.error());
  auto lock = folder->lock();
  if (!lock) return fail(lock.error());
  const auto token = folder->token();
  if (!token) return fail(token.error());
  const auto key = signing_key(*folder);
  if (!key) return fail(key.error());
  const auto holder = holder_name(*folder);
  if (!holder) return fail(holder.error());
  std::unique_ptr<Standby> standby(new Standby(std::unique_ptr<Parts>(new Parts{
      settings, clock, options, *folder, *std::move(lock), key->public_key().hex(), *http,
      *std::move(agent), StandbyPorts(*network), network->cells, shared_settings(settings),
      storage::PostgresqlStandby({.url = settings.store,
                                  .holder = *holder,
                                  .described = description(*folder),
                                  .lease = std::chrono::seconds(settings.takeover_s)}),
      clock.steady_now()})));
  auto view = standby->parts_->database.look();
  if (!view) return fail(view.error());
  if (auto fits = standby->check(*view); !fits) return fail(fits.error());
  if (!view->is_free) {
    if (auto same = standby->check_token(*token); !same) return fail(same.error());
    standby->look_at_settings(*view);
    if (const auto& fault = standby->faults_.network; !fault.empty())
      return fail(Errc::Conflict,
                  "standby for {}: {}. Where that server is gone for good, start this one once "
                  "with standby = \"no\"",
                  name_of(*view), fault);
  }
  standby->view_ = *std::move(view);
  return standby;
}

/// Two servers sign one audit trail, and people's tokens are the same at both.
Result<void> Standby::check(const View& view) const {
  if (!view.has_tables) return {};
  const auto expected = parts_->folder.expect_identity(view.identity, "the one that --store names");
  const bool is_new = !expected && expected.error().code == Errc::NotFound;
  if (!expected && !is_new) return expected;
  const bool has_key = view.signing_key == parts_->signing_key;
  if (view.signing_key.empty() ? !is_new : has_key) return {};
  return fail(
      Errc::Conflict,
      "{} has not the key that the audit trail of this database is signed with: the servers "
      "of one database have the files signing.key, token and database.id of the first one's "
      "state folder ({}). Copy these three there, and not server.id",
      parts_->folder.path().string(),
      view.described.empty() ? "its server is not named" : view.described);
}

/// Otherwise each takeover would replace the token that people and scripts of the other computer
/// use.
Result<void> Standby::check_token(const std::string& token) const {
  using identity::Accounts;
  const auto is_other =
      parts_->database.has_other_token(Accounts::kFirstUser, Accounts::kLocalToken, token);
  if (!is_other) return fail(is_other.error());
  if (!*is_other) return {};
  return fail(Errc::Conflict,
              "{} is not the token that the active server has: the servers of one database have "
              "the same. Copy the file from its state folder",
              parts_->folder.token_file().string());
}

bool Standby::is_for_others(const View& view) const {
  if (parts_->options.handed_over == 0 || view.term > parts_->options.handed_over) return false;
  const auto waited = parts_->clock.steady_now() - parts_->began;
  return view.has_others || waited < kForOthers;
}

/// One that hears gateways is quicker.
bool Standby::is_for_hearers(const View& view) {
  const SteadyTime now = parts_->clock.steady_now();
  if (!view.is_for_hearers) hearers_since_.reset();
  if (!view.is_for_hearers || parts_->ports.gateways(now).value_or(0) > 0) return false;
  if (!hearers_since_) hearers_since_ = now;
  return now - *hearers_since_ < kForHearers;
}

bool Standby::is_pausing() const {
  const int pauses = std::min(parts_->options.late - 1, kMaxLatePauses);  // the first is at once
  return parts_->clock.steady_now() - parts_->began < std::max(pauses, 0) * kLatePause;
}

Result<bool> Standby::look() {
  const UtcTime before = parts_->clock.now();
  parts_->ports.receive(parts_->clock.steady_now());
  parts_->database.set_gateways(parts_->ports.gateways(parts_->clock.steady_now()));
  auto view = parts_->database.look();
  if (!view) {
    const bool is_final = view.error().code == Errc::Unsupported;
    const std::lock_guard lock(mutex_);
    if (faults_.database.empty() && !is_final)
      process::log_warning("standing by, but the database cannot be looked at: {}",
                           view.error().what);
    faults_.database = view.error().what;
    return is_final ? Result<bool>(fail(view.error())) : Result<bool>(false);
  }
  if (view->term != view_.term) {
    if (auto fits = check(*view); !fits) return fail(fits.error());
  }
  look_at_place(*view);
  look_at_settings(*view);
  look_at_clock(before, *view);
  const bool is_free = view->is_free && !is_for_others(*view) && !is_for_hearers(*view) &&
                       !is_pausing() && faults_.network.empty();
  const bool is_due = has_ports(is_free) && is_free;
  const std::lock_guard lock(mutex_);
  if (!std::exchange(faults_.database, "").empty()) process::log_info("the database answers again");
  if (view->term != view_.term && view_.term != 0 && !view->is_free)
    process::log_info("standing by for {}", name_of(*view));
  view_ = *std::move(view);
  return is_due;
}

Result<void> Standby::check_ports() const {
  const auto free = parts_->ports.check();
  if (free) return {};
  return fail(Errc::Busy,
              "{}: two servers on one computer need a --dds-port each, {} apart or more",
              free.error().what, 2 * parts_->cells);
}

/// Said when it begins and when it is over. One thread writes; the answers read.
void Standby::set_fault(std::string StandbyFaults::*which, std::string now, const char* cleared) {
  const std::lock_guard lock(mutex_);
  const std::string before = std::exchange(faults_.*which, std::move(now));
  if (!(faults_.*which).empty() && before.empty())
    process::log_warning("this standby: {}", faults_.*which);
  if ((faults_.*which).empty() && !before.empty()) process::log_info("{}", cleared);
}

/// Looked at when it matters, and each second for people and for a hand-over.
bool Standby::has_ports(bool is_due) {
  const SteadyTime now = parts_->clock.steady_now();
  if (!is_due && now - ports_seen_ < kPortsEvery) return faults_.ports.empty();
  ports_seen_ = now;
  look_at_agent();
  look_at_disk();
  const auto free = check_ports();
  set_fault(&StandbyFaults::ports, free ? "" : "it cannot take over: " + free.error().what,
            "the UDP ports are free: it can take over again");
  parts_->database.set_able(!faults_.is_unfit());
  parts_->database.set_note(faults_.note());
  return free.has_value();
}

/// Waited for as long as it takes: the active server may be alive, and slow.
void Standby::look_at_place(const View& view) {
  std::string fault;
  if (!view.obstacle.empty()) {
    fault =
        "the lease of the active server is over, but it is not taken over yet: " + view.obstacle;
  } else if (parts_->options.late > 1 && parts_->clock.steady_now() - parts_->began < kLateShown) {
    fault = fmt::format("it tried {} times to take over, in vain: {}", parts_->options.late,
                        parts_->options.late_because);
  }
  set_fault(&StandbyFaults::place, std::move(fault), "the place of the active server is in order");
}

/// What would fail at a takeover is reported now. The machines need no agent: it is none of what is
/// waited for.
void Standby::look_at_agent() {
  if (!parts_->agent) return;
  const auto free = api::check_free(parts_->agent->address);
  set_fault(&StandbyFaults::agent,
            free ? "" : "it would take over without its MTConnect agent: " + free.error().what,
            "the address of the MTConnect agent is free");
}

void Standby::look_at_disk() {
  std::error_code ec;
  const auto space = std::filesystem::space(parts_->folder.path(), ec);
  if (ec) return;
  const auto finding = library::judge_disk(space.capacity, space.available);
  using Level = library::Health::Level;
  const bool is_well = finding.level == Level::Ok;
  {
    const std::lock_guard lock(mutex_);
    faults_.is_disk_full = finding.level == Level::Failed;
  }
  set_fault(&StandbyFaults::disk,
            is_well ? "" : fmt::format("{} ({})", finding.what, parts_->folder.path().string()),
            "the disk has room again");
}

void Standby::look_at_clock(UtcTime before, const View& view) {
  if (!view.has_tables) return;
  const auto finding =
      library::judge_clock(before, view.time, parts_->clock.now(), !faults_.clock.empty());
  const bool is_well = finding.level == library::Health::Level::Ok;
  set_fault(&StandbyFaults::clock,
            is_well ? "" : fmt::format("{}: {}", finding.what, finding.detail),
            "the clocks of this server and of its database agree again");
}

/// With those of the server that has the place, or was killed with it. A place that is given back
/// stays that server's in this: its gateways are where they were.
void Standby::look_at_settings(const View& view) {
  const bool is_given_back = view.is_free && !view.is_lapsed;
  if (view.is_own || is_given_back) return;
  const auto difference = compare_settings(parts_->published_settings, view.settings);
  set_fault(&StandbyFaults::network,
            difference.forbids.empty()
                ? ""
                : fmt::format("it cannot take over, gateways would not find it: {}",
                              fmt::join(difference.forbids, "; ")),
            "the DDS settings are those of the active server: it can take over again");
  set_fault(&StandbyFaults::settings,
            difference.others.empty()
                ? ""
                : fmt::format("its settings differ: {}", fmt::join(difference.others, "; ")),
            "the settings are those of the active server");
}

Result<void> Standby::listen() {
  auto http = api::HttpServer::start(parts_->http, {.handle = [this](const api::Request& request) {
                                       api::Response response = answer(request);
                                       // By which a client that knows several servers asks the next
                                       // one.
                                       response.headers.emplace_back("Dripline-Role", "standby");
                                       return response;
                                     }});
  if (!http) return fail(http.error());
  http_ = *std::move(http);
  api::HttpAddress bound = parts_->http.address;
  bound.port = http_->port();
  address_ = bound.text();
  url_ = fmt::format("{}://{}", parts_->http.tls ? "https" : "http", address_);
  const auto announced = parts_->folder.announce({.url = url_,
                                                  .dds_domain = parts_->settings.dds_domain,
                                                  .dds_tag = parts_->settings.dds_tag});
  if (!announced) process::log_warning("{}", announced.error().what);
  return {};
}

std::string Standby::status() const {
  const std::lock_guard lock(mutex_);
  return fmt::format("{}: standby for {}{}", url_, name_of(view_), faults_.summary());
}

std::optional<storage::LeaseRow> Standby::ended() const {
  const std::lock_guard lock(mutex_);
  return view_.is_lapsed ? std::optional(view_.lease) : std::nullopt;
}

std::string Standby::takeover() const {
  const std::lock_guard lock(mutex_);
  if (!view_.has_tables || view_.described.empty())
    return "taking over the library, which no server has had";
  if (view_.is_own)
    return fmt::format("taking over the library again, which this server had before ({})",
                       view_.described);
  if (!view_.is_lapsed)
    return fmt::format("taking over from {}: it has given the library back (an end or a drain)",
                       name_of(view_));
  return fmt::format(
      "taking over from {}: its lease ran out (it was killed, hangs, or does not reach the "
      "database)",
      name_of(view_));
}

/// What anybody may know, and for everything else which server to ask.
api::Response Standby::answer(const api::Request& request) const {
  const std::lock_guard lock(mutex_);
  const bool is_well = faults_.is_well();
  nlohmann::json health = faults_.health();
  const std::string path = fmt::format("/{}", fmt::join(request.target.segments, "/"));
  if (path == "/api/v1/health") return api::json_response(200, health);
  if (path == "/api/v1/ready") {
    health["ready"] = false;
    return api::json_response(kUnavailable, health);
  }
  if (path == "/api/v1/metrics") {
    api::MetricsText out;
    out.gauge("dripline_server_active", "1: this server has its library; 0: it stands by.", 0);
    out.gauge("dripline_server_standby_ok",
              "1: a standby could take over, with the settings of the active server.",
              is_well ? 1 : 0);
    api::Response response;
    response.content_type = api::MetricsText::kContentType;
    response.body = out.take();
    return response;
  }
  if (wants_page(request)) {
    api::Response page =
        standby_page({.name = view_.described, .url = view_.url}, faults_, request);
    page.ends_connection = true;
    return page;
  }
  api::Response refused = api::error_response(
      kUnavailable,
      {Errc::Busy,
       fmt::format("this server stands by: {} has the library. Ask that one", name_of(view_))});
  refused.ends_connection = true;  // through a load balancer the next one may lead to that server
  return refused;
}

}  // namespace dripline::app
