// Clocks, databases and limits of the system that are not as they should be.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <csignal>
#include <fstream>

#include "tests/integration/system.hpp"
#include "tests/support/preload.hpp"
#include "tests/support/service_socket.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;
using test_support::kCanPreload;
using test_support::run_to_end;

std::string long_program() {
  std::string text = "O0100\nG98 F100\n";
  for (int i = 0; i < 200; ++i) text += i % 2 == 0 ? "G1 X1.\n" : "G1 X2.\n";
  return text + "M30\n";
}

/// The gateway's time of day is so many seconds off.
class Clocks : public testing::TestWithParam<int> {};

TEST_P(Clocks, ThatDifferByAnHourNeitherStopNorHinderAnything) {
  if (!kCanPreload) GTEST_SKIP() << "a sanitizer must be loaded first";
  System::Options options;
  options.speed = "1x";
  options.gateway_environment = {std::string("LD_PRELOAD=") + DRIPLINE_SHIFTED_CLOCK,
                                 "DRIPLINE_TEST_SHIFT=" + std::to_string(GetParam())};
  System system(options);
  system.start_server();
  system.start_gateway();
  system.wait_connected();
  system.push("O0100", long_program());
  const auto machine = [&] { return system.rest().get("/api/v1/machines/lathe-1").json(); };
  ASSERT_TRUE(eventually([&] { return !machine()["clock_ahead_seconds"].is_null(); }));
  EXPECT_NEAR(machine()["clock_ahead_seconds"].get<double>(), GetParam(), 5);
  EXPECT_NE(machine()["notices"].dump().find("the gateway's clock is"), std::string::npos);

  const std::string id = system.start_run("O0100");
  const auto command = [&](const json& body) {
    const auto reply = system.rest().post("/api/v1/runs/" + id + "/commands", body);
    EXPECT_EQ(reply.status, 200) << body.dump() << reply.body;
  };
  const auto comes_to = [&](const std::string& execution) {
    return eventually([&] { return machine()["status"].value("execution", "") == execution; });
  };
  EXPECT_TRUE(comes_to("ACTIVE"));
  command({{"action", "feed_override"}, {"value", 0}});
  command({{"action", "feed_override"}, {"value", 1}});
  command({{"action", "hold"}});
  EXPECT_TRUE(comes_to("FEED_HOLD"));
  command({{"action", "resume"}});
  EXPECT_TRUE(comes_to("ACTIVE"));
  command({{"action", "abort"}});
  const json ended = system.wait_ended(id);
  EXPECT_EQ(ended.value("state", ""), "aborted");
  EXPECT_LE(ended.value("created", ""), ended.value("started", ""));
  EXPECT_LE(ended.value("started", ""), ended.value("ended", ""));
  const auto pressed =
      system.rest().post("/api/v1/machines/lathe-1/commands",
                         {{"action", "switch"}, {"name", "emergency_stop"}, {"value", 1}});
  EXPECT_EQ(pressed.status, 200) << pressed.body;
  EXPECT_TRUE(eventually([&] { return machine()["status"].value("emergency_stop", false); }));

  std::ifstream log(system.folder() / "dncd.log");
  int warnings = 0;
  for (std::string line; std::getline(log, line);)
    warnings += line.find("the gateway's clock is") != std::string::npos ? 1 : 0;
  EXPECT_EQ(warnings, 1) << "once, when it begins";
}
INSTANTIATE_TEST_SUITE_P(, Clocks, testing::Values(3600, -3600),
                         [](const auto& i) { return i.param > 0 ? "Ahead" : "After"; });

class Database : public testing::Test {
 protected:
  Database() {
    system.start_server();
    system.push("O0100", long_program());
    stop_server();
  }
  void stop_server() {
    system.server().signal(SIGTERM);
    ASSERT_EQ(system.server().wait(), 0);
  }
  std::filesystem::path file() const { return system.server_state() / "dripline.sqlite"; }
  test_support::Finished start(const std::string& option = "") const {
    std::vector<std::string> command{
        program_path("dncd"), "--state",      system.server_state(),          "--http",
        "127.0.0.1:0",        "--dds-domain", std::to_string(system.domain())};
    if (!option.empty()) command.push_back(option);
    return run_to_end(command, system.folder() / "refused.out");
  }
  void change(const std::string& sql) const {
    const auto done = run_to_end({"/usr/bin/sqlite3", file(), sql}, system.folder() / "sqlite.out");
    ASSERT_EQ(done.status, 0) << done.output;
  }
  System system;
};

TEST_F(Database, ThatIsLostIsNotReplacedByAnEmptyOneWithoutAWord) {
  std::filesystem::remove(file());
  auto refused = start();
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("missing: restore it from a backup"), std::string::npos)
      << refused.output;
  std::ofstream(file()).close();  // 0 bytes
  refused = start();
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("empty: restore it from a backup"), std::string::npos)
      << refused.output;
  system.add_server_argument("--begin-empty");
  system.start_server();
  EXPECT_TRUE(system.rest().get("/api/v1/programs").json()["programs"].empty());
  stop_server();
  refused = start("--begin-empty");
  EXPECT_EQ(refused.status, 1) << "once is meant, not for ever";
  EXPECT_NE(refused.output.find("is there"), std::string::npos) << refused.output;
}

TEST_F(Database, OfAnotherFolderIsNoticed) {
  change("UPDATE identity SET id = 'another'");
  const auto refused = start();
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("is not the database this folder has had"), std::string::npos)
      << refused.output;
}

TEST_F(Database, WithZeroedPagesIsNoticedAtTheStart) {
  std::fstream bytes(file(), std::ios::binary | std::ios::in | std::ios::out);
  bytes.seekp(4096);
  bytes << std::string(4 * 4096, '\0');  // pages 2 to 5
  bytes.close();
  const auto refused = start();
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("dripline.sqlite"), std::string::npos) << refused.output;
}

/// Every chunk is sound, and one is another program's.
TEST_F(Database, WithAnotherProgramsChunkStartsNothing) {
  system.start_server();
  std::string big = "O0300\n", other = "O0400\n";
  for (int i = 0; i < 70'000; ++i) {
    big += fmt::format("G1 X{}. F100\n", i % 97);
    other += fmt::format("G1 X{}. F100\n", i % 89);
  }
  big += "M30\n";
  other += "M30\n";
  ASSERT_GT(big.size(), 3u * 262'144u);
  system.push("O0300", big);
  system.push("O0400", other);
  stop_server();
  change(
      "UPDATE content_chunk SET chunk = (SELECT chunk FROM content_chunk WHERE position = 2 AND "
      "content = (SELECT max(id) FROM content)) WHERE position = 2 AND content = (SELECT max(id) "
      "FROM content) - 1");
  system.start_server();
  system.start_gateway();
  system.wait_connected();
  const auto reply =
      system.rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0300"}});
  EXPECT_NE(reply.status, 201) << reply.body;
  EXPECT_NE(reply.body.find("chunk 2 (bytes from 524288)"), std::string::npos) << reply.body;
  EXPECT_TRUE(system.rest().get("/api/v1/runs").json()["runs"].empty());
}

/// Every content is sound, and a revision's row names another one's.
TEST_F(Database, WhoseRevisionNamesAnotherProgramsContentRunsNothingOfIt) {
  system.start_server();
  system.push("O0300", "O0300\nG0 X1\nM30\n");
  system.push("O0400", "O0400\nG0 X999\nM30\n");
  system.push("O0500", "O0500\nM98 P300\nM30\n");
  stop_server();
  change(
      "UPDATE revision SET content = (SELECT max(id) - 1 FROM content) WHERE content = (SELECT "
      "max(id) - 2 FROM content)");
  system.start_server();
  system.start_gateway();
  system.wait_connected();
  const auto reply =
      system.rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0300"}});
  EXPECT_NE(reply.status, 201) << reply.body;
  EXPECT_NE(reply.body.find("O0300 revision 1: its row names content"), std::string::npos)
      << reply.body;
  EXPECT_TRUE(system.rest().get("/api/v1/runs").json()["runs"].empty());
  // One that calls it gets what was stored as that revision.
  const auto run = system.wait_ended(system.start_run("O0500"));
  EXPECT_EQ(run.value("state", ""), "completed") << run;
  EXPECT_EQ(run.value("executed", 0u), 6u) << run;
  EXPECT_TRUE(run.value("content_verified", false)) << run;
  system.push("O0300", "O0300\nG0 X1\nM30\n");
  EXPECT_EQ(system.wait_ended(system.start_run("O0300")).value("state", ""), "completed");
}

TEST(OpenFiles, TooFewAreRefusedWithAMessage) {
  const test_support::TemporaryFolder folder;
  const auto limited = [&](const std::string& command) {
    return run_to_end({"/bin/sh", "-c", "ulimit -n 24; exec " + command}, folder.path() / "out");
  };
  for (const std::string& command :
       {program_path("dncd") + " --http 127.0.0.1:0 --state " + (folder.path() / "s").string(),
        program_path("dncgw") + " --machine m --control centurion --state " +
            (folder.path() / "g").string()}) {
    const auto refused = limited(command);
    EXPECT_EQ(refused.status, 1) << refused.output;
    EXPECT_NE(refused.output.find("may open 24 files, it needs at least"), std::string::npos)
        << refused.output;
  }
}

/// The gateway comes to what it needs next, a folder for its state.
TEST(EmptySetupFile, IsOneOfDefaults) {
  const test_support::TemporaryFolder folder;
  const auto setup = folder.path() / "empty.toml", state = folder.path() / "no_folder";
  std::ofstream(setup).close();
  std::ofstream(state) << "a file";
  const auto refused = run_to_end({program_path("dncgw"), "--machine", "m", "--control", "fanuc",
                                   "--setup", setup, "--state", state},
                                  folder.path() / "out");
  EXPECT_EQ(refused.status, 1) << refused.output;
  EXPECT_EQ(refused.output.find("cannot read"), std::string::npos) << refused.output;
  EXPECT_NE(refused.output.find("no_folder"), std::string::npos) << refused.output;
}

TEST(OpenNetwork, NeedsToBeConfirmed) {
  const test_support::TemporaryFolder folder;
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{program_path("dncd"), "--http", "127.0.0.1:0", "--state",
                                 folder.path() / "s"},
        std::vector<std::string>{program_path("dncgw"), "--machine", "m", "--control", "centurion",
                                 "--state", folder.path() / "g"}}) {
    std::vector<std::string> open = command;
    open.insert(open.end(), {"--dds-interface", "eth0"});
    const auto refused = run_to_end(open, folder.path() / "out");
    EXPECT_EQ(refused.status, 2) << refused.output;
    EXPECT_NE(refused.output.find("dds-open-network"), std::string::npos) << refused.output;
  }
}

/// What systemd learns of a unit of Type=notify with a watchdog of one second.
TEST(ServiceUnit, IsReadyStaysAliveAndAnnouncesItsEnd) {
  const auto in_unit = [](const test_support::ServiceSocket& manager, const auto& start) {
    ::setenv("NOTIFY_SOCKET", manager.path().c_str(), 1);  // NOLINT(concurrency-mt-unsafe): alone
    ::setenv("WATCHDOG_USEC", "1000000", 1);               // NOLINT(concurrency-mt-unsafe): alone
    start();
    ::unsetenv("NOTIFY_SOCKET");  // NOLINT(concurrency-mt-unsafe): alone
    ::unsetenv("WATCHDOG_USEC");  // NOLINT(concurrency-mt-unsafe): alone
  };
  const auto expect_next = [](test_support::ServiceSocket& manager, const std::string& begin) {
    const auto message = manager.receive();
    ASSERT_TRUE(message) << begin;
    EXPECT_EQ(message->substr(0, begin.size()), begin);
  };
  test_support::ServiceSocket server_manager, gateway_manager;
  System system;
  in_unit(server_manager, [&] { system.start_server(); });
  in_unit(gateway_manager, [&] { system.start_gateway(); });
  expect_next(server_manager,
              "READY=1\nSTATUS=" + system.url() + ": 0 of 0 machines connected, ok");
  expect_next(gateway_manager, "READY=1\nSTATUS=lathe-1 READY");
  system.wait_connected();
  for (int i = 0; i < 2; ++i) {
    expect_next(server_manager, "WATCHDOG=1\nSTATUS=" + system.url());
    expect_next(gateway_manager, "WATCHDOG=1\nSTATUS=lathe-1 READY");
  }
  system.gateway().signal(SIGHUP);  // `systemctl reload`: a service has no terminal to lose
  system.server().signal(SIGHUP);
  expect_next(gateway_manager, "WATCHDOG=1");
  expect_next(server_manager, "WATCHDOG=1");
  for (auto [child, manager] : {std::pair{&system.gateway(), &gateway_manager},
                                std::pair{&system.server(), &server_manager}}) {
    child->signal(SIGTERM);
    EXPECT_EQ(child->wait(), 0);
    std::optional<std::string> last;
    while (auto message = manager->receive(std::chrono::milliseconds(0))) last = message;
    EXPECT_EQ(last, "STOPPING=1");
  }
}

}  // namespace
}  // namespace dripline::integration
