// Two servers of one library and a machine that runs: whatever happens to the active one, the other
// takes over, the machine is fed, and nothing is lost, doubled or written by two.
// DRIPLINE_TAKEOVERS changes how often (6 by default).
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <random>
#include <thread>

#include "storage/postgresql/database.hpp"
#include "tests/integration/system.hpp"
#include "tests/integration/two_servers.hpp"
#include "tests/support/postgresql/database_cable.hpp"
#include "tests/support/postgresql/test_database.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using storage::postgresql::Database;
using test_support::eventually;

constexpr std::uint64_t kMovesPerLine = 50;

int takeovers() {
  const char* wanted = std::getenv("DRIPLINE_TAKEOVERS");
  return wanted != nullptr ? std::atoi(wanted) : 6;
}

/// Seconds, of the servers' places: `DRIPLINE_TAKEOVER_S=3`.
std::string lease() {
  const char* wanted = std::getenv("DRIPLINE_TAKEOVER_S");
  return wanted != nullptr ? wanted : "2";
}

/// Some 0.4 MB of text a second at the speed of this test: the 4 MiB that a gateway holds at most
/// are ten seconds of it, and the program is longer than what is fed during the rounds.
std::string long_program(std::uint64_t lines) {
  const std::string padding(180, 'A');
  std::string text = "O0300\nG20 G93 G98\nG0 X2 Z0\nPOPEN P0\n";
  for (std::uint64_t line = 1; line <= lines; ++line) {
    text += fmt::format("P1={}\n", line);
    for (std::uint64_t i = 0; i < kMovesPerLine; ++i)
      text += fmt::format("G1 X2.00{} Z-0.0{:02} F800 ({})\n", i % 2, i % 31, padding);
    text += "DPRNT [LINE #1[60]]\n";
  }
  return text + "PCLOS\nM30\n";
}

class TwoServersTest : public testing::Test {
 protected:
  void SetUp() override {
    database_ = test::TestDatabase::make_empty();
    if (database_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
  }
  /// The sessions of each server have its name, for the witness in the database.
  std::string store(char server) {
    auto& cable = cables_[server == 'a' ? 0 : 1];
    cable = std::make_unique<test::DatabaseCable>(database_->url());
    return cable->url() + "&options=-c%20dripline.server%3D" + server;
  }
  void begin(const std::vector<std::string>& arguments = {}) {
    shop_.emplace(TwoServers::Options{
        .stores = {store('a'), store('b')}, .speed = "10x", .arguments = arguments});
    shop_->start(0);
    ASSERT_TRUE(shop_->wait_active(0)) << shop_->log(0);
    shop_->share_keys();
    shop_->start(1);
    ASSERT_EQ(shop_->role(1), "standby") << shop_->log(1);
    ASSERT_TRUE(shop_->wait_for_standby());
  }
  Database connect() const {
    auto database = Database::connect({.url = database_->url()});
    EXPECT_TRUE(database) << database.error().what;
    return *std::move(database);
  }
  /// Of every row that matters: who wrote it, in which term.
  void place_witness() const {
    auto database = connect();
    const auto made = database.execute(
        "CREATE TABLE witness (server text, term bigint, rows bigint, PRIMARY KEY (server, term));"
        "CREATE FUNCTION note_writer() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN "
        "INSERT INTO witness VALUES (current_setting('dripline.server', true), (SELECT term FROM "
        "store_holder), 1) ON CONFLICT (server, term) DO UPDATE SET rows = witness.rows + 1; "
        "RETURN NULL; END $$;"
        "CREATE TRIGGER witness AFTER INSERT ON record FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer();"
        "CREATE TRIGGER witness AFTER INSERT ON audit FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer();"
        "CREATE TRIGGER witness AFTER UPDATE ON machine FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer();"
        "CREATE TRIGGER witness AFTER UPDATE ON run FOR EACH STATEMENT EXECUTE FUNCTION "
        "note_writer()");
    ASSERT_TRUE(made) << made.error().what;
  }
  void expect_one_writer_in_each_term() const {
    auto database = connect();
    EXPECT_EQ(database.integer("SELECT count(*) FROM (SELECT term FROM witness GROUP BY term "
                               "HAVING count(DISTINCT server) > 1) AS two"),
              0);
    EXPECT_GT(database.integer("SELECT count(DISTINCT term) FROM witness").value_or(0), 1);
  }
  void expect_whole_trail(int server) const {
    const auto verified =
        shop_->rest(server).post("/api/v1/audit/verification", nlohmann::json::object());
    ASSERT_EQ(verified.status, 200) << verified.body;
    EXPECT_TRUE(verified.json()["verification"]["fault"].is_null()) << verified.body;
  }
  std::string start_run(int server) {
    const auto reply =
        shop_->rest(server).post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0300"}});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.json().value("id", "none");
  }
  nlohmann::json run(int server, const std::string& id) const {
    auto found = shop_->rest(server).get("/api/v1/runs/" + id).json();
    return found.is_object() ? found : nlohmann::json::object();
  }
  void expect_every_line_once(int server, const std::string& id, std::uint64_t lines) const {
    std::istringstream text(shop_->rest(server).get("/api/v1/reports/" + id + "?format=text").body);
    std::uint64_t count = 0;
    for (std::string line; std::getline(text, line);) {
      ++count;
      ASSERT_EQ(line, fmt::format("LINE {:06}", count));
    }
    EXPECT_EQ(count, lines);
  }

  std::unique_ptr<test::TestDatabase> database_;
  std::array<std::unique_ptr<test::DatabaseCable>, 2> cables_;  ///< of each server
  std::optional<TwoServers> shop_;
};

enum class Event { Kill, Freeze, Cut, Drain };
constexpr std::array kEvents{Event::Kill, Event::Freeze, Event::Cut, Event::Drain};
const char* word(Event event) {
  return std::array{"kill", "freeze", "cut", "drain"}[static_cast<std::size_t>(event)];
}

/// A run of a machine while its servers come and go.
class Takeovers : public TwoServersTest {
 protected:
  struct Figures {
    int count = 0;
    milliseconds most{0}, sum{0};
    double least_level = 1;  ///< of the text at the gateway, against what was there before
    std::uint64_t least_bytes = UINT64_MAX;
  };

  /// What happens to the active server, until the other one has the machine. Returns which that is.
  int happen(Event event, int active) {
    const int other = 1 - active;
    const auto level = levels_->now();
    ASSERT_GT_OR(level.most, 0);
    levels_->reset();
    const auto begun = std::chrono::steady_clock::now();
    switch (event) {
      case Event::Kill:
        shop_->server(active).kill();
        break;
      case Event::Freeze:
        shop_->freeze(active);
        break;
      case Event::Cut:
        cables_[static_cast<std::size_t>(active)]->pull();
        break;
      case Event::Drain: {
        const auto reply =
            shop_->rest(active).post("/api/v1/server/drain", nlohmann::json::object());
        EXPECT_EQ(reply.status, 202) << reply.body;
      }
    }
    EXPECT_TRUE(shop_->wait_active(other)) << word(event) << "\n" << shop_->log(other);
    EXPECT_TRUE(shop_->wait_connected(other)) << word(event) << "\n" << shop_->log(other);
    const auto took =
        std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begun);
    std::this_thread::sleep_for(milliseconds(500));  // until text flows again
    const auto after = levels_->now();
    EXPECT_FALSE(after.has_ended) << "the run ended during the test: it is too short";
    EXPECT_GE(after.least * 2, level.most)
        << word(event) << ": the text at the gateway fell below half";
    Figures& figures = figures_[static_cast<std::size_t>(event)];
    ++figures.count;
    figures.sum += took;
    figures.most = std::max(figures.most, took);
    figures.least_bytes = std::min(figures.least_bytes, after.least);
    figures.least_level = std::min(
        figures.least_level, static_cast<double>(after.least) / static_cast<double>(level.most));
    return other;
  }

  /// The one that lost its place is there again as the standby.
  void recover(Event event, int lost) {
    if (event == Event::Freeze) shop_->thaw(lost);
    if (event == Event::Cut) cables_[static_cast<std::size_t>(lost)]->plug();
    if (event == Event::Freeze || event == Event::Cut) {
      const auto status = shop_->server(lost).wait(seconds(30));
      ASSERT_TRUE(status) << "it ends when it comes back\n" << shop_->log(lost);
      EXPECT_EQ(*status, 1) << shop_->log(lost);
      EXPECT_NE(shop_->log(lost).find("was taken over by another server"), std::string::npos);
    }
    if (event != Event::Drain) shop_->start(lost);  // as a service manager does
    ASSERT_TRUE(shop_->wait_for_standby()) << shop_->log(lost);
    EXPECT_EQ(shop_->role(lost), "standby") << "it waits";
  }
  static void ASSERT_GT_OR(std::uint64_t value, std::uint64_t least) { EXPECT_GT(value, least); }

  std::optional<TextLevel> levels_;
  std::array<Figures, kEvents.size()> figures_{};
};

TEST_F(Takeovers, AtRandomTheMachineIsFedAndNothingIsLostOrDoubled) {
  const int rounds = takeovers();
  const auto lines = static_cast<std::uint64_t>(900 + rounds * 330);
  begin({"--takeover-s", lease()});
  place_witness();
  shop_->start_gateway();
  ASSERT_TRUE(shop_->wait_connected(0)) << shop_->gateway_log();
  shop_->push(0, "O0300", long_program(lines));
  const std::string id = start_run(0);
  const auto started = std::chrono::steady_clock::now();
  levels_.emplace(shop_->gateway_state());
  // The gateway has its ten seconds of text.
  ASSERT_TRUE(eventually([&] { return levels_->now().most > 3'000'000; }))
      << levels_->now().most << "\n"
      << shop_->gateway_log();
  std::mt19937 random{std::random_device{}()};
  int active = 0;
  for (int i = 0; i < rounds && !HasFailure(); ++i) {
    constexpr int kKinds = static_cast<int>(kEvents.size());
    const int kind = i < kKinds ? i : std::uniform_int_distribution<>(0, kKinds - 1)(random);
    const Event event = kEvents[static_cast<std::size_t>(kind)];
    levels_->reset();
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<>(800, 2500)(random)));
    const int lost = active;
    active = happen(event, active);
    if (HasFailure()) break;
    std::this_thread::sleep_for(milliseconds(std::uniform_int_distribution<>(0, 1500)(random)));
    recover(event, lost);
  }
  const bool has_ended = eventually(
      [&] {
        const std::string state = run(active, id).value("state", "");
        return !state.empty() && state != "active" && state != "ordered";
      },
      seconds(120 + 15 * rounds));
  const auto ended = run(active, id);
  ASSERT_TRUE(has_ended) << ended.dump();
  EXPECT_EQ(ended.value("state", ""), "completed") << ended.dump();
  EXPECT_EQ(ended.value("content_verified", false), true) << ended.dump();
  EXPECT_EQ(ended.value("executed", std::uint64_t{0}), 6 + lines * (kMovesPerLine + 2))
      << ended.dump();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  fmt::print("{:.0f} KB/s of text\n",
             ended.value("total_bytes", ended.value("size", 0.0)) / 1000 / took.count());
  expect_every_line_once(active, id, lines);
  expect_whole_trail(active);
  expect_one_writer_in_each_term();
  for (const Event event : kEvents) {
    const Figures& figures = figures_[static_cast<std::size_t>(event)];
    if (figures.count == 0) continue;
    fmt::print("{}: {} times, mean {} ms, at most {} ms, least text {} bytes, {:.0f} %\n",
               word(event), figures.count, figures.sum.count() / figures.count,
               figures.most.count(), figures.least_bytes, 100 * figures.least_level);
  }
}

TEST_F(TwoServersTest, TheStandbySaysWhatItIsAndWhoIsActive) {
  begin();
  const auto health = shop_->rest(1).get("/api/v1/health");
  EXPECT_EQ(health.status, 200);
  EXPECT_EQ(health.json().value("role", ""), "standby") << health.body;
  const auto ready = shop_->rest(1).get("/api/v1/ready");
  EXPECT_EQ(ready.status, 503);
  EXPECT_EQ(ready.json().value("ready", true), false) << ready.body;
  EXPECT_EQ(shop_->rest(0).get("/api/v1/ready").json().value("role", ""), "active");
  const auto refused = shop_->rest(1).get("/api/v1/machines");
  EXPECT_EQ(refused.status, 503);
  EXPECT_NE(refused.body.find(shop_->rest(0).url()), std::string::npos) << refused.body;
  EXPECT_NE(shop_->rest(1).get("/api/v1/metrics").body.find("\ndripline_server_active 0\n"),
            std::string::npos);
  const auto metrics = shop_->rest(0).get("/api/v1/metrics").body;
  EXPECT_NE(metrics.find("\ndripline_server_active 1\n"), std::string::npos);
  EXPECT_NE(metrics.find("\ndripline_server_standbys 1\n"), std::string::npos);
}

/// Sessions, tokens, webhooks and the rest come from the database.
TEST_F(TwoServersTest, AnOrderlyEndHandsOverAtOnceWithEverythingInTheDatabase) {
  begin();
  const auto token = shop_->rest(0).post("/api/v1/users/admin/tokens", {{"name", "robot"}});
  ASSERT_EQ(token.status, 201) << token.body;
  const std::string secret = token.json().value("secret", token.json().value("token", ""));
  const auto begun = std::chrono::steady_clock::now();
  shop_->server(0).signal(SIGTERM);
  ASSERT_TRUE(shop_->wait_active(1));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, seconds(4))
      << "without waiting for the end of a lease";
  EXPECT_EQ(shop_->server(0).wait(seconds(10)), 0);
  const test_support::RestClient robot(shop_->rest(1).url(), secret);
  EXPECT_EQ(robot.get("/api/v1/server").status, 200);
  expect_whole_trail(1);
}

TEST_F(TwoServersTest, ADrainAtTheCommandLineHandsOverAndTheDrainedOneStandsBy) {
  begin();
  const auto dnc = [&](int server, const std::string& verb) {
    return test_support::run_to_end(
        {program_path("dnc"), "--state", shop_->state(server), "server", verb},
        shop_->folder() / "dnc.out");
  };
  const auto shown = dnc(0, "status");
  EXPECT_EQ(shown.status, 0) << shown.output;
  EXPECT_NE(shown.output.find(", standby: dncd "), std::string::npos) << shown.output;
  const auto refused = dnc(1, "drain");
  EXPECT_NE(refused.status, 0);
  EXPECT_NE(refused.output.find("this server stands by"), std::string::npos) << refused.output;
  const auto drained = dnc(0, "drain");
  EXPECT_EQ(drained.status, 0) << drained.output;
  EXPECT_NE(drained.output.find("handed over to dncd "), std::string::npos) << drained.output;
  ASSERT_TRUE(shop_->wait_active(1));
  EXPECT_TRUE(shop_->wait_for_standby());
  EXPECT_EQ(shop_->role(0), "standby");
  EXPECT_TRUE(shop_->server(0).is_running()) << "the same process";
  expect_whole_trail(1);
}

TEST_F(TwoServersTest, WithoutAStandbyNothingIsHandedOver) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("no server waits"), std::string::npos) << refused.body;
  EXPECT_EQ(shop_->role(0), "active");
}

TEST_F(TwoServersTest, NothingIsHandedOverToAStandbyThatDoesNotAnswer) {
  begin();
  shop_->server(1).signal(SIGSTOP);
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("has not looked at it"), std::string::npos) << refused.body;
  EXPECT_EQ(shop_->role(0), "active");
  shop_->server(1).signal(SIGCONT);
  const auto drained = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(drained.status, 202) << drained.body;
  ASSERT_TRUE(shop_->wait_active(1));
}

TEST_F(TwoServersTest, AFolderWithoutTheKeysIsRefused) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", shop_->state(1), "--store", store('b'), "--standby", "yes",
       "--http", "127.0.0.1:0", "--dds-domain", std::to_string(shop_->domain())},
      shop_->folder() / "refused.out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("signing.key, token and database.id"), std::string::npos)
      << refused.output;
}

TEST_F(TwoServersTest, AFolderWithAnotherTokenIsRefused) {
  shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')}});
  shop_->start(0);
  shop_->share_keys();
  std::ofstream(shop_->state(1) / "token") << std::string(64, 'a') << "\n";
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", shop_->state(1), "--store", store('b'), "--standby", "yes",
       "--http", "127.0.0.1:0", "--dds-domain", std::to_string(shop_->domain())},
      shop_->folder() / "refused.out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("is not the token that the active server has"), std::string::npos)
      << refused.output;
}

TEST_F(TwoServersTest, ASqliteFileHasNoStandby) {
  const test_support::TemporaryFolder folder;
  const auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", folder.path() / "s", "--standby", "yes"},
      folder.path() / "out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("standby: servers share a PostgreSQL database"), std::string::npos)
      << refused.output;
}

/// A device server that lets several computers use its port at once, as many do.
class OpenDeviceServer {
 public:
  OpenDeviceServer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    auto* address = reinterpret_cast<sockaddr*>(&place);
    EXPECT_EQ(::bind(listener_.get(), address, size), 0);
    EXPECT_EQ(::listen(listener_.get(), 4), 0);
    ::getsockname(listener_.get(), address, &size);
    address_ = "tcp://127.0.0.1:" + std::to_string(ntohs(place.sin_port));
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  const std::string& address() const { return address_; }
  std::size_t received() const { return received_; }
  bool stays_silent(milliseconds time) const {
    const std::size_t before = received_;
    std::this_thread::sleep_for(time);
    return received_ == before;
  }

 private:
  void serve(const std::stop_token& stop) {
    std::vector<Descriptor> clients;
    while (!stop.stop_requested()) {
      std::vector<pollfd> ends{{listener_.get(), POLLIN, 0}};
      for (const auto& client : clients) ends.push_back({client.get(), POLLIN, 0});
      if (::poll(ends.data(), ends.size(), 20) <= 0) continue;
      for (std::size_t i = clients.size(); i > 0; --i) {
        std::array<char, 256> piece;
        if (ends[i].revents == 0) continue;
        const auto got = ::recv(clients[i - 1].get(), piece.data(), piece.size(), 0);
        if (got > 0) received_ += static_cast<std::size_t>(got);
        if (got <= 0) clients.erase(clients.begin() + static_cast<std::ptrdiff_t>(i - 1));
      }
      if (ends[0].revents != 0) clients.emplace_back(::accept(listener_.get(), nullptr, nullptr));
    }
  }
  Descriptor listener_;
  std::string address_;
  std::atomic<std::size_t> received_ = 0;
  std::jthread thread_;
};

/// A control at the end of a device server, which both servers reach.
class SharedLine : public TwoServersTest {
 protected:
  /// A run that takes its line for some minutes.
  void begin_run() {
    begin();
    const nlohmann::json settings{
        {"machine", "mill-1"}, {"address", device_.address()}, {"template", "plain"}};
    const auto added = shop_->rest(0).put_bytes("/api/v1/ports/line-1", settings.dump());
    ASSERT_LT(added.status, 300) << added.body;
    std::string text = "O1\n";
    for (int i = 1; i < 6000; ++i) text += fmt::format("N{} G1 X{}\n", i, i % 9);
    shop_->push(0, "O1", text);
    ASSERT_TRUE(eventually([&] { return port(0).value("open", false); })) << port(0).dump();
    const auto begun =
        shop_->rest(0).post("/api/v1/runs", {{"machine", "mill-1"}, {"program", "O1"}});
    ASSERT_EQ(begun.status, 201) << begun.body;
    id_ = begun.json().value("id", "none");
    ASSERT_TRUE(eventually([&] { return device_.received() > 500; }));
  }
  nlohmann::json port(int server) const {
    return shop_->rest(server).get("/api/v1/ports/line-1").json();
  }

  OpenDeviceServer device_;
  std::string id_;
};

/// The control would have half a program in its memory.
TEST_F(SharedLine, IsNotHandedOverInTheMiddleOfATransfer) {
  begin_run();
  ASSERT_LT(shop_->rest(0).post("/api/v1/runs/" + id_ + "/commands", {{"action", "abort"}}).status,
            300);
  ASSERT_TRUE(eventually([&] { return run(0, id_).value("state", "") == "aborted"; }));
  const auto sent = shop_->rest(0).post("/api/v1/ports/line-1/transfers",
                                        {{"programs", nlohmann::json::array({"O1"})}});
  ASSERT_LT(sent.status, 300) << sent.body;
  const auto refused = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  EXPECT_EQ(refused.status, 409) << refused.body;
  EXPECT_NE(refused.body.find("port 'line-1' of machine 'mill-1' is sending"), std::string::npos)
      << refused.body;
  EXPECT_EQ(shop_->role(0), "active");
}

/// Two programs at once on one line would be another program at the control.
TEST_F(SharedLine, IsFedByNobodyWhoMayHaveLostTheLibrary) {
  begin_run();
  cables_[0]->pull();
  ASSERT_TRUE(shop_->wait_active(1));
  EXPECT_TRUE(device_.stays_silent(seconds(2)));
  EXPECT_EQ(run(1, id_).value("state", ""), "interrupted");
  EXPECT_NE(port(0).dump().find("nothing is sent"), std::string::npos) << port(0).dump();
  cables_[0]->plug();
  EXPECT_EQ(shop_->server(0).wait(seconds(30)), 1) << shop_->log(0);
  EXPECT_TRUE(device_.stays_silent(seconds(1)));
}

TEST_F(SharedLine, IsSentNothingByAServerThatWakesUp) {
  begin_run();
  shop_->freeze(0);
  ASSERT_TRUE(shop_->wait_active(1));
  ASSERT_TRUE(eventually([&] { return run(1, id_).value("state", "") == "interrupted"; }));
  ASSERT_TRUE(device_.stays_silent(seconds(1)));
  const std::size_t before = device_.received();
  shop_->thaw(0);
  EXPECT_EQ(shop_->server(0).wait(seconds(30)), 1) << shop_->log(0);
  EXPECT_EQ(device_.received(), before);
}

/// The database was away, and no other server has the library: the run continues where it was.
TEST_F(SharedLine, IsFedAgainWhenThePlaceIsRenewed) {
  begin_run();
  shop_->server(1).kill();
  cables_[0]->pull();
  ASSERT_TRUE(eventually([&] { return device_.stays_silent(seconds(1)); }));
  const std::size_t before = device_.received();
  cables_[0]->plug();
  EXPECT_TRUE(eventually([&] { return device_.received() > before + 500; })) << shop_->log(0);
  EXPECT_EQ(run(0, id_).value("state", ""), "active");
  EXPECT_TRUE(port(0)["fault"].is_null()) << port(0).dump();
}

/// The standby's own /dev/ttyUSB0 is another machine's.
TEST_F(TwoServersTest, ADeviceOfTheOtherComputerIsNotOpened) {
  begin();
  auto database = connect();
  const nlohmann::json settings{{"machine", "mill-1"}, {"address", "/dev/null"}};
  const auto added = shop_->rest(0).put_bytes("/api/v1/ports/line-1", settings.dump());
  ASSERT_LT(added.status, 300) << added.body;
  EXPECT_NE(database.text("SELECT host FROM port").value_or(""), "");
  ASSERT_TRUE(database.execute("UPDATE port SET host = 'srv-1'"));
  shop_->server(0).kill();
  ASSERT_TRUE(shop_->wait_active(1));
  const auto port = shop_->rest(1).get("/api/v1/ports/line-1");
  EXPECT_NE(port.body.find("is a device of computer srv-1"), std::string::npos) << port.body;
  EXPECT_NE(port.body.find("rfc2217"), std::string::npos) << port.body;
}

}  // namespace
}  // namespace dripline::integration
