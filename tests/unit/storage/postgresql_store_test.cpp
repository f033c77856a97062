// What only the store in PostgreSQL has besides its place: locks of others, lost connections,
// transactions that are begun again.
#include "storage/postgresql/database.hpp"
#include "storage/postgresql/lock_holders.hpp"
#include "storage/sql/query.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/unit/storage/postgresql_store_fixture.hpp"

namespace dripline::storage {
namespace {

TEST_F(PostgresqlStoreTest, ALockedTableIsNamedWithWhoHasIt) {
  store_.reset();
  auto other = postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(other->execute("SET application_name = 'psql'"));
  ASSERT_TRUE(other->begin());
  ASSERT_TRUE(other->integer("SELECT id FROM store_holder FOR UPDATE"));
  const auto pid = other->integer("SELECT CAST(pg_backend_pid() AS bigint)");
  const auto refused = PostgresqlStore::open(
      {.url = database_->url(), .wait = std::chrono::milliseconds(300)}, clock_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  const std::string& what = refused.error().what;
  EXPECT_NE(what.find(fmt::format("process {} (psql) of user dripline", *pid)), std::string::npos)
      << what;
  EXPECT_NE(what.find("has locked store_holder"), std::string::npos) << what;
  EXPECT_NE(what.find("0.3 s"), std::string::npos) << what;
  EXPECT_EQ(what.find("SELECT"), std::string::npos) << what;
  EXPECT_EQ(what.find("55P03"), std::string::npos) << what;
  other->roll_back();
  EXPECT_TRUE(open_another());
}

TEST_F(PostgresqlStoreTest, LocksInACopyOfTheDatabaseAreNotOurs) {
  store_.reset();
  const auto copy = test::TestDatabase::make();  // from the same template, as ours
  auto other = postgresql::Database::connect({.url = copy->url()});
  ASSERT_TRUE(other->begin());
  ASSERT_TRUE(other->integer("SELECT id FROM store_holder FOR UPDATE"));
  auto database = postgresql::Database::connect({.url = database_->url()});
  const Error error = postgresql::locked_by_others(*database, std::chrono::milliseconds(300));
  EXPECT_NE(error.what.find("the session that had it is gone"), std::string::npos) << error.what;
}

TEST_F(PostgresqlStoreTest, PostgresqlsOwnDatabasesAreRefused) {
  const std::string url = database_->url();
  const auto name = url.find("test_");
  for (const std::string own : {"postgres", "template0", "template1"}) {
    const std::string named = url.substr(0, name) + own + url.substr(url.find('?'));
    const auto refused = PostgresqlStore::open({.url = named}, clock_);
    ASSERT_FALSE(refused) << own;
    EXPECT_EQ(refused.error().code, Errc::Unsupported);
    EXPECT_EQ(refused.error().what.rfind("database " + own + ": PostgreSQL keeps it", 0), 0u)
        << refused.error().what;
  }
  // As libpq takes it when no database is named.
  const auto unnamed = PostgresqlStore::open({.url = "postgresql://postgres@127.0.0.1:1/"}, clock_);
  ASSERT_FALSE(unnamed);
  EXPECT_EQ(unnamed.error().code, Errc::Unsupported) << unnamed.error().what;
}

TEST_F(PostgresqlStoreTest, APasswordInTheUrlIsSeen) {
  EXPECT_EQ(holds_password("postgresql://anna:secret@db-1/shop"), true);
  EXPECT_EQ(holds_password("postgresql://anna@db-1/shop?password=secret"), true);
  EXPECT_EQ(holds_password("postgresql://anna@db-1/shop?passfile=/etc/dripline/pgpass"), false);
  const auto wrong = holds_password("postgresql://anna:secret@db-1/shop?nothing=1");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().what.find("secret"), std::string::npos) << wrong.error().what;
}

TEST_F(PostgresqlStoreTest, ALostConnectionIsOpenedAgain) {
  const Run run = make_run("r1");
  ASSERT_TRUE(store_->runs.create(run));
  lose_connections();
  EXPECT_TRUE(store_->runs.find("r1"));
  EXPECT_EQ(store_->records.store(make_batch(1, 300)), 300u);
  lose_connections();
  EXPECT_EQ(store_->records.store(make_batch(301, 600)), 600u);
  EXPECT_EQ(query("SELECT count(*) FROM record"), 600);
}

/// A sequence is not undone, so the trigger fails only the first `times` transactions.
std::string failing_first(int times, const char* state) {
  return fmt::format(
      "CREATE SEQUENCE tries; CREATE FUNCTION fail_first() RETURNS trigger LANGUAGE plpgsql AS $$ "
      "BEGIN IF NEW.number = 3 AND nextval('tries') <= {} THEN RAISE EXCEPTION 'a conflict' USING "
      "ERRCODE = '{}'; END IF; RETURN NEW; END $$; "
      "CREATE TRIGGER fail_first BEFORE INSERT ON record FOR EACH ROW EXECUTE FUNCTION "
      "fail_first()",
      times, state);
}

TEST_F(PostgresqlStoreTest, ATransactionThatWasInTheWayIsBegunAgain) {
  for (const char* state : {"40001", "40P01"}) {
    make_run("r1");
    damage(failing_first(3, state));
    const auto stored = store_->records.store_all({make_batch(1, 5)});
    ASSERT_EQ(stored.size(), 1u) << "and nothing of the tries before is left";
    EXPECT_EQ(stored.front(), 5u);
    EXPECT_EQ(query("SELECT last_value FROM tries"), 4);
    damage(
        "DELETE FROM record; DELETE FROM record_epoch; DROP FUNCTION fail_first() CASCADE; DROP "
        "SEQUENCE tries");
  }
}

TEST_F(PostgresqlStoreTest, AnotherErrorIsNotTriedAgain) {
  make_run("r1");
  damage(failing_first(1, "53100"));
  const auto refused = store_->records.store(make_batch(1, 5));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Io);
  EXPECT_EQ(refused.error().what.rfind("disk full", 0), 0u) << refused.error().what;
  EXPECT_EQ(query("SELECT last_value FROM tries"), 1);
  EXPECT_EQ(query("SELECT count(*) FROM record"), 0);
}

TEST_F(PostgresqlStoreTest, AnyBytesOfATextGiveTheSameDigestInTheAuditTrail) {
  for (const std::string& text :
       {std::string("R\xF6hm"), std::string("a\0b", 3), std::string("\uF7F6"), std::string("ok")}) {
    std::string digits;
    for (const char c : text) digits += fmt::format("{:02X}", static_cast<unsigned char>(c));
    auto database = postgresql::Database::connect({.url = database_->url()});
    auto statement = database->prepare("SELECT hex(?1)");
    ASSERT_TRUE(statement->bind(text).step().value());
    EXPECT_EQ(statement->text(0), digits);
  }
}

/// One SQL reads both: a column that one schema gets and the other does not is found here.
TEST_F(PostgresqlStoreTest, HasTheColumnsOfTheSqliteSchema) {
  const auto columns_in = [](sql::Database& database, const std::string& sql) {
    auto rows = sql::all_rows(database, sql, [](const sql::Statement& row) { return row.text(0); });
    EXPECT_TRUE(rows) << rows.error().what;
    return rows.value_or(std::vector<std::string>{});
  };
  ASSERT_TRUE(SqliteStore::open(options_, clock_));
  auto file = sqlite::Database::open(options_.file);
  auto database = postgresql::Database::connect({.url = database_->url()});
  const auto of_file = columns_in(
      *file,
      "SELECT t.name || '.' || c.name AS named FROM sqlite_schema AS t JOIN "
      "pragma_table_info(t.name) AS c WHERE t.type IN ('table', 'view') AND t.name NOT LIKE "
      "'sqlite_%' AND t.name NOT LIKE 'search_index%' ORDER BY named");
  const auto of_database = columns_in(
      *database,
      "SELECT CAST(table_name || '.' || column_name AS text) COLLATE \"C\" AS named FROM "
      "information_schema.columns WHERE table_schema = current_schema() AND table_name NOT IN "
      "('store_holder', 'store_standby', 'schema_version', 'search_index') ORDER BY named");
  EXPECT_GT(of_file.size(), 300u);
  EXPECT_EQ(of_database, of_file);
}

TEST_F(PostgresqlStoreTest, HasBackupsOfItsOwn) {
  const auto refused = store_->copy_to(directory_ / "copy", [](auto, auto) { return true; });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
  EXPECT_NE(refused.error().what.find("pg_basebackup"), std::string::npos) << refused.error().what;
}

TEST_F(PostgresqlStoreTest, IsProbedAndChecked) {
  EXPECT_TRUE(store_->probe());
  EXPECT_EQ(store_->check(), true);
  const auto identity = store_->identity();
  reopen();
  EXPECT_EQ(store_->identity(), *identity);
}

}  // namespace
}  // namespace dripline::storage
