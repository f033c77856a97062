#pragma once

#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "tests/unit/server/api/fake_machines.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {

inline constexpr const char* kSecret = "0123456789abcdef0123456789abcdef";

struct Call {
  std::string body;
  std::map<std::string, std::string> headers;
  std::string token = kSecret;
};

/// A webhook's receiver that takes everything.
class FakeSender final : public webhooks::Sender {
 public:
  Result<void> send(const webhooks::Delivery& delivery, const std::stop_token&) override {
    sent.push_back(delivery);
    return {};
  }
  std::vector<webhooks::Delivery> sent;
};

/// The API on a real store and fake machines, without sockets.
class ApiTest : public ServerTest {
 protected:
  using Json = nlohmann::json;

  ApiTest() {
    const identity::Accounts::Options cheap{.hashing = {.cost = {.passes = 1, .memory = 8192}}};
    accounts_ = identity::Accounts::open(
                    {.store = store_->accounts, .audit = *audit_, .clock = clock_}, cheap)
                    .value();
    EXPECT_TRUE(accounts_->use_local_secret(kSecret, false));
    start_search();
    make_api(&ports_);
  }

  void make_api(ports::PortControl* ports) {
    paths_ = std::make_unique<paths::ProgramPaths>(
        machines::RunSources{.store = *store_, .releases = *releases_, .clock = clock_});
    imports_ = std::make_unique<imports::Imports>(
        imports::Imports::Parts{.store = *store_,
                                .paths = *paths_,
                                .policy = releases_->policy(),
                                .clock = clock_,
                                .on_change = api::publish_imports_to(events_)});
    measurements_ = std::make_unique<measurements::Measurements>(measurements::Measurements::Parts{
        .store = *store_, .clock = clock_, .on_part = api::publish_parts_to(events_)});
    offsets_ = std::make_unique<offsets::Offsets>(
        offsets::Offsets::Parts{.store = *store_,
                                .setups = *setups_,
                                .clock = clock_,
                                .on_change = api::publish_offsets_to(events_)});
    jobs_ = std::make_unique<library::JobQueue>(
        library::JobQueue::Parts{.store = *store_,
                                 .releases = *releases_,
                                 .clock = clock_,
                                 .on_change = api::publish_jobs_to(events_)});
    folders::FolderSettings folder;
    folder.name = "cam";
    folder.path = folder_.path() / "cam";
    folders_ = std::make_unique<folders::Folders>(
        folders::HotFolder::Parts{
            .programs = *programs_,
            .catalog = catalog_,
            .sources = {.store = *store_, .releases = *releases_, .clock = clock_},
            .spool = folder_.path()},
        std::vector{folder});  // no one looks at it
    webhooks_ = std::make_unique<webhooks::Webhooks>(
        webhooks::Webhooks::Parts{
            .store = store_->webhooks, .sender = sender_, .clock = clock_, .server = "db"},
        webhooks::Webhooks::Options{});
    api_ = std::make_unique<api::Api>(api::Services{.programs = *programs_,
                                                    .releases = *releases_,
                                                    .attachments = *attachments_,
                                                    .search = *search_,
                                                    .setups = *setups_,
                                                    .machines = machines_,
                                                    .runs = *runs_,
                                                    .jobs = *jobs_,
                                                    .paths = *paths_,
                                                    .audit = *audit_,
                                                    .chain = *chain_,
                                                    .accounts = *accounts_,
                                                    .events = events_,
                                                    .clock = clock_,
                                                    .facts = {.name = "office",
                                                              .version = "1",
                                                              .data_dir = folder_.path().string(),
                                                              .started = clock_.now(),
                                                              .dds_domain = 3},
                                                    .dds_rejected = [] { return std::uint64_t{4}; },
                                                    .ports = ports,
                                                    .health = &health_,
                                                    .backups = backups_.get(),
                                                    .imports = imports_.get(),
                                                    .measurements = measurements_.get(),
                                                    .retention = retention_.get(),
                                                    .offsets = offsets_.get(),
                                                    .folders = folders_.get(),
                                                    .webhooks = webhooks_.get(),
                                                    .shared = shared_});
  }

  /// As of a PostgreSQL database that another server waits for.
  void share_library(std::vector<std::string> standbys) {
    const auto waiting = [standbys]() -> Result<std::vector<std::string>> { return standbys; };
    shared_ = api::SharedLibrary{.term = 41,
                                 .has_standby = true,
                                 .waiting = waiting,
                                 .hand_over = [standbys]() -> Result<std::vector<std::string>> {
                                   if (standbys.empty())
                                     return fail(Errc::Conflict, "no server waits");
                                   return standbys;
                                 },
                                 .leave = [this] { ++handed_over_; }};
    make_api(&ports_);
  }

  /// Made when they are asked for, in a folder beside the store.
  void set_up_backups() {
    auto folder = backup::BackupFolder::open(folder_.path() / "backups");
    ASSERT_TRUE(folder) << folder.error().what;
    backup::Source source{.folder = folder_.path(),
                          .database = "store.sqlite",
                          .files = {},
                          .made_by = "dncd 1",
                          .copy = [this](const std::filesystem::path& copy, const auto& proceed) {
                            return store_->copy_to(copy, proceed);
                          }};
    backups_ = std::make_unique<library::Backups>(
        library::Backups::Parts{.folder = *std::move(folder),
                                .source = std::move(source),
                                .audit = *audit_,
                                .health = health_,
                                .clock = clock_},
        library::Backups::Options{.every = std::chrono::hours(0)});
    make_api(&ports_);
  }

  /// Of what is older than a day, in a folder beside the store.
  void set_up_archives() {
    library::Retention::Options options;
    options.records.age = options.measurements.age = std::chrono::hours(24);
    retention_ =
        std::make_unique<library::Retention>(library::Retention::Parts{.store = *store_,
                                                                       .clock = clock_,
                                                                       .folder = folder_.path(),
                                                                       .database = "db",
                                                                       .made_by = "dncd 1"},
                                             options);
    make_api(&ports_);
  }

  api::Response call(const std::string& method, const std::string& target, const Call& call = {}) {
    auto parsed = api::parse_target(target);
    EXPECT_TRUE(parsed) << target;
    api::Request request;
    request.method = method;
    request.target = parsed.value_or(api::Target{});
    request.headers = call.headers;
    if (!call.token.empty()) request.headers["authorization"] = "Bearer " + call.token;
    request.headers.emplace("content-length", std::to_string(call.body.size()));
    request.address = "192.0.2.1";
    request.body = call.body;
    return api_->handle(std::move(request));
  }
  api::Response get(const std::string& target) { return call("GET", target); }
  api::Response post(const std::string& target, const Json& body) {
    return call("POST", target, {.body = body.dump(), .headers = {}});
  }
  static Json json(const api::Response& response) {
    return Json::parse(body(response), nullptr, false);
  }
  /// The whole body, pulled when it comes in pieces.
  static std::string body(const api::Response& response) {
    if (!response.source) return response.body;
    std::string text;
    for (;;) {
      auto piece = response.source();
      EXPECT_TRUE(piece) << piece.error().what;
      if (!piece || !*piece) return text;
      text += **piece;
    }
  }
  static std::string header(const api::Response& response, const std::string& name) {
    for (const auto& [key, value] : response.headers) {
      if (key == name) return value;
    }
    return {};
  }
  static void expect_error(const api::Response& response, int status, const std::string& code,
                           const std::string& part) {
    EXPECT_EQ(response.status, status) << response.body;
    const Json answer = json(response);
    ASSERT_TRUE(answer.contains("error")) << response.body;
    EXPECT_EQ(answer["error"]["code"], code);
    EXPECT_NE(answer["error"].value("message", "").find(part), std::string::npos) << response.body;
  }
  void show_machine(const std::string& name) {
    add_machine(name);
    machines::MachineView view;
    view.machine = store_->machines.find(name).value();
    view.is_connected = true;
    machines_.views.push_back(std::move(view));
  }
  /// A run of O0100 with some output lines and its end, as it would be stored.
  std::string stored_run(std::uint64_t outputs) {
    const auto revision = push("O0100", "O0100\nM30\n");
    show_machine("lathe-1");
    Run run = run_of(revision, "run-1");
    run.author = "admin";
    EXPECT_TRUE(store_->runs.create(run));
    storage::RecordBatch batch;
    batch.machine = "lathe-1";
    batch.epoch = 7;
    for (std::uint64_t n = 1; n <= outputs; ++n) {
      storage::Record record;
      record.machine = "lathe-1";
      record.epoch = 7;
      record.number = n;
      record.time = clock_.now();
      record.run = run.id;
      record.kind = "output";
      record.block = n;
      record.line = n;
      record.device = "port1";
      record.text = fmt::format("X{}, \"Z\"", n);
      batch.records.push_back(record);
    }
    EXPECT_TRUE(store_->records.store(batch));
    machines_.run = store_->runs.find(run.id).value();
    return run.id;
  }

  /// A token of a user with this role, who is made when there is none yet and has every machine.
  std::string token_of(const std::string& role) {
    const identity::Caller admin =
        accounts_->find({identity::PresentedSecret::From::Bearer, kSecret}, "").value();
    identity::NewUser user{.name = "a-" + role, .role = storage::parse_role(role).value()};
    user.groups = {storage::kAllMachines};
    (void)accounts_->users().add(admin, user);
    (void)accounts_->tokens().revoke(admin, user.name, "test");
    const auto issued = accounts_->tokens().add(admin, user.name, {.name = "test"});
    EXPECT_TRUE(issued) << issued.error().what;
    return issued ? issued->secret : "";
  }

  std::unique_ptr<identity::Accounts> accounts_;
  FakeMachines machines_;
  FakePorts ports_;
  library::Health health_{clock_};
  std::unique_ptr<library::Backups> backups_;
  api::EventHub events_;
  std::unique_ptr<paths::ProgramPaths> paths_;
  std::unique_ptr<imports::Imports> imports_;
  std::unique_ptr<measurements::Measurements> measurements_;
  std::unique_ptr<library::Retention> retention_;
  std::unique_ptr<offsets::Offsets> offsets_;
  std::unique_ptr<library::JobQueue> jobs_;
  std::unique_ptr<folders::Folders> folders_;
  FakeSender sender_;
  std::unique_ptr<webhooks::Webhooks> webhooks_;
  std::optional<api::SharedLibrary> shared_;
  int handed_over_ = 0;
  std::unique_ptr<api::Api> api_;
};

/// What the handlers answer, without sockets.
class ApiHandlers : public ApiTest {};

}  // namespace dripline::server_test
