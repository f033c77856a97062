// A shop moves from its SQLite file to PostgreSQL and back: everything is there, and it continues,
// whenever the moving is killed.
#include <gtest/gtest.h>
#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "storage/postgresql/database.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/postgresql/test_database.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr std::uint64_t kLines = 300;

std::string report_program() {
  std::string text;
  test_support::write_report_program(kLines, 3, [&](std::string_view piece) { text += piece; });
  return text;
}

class Migration : public testing::Test {
 protected:
  void SetUp() override {
    database_ = test::TestDatabase::make_empty();
    if (database_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
    start_on("");
    system_->push("O0300", report_program());
    run_ = run_whole();
    stop();
  }
  /// The same folder every time; an empty URL: its SQLite file.
  void start_on(const std::string& url) {
    if (!system_) system_.emplace(System::Options{});
    system_->use_server_arguments(url.empty() ? std::vector<std::string>{}
                                              : std::vector<std::string>{"--store", url});
    system_->start_server();
    system_->start_gateway();
    system_->wait_connected();
  }
  void stop() {
    system_->server().signal(SIGTERM);
    ASSERT_TRUE(system_->server().wait());
  }
  std::string run_whole() {
    const std::string id = system_->start_run("O0300");
    EXPECT_EQ(system_->wait_ended(id).value("state", ""), "completed");
    EXPECT_EQ(system_->report_lines(id).size(), kLines);
    return id;
  }
  std::vector<std::string> command(const std::vector<std::string>& words) const {
    std::vector<std::string> all{program_path("dnc"), "--state", system_->server_state(), "server",
                                 "migrate"};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }
  test_support::Finished migrate(const std::vector<std::string>& words) {
    return test_support::run_to_end(command(words), system_->folder() / "migrate.out");
  }
  void expect_audit_verified() {
    const auto verified = test_support::run_to_end(
        {program_path("dnc"), "--state", system_->server_state(), "audit", "verify"},
        system_->folder() / "audit.out");
    EXPECT_EQ(verified.status, 0) << verified.output;
  }
  /// The shop as it was, and as it continues.
  void expect_shop() {
    EXPECT_EQ(system_->run(run_).value("state", ""), "completed");
    EXPECT_EQ(system_->report_lines(run_).size(), kLines);
    expect_audit_verified();
    run_whole();
    EXPECT_EQ(system_->push("O0300", fmt::format("{}({})\n", report_program(), next_))
                  .value("revision", 0),
              next_);
    ++next_;
    expect_audit_verified();
  }
  std::filesystem::path file() const { return system_->server_state() / "dripline.sqlite"; }

  std::unique_ptr<test::TestDatabase> database_;
  std::optional<System> system_;
  std::string run_;
  int next_ = 2;  ///< revision of the program
};

TEST_F(Migration, TheShopContinuesInPostgresqlAndBackInItsFile) {
  const auto there = migrate({"--to", database_->url(), "--json"});
  ASSERT_EQ(there.status, 0) << there.output;
  const json report = json::parse(there.output.substr(there.output.find('{')));
  EXPECT_GE(report.value("rows", 0), static_cast<int>(kLines)) << report;
  EXPECT_FALSE(report.value("resumed", true));

  auto refused = test_support::run_to_end(
      {program_path("dncd"), "--state", system_->server_state()}, system_->folder() / "old.out");
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find("was migrated to a PostgreSQL database"), std::string::npos)
      << refused.output;

  start_on(database_->url());
  auto database = storage::postgresql::Database::connect({.url = database_->url()});
  const auto runs = database->integer("SELECT max(number) FROM run");
  expect_shop();
  EXPECT_EQ(database->integer("SELECT max(number) FROM run"), *runs + 1) << "numbers continue";
  const auto busy = migrate({"--from", database_->url(), "--to", system_->server_state()});
  EXPECT_EQ(busy.status, 1) << "the server uses it: " << busy.output;
  stop();

  const auto back = migrate({"--from", database_->url(), "--to", system_->server_state()});
  ASSERT_EQ(back.status, 0) << back.output;
  EXPECT_NE(back.output.find("read back and compared"), std::string::npos) << back.output;
  start_on("");
  expect_shop();
}

/// Servers of a PostgreSQL database have terms, and the gateway has seen one.
TEST_F(Migration, AGatewayGoesBackToTheFileWithoutARestart) {
  ASSERT_EQ(migrate({"--to", database_->url()}).status, 0);
  start_on(database_->url());
  stop();
  const auto back = migrate({"--from", database_->url(), "--to", system_->server_state()});
  ASSERT_EQ(back.status, 0) << back.output;
  system_->use_server_arguments({});
  system_->start_server();
  system_->wait_connected();
  run_whole();
}

TEST_F(Migration, KilledAtAnyMomentItContinues) {
  {
    auto kept = storage::sqlite::Database::open(file());
    const auto many = kept->execute(
        "WITH RECURSIVE n (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 150000) INSERT "
        "INTO record SELECT id, 1, i, i, NULL, 'message', 1, 1, -1, '', 'X' || i, NULL FROM "
        "machine, "
        "n");
    ASSERT_TRUE(many) << many.error().what;
  }
  int kills = 0;
  for (;; ++kills) {
    ASSERT_LT(kills, 200);
    test_support::ChildProcess child(command({"--to", database_->url()}),
                                     system_->folder() / "migrate.out");
    const auto status = child.wait(milliseconds(60 + 40 * kills));
    if (!status) {
      child.kill();
      continue;
    }
    ASSERT_EQ(*status, 0) << child.output();
    break;
  }
  EXPECT_GE(kills, 5);
  start_on(database_->url());
  auto database = storage::postgresql::Database::connect({.url = database_->url()});
  EXPECT_EQ(database->integer("SELECT count(*) FROM record WHERE epoch = 1"), 150000);
  expect_shop();
}

TEST_F(Migration, AServerThatRunsKeepsItsDatabase) {
  start_on("");
  const auto refused = migrate({"--to", database_->url()});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.output.find(file().string()), std::string::npos) << refused.output;
  expect_shop();
}

TEST_F(Migration, OnlyTheFoldersOwnDatabaseIsTaken) {
  const auto elsewhere = migrate({"--from", database_->url(), "--to", system_->folder()});
  EXPECT_EQ(elsewhere.status, 1);
  EXPECT_NE(elsewhere.output.find("the key that the audit trail is signed with"), std::string::npos)
      << elsewhere.output;
  const auto both = migrate({"--from", database_->url(), "--to", database_->url()});
  EXPECT_EQ(both.status, 1);
  EXPECT_NE(both.output.find("pg_dump"), std::string::npos) << both.output;
  EXPECT_TRUE(std::filesystem::exists(file()));
}

}  // namespace
}  // namespace dripline::integration
