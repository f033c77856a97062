#include "storage/sqlite/database.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "storage/sqlite/transaction.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage::sqlite {
namespace {

constexpr const char* kInsert = "INSERT INTO item (id, name, payload) VALUES (?1, ?2, ?3)";

class DatabaseTest : public testing::Test {
 protected:
  Database open(const OpenOptions& options = {}) {
    auto database = Database::open(file_, options);
    EXPECT_TRUE(database) << database.error().what;
    return std::move(*database);
  }
  Database with_table(const OpenOptions& options = {}) {
    Database database = open(options);
    const auto done = database.execute(
        "CREATE TABLE item (id INTEGER PRIMARY KEY, name TEXT, payload BLOB) STRICT");
    EXPECT_TRUE(done) << done.error().what;
    return database;
  }
  static std::int64_t count(Database& database) {
    return database.integer("SELECT count(*) FROM item").value();
  }

  TemporaryDirectory directory_;
  std::filesystem::path file_ = directory_ / "test.sqlite";
};

TEST_F(DatabaseTest, ReturnsWhatWasBoundAndSeparatesNullFromEmpty) {
  Database database = with_table();
  const std::vector<std::byte> bytes{std::byte{0}, std::byte{255}};
  auto insert = database.prepare(kInsert);
  ASSERT_TRUE(insert->bind(1, std::string("a\0b", 3), std::span(bytes)).run());
  ASSERT_TRUE(insert->bind(2, "", std::span<const std::byte>()).run());
  ASSERT_TRUE(insert->bind(3, std::nullopt, std::optional<std::string>()).run());

  auto select = database.prepare("SELECT id, name, payload FROM item ORDER BY id");
  ASSERT_TRUE(select->step().value());
  EXPECT_EQ(select->text(1), std::string("a\0b", 3));
  EXPECT_TRUE(std::ranges::equal(select->blob(2), bytes));
  ASSERT_TRUE(select->step().value());
  EXPECT_EQ(select->optional_text(1), "");
  EXPECT_FALSE(select->is_null(2));
  ASSERT_TRUE(select->step().value());
  EXPECT_EQ(select->optional_text(1), std::nullopt);
  EXPECT_TRUE(select->is_null(2));
  EXPECT_FALSE(select->step().value());
}

TEST_F(DatabaseTest, KeepsAll64BitsOfUnsignedNumbers) {
  Database database = with_table();
  constexpr auto kMax = std::numeric_limits<std::uint64_t>::max();
  ASSERT_TRUE(database.prepare(kInsert)->bind(kMax, "x", std::nullopt).run());
  auto select = database.prepare("SELECT id FROM item");
  ASSERT_TRUE(select->step().value());
  EXPECT_EQ(select->number(0), kMax);
}

TEST_F(DatabaseTest, RollsBackUnlessCommitted) {
  Database database = with_table();
  {
    auto transaction = Transaction::begin(database);
    ASSERT_TRUE(database.prepare(kInsert)->bind(1, "lost", std::nullopt).run());
  }
  EXPECT_EQ(count(database), 0);
  auto transaction = Transaction::begin(database);
  ASSERT_TRUE(database.prepare(kInsert)->bind(1, "kept", std::nullopt).run());
  ASSERT_TRUE(transaction->commit());
  EXPECT_EQ(count(database), 1);
}

TEST_F(DatabaseTest, SecondWriterIsBusyUntilTheFirstHasFinished) {
  Database first = with_table();
  Database second = open({.busy_timeout = std::chrono::milliseconds{1}});
  auto held = Transaction::begin(first);
  ASSERT_TRUE(held);
  const auto refused = Transaction::begin(second);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy) << refused.error().what;
  ASSERT_TRUE(held->commit());
  EXPECT_TRUE(Transaction::begin(second));
}

TEST_F(DatabaseTest, SnapshotDoesNotSeeLaterCommits) {
  Database writer = with_table();
  Database reader = open({.access = Access::ReadOnly});
  {
    auto snapshot = Snapshot::begin(reader);
    ASSERT_TRUE(snapshot);
    EXPECT_EQ(count(reader), 0);
    ASSERT_TRUE(writer.prepare(kInsert)->bind(1, "x", std::nullopt).run());
    EXPECT_EQ(count(reader), 0);
  }
  EXPECT_EQ(count(reader), 1);
}

TEST_F(DatabaseTest, FullDiskIsAnIoErrorThatNamesItAndChangesNothing) {
  Database database = with_table({.max_bytes = 64 << 10});
  const std::vector<std::byte> big(256 << 10, std::byte{7});
  auto transaction = Transaction::begin(database);
  ASSERT_TRUE(database.prepare(kInsert)->bind(1, "small", std::nullopt).run());
  const auto full = database.prepare(kInsert)->bind(2, "big", std::span(big)).run();
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().code, Errc::Io);
  EXPECT_NE(full.error().what.find("disk full"), std::string::npos) << full.error().what;
  { const auto undone = std::move(*transaction); }
  EXPECT_EQ(count(database), 0);
  EXPECT_TRUE(database.prepare(kInsert)->bind(1, "small", std::nullopt).run());
}

TEST_F(DatabaseTest, ErrorsNameCodeAndSql) {
  Database database = with_table();
  const auto wrong = database.execute("SELECT nothing FROM nowhere");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().what.find("nowhere"), std::string::npos);
  ASSERT_TRUE(database.prepare(kInsert)->bind(1, "x", std::nullopt).run());
  const auto twice = database.prepare(kInsert)->bind(1, "x", std::nullopt).run();
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().code, Errc::Conflict);
  EXPECT_NE(twice.error().what.find("1555"), std::string::npos) << twice.error().what;
}

TEST_F(DatabaseTest, RefusesAFileThatIsNoDatabase) {
  FILE* junk = std::fopen(file_.c_str(), "w");
  for (int i = 0; i < 1000; ++i) std::fputs("G01 X1. Z2.\n", junk);
  std::fclose(junk);
  const auto opened = Database::open(file_);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::Corrupt) << opened.error().what;
}

TEST_F(DatabaseTest, StatementsOfTheSameTextCanBeUsedAtTheSameTime) {
  Database database = with_table();
  auto outer = database.prepare("SELECT 1 UNION SELECT 2");
  auto inner = database.prepare("SELECT 1 UNION SELECT 2");
  ASSERT_TRUE(outer->step().value());
  ASSERT_TRUE(inner->step().value());
  ASSERT_TRUE(outer->step().value());
  EXPECT_EQ(outer->integer(0), 2);
  EXPECT_EQ(inner->integer(0), 1);
}

constexpr Migration kSteps[] = {{1, "0001", "CREATE TABLE a (x INTEGER) STRICT"},
                                {2, "0002", "CREATE TABLE b (x INTEGER) STRICT"}};
constexpr Migration kBroken[] = {
    kSteps[0], {2, "0002", "CREATE TABLE b (x INTEGER) STRICT; CREATE TABLE a (x)"}};

TEST_F(DatabaseTest, MigratesStepByStepAndOnlyOnce) {
  Database database = open();
  ASSERT_TRUE(migrate(database, std::span(kSteps).first(1)));
  EXPECT_EQ(database.integer("PRAGMA user_version"), 1);
  ASSERT_TRUE(migrate(database, kSteps));
  ASSERT_TRUE(migrate(database, kSteps));
  EXPECT_EQ(database.integer("PRAGMA user_version"), 2);
}

TEST_F(DatabaseTest, FailedMigrationLeavesTheVersionBeforeIt) {
  Database database = open();
  const auto failed = migrate(database, kBroken);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().what.find("0002"), std::string::npos) << failed.error().what;
  EXPECT_EQ(database.integer("PRAGMA user_version"), 1);
  EXPECT_EQ(database.integer("SELECT count(*) FROM sqlite_schema"), 1);
}

TEST_F(DatabaseTest, RefusesANewerSchemaAndForeignTables) {
  {
    Database database = open();
    ASSERT_TRUE(migrate(database, kSteps));
    const auto older_program = migrate(database, std::span(kSteps).first(1));
    ASSERT_FALSE(older_program);
    EXPECT_EQ(older_program.error().code, Errc::Unsupported);
    EXPECT_NE(older_program.error().what.find("version 2"), std::string::npos);
  }
  file_ = directory_ / "foreign.sqlite";
  Database foreign = with_table();
  EXPECT_EQ(migrate(foreign, kSteps).error().code, Errc::Unsupported);
}

}  // namespace
}  // namespace dripline::storage::sqlite
