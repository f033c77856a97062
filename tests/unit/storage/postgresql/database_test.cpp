#include <gtest/gtest.h>
#include <limits>

#include "storage/postgresql/database.hpp"
#include "storage/postgresql/migration.hpp"
#include "storage/sql/query.hpp"
#include "tests/support/postgresql/test_cluster.hpp"
#include "tests/support/postgresql/test_database.hpp"

namespace dripline::storage::postgresql {
namespace {

class PostgresqlDatabase : public testing::Test {
 protected:
  void SetUp() override {
    made_ = test::TestDatabase::make_empty();
    if (made_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
    database_ = std::make_unique<Database>(connected());
  }
  Database connected() { return std::move(Database::connect({.url = made_->url()}).value()); }
  void make_table() {
    const auto made = database_->execute(
        "CREATE TABLE kept (number bigint PRIMARY KEY, word text, bytes bytea, part double "
        "precision)");
    ASSERT_TRUE(made) << made.error().what;
  }
  std::int64_t count() { return database_->integer("SELECT count(*) FROM kept").value_or(-1); }

  std::unique_ptr<test::TestDatabase> made_;
  std::unique_ptr<Database> database_;
};

TEST_F(PostgresqlDatabase, ValuesComeBackAsTheyWere) {
  make_table();
  const std::array bytes{std::byte{0}, std::byte{0xFF}};
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  const auto kept = sql::run(*database_, "INSERT INTO kept VALUES (?1, ?2, ?3, ?4)", kLeast,
                             std::string("\xFF'"), std::span<const std::byte>(bytes), -0.1);
  ASSERT_TRUE(kept) << kept.error().what;
  const auto read = sql::first_row(
      *database_, "SELECT number, word, bytes, part FROM kept", [&](const sql::Statement& row) {
        return row.integer(0) == kLeast && row.text(1) == "\xFF'" && row.real(3) == -0.1 &&
               std::ranges::equal(row.blob(2), bytes);
      });
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(*read, true);
}

TEST_F(PostgresqlDatabase, NullIsNothingOfAnyType) {
  make_table();
  std::optional<std::string> word;
  std::optional<double> part;
  const auto kept =
      sql::run(*database_, "INSERT INTO kept VALUES (1, ?1, ?2, ?3)", word, std::nullopt, part);
  ASSERT_TRUE(kept) << kept.error().what;
  const auto read = sql::first_row(
      *database_, "SELECT word, bytes, part FROM kept WHERE ?1 IS NULL AND word IS NULL",
      [](const sql::Statement& row) {
        return row.is_null(0) && row.is_null(1) && !row.optional_real(2);
      },
      word);
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(*read, true);
}

TEST_F(PostgresqlDatabase, SumsAndClaimsAreNumbers) {
  EXPECT_EQ(
      database_->integer("SELECT sum(n) FROM (VALUES (1234567890123456789::bigint), (1)) AS v (n)"),
      1234567890123456790);
  EXPECT_EQ(database_->integer("SELECT sum(n) FROM (VALUES (-20000::bigint), (-3)) AS v (n)"),
            -20003);
  EXPECT_EQ(database_->integer("SELECT 100000000::numeric"), 100000000);
  EXPECT_EQ(database_->integer("SELECT 0::numeric"), 0);
  EXPECT_EQ(database_->integer("SELECT 2 > 1"), 1);
  EXPECT_EQ(database_->integer("SELECT CAST(-3 AS integer)"), -3);
}

TEST_F(PostgresqlDatabase, NothingOfATransactionStaysUnlessItIsCommitted) {
  make_table();
  ASSERT_TRUE(database_->begin());
  ASSERT_TRUE(sql::run(*database_, "INSERT INTO kept (number) VALUES (?1)", 1));
  database_->roll_back();
  EXPECT_EQ(count(), 0);
  ASSERT_TRUE(database_->begin());
  ASSERT_TRUE(sql::run(*database_, "INSERT INTO kept (number) VALUES (?1)", 1));
  ASSERT_TRUE(database_->commit());
  EXPECT_EQ(count(), 1);
}

/// Far more than may be in progress at once.
TEST_F(PostgresqlDatabase, WhatIsPostedIsThereAfterTheCommit) {
  make_table();
  ASSERT_TRUE(database_->begin());
  {
    auto add = database_->prepare("INSERT INTO kept (number, word) VALUES (?1, ?2)");
    for (int n = 0; n < 5000; ++n) ASSERT_TRUE(add->bind(n, "a word").post());
  }
  ASSERT_TRUE(database_->commit());
  EXPECT_EQ(count(), 5000);
}

/// Rows are kept back to be sent together; what else is asked meanwhile comes after them.
TEST_F(PostgresqlDatabase, WhatIsPostedIsThereForWhateverIsAskedNext) {
  make_table();
  ASSERT_TRUE(database_->begin());
  auto add = database_->prepare("INSERT INTO kept (number, word) VALUES (?1, ?2)");
  auto other = database_->prepare("INSERT INTO kept (number, part) VALUES (?1, ?2)");
  for (int n = 0; n < 100; ++n) ASSERT_TRUE(add->bind(n, std::optional<std::string>()).post());
  EXPECT_EQ(count(), 100);
  for (int n = 100; n < 130; ++n) {
    ASSERT_TRUE(add->bind(n, "a word").post());
    ASSERT_TRUE(other->bind(n + 1000, 0.5).post());
  }
  ASSERT_TRUE(sql::run(*database_, "DELETE FROM kept WHERE number = ?1", 129));
  EXPECT_EQ(database_->changes(), 1u);
  ASSERT_TRUE(add->bind(129, 7).post()) << "of another kind";
  EXPECT_EQ(count(), 160);
  ASSERT_TRUE(database_->commit());
  EXPECT_EQ(database_->integer("SELECT count(*) FROM kept WHERE word = 'a word'"), 29);
}

TEST_F(PostgresqlDatabase, AnErrorOfWhatIsPostedKeepsAllFromTheDisk) {
  make_table();
  ASSERT_TRUE(database_->begin());
  {
    auto add = database_->prepare("INSERT INTO kept (number) VALUES (?1)");
    for (const int n : {1, 2, 1, 3}) ASSERT_TRUE(add->bind(n).post());
  }
  const auto refused = database_->commit();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_NE(refused.error().what.find("23505"), std::string::npos) << refused.error().what;
  EXPECT_EQ(refused.error().what.find("INSERT"), std::string::npos) << refused.error().what;
  database_->roll_back();
  EXPECT_EQ(count(), 0);
}

TEST_F(PostgresqlDatabase, AFailedStatementIsPreparedAgain) {
  const std::string sql = "SELECT count(*) FROM later WHERE number = ?1";
  const auto ask = [&] {
    return sql::first_row(
        *database_, sql, [](const sql::Statement& row) { return row.integer(0); }, 1);
  };
  EXPECT_FALSE(ask());
  ASSERT_TRUE(database_->execute("CREATE TABLE later (number bigint)"));
  const auto found = ask();
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_EQ(*found, 0);
}

TEST_F(PostgresqlDatabase, ASnapshotIsOnePicture) {
  make_table();
  Database other = connected();
  database_->begin_snapshot();
  EXPECT_EQ(count(), 0);
  ASSERT_TRUE(sql::run(other, "INSERT INTO kept (number) VALUES (1)"));
  EXPECT_EQ(count(), 0);
  database_->end_snapshot();
  EXPECT_EQ(count(), 1);
}

TEST_F(PostgresqlDatabase, ALostConnectionSaysSo) {
  Database other = connected();
  ASSERT_TRUE(database_->is_alive());
  ASSERT_TRUE(
      other.execute("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = "
                    "current_database() AND pid <> pg_backend_pid()"));
  const auto lost = database_->integer("SELECT 1");
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().code, Errc::Io);
  EXPECT_FALSE(database_->is_alive());
}

TEST_F(PostgresqlDatabase, TheSchemaIsMadeOnceAndForeignTablesAreRefused) {
  const auto made = migrate(*database_, schema());
  ASSERT_TRUE(made) << made.error().what;
  const auto identity = database_->text("SELECT id FROM identity");
  EXPECT_EQ(identity->size(), 32u);
  ASSERT_TRUE(migrate(*database_, schema()));
  EXPECT_EQ(database_->text("SELECT id FROM identity"), *identity);
  ASSERT_TRUE(database_->execute("UPDATE schema_version SET version = 1000"));
  EXPECT_EQ(migrate(*database_, schema()).error().code, Errc::Unsupported);
  ASSERT_TRUE(database_->execute("DROP TABLE schema_version"));
  const auto foreign = migrate(*database_, schema());
  EXPECT_EQ(foreign.error().code, Errc::Unsupported);
  EXPECT_NE(foreign.error().what.find("not ours"), std::string::npos) << foreign.error().what;
}

TEST_F(PostgresqlDatabase, AUserWithoutTheRightToMakeTablesIsToldSo) {
  const std::string user = database_->text("SELECT current_database()").value() + "_guest";
  ASSERT_TRUE(database_->execute("REVOKE CREATE ON SCHEMA public FROM PUBLIC; CREATE ROLE " + user +
                                 "; SET ROLE " + user));
  const auto refused = migrate(*database_, schema());
  const auto statement = database_->execute("CREATE TABLE of_a_guest (id bigint)");
  ASSERT_TRUE(database_->execute("RESET ROLE; DROP ROLE " + user));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Denied);
  EXPECT_NE(refused.error().what.find("user " + user + " may not make tables in database test_"),
            std::string::npos)
      << refused.error().what;
  EXPECT_NE(refused.error().what.find("createdb --owner=" + user), std::string::npos);
  ASSERT_FALSE(statement);
  EXPECT_NE(statement.error().what.find("(PostgreSQL code 42501)"), std::string::npos)
      << statement.error().what;
  EXPECT_EQ(statement.error().what.find("of_a_guest"), std::string::npos) << "no SQL";
  EXPECT_TRUE(migrate(*database_, schema())) << "and its owner may";
}

TEST(PostgresqlConnection, IsRefusedWithoutRepeatingAPassword) {
  const auto unreachable = Database::connect({.url = "postgresql://anna:secret@127.0.0.1:1/shop"});
  ASSERT_FALSE(unreachable);
  EXPECT_EQ(unreachable.error().code, Errc::Io);
  EXPECT_NE(unreachable.error().what.find("127.0.0.1:1/shop"), std::string::npos)
      << unreachable.error().what;
  EXPECT_EQ(unreachable.error().what.find("secret"), std::string::npos) << unreachable.error().what;
  const auto unreadable = Database::connect({.url = "postgresql://anna:secret@host:port:1/x"});
  ASSERT_FALSE(unreadable);
  EXPECT_EQ(unreadable.error().what.find("secret"), std::string::npos) << unreadable.error().what;
}

/// With a server of its own, which a test may freeze.
class FrozenDatabase : public testing::Test {
 protected:
  void SetUp() override {
    cluster_ = test::TestCluster::make();
    if (cluster_ == nullptr) GTEST_SKIP() << "PostgreSQL is not installed";
  }
  ConnectOptions impatient() const {
    return {.url = cluster_->url(),
            .connect_timeout = std::chrono::seconds(2),
            .silence = std::chrono::milliseconds(200)};
  }
  std::unique_ptr<test::TestCluster> cluster_;
};

TEST_F(FrozenDatabase, IsGivenUp) {
  auto database = Database::connect(impatient());
  ASSERT_TRUE(database) << database.error().what;
  ASSERT_TRUE(database->execute("CREATE TABLE kept (bytes bytea)"));
  cluster_->freeze();
  const auto read = database->integer("SELECT count(*) FROM kept");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::Io);
  EXPECT_NE(read.error().what.find("says nothing"), std::string::npos) << read.error().what;
  EXPECT_FALSE(database->is_alive());
  EXPECT_FALSE(database->execute("SELECT 1"));
}

/// More than any buffer between the two takes.
TEST_F(FrozenDatabase, IsGivenUpWhileItIsSentMuch) {
  auto database = Database::connect(impatient());
  ASSERT_TRUE(database) << database.error().what;
  ASSERT_TRUE(database->execute("CREATE TABLE kept (bytes bytea)"));
  cluster_->freeze();
  const std::vector<std::byte> much(16U << 20U);
  ASSERT_TRUE(database->begin());
  const auto kept = sql::run(*database, "INSERT INTO kept VALUES (?1)", std::span(much));
  EXPECT_FALSE(kept && database->commit());
  EXPECT_FALSE(database->is_alive());
}

/// As after a failover in which the former primary hangs: its successor answers, but not for it.
TEST_F(FrozenDatabase, IsGivenUpWhileAnotherHostOfTheUrlAnswers) {
  const auto other = test::TestCluster::make();
  ASSERT_NE(other, nullptr);
  ConnectOptions options = impatient();
  const std::string other_url = other->url();
  options.url += "," + other_url.substr(other_url.find("host=") + 5);
  auto database = Database::connect(options);
  ASSERT_TRUE(database) << database.error().what;
  cluster_->freeze();
  EXPECT_FALSE(database->execute("SELECT 1"));
  EXPECT_FALSE(database->is_alive());
}

TEST_F(FrozenDatabase, AStatementMayTakeLongWhileTheServerAnswersOthers) {
  auto database = Database::connect(impatient());
  ASSERT_TRUE(database) << database.error().what;
  EXPECT_EQ(database->integer("SELECT CAST(1 AS bigint) FROM pg_sleep(1)").value_or(0), 1);
  EXPECT_TRUE(database->execute("SELECT pg_sleep(0.5)"));
}

}  // namespace
}  // namespace dripline::storage::postgresql
