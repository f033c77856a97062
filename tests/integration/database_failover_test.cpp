// The database is away for some seconds, or answers nothing: machines that run are fed from the
// server's own disk, and what they report meanwhile is stored afterwards.
#include <gtest/gtest.h>
#include <stdlib.h>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <thread>

#include "tests/integration/system.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/support/postgresql/test_cluster.hpp"

namespace dripline::integration {
namespace {

using std::chrono::seconds;
using test_support::eventually;

constexpr std::uint64_t kLines = 3000, kMovesPerLine = 400;
/// A gateway holds no more text (PullFeedOptions::cache_bytes), and what is in progress to it.
constexpr std::uint64_t kMostHeld = 10 << 20;
constexpr std::uint64_t kChunk = 256 << 10;

/// As of a database that fails over: `DRIPLINE_OUTAGE_S=30`.
seconds outage() {
  const char* given = ::getenv("DRIPLINE_OUTAGE_S");
  return given == nullptr ? seconds(3) : seconds(std::stoi(given));
}

/// Report lines far apart, without a loop: all of its text is needed once.
std::string written_out() {
  std::string text = "O0300\nG20 G93 G98\nG0 X2 Z0\nPOPEN P0\n";
  for (std::uint64_t line = 1; line <= kLines; ++line) {
    text += fmt::format("P1={}\n", line);
    for (std::uint64_t i = 0; i < kMovesPerLine; ++i)
      text += fmt::format("G1 X2.00{} Z-0.00{} F50\n", i % 2, i % 7);
    text += "DPRNT [LINE #1[50]]\n";
  }
  return text + "PCLOS\nM30\n";
}

enum class Way { Stopped, Frozen };

class DatabaseFailover : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    cluster_ = test::TestCluster::make();
    if (cluster_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
    text_ = written_out();
    ASSERT_GT(text_.size(), 2 * kMostHeld);
  }
  void start_shop(const std::vector<std::string>& more = {}, const std::string& speed = "max") {
    std::vector<std::string> arguments{"--store", cluster_->url()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    system_.emplace(
        System::Options{.speed = speed, .server_arguments = arguments, .gateway_arguments = {}});
    system_->start_server();
    system_->start_gateway();
    system_->wait_connected();
    system_->push("O0300", text_);
  }
  void leave() { GetParam() == Way::Stopped ? cluster_->stop() : cluster_->freeze(); }
  void come_back() { GetParam() == Way::Stopped ? cluster_->start() : cluster_->thaw(); }

  std::uint64_t executed_lines() const { return system_->execution_probe().outputs_done; }
  /// About, of the program's text.
  std::uint64_t executed_bytes() const { return text_.size() / kLines * executed_lines(); }
  nlohmann::json cache_state() const {
    return system_->rest().get("/api/v1/server").json()["program_cache"];
  }
  std::uint64_t chunk_files() const {
    std::error_code ec;
    const std::filesystem::recursive_directory_iterator files(
        system_->server_state() / "cache" / "chunks", ec);
    return static_cast<std::uint64_t>(std::count_if(
        begin(files), end(files),
        [&](const std::filesystem::directory_entry& entry) { return entry.is_regular_file(ec); }));
  }
  void expect_whole(const std::string& id) {
    EXPECT_EQ(system_->wait_ended(id, seconds(120)).value("state", ""), "completed");
    const auto lines = system_->report_lines(id);
    ASSERT_EQ(lines.size(), kLines);
    for (std::size_t i = 0; i < lines.size(); ++i)
      ASSERT_EQ(lines[i], fmt::format("LINE {:05}", i + 1));
  }

  std::unique_ptr<test::TestCluster> cluster_;
  std::optional<System> system_;
  std::string text_;
};

TEST_P(DatabaseFailover, AMachineIsFedAndNoLineIsLostOrDoubled) {
  start_shop();
  const std::string id = system_->start_run("O0300");
  const std::uint64_t chunks = (text_.size() + kChunk - 1) / kChunk;
  ASSERT_TRUE(eventually([&] { return chunk_files() == chunks; }))
      << "the whole program comes near: " << cache_state();
  const std::uint64_t before = executed_bytes();
  ASSERT_LT(before + 2 * kMostHeld, text_.size()) << "too late: the gateway has nearly all of it";
  leave();
  const auto left = std::chrono::steady_clock::now();
  EXPECT_TRUE(eventually([&] { return executed_lines() == kLines; }, seconds(60)))
      << "from byte " << before << " to " << executed_bytes() << " of " << text_.size();
  const auto fed = std::chrono::steady_clock::now() - left;
  RecordProperty("fed_ms", std::to_string(fed / std::chrono::milliseconds(1)));
  std::this_thread::sleep_until(left + outage());
  come_back();
  expect_whole(id);
  const auto state = cache_state();
  EXPECT_EQ(state["damaged"], 0);
  EXPECT_GT(state["hits"], 0);
  const auto metrics = system_->rest().get("/api/v1/metrics").body;
  EXPECT_NE(metrics.find("\ndripline_cache_hits_total "), std::string::npos) << metrics;
}

/// What the one before would show if the cache did nothing.
TEST_P(DatabaseFailover, WithoutACacheAMachineWaitsForTheDatabase) {
  start_shop({"--program-cache-mb", "0"});
  EXPECT_TRUE(cache_state().is_null());
  const std::string id = system_->start_run("O0300");
  ASSERT_TRUE(eventually([&] { return executed_lines() > 10; }));
  leave();
  const std::uint64_t before = executed_bytes();
  std::this_thread::sleep_for(seconds(3));
  EXPECT_LT(executed_bytes(), before + kMostHeld + 8 * kChunk);
  EXPECT_LT(executed_lines(), kLines);
  come_back();
  expect_whole(id);
  EXPECT_FALSE(std::filesystem::exists(system_->server_state() / "cache"));
}

/// The machine is fed meanwhile, so it must be stopped too.
TEST_P(DatabaseFailover, AStopReachesTheMachineMeanwhile) {
  start_shop({}, "1000x");
  const std::string id = system_->start_run("O0300");
  const auto executed = [&] { return system_->execution_probe().blocks_done; };
  ASSERT_TRUE(eventually([&] { return executed() > 1000; }));
  leave();
  const auto give = [&](const char* action) {
    return system_->rest().post("/api/v1/runs/" + id + "/commands", {{"action", action}});
  };
  const auto given = std::chrono::steady_clock::now();
  auto held = std::async(std::launch::async, give, "hold");
  const auto rests = [&] {
    const std::uint64_t before = executed();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    return executed() == before;
  };
  EXPECT_TRUE(eventually(rests, seconds(5)));
  const auto answer = held.get();
  EXPECT_EQ(answer.status, 200) << answer.body;
  const auto aborted = give("abort");
  EXPECT_EQ(aborted.status, 200) << aborted.body;
  EXPECT_LT(std::chrono::steady_clock::now() - given, seconds(8)) << "they wait for no database";
  come_back();
  EXPECT_EQ(system_->wait_ended(id).value("state", ""), "aborted");
  // What was done meanwhile is written down then.
  const auto entries = [&] { return system_->rest().get("/api/v1/audit?limit=50").body; };
  for (const char* action : {"run.hold", "run.abort"})
    EXPECT_TRUE(eventually([&] { return entries().find(action) != std::string::npos; })) << action;
}

/// A control at a serial port of the server.
TEST_P(DatabaseFailover, AStopReachesALineMeanwhile) {
  test_support::PtyCable cable;
  start_shop();
  const nlohmann::json port{
      {"machine", "old-lathe"}, {"address", cable.host()}, {"settings", {{"baud", "9600"}}}};
  const auto added = system_->rest().put_bytes("/api/v1/ports/port-1", port.dump());
  ASSERT_EQ(added.status / 100, 2) << added.body;
  const auto shown = [&] { return system_->rest().get("/api/v1/ports/port-1").json(); };
  ASSERT_TRUE(eventually([&] { return shown().value("open", false); })) << shown();
  const std::string id = system_->start_run("O0300", "old-lathe");
  ASSERT_TRUE(eventually([&] { return shown().value("sent", 0U) > 0; })) << shown();
  leave();
  for (const char* action : {"hold", "abort"}) {
    const auto given = std::chrono::steady_clock::now();
    const auto answer =
        system_->rest().post("/api/v1/runs/" + id + "/commands", {{"action", action}});
    EXPECT_EQ(answer.status, 200) << answer.body;
    EXPECT_LT(std::chrono::steady_clock::now() - given, seconds(3)) << action;
  }
  come_back();
  EXPECT_EQ(system_->wait_ended(id).value("state", ""), "aborted");
}

/// What the database did not have when the server was killed.
TEST_P(DatabaseFailover, AStopIsInTheAuditTrailThoughTheServerWasKilledMeanwhile) {
  start_shop({}, "1000x");
  const std::string id = system_->start_run("O0300");
  leave();
  EXPECT_EQ(system_->rest().post("/api/v1/runs/" + id + "/commands", {{"action", "abort"}}).status,
            200);
  system_->server().kill();
  come_back();
  system_->start_server();
  const auto entries = [&] { return system_->rest().get("/api/v1/audit?limit=50").body; };
  EXPECT_TRUE(eventually([&] { return entries().find("run.abort") != std::string::npos; }))
      << entries();
  EXPECT_TRUE(std::filesystem::is_empty(system_->server_state() / "audit-waiting"));
}

/// Whoever asks whether the server is ready waits for no database, and hears the truth.
TEST_P(DatabaseFailover, TheServerIsNotReadyUntilTheDatabaseAnswersAgain) {
  start_shop();
  const auto ready = [&] { return system_->rest().get("/api/v1/ready").status; };
  EXPECT_EQ(ready(), 200);
  leave();
  const auto left = std::chrono::steady_clock::now();
  EXPECT_TRUE(eventually([&] { return ready() == 503; }, seconds(30)));
  // Longer than a silent database is waited for: all connections are new ones then.
  std::this_thread::sleep_until(left + seconds(12));
  const auto asked = std::chrono::steady_clock::now();
  EXPECT_EQ(ready(), 503);
  EXPECT_LT(std::chrono::steady_clock::now() - asked, seconds(2)) << "it waits for no one";
  EXPECT_EQ(system_->rest().get("/api/v1/programs").status / 100, 5);
  come_back();
  EXPECT_TRUE(eventually([&] { return ready() == 200; }, seconds(30)));
  EXPECT_EQ(system_->rest().get("/api/v1/programs").status, 200);
}

INSTANTIATE_TEST_SUITE_P(, DatabaseFailover, testing::Values(Way::Stopped, Way::Frozen),
                         [](const auto& i) {
                           return i.param == Way::Stopped ? "Stopped" : "Frozen";
                         });

}  // namespace
}  // namespace dripline::integration
