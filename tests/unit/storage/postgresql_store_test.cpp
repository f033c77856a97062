// What only the store in PostgreSQL has: its one holder, lost connections, transactions that are
// begun again.
#include <atomic>
#include <thread>

#include "storage/postgresql/database.hpp"
#include "storage/postgresql/lock_holders.hpp"
#include "storage/postgresql_standby.hpp"
#include "storage/sql/query.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class PostgresqlStoreTest : public StoreTest {
 protected:
  PostgresqlStoreTest() : StoreTest(sql::Engine::Postgresql) {}

  Result<std::unique_ptr<PostgresqlStore>> open_another(const std::string& holder = "") {
    return open_waiting(holder, std::chrono::milliseconds(0));
  }
  Result<std::unique_ptr<PostgresqlStore>> open_waiting(
      const std::string& holder, std::chrono::milliseconds wait,
      std::chrono::milliseconds lease = std::chrono::seconds(3)) {
    return PostgresqlStore::open({.url = database_->url(),
                                  .holder = holder,
                                  .described = "dncd 7 on srv-2",
                                  .lease = lease,
                                  .wait_for_holder = wait},
                                 clock_);
  }
  /// Its lease is not renewed while the test lasts, as of a server that was killed.
  Result<std::unique_ptr<PostgresqlStore>> open_as_if_killed(const std::string& holder) {
    return open_waiting(holder, std::chrono::milliseconds(0), std::chrono::minutes(10));
  }
  void lose_connections() {
    change(
        "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE datname = "
        "current_database() AND pid <> pg_backend_pid()");
  }
};

TEST_F(PostgresqlStoreTest, OneServerUsesADatabase) {
  const auto second = open_another();
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
  store_.reset();
  const auto third = open_another();
  ASSERT_TRUE(third) << third.error().what;
  const auto fourth = open_another();
  ASSERT_FALSE(fourth);
  EXPECT_NE(fourth.error().what.find("(dncd 7 on srv-2), and still was after 0 s"),
            std::string::npos)
      << fourth.error().what;
}

TEST_F(PostgresqlStoreTest, APlaceThatIsNotRenewedEnds) {
  change("UPDATE store_holder SET until = now() - interval '1 second'");
  const auto second = open_another();
  EXPECT_TRUE(second) << second.error().what;
}

TEST_F(PostgresqlStoreTest, TheSameServerHasItsPlaceAgainBeforeItsLeaseEnds) {
  store_.reset();
  auto first = open_as_if_killed("srv-2");
  ASSERT_TRUE(first) << first.error().what;
  const auto again = open_waiting("srv-2", std::chrono::seconds(8));
  EXPECT_TRUE(again) << again.error().what;
}

/// Of a folder that was copied to a computer of the same name.
TEST_F(PostgresqlStoreTest, ANamesakeOfAServerThatWorksIsRefused) {
  store_.reset();
  const auto first = open_another("srv-2");
  ASSERT_TRUE(first) << first.error().what;
  const auto second = open_waiting("srv-2", std::chrono::seconds(8));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Conflict);
  EXPECT_NE(second.error().what.find("Delete server.id in the copy"), std::string::npos)
      << second.error().what;
  EXPECT_TRUE((*first)->probe()) << "and keeps its place";
}

/// A server that was frozen and wakes up after another has taken its place.
TEST_F(PostgresqlStoreTest, WhoLostThePlaceStoresNothing) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  change("UPDATE store_holder SET until = now() - interval '1 second'");
  const auto second = open_another();
  ASSERT_TRUE(second) << second.error().what;
  const auto refused = store_->records.store(make_batch(1, 3));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Io);
  EXPECT_NE(refused.error().what.find("taken over"), std::string::npos) << refused.error().what;
  EXPECT_FALSE(store_->probe()) << "and the server's health says so";
  EXPECT_FALSE(store_->runs.find("r1")) << "what it would do with it is another server's now";
  EXPECT_EQ(query("SELECT count(*) FROM record"), 0);
  EXPECT_EQ((*second)->records.store(make_batch(1, 3)), 3u);
}

/// The term alone tells them apart: both have one name, as of a folder that was copied.
TEST_F(PostgresqlStoreTest, ATermOfBeforeStoresNothing) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  store_.reset();
  auto first = open_as_if_killed("srv-2");
  ASSERT_TRUE(first) << first.error().what;
  EXPECT_EQ((*first)->records.store(make_batch(1, 3)), 3u);
  const auto second = open_waiting("srv-2", std::chrono::seconds(8));
  ASSERT_TRUE(second) << second.error().what;
  EXPECT_GT((*second)->term(), (*first)->term());
  const auto before = query("SELECT count(*) FROM record");
  const auto refused = (*first)->records.store(make_batch(4, 6));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("taken over"), std::string::npos) << refused.error().what;
  EXPECT_FALSE((*first)->probe());
  EXPECT_EQ(query("SELECT count(*) FROM record"), before);
  first->reset();
  EXPECT_EQ(query("SELECT count(*) FROM store_holder WHERE holder = 'srv-2'"), 1)
      << "nor does it give the place of its successor back";
  EXPECT_TRUE((*second)->probe());
}

TEST_F(PostgresqlStoreTest, TermsOnlyGrow) {
  std::uint64_t last = 0;
  for (const std::string holder : {"a", "b", "a", "a"}) {
    store_.reset();
    const auto store = open_another(holder);
    ASSERT_TRUE(store) << store.error().what;
    EXPECT_GT((*store)->term(), last);
    last = (*store)->term();
  }
  // A backup of an hour ago is restored: what gateways have seen since is not given again.
  change("UPDATE store_holder SET term = term - 3600");
  auto restored = open_another("b");
  ASSERT_TRUE(restored) << restored.error().what;
  EXPECT_GT((*restored)->term(), last - 60);
  restored->reset();
  change("UPDATE store_holder SET term = 9000000000");  // the clock was wrong once
  const auto after = open_another("b");
  ASSERT_TRUE(after) << after.error().what;
  EXPECT_EQ((*after)->term(), 9000000001u);
}

/// A server that is frozen in the middle of a transaction has the row locked.
TEST_F(PostgresqlStoreTest, AWriterThatIsFrozenInATransactionKeepsNobodyOut) {
  store_.reset();
  auto frozen = postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(
      frozen->execute("BEGIN; SELECT 1 FROM store_holder WHERE id = 1 FOR UPDATE; UPDATE "
                      "identity SET id = repeat('0', 32)"));
  const auto second = PostgresqlStore::open({.url = database_->url(),
                                             .lease = std::chrono::milliseconds(700),
                                             .wait_for_holder = std::chrono::seconds(8)},
                                            clock_);
  ASSERT_TRUE(second) << second.error().what;
  EXPECT_FALSE(frozen->execute("COMMIT")) << "it wakes up";
  EXPECT_EQ(query("SELECT count(*) FROM identity WHERE id = repeat('0', 32)"), 0);
}

/// The row is locked as long as it takes, and renewed at its end.
TEST_F(PostgresqlStoreTest, ATransactionThatTakesLongerThanTheLeaseKeepsThePlace) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  store_.reset();
  auto first = PostgresqlStore::open(
      {.url = database_->url(), .holder = "a", .lease = std::chrono::milliseconds(600)}, clock_);
  ASSERT_TRUE(first) << first.error().what;
  change(
      "CREATE FUNCTION be_slow() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM "
      "pg_sleep(2); RETURN NEW; END $$; CREATE TRIGGER slow BEFORE INSERT ON record FOR EACH "
      "STATEMENT EXECUTE FUNCTION be_slow()");
  std::jthread storing([&] { EXPECT_EQ((*first)->records.store(make_batch(1, 3)), 3u); });
  const auto second = PostgresqlStore::open({.url = database_->url(),
                                             .holder = "b",
                                             .lease = std::chrono::milliseconds(600),
                                             .wait_for_holder = std::chrono::milliseconds(2500)},
                                            clock_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy) << second.error().what;
  storing.join();
  EXPECT_TRUE((*first)->probe());
  EXPECT_EQ(query("SELECT count(*) FROM record"), 3);
}

/// What a server does beside its database, as sending over a line that others reach too.
TEST_F(PostgresqlStoreTest, APlaceThatCannotBeRenewedMayBeAnothersByItsOwnClock) {
  store_.reset();
  const auto store = PostgresqlStore::open(
      {.url = database_->url(), .holder = "a", .lease = std::chrono::milliseconds(600)}, clock_);
  ASSERT_TRUE(store) << store.error().what;
  EXPECT_TRUE(test_support::eventually([&] { return (*store)->has_place(); }));
  auto other = postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(other->execute("BEGIN; SELECT 1 FROM store_holder WHERE id = 1 FOR UPDATE"));
  EXPECT_TRUE(test_support::eventually([&] { return !(*store)->has_place(); }));
  ASSERT_TRUE(other->execute("ROLLBACK"));
  EXPECT_TRUE(test_support::eventually([&] { return (*store)->has_place(); }));
  std::unique_ptr<PostgresqlStore> second;
  ASSERT_TRUE(test_support::eventually([&] {
    change("UPDATE store_holder SET until = now() - interval '1 second'");
    if (auto taken = open_another()) second = *std::move(taken);
    return second != nullptr;
  }));
  EXPECT_FALSE((*store)->probe());
  EXPECT_FALSE((*store)->has_place()) << "at once";
}

TEST_F(PostgresqlStoreTest, AStandbySeesWhoHasThePlaceAndIsSeen) {
  ASSERT_TRUE(store_->publish({.url = "https://srv-1:8430", .signing_key = "abcd"}));
  {
    PostgresqlStandby standby(
        {.url = database_->url(), .holder = "srv-2", .described = "dncd 8 on srv-2"});
    const auto view = standby.look();
    ASSERT_TRUE(view) << view.error().what;
    EXPECT_FALSE(view->is_free);
    EXPECT_EQ(view->url, "https://srv-1:8430");
    EXPECT_EQ(view->signing_key, "abcd");
    EXPECT_EQ(view->term, store_->term());
    EXPECT_EQ(view->identity, *store_->identity());
    const auto waiting = store_->waiting();
    ASSERT_TRUE(waiting) << waiting.error().what;
    ASSERT_EQ(waiting->size(), 1u);
    EXPECT_EQ(waiting->front().described, "dncd 8 on srv-2");
    change("UPDATE store_holder SET until = now() - interval '1 second'");
    EXPECT_FALSE(standby.look()->is_free) << "after an outage of the database its holder is first";
    EXPECT_TRUE(standby.look()->is_lapsed);
    EXPECT_FALSE(standby.look()->is_own);
    change("UPDATE store_holder SET holder = ''");
    EXPECT_TRUE(standby.look()->is_free) << "given back";
    EXPECT_FALSE(standby.look()->is_lapsed);
    change("UPDATE store_holder SET holder = 'srv-2', until = now() + interval '1 hour'");
    EXPECT_TRUE(standby.look()->is_free) << "of this server, which was killed";
    EXPECT_TRUE(standby.look()->is_own);
  }
  EXPECT_EQ(query("SELECT count(*) FROM store_standby"), 0);
}

TEST_F(PostgresqlStoreTest, WhoLostThePlaceIsTold) {
  store_.reset();
  std::atomic<int> calls = 0;
  std::string why;
  auto first = PostgresqlStore::open({.url = database_->url(),
                                      .on_lost =
                                          [&](const Error& error) {
                                            why = error.what;
                                            ++calls;
                                          }},
                                     clock_);
  ASSERT_TRUE(first) << first.error().what;
  ASSERT_TRUE((*first)->probe());
  EXPECT_EQ(calls, 0);
  change("UPDATE store_holder SET holder = 'srv-2', until = now() + interval '1 hour'");
  EXPECT_FALSE((*first)->probe());
  EXPECT_FALSE((*first)->probe());
  EXPECT_EQ(calls, 1);
  EXPECT_NE(why.find("taken over by another server"), std::string::npos) << why;
  first->reset();
  EXPECT_EQ(query("SELECT count(*) FROM store_holder WHERE holder = 'srv-2'"), 1)
      << "and gives nothing back that is another one's";
}

/// What the other one stored meanwhile is not what this one has in memory.
TEST_F(PostgresqlStoreTest, APlaceThatWasTakenAndGivenBackIsLostToo) {
  ASSERT_TRUE(store_->probe());
  change("UPDATE store_holder SET holder = '', until = now()");
  EXPECT_FALSE(store_->probe());
}

TEST_F(PostgresqlStoreTest, WhoDoesNotStartKeepsNobodyOut) {
  store_.reset();
  change("UPDATE schema_version SET version = 99");
  const auto newer = open_another("srv-2");
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, Errc::Unsupported);
  EXPECT_EQ(query("SELECT count(*) FROM store_holder WHERE holder = ''"), 1);
}

TEST_F(PostgresqlStoreTest, TablesAreNotMigratedUnderAServerThatWorks) {
  change("UPDATE schema_version SET version = 99");
  const auto newer = open_another();
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, Errc::Busy) << "the place comes first: " << newer.error().what;
}

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
