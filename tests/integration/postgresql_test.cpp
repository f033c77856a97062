// A server that keeps everything in PostgreSQL: machines are fed and nothing is lost or doubled,
// whatever is killed or cut off.
#include <gtest/gtest.h>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>

#include "storage/postgresql/database.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/postgresql/test_database.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kLines = 2000;

std::string report_program() {
  std::string text;
  test_support::write_report_program(kLines, 3, [&](std::string_view piece) { text += piece; });
  return text;
}

class Postgresql : public testing::Test {
 protected:
  void SetUp() override {
    database_ = test::TestDatabase::make_empty();
    if (database_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
    system_.emplace(System::Options{.speed = "max",
                                    .server_arguments = {"--store", database_->url()},
                                    .gateway_arguments = {}});
  }
  void begin() {
    system_->start_server();
    system_->start_gateway();
    system_->wait_connected();
    system_->push("O0300", report_program());
  }
  /// Every line once, in its order.
  void expect_whole(const std::string& id) {
    EXPECT_EQ(system_->wait_ended(id).value("state", ""), "completed");
    const auto lines = system_->report_lines(id);
    ASSERT_EQ(lines.size(), kLines);
    for (std::size_t i = 0; i < lines.size(); ++i)
      ASSERT_EQ(lines[i], fmt::format("LINE {:05}", i + 1));
  }
  std::string log_text() const {
    std::stringstream text;
    text << std::ifstream(system_->folder() / "dncd.log").rdbuf();
    return text.str();
  }
  /// As a database that is restarted, or fails over: whatever is in progress is undone.
  void cut_off() {
    auto other = storage::postgresql::Database::connect({.url = database_->url()});
    ASSERT_TRUE(other) << other.error().what;
    EXPECT_TRUE(
        other->execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = "
                       "current_database() AND pid <> pg_backend_pid()"));
  }

  std::unique_ptr<test::TestDatabase> database_;
  std::optional<System> system_;
};

TEST_F(Postgresql, AMachineIsFedAndReportsEveryLineOnce) {
  begin();
  expect_whole(system_->start_run("O0300"));
  EXPECT_FALSE(std::filesystem::exists(system_->server_state() / "dripline.sqlite"));
  const auto health = system_->rest().get("/api/v1/health");
  EXPECT_EQ(health.status, 200) << health.body;
}

TEST_F(Postgresql, AKilledServerHasItsDatabaseAgainSoon) {
  begin();
  std::string id = system_->start_run("O0300");
  for (int i = 0; i < 10 && !HasFailure(); ++i) {
    std::this_thread::sleep_for(milliseconds(20 * i));  // the moment is the test's subject
    system_->server().kill();
    const auto begun = std::chrono::steady_clock::now();
    system_->start_server();
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(8))
        << "without waiting until the place of the killed one has ended";
    if (system_->run(id).value("state", "") == "active") continue;
    expect_whole(id);
    system_->wait_connected();
    id = system_->start_run("O0300");
  }
  expect_whole(id);
}

TEST_F(Postgresql, ADatabaseThatIsCutOffAgainAndAgainLosesNoLine) {
  begin();
  const std::string id = system_->start_run("O0300");
  for (int i = 0; i < 20; ++i) {
    cut_off();
    std::this_thread::sleep_for(milliseconds(50));
  }
  expect_whole(id);
}

TEST_F(Postgresql, ASecondServerIsRefusedWhileTheFirstWorks) {
  begin();
  System second(System::Options{
      .speed = "max", .server_arguments = {"--store", database_->url()}, .gateway_arguments = {}});
  second.launch_server();
  EXPECT_TRUE(test_support::eventually([&] { return !second.server().is_running(); }));
  EXPECT_NE(second.server().output().find("is used by another server (dncd "), std::string::npos)
      << second.server().output();
  expect_whole(system_->start_run("O0300"));
}

/// As a server that was frozen, or cut off, for longer than its place lasts.
TEST_F(Postgresql, AServerThatLostItsPlaceEndsAndSaysWhy) {
  begin();
  auto other = storage::postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(other->execute(
      "UPDATE store_holder SET holder = 'srv-2', until = now() + interval '1 hour'"));
  const auto status = system_->server().wait();
  ASSERT_TRUE(status) << "it ends: " << system_->server().output();
  EXPECT_EQ(*status, 1);
  EXPECT_NE(system_->server().output().find("was taken over by another server"), std::string::npos)
      << system_->server().output();
  ASSERT_TRUE(other->execute("UPDATE store_holder SET until = now()"));
  system_->start_server();  // as a service manager does
  system_->wait_connected();
  expect_whole(system_->start_run("O0300"));
}

/// Whatever fails after the place was taken: here the ports of DDS are another one's.
TEST_F(Postgresql, AServerThatDoesNotStartKeepsNobodyOut) {
  begin();
  const auto second = test::TestDatabase::make_empty();
  const auto failed =
      test_support::run_to_end({program_path("dncd"), "--state", system_->folder() / "other",
                                "--store", second->url(), "--http", "127.0.0.1:0", "--dds-domain",
                                std::to_string(system_->domain()), "--dds-tag", "other"},
                               system_->folder() / "other.out");
  EXPECT_EQ(failed.status, 1) << failed.output;
  EXPECT_NE(failed.output.find("in use"), std::string::npos) << failed.output;
  auto database = storage::postgresql::Database::connect({.url = second->url()});
  EXPECT_EQ(database->integer("SELECT count(*) FROM store_holder WHERE holder = ''"), 1);
}

TEST_F(Postgresql, APasswordInTheUrlIsWarnedOfAndNeverLogged) {
  std::string url = database_->url();
  url.insert(url.find('@'), ":wonderland");
  system_.emplace(System::Options{
      .speed = "max", .server_arguments = {"--store", url}, .gateway_arguments = {}});
  system_->start_server();
  const std::string output = system_->server().output() + log_text();
  EXPECT_NE(output.find("the URL has a password in it"), std::string::npos) << output;
  EXPECT_NE(output.find("PGPASSFILE"), std::string::npos) << output;
  EXPECT_EQ(output.find("wonderland"), std::string::npos) << output;
}

// Its audit trail is signed with the key of the folder that wrote it.
TEST_F(Postgresql, AFolderThatIsNewTakesNoDatabaseOfAnother) {
  begin();
  expect_whole(system_->start_run("O0300"));
  system_->server().signal(SIGTERM);
  ASSERT_TRUE(test_support::eventually([&] { return !system_->server().is_running(); }));
  System other(System::Options{
      .speed = "max", .server_arguments = {"--store", database_->url()}, .gateway_arguments = {}});
  other.launch_server();
  EXPECT_TRUE(test_support::eventually([&] { return !other.server().is_running(); }));
  EXPECT_NE(other.server().output().find("this state folder has never had it"), std::string::npos)
      << other.server().output();
  begin();
  expect_whole(system_->start_run("O0300"));
}

TEST_F(Postgresql, AFolderKeepsToItsDatabase) {
  begin();
  system_->server().signal(SIGTERM);
  EXPECT_TRUE(test_support::eventually([&] { return !system_->server().is_running(); }));
  auto database = storage::postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(database->execute("UPDATE identity SET id = repeat('0', 32)"));  // as of another one
  system_->launch_server();
  EXPECT_TRUE(test_support::eventually([&] { return !system_->server().is_running(); }));
  EXPECT_NE(system_->server().output().find("is not the database this folder has had"),
            std::string::npos)
      << system_->server().output();
}

}  // namespace
}  // namespace dripline::integration
