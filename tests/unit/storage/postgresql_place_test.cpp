// Who has the database: one server at a time, by a lease with a term; a server that lost it stores
// nothing.
#include <atomic>
#include <thread>

#include "storage/postgresql/database.hpp"
#include "storage/postgresql_standby.hpp"
#include "storage/sql/query.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/storage/postgresql_store_fixture.hpp"

namespace dripline::storage {
namespace {

class PostgresqlPlaceTest : public PostgresqlStoreTest {};

TEST_F(PostgresqlPlaceTest, OneServerUsesADatabase) {
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

TEST_F(PostgresqlPlaceTest, APlaceThatIsNotRenewedEnds) {
  store_.reset();
  const auto killed = open_as_if_killed("srv-1");
  ASSERT_TRUE(killed) << killed.error().what;
  change("UPDATE store_holder SET until = now() - interval '1 second'");
  const auto second = open_waiting("srv-2", std::chrono::milliseconds(1));
  EXPECT_TRUE(second) << second.error().what;
}

TEST_F(PostgresqlPlaceTest, TheSameServerHasItsPlaceAgainBeforeItsLeaseEnds) {
  store_.reset();
  auto first = open_as_if_killed("srv-2");
  ASSERT_TRUE(first) << first.error().what;
  const auto again = open_waiting("srv-2", std::chrono::seconds(8));
  EXPECT_TRUE(again) << again.error().what;
}

/// Of a folder that was copied to a computer of the same name.
TEST_F(PostgresqlPlaceTest, ANamesakeOfAServerThatWorksIsRefused) {
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
TEST_F(PostgresqlPlaceTest, WhoLostThePlaceStoresNothing) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  change("UPDATE store_holder SET holder = ''");  // so the other one does not wait
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
TEST_F(PostgresqlPlaceTest, ATermOfBeforeStoresNothing) {
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

TEST_F(PostgresqlPlaceTest, TermsOnlyGrow) {
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
TEST_F(PostgresqlPlaceTest, AWriterThatIsFrozenInATransactionKeepsNobodyOut) {
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
TEST_F(PostgresqlPlaceTest, ATransactionThatTakesLongerThanTheLeaseKeepsThePlace) {
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

/// On a slow line a transaction takes as long as its text: a standby must see that its server
/// lives.
TEST_F(PostgresqlPlaceTest, TheLeaseIsRenewedWhileATransactionTakesLong) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  store_.reset();
  auto first = PostgresqlStore::open(
      {.url = database_->url(), .holder = "a", .lease = std::chrono::seconds(4)}, clock_);
  ASSERT_TRUE(first) << first.error().what;
  change(
      "CREATE FUNCTION be_slow() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM "
      "pg_sleep(5); RETURN NEW; END $$; CREATE TRIGGER slow BEFORE INSERT ON record FOR EACH "
      "STATEMENT EXECUTE FUNCTION be_slow()");
  std::atomic<bool> is_stored = false;
  std::jthread storing([&] {
    EXPECT_EQ((*first)->records.store(make_batch(1, 3)), 3u);
    is_stored = true;
  });
  int lapsed = 0, looks = 0;
  while (!is_stored) {
    lapsed += query("SELECT count(*) FROM store_holder WHERE until <= clock_timestamp()") > 0;
    ++looks;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_GT(looks, 10);
  EXPECT_EQ(lapsed, 0);
  EXPECT_TRUE((*first)->has_place());
}

/// The lock that each writer has: no other server is given the place in the middle of a
/// transaction, however long its lease is over, and the next one stores nothing.
TEST_F(PostgresqlPlaceTest, ATransactionOfATermEndsBeforeTheNextTerm) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  store_.reset();
  auto first = open_as_if_killed("srv-2");
  ASSERT_TRUE(first) << first.error().what;
  ASSERT_TRUE((*first)->probe()) << "renewed now, and not at the end of what follows";
  change(
      "CREATE FUNCTION be_slow() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN PERFORM "
      "pg_sleep(2); RETURN NEW; END $$; CREATE TRIGGER slow BEFORE INSERT ON record FOR EACH "
      "STATEMENT EXECUTE FUNCTION be_slow(); CREATE TABLE seen (term bigint); CREATE FUNCTION "
      "note_term() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN INSERT INTO seen SELECT term FROM "
      "store_holder; RETURN NULL; END $$; CREATE TRIGGER noted AFTER INSERT ON record FOR EACH "
      "STATEMENT EXECUTE FUNCTION note_term()");
  std::jthread storing([&] { EXPECT_EQ((*first)->records.store(make_batch(1, 3)), 3u); });
  ASSERT_TRUE(test_support::eventually([&] {
    return query("SELECT count(*) FROM pg_stat_activity WHERE wait_event = 'PgSleep'") > 0;
  }));
  change("UPDATE store_holder SET until = now() - interval '1 second'");
  const auto second = open_waiting("b", std::chrono::seconds(8));
  ASSERT_TRUE(second) << second.error().what;
  EXPECT_EQ(query("SELECT count(*) FROM record"), 3) << "before it: it was committed";
  EXPECT_EQ(query("SELECT max(term) FROM seen"), static_cast<std::int64_t>((*first)->term()));
  storing.join();
  EXPECT_FALSE((*first)->records.store(make_batch(4, 6)));
  EXPECT_EQ(query("SELECT count(*) FROM record"), 3);
}

/// What a server does beside its database, as sending over a line that others reach too.
TEST_F(PostgresqlPlaceTest, APlaceThatCannotBeRenewedMayBeAnothersByItsOwnClock) {
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
  change("UPDATE store_holder SET holder = 'b', term = term + 1");
  EXPECT_FALSE((*store)->probe());
  EXPECT_FALSE((*store)->has_place()) << "at once";
}

TEST_F(PostgresqlPlaceTest, AStandbySeesWhoHasThePlaceAndIsSeen) {
  ASSERT_TRUE(store_->publish(
      {.url = "https://srv-1:8430", .signing_key = "abcd", .settings = "dds-domain 0\n"}));
  {
    PostgresqlStandby standby(
        {.url = database_->url(), .holder = "srv-2", .described = "dncd 8 on srv-2"});
    const auto view = standby.look();
    ASSERT_TRUE(view) << view.error().what;
    EXPECT_FALSE(view->is_free);
    EXPECT_EQ(view->url, "https://srv-1:8430");
    EXPECT_EQ(view->signing_key, "abcd");
    EXPECT_EQ(view->settings, "dds-domain 0\n");
    EXPECT_EQ(view->term, store_->term());
    EXPECT_EQ(view->identity, *store_->identity());
    EXPECT_LT(std::chrono::abs(SystemClock().now() - view->time), std::chrono::seconds(30));
    const auto time = store_->time();
    ASSERT_TRUE(time && *time);
    EXPECT_GE(**time, view->time);
    const auto waiting = store_->waiting();
    ASSERT_TRUE(waiting) << waiting.error().what;
    ASSERT_EQ(waiting->size(), 1u);
    EXPECT_EQ(waiting->front().described, "dncd 8 on srv-2");
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

/// A writer that is alive and slow is not tried against; one that was frozen is ended.
TEST_F(PostgresqlPlaceTest, AStandbyWaitsForATransactionThatHasThePlaceLocked) {
  store_.reset();
  PostgresqlStandby standby({.url = database_->url(),
                             .holder = "srv-2",
                             .described = "dncd 8 on srv-2",
                             .lease = std::chrono::seconds(4)});
  ASSERT_TRUE(standby.look());
  change(
      "UPDATE store_holder SET holder = 'srv-1', described = 'dncd 7 on srv-1', until = now() - "
      "interval '1 second'");
  ASSERT_TRUE(test_support::eventually([&] { return standby.look()->is_free; }));
  auto writer = postgresql::Database::connect({.url = database_->url()});
  const auto hold = [&] {
    return writer->execute("BEGIN; SELECT 1 FROM store_holder WHERE id = 1 FOR KEY SHARE");
  };
  ASSERT_TRUE(hold());
  const auto locked = standby.look();
  ASSERT_TRUE(locked) << locked.error().what;
  EXPECT_FALSE(locked->is_free);
  EXPECT_TRUE(locked->is_lapsed);
  ASSERT_TRUE(writer->execute("ROLLBACK"));
  EXPECT_TRUE(standby.look()->is_free);
  ASSERT_TRUE(hold());
  EXPECT_TRUE(test_support::eventually([&] { return standby.look()->is_free; }));
  EXPECT_FALSE(writer->execute("COMMIT")) << "it wakes up";
}

/// Of a person, who is not disconnected.
TEST_F(PostgresqlPlaceTest, AStandbyNamesTheSessionThatHasThePlaceLocked) {
  store_.reset();
  PostgresqlStandby standby({.url = database_->url(),
                             .holder = "srv-2",
                             .described = "",
                             .lease = std::chrono::seconds(1)});
  ASSERT_TRUE(standby.look());
  change("UPDATE store_holder SET holder = 'srv-1', until = now() - interval '1 second'");
  auto person = postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(person->execute("SET application_name = 'psql'"));
  ASSERT_TRUE(person->execute("BEGIN; SELECT 1 FROM store_holder WHERE id = 1 FOR UPDATE"));
  std::string obstacle;
  EXPECT_TRUE(test_support::eventually([&] {
    const auto view = standby.look();
    obstacle = view ? view->obstacle : view.error().what;
    return !obstacle.empty();
  }));
  EXPECT_NE(obstacle.find("(psql)"), std::string::npos) << obstacle;
  EXPECT_TRUE(person->execute("COMMIT"));
  const auto free = standby.look();
  ASSERT_TRUE(free) << free.error().what;
  EXPECT_TRUE(free->is_free);
  EXPECT_EQ(free->obstacle, "");
}

TEST_F(PostgresqlPlaceTest, WhoLostThePlaceIsTold) {
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

TEST_F(PostgresqlPlaceTest, WhoEndsGivesItBackAndStoresNothingMore) {
  store_.reset();
  std::atomic<int> calls = 0;
  auto first = PostgresqlStore::open(
      {.url = database_->url(), .on_lost = [&](const Error&) { ++calls; }}, clock_);
  ASSERT_TRUE(first) << first.error().what;
  (*first)->give_back();
  const auto second = open_another("srv-2");
  ASSERT_TRUE(second) << second.error().what;
  EXPECT_FALSE((*first)->probe());
  EXPECT_EQ(calls, 0) << "it ends already";
  first->reset();
  EXPECT_TRUE((*second)->probe());
}

/// A part of a server that ends may take longer than anyone waits.
TEST_F(PostgresqlPlaceTest, WhoEndsDoesNotKeepItByRenewing) {
  store_->stop_renewing();
  EXPECT_TRUE(store_->identity()) << "until another one has it";
  const auto second = open_waiting("srv-2", std::chrono::seconds(8));
  EXPECT_TRUE(second) << second.error().what;
}

/// What the other one stored meanwhile is not what this one has in memory.
TEST_F(PostgresqlPlaceTest, APlaceThatWasTakenAndGivenBackIsLostToo) {
  ASSERT_TRUE(store_->probe());
  change("UPDATE store_holder SET holder = '', until = now()");
  EXPECT_FALSE(store_->probe());
}

TEST_F(PostgresqlPlaceTest, WhoDoesNotStartKeepsNobodyOut) {
  store_.reset();
  change("UPDATE schema_version SET version = 99");
  const auto newer = open_another("srv-2");
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, Errc::Unsupported);
  EXPECT_EQ(query("SELECT count(*) FROM store_holder WHERE holder = ''"), 1);
}

TEST_F(PostgresqlPlaceTest, TablesAreNotMigratedUnderAServerThatWorks) {
  change("UPDATE schema_version SET version = 99");
  const auto newer = open_another();
  ASSERT_FALSE(newer);
  EXPECT_EQ(newer.error().code, Errc::Busy) << "the place comes first: " << newer.error().what;
}

}  // namespace
}  // namespace dripline::storage
