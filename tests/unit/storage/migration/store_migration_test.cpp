// A kept file with a bit of everything (tests/golden/storage) goes into PostgreSQL and comes back.
#include "storage/migration/store_migration.hpp"

#include <fstream>
#include <map>
#include <sstream>

#include "storage/migration/files.hpp"
#include "storage/postgresql/database.hpp"
#include "storage/sql/query.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::migration {
namespace {

using storage::PostgresqlStore;
using storage::SqliteStore;

std::string file_text(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

constexpr const char* kTables = "SELECT count(*) FROM pg_tables WHERE schemaname = 'public'";

class StoreMigration : public testing::Test {
 protected:
  void SetUp() override {
    database_ = test::TestDatabase::make_empty();
    if (database_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
    auto kept = storage::sqlite::Database::open(file_);
    ASSERT_TRUE(kept) << kept.error().what;
    ASSERT_TRUE(kept->execute(file_text("tests/golden/storage/v19.sql")));
    // What the engines keep differently: bytes that are no UTF-8, also in a key, a zero with
    // a sign, a number whose row is gone.
    const auto more = kept->execute(
        "INSERT INTO port VALUES (CAST(x'ff41' AS TEXT), 'm9', '/dev/ttyS9', '', '', 1), "
        "('\uF7F6', "
        "'m8', '/dev/ttyS8', '', '', 0), ('zz', 'm7', '/dev/ttyS7', '', CAST(x'410042' AS TEXT), "
        "0);"
        "UPDATE measurement SET actual = -0.0; UPDATE sqlite_sequence SET seq = 77 WHERE name = "
        "'event'; DELETE FROM event; INSERT INTO chunk (sha256, size, data) VALUES "
        "(randomblob(32), "
        "1, x'');");
    ASSERT_TRUE(more) << more.error().what;
    // Beyond one part of what is read and written at once.
    const auto many = kept->execute(
        "WITH RECURSIVE n (i) AS (SELECT 100 UNION ALL SELECT i + 1 FROM n WHERE i < 12345) INSERT "
        "INTO record SELECT id, 7, i, i, 'r1', 'output', 1, 1, -1, 'port1', 'X' || i, NULL FROM "
        "machine, n");
    ASSERT_TRUE(many) << many.error().what;
  }
  Request request(Request::Direction direction) const {
    return {.direction = direction,
            .file = file_,
            .postgresql = {.url = database_->url(),
                           .holder = "srv-1",
                           .described = "migration",
                           .wait_for_holder = std::chrono::milliseconds(0)}};
  }
  Result<Report> enter() { return migrate(request(Request::Direction::ToPostgresql)); }
  Result<Report> come_back() { return migrate(request(Request::Direction::ToSqlite)); }
  /// Ended when `proceed` was asked for the n-th time; nothing: it was whole before.
  Result<Report> stopped_at(Request::Direction direction, int n) {
    Request ended = request(direction);
    ended.proceed = [&n](const Progress&) { return n-- > 0; };
    return migrate(ended);
  }
  std::int64_t in_postgresql(const std::string& sql) {
    auto database = storage::postgresql::Database::connect({.url = database_->url()});
    return database->integer(sql).value_or(-1);
  }
  std::int64_t in_file(const std::string& sql) {
    auto database = storage::sqlite::Database::open(file_);
    return database->integer(sql).value_or(-1);
  }
  void change_file(const std::string& sql) {
    auto database = storage::sqlite::Database::open(file_);
    const auto done = database->execute(sql);
    ASSERT_TRUE(done) << done.error().what;
  }
  Result<std::unique_ptr<PostgresqlStore>> serve() {
    return PostgresqlStore::open({.url = database_->url(),
                                  .holder = "srv-1",
                                  .wait_for_holder = std::chrono::milliseconds(0)},
                                 clock_);
  }

  storage::TemporaryDirectory folder_;
  const std::filesystem::path file_ = folder_ / "dripline.sqlite";
  std::unique_ptr<test::TestDatabase> database_;
  storage::ManualClock clock_;
};

std::map<std::string, std::uint64_t> rows_by_table(const Report& report) {
  std::map<std::string, std::uint64_t> rows;
  for (const auto& table : report.tables) rows[table.name] = table.digest.rows;
  return rows;
}

TEST_F(StoreMigration, TakesEveryTableAndTheShopContinues) {
  ASSERT_TRUE(SqliteStore::open({.file = file_}, clock_)) << "the tables of today";
  change_file(
      "INSERT INTO port_transfer VALUES ('zz', 'send', 't-1', 'O1', 9, 3, 6, 'interrupted', "
      "'killed', 1, 2, 'r1')");
  const auto report = enter();
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_FALSE(report->was_resumed);
  auto rows = rows_by_table(*report);
  EXPECT_EQ(rows["record"], 12249u);
  EXPECT_EQ(rows["port"], 4u);
  for (const auto& [table, count] : rows) {
    if (table == "event" || table == "revision_pin") continue;  // none are in the kept file
    EXPECT_GT(count, 0u) << table;
  }
  auto store = serve();
  ASSERT_TRUE(store) << store.error().what;
  EXPECT_EQ((*store)->identity(), report->identity);
  const auto run = (*store)->runs.find("r1");
  ASSERT_TRUE(run) << run.error().what;
  const auto text = (*store)->programs.read_content(run->content, 0, 1000);
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(storage::text_of(*text), "G00 X1.\nM30\n");
  // An upload that was half done, triggers, and numbers that were used.
  ASSERT_TRUE((*store)->uploads.append("u1", 5, storage::bytes_of("9.\n")));
  const auto revision = (*store)->uploads.commit("u1", sha256("G01 X9.\n"));
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_GT(in_postgresql("SELECT max(id) FROM event"), 77) << "numbers of events continue";
  EXPECT_GT(in_postgresql("SELECT count(*) FROM search_due"), 0) << "the index is made again";
}

TEST_F(StoreMigration, LeavesTheSourceToNoServer) {
  ASSERT_TRUE(enter());
  EXPECT_FALSE(std::filesystem::exists(file_));
  EXPECT_TRUE(std::filesystem::exists(left_file(file_)));
  const auto again = enter();
  ASSERT_TRUE(again) << again.error().what;
  EXPECT_TRUE(again->was_complete);
  ASSERT_TRUE(come_back());
  const auto refused = serve();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("was migrated to " + file_.string()), std::string::npos)
      << refused.error().what;
}

TEST_F(StoreMigration, ComesBackAsItWas) {
  const auto there = enter();
  ASSERT_TRUE(there) << there.error().what;
  const auto back = come_back();
  ASSERT_TRUE(back) << back.error().what;
  ASSERT_EQ(back->tables.size(), there->tables.size());
  for (std::size_t i = 0; i < back->tables.size(); ++i)
    EXPECT_EQ(back->tables[i].digest, there->tables[i].digest) << back->tables[i].name;
  EXPECT_EQ(in_file("SELECT seq FROM sqlite_sequence WHERE name = 'event'"), 77);
  const char* triggers = "SELECT count(*) FROM sqlite_schema WHERE type = 'trigger'";
  const auto has = in_file(triggers);
  EXPECT_GT(has, 10);
  EXPECT_EQ(in_file("SELECT count(*) FROM sqlite_schema WHERE name LIKE 'store_migration%'"), 0);
  auto store = SqliteStore::open({.file = file_}, clock_);
  ASSERT_TRUE(store) << store.error().what;
  EXPECT_EQ((*store)->check(), true);
  EXPECT_EQ((*store)->identity(), there->identity);
  auto fresh = SqliteStore::open({.file = folder_ / "fresh"}, clock_);
  EXPECT_EQ(storage::sqlite::Database::open(folder_ / "fresh")->integer(triggers), has);
}

TEST_F(StoreMigration, EndedAnywhereItContinues) {
  for (const auto direction : {Request::Direction::ToPostgresql, Request::Direction::ToSqlite}) {
    int ended = 0;
    for (;; ++ended) {
      ASSERT_LT(ended, 100);
      const auto report = stopped_at(direction, 5 * ended);
      if (report) {
        EXPECT_FALSE(report->was_begun_again);
        EXPECT_EQ(rows_by_table(*report)["record"], 12249u);
        break;
      }
      ASSERT_EQ(report.error().code, Errc::Timeout) << report.error().what;
      if (direction == Request::Direction::ToPostgresql) {
        EXPECT_FALSE(serve()) << "no server uses what is not complete";
      } else {
        EXPECT_FALSE(std::filesystem::exists(file_));
      }
    }
    EXPECT_GT(ended, 16) << "before and within tables";
  }
}

TEST_F(StoreMigration, EndedAtItsLastStepsNoServerUsesBoth) {
  for (const auto direction : {Request::Direction::ToPostgresql, Request::Direction::ToSqlite}) {
    for (const Step last : {Step::Leave, Step::Activate}) {
      Request ended = request(direction);
      ended.proceed = [last](const Progress& progress) { return progress.step != last; };
      ASSERT_EQ(migrate(ended).error().code, Errc::Timeout);
      const bool to_postgresql = direction == Request::Direction::ToPostgresql;
      const bool is_left = last == Step::Activate;
      EXPECT_EQ(serve().has_value(), !to_postgresql && !is_left) << "PostgreSQL";
      EXPECT_EQ(std::filesystem::exists(file_), to_postgresql && !is_left) << "SQLite";
    }
    const auto report = migrate(request(direction));
    ASSERT_TRUE(report) << report.error().what;
    EXPECT_EQ(rows_by_table(*report)["record"], 12249u);
  }
}

/// A kill between the last transaction and the last name.
TEST_F(StoreMigration, AFileThatOnlyLacksItsNameGetsIt) {
  ASSERT_TRUE(enter());
  ASSERT_TRUE(come_back());
  std::filesystem::rename(file_, entered_file(file_));
  const auto again = come_back();
  ASSERT_TRUE(again) << again.error().what;
  EXPECT_TRUE(again->was_complete);
  EXPECT_TRUE(SqliteStore::open({.file = file_}, clock_));
}

/// Who took the file back by hand has a shop in two places.
TEST_F(StoreMigration, ADatabaseThatMayHaveBeenUsedIsNotTakenForACopy) {
  ASSERT_TRUE(enter());
  std::filesystem::rename(left_file(file_), file_);
  const auto refused = enter();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("which a server may have used"), std::string::npos)
      << refused.error().what;
  EXPECT_TRUE(std::filesystem::exists(file_));
}

/// What was left is not copied again into another database: more was stored since, elsewhere.
TEST_F(StoreMigration, WhatWasLeftIsNotMigratedAnewElsewhere) {
  ASSERT_TRUE(enter());
  database_ = test::TestDatabase::make_empty();
  const auto refused = enter();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("was migrated before"), std::string::npos)
      << refused.error().what;
  EXPECT_EQ(in_postgresql(kTables), 0) << "it is as empty as it was";
}

/// Also for the migration back: no file is made for what was left for another one.
TEST_F(StoreMigration, WhatWasLeftForAnotherFileMakesNone) {
  ASSERT_TRUE(enter());
  ASSERT_TRUE(come_back());
  std::filesystem::remove(file_);
  const auto refused = come_back();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("was migrated before"), std::string::npos)
      << refused.error().what;
  EXPECT_FALSE(std::filesystem::exists(entered_file(file_)));
}

TEST_F(StoreMigration, NothingIsMadeInADatabaseThatHoldsNoStore) {
  std::filesystem::remove(file_);
  const auto refused = come_back();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::NotFound);
  EXPECT_NE(refused.error().what.find("holds no store"), std::string::npos) << refused.error().what;
  EXPECT_EQ(in_postgresql(kTables), 0);
  EXPECT_FALSE(std::filesystem::exists(entered_file(file_)));
}

TEST_F(StoreMigration, ASourceThatWasUsedMeanwhileIsCopiedAgain) {
  ASSERT_FALSE(stopped_at(Request::Direction::ToPostgresql, 60));
  change_file("UPDATE archive SET bytes = 4711 WHERE id = 1");
  const auto report = enter();
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_TRUE(report->was_resumed);
  EXPECT_TRUE(report->was_begun_again);
  EXPECT_EQ(in_postgresql("SELECT count(*) FROM archive WHERE bytes = 4711"), 1);
}

TEST_F(StoreMigration, RowsThatWereChangedInTheTargetAreFound) {
  Request request = this->request(Request::Direction::ToPostgresql);
  int changes = 0;
  request.proceed = [&](const Progress& progress) {
    if (progress.step == Step::Verify && progress.table == "program" && changes++ < 1) {
      auto database = storage::postgresql::Database::connect({.url = database_->url()});
      EXPECT_TRUE(database->execute("UPDATE program SET part = 'x'"));
    }
    return true;
  };
  const auto refused = migrate(request);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Corrupt);
  EXPECT_NE(refused.error().what.find("table program"), std::string::npos) << refused.error().what;
  EXPECT_TRUE(std::filesystem::exists(file_)) << "the source is as it was";
  EXPECT_FALSE(serve());
}

TEST_F(StoreMigration, ATargetThatHoldsSomethingIsRefused) {
  {
    const auto used = serve();
    ASSERT_TRUE(used) << used.error().what;
  }
  const auto refused = enter();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("has tables already"), std::string::npos)
      << refused.error().what;
  EXPECT_TRUE(serve()) << "and its place is free";
  EXPECT_TRUE(std::filesystem::exists(file_));
}

TEST_F(StoreMigration, ABegunMigrationOfAnotherDatabaseIsRefused) {
  ASSERT_FALSE(stopped_at(Request::Direction::ToPostgresql, 3));
  change_file("UPDATE identity SET id = 'fedcba9876543210fedcba9876543210'");
  const auto refused = enter();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("of another database"), std::string::npos)
      << refused.error().what;
}

TEST_F(StoreMigration, ASourceThatAServerUsesIsRefused) {
  const auto used = SqliteStore::open({.file = file_}, clock_);
  ASSERT_TRUE(used) << used.error().what;
  const auto refused = enter();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  EXPECT_EQ(in_postgresql(kTables), 0);
}

TEST_F(StoreMigration, ADatabaseThatAServerUsesIsNotLeft) {
  ASSERT_TRUE(enter());
  auto used = PostgresqlStore::open({.url = database_->url(), .holder = "srv-2"}, clock_);
  ASSERT_TRUE(used) << used.error().what;
  const auto refused = come_back();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(StoreMigration, NothingIsMadeOfAFileThatIsMissing) {
  std::filesystem::remove(file_);
  const auto refused = enter();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::NotFound);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace dripline::migration
