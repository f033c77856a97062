// A lease, whatever the clock of the database does: a server that works keeps its place, one that
// is gone loses it, and of two that take it one has it.
#include <algorithm>
#include <array>
#include <optional>
#include <thread>
#include <vector>

#include "storage/postgresql_standby.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/postgresql/database_clock.hpp"
#include "tests/unit/storage/postgresql_store_fixture.hpp"

namespace dripline::storage {
namespace {

using test_support::eventually;
using namespace std::chrono_literals;

class PostgresqlLeaseTest : public PostgresqlStoreTest {
 protected:
  void SetUp() override {
    PostgresqlStoreTest::SetUp();
    if (IsSkipped()) return;
    store_.reset();
    clock_of_database_.emplace(database_->url());
    auto opened = open_another("srv-1");
    ASSERT_TRUE(opened) << opened.error().what;
    store_ = *std::move(opened);
  }
  /// As of a server that was killed a moment ago.
  void leave_lease() {
    store_.reset();
    change(
        "UPDATE store_holder SET holder = 'srv-1', until = clock_timestamp() + interval '2 "
        "seconds'");
  }
  PostgresqlStandby standby() const {
    return PostgresqlStandby({.url = database_->url(), .holder = "srv-2", .described = "srv-2"});
  }
  std::int64_t waiting_for_the_row() {
    return query(
        "SELECT count(*) FROM pg_stat_activity WHERE datname = current_database() AND "
        "wait_event_type = 'Lock'");
  }
  std::optional<test::DatabaseClock> clock_of_database_;
};

TEST_F(PostgresqlLeaseTest, AServerThatIsGoneLosesItThoughTheClockWentBack) {
  leave_lease();
  auto watcher = standby();
  ASSERT_TRUE(watcher.look());
  clock_of_database_->shift(-1h);
  ASSERT_TRUE(eventually([&] { return watcher.look()->is_free; }));
  const auto view = watcher.look();
  EXPECT_TRUE(view->is_lapsed);
  EXPECT_EQ(view->lease, row());
  EXPECT_EQ(query("SELECT count(*) FROM store_holder WHERE until > clock_timestamp()"), 1);
  const auto taken = open_ended(view->lease, "srv-2");
  ASSERT_TRUE(taken) << taken.error().what;
  EXPECT_GT((*taken)->term(), view->term);
}

TEST_F(PostgresqlLeaseTest, AServerThatRenewsKeepsItWhateverTheClockDoes) {
  auto watcher = standby();
  bool is_over = false, was_past = false, was_ahead = false;
  for (const auto by : {0h, 1h, -2h, 3h, -5h, 1h}) {
    clock_of_database_->shift(by);
    const auto end = std::chrono::steady_clock::now() + 1500ms;
    while (std::chrono::steady_clock::now() < end) {
      const auto view = watcher.look();
      ASSERT_TRUE(view) << view.error().what;
      is_over = is_over || view->is_lapsed || view->is_free;
      const auto left =
          std::chrono::microseconds(view->lease.until) - view->time.time_since_epoch();
      was_past = was_past || left < 0s;
      was_ahead = was_ahead || left > 10s;
      std::this_thread::sleep_for(20ms);
    }
  }
  EXPECT_TRUE(was_past && was_ahead) << "there was something to be wrong about";
  EXPECT_FALSE(is_over);
  EXPECT_TRUE(store_->probe());
  EXPECT_TRUE(store_->has_place());
}

TEST_F(PostgresqlLeaseTest, AServerThatStartsWaitsForTheLeaseOfAnotherByItsOwnTime) {
  clock_of_database_->shift(1h);
  const auto refused = open_another("srv-3");
  ASSERT_FALSE(refused) << "the other one works, and has not renewed since";
  EXPECT_EQ(refused.error().code, Errc::Busy);
  leave_lease();
  clock_of_database_->shift(1h);
  const auto begun = std::chrono::steady_clock::now();
  const auto taken = open_waiting("srv-3", 8s);
  ASSERT_TRUE(taken) << taken.error().what;
  EXPECT_GE(std::chrono::steady_clock::now() - begun, 3s);
}

TEST_F(PostgresqlLeaseTest, ALeaseThatWasRenewedSinceTheLookIsNotTaken) {
  const auto seen = row();
  ASSERT_TRUE(eventually([&] { return row() != seen; })) << "it renews";
  const auto second = open_ended(seen, "srv-2");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy) << second.error().what;
  EXPECT_TRUE(store_->probe());
}

/// The renewal is committed while the taking waits for the row.
TEST_F(PostgresqlLeaseTest, AServerThatRenewsBetweenLookAndTakingKeepsIt) {
  leave_lease();
  auto renewing = postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(renewing->execute("BEGIN; UPDATE store_holder SET until = until + interval '1 s'"));
  const auto seen = row();
  std::jthread taking([&] {
    const auto second = open_ended(seen, "srv-2");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, Errc::Busy) << second.error().what;
  });
  EXPECT_TRUE(eventually([&] { return waiting_for_the_row() == 1; }));
  ASSERT_TRUE(renewing->execute("COMMIT"));
  taking.join();
  EXPECT_EQ(row().holder, "srv-1");
}

TEST_F(PostgresqlLeaseTest, OfServersThatTakeItAtOnceOneHasIt) {
  leave_lease();
  const auto seen = row();
  auto other = postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(other->execute("BEGIN; SELECT 1 FROM store_holder WHERE id = 1 FOR UPDATE"));
  std::array<std::unique_ptr<PostgresqlStore>, 3> stores;
  std::vector<std::jthread> taking;
  for (std::size_t i = 0; i < stores.size(); ++i) {
    taking.emplace_back([this, &stores, &seen, i] {
      if (auto taken = open_ended(seen, "srv-" + std::to_string(i + 2)))
        stores[i] = *std::move(taken);
    });
  }
  EXPECT_TRUE(eventually([&] { return waiting_for_the_row() == 3; }));
  ASSERT_TRUE(other->execute("COMMIT"));
  taking.clear();
  EXPECT_EQ(std::ranges::count_if(stores, [](const auto& store) { return store != nullptr; }), 1);
}

/// One that was frozen in a transaction, as the clock was set back: what the database says of its
/// sessions is in the future then.
TEST_F(PostgresqlLeaseTest, AWriterThatIsFrozenIsEndedByTheWatchersOwnTime) {
  leave_lease();
  auto watcher = standby();
  ASSERT_TRUE(watcher.look());
  auto frozen = postgresql::Database::connect({.url = database_->url()});
  ASSERT_TRUE(frozen->execute("BEGIN; SELECT 1 FROM store_holder WHERE id = 1 FOR KEY SHARE"));
  clock_of_database_->shift(-1h);
  EXPECT_TRUE(eventually([&] { return watcher.look()->is_free; }));
  EXPECT_FALSE(frozen->execute("COMMIT")) << "it wakes up";
}

/// Not one that a clock which was set back leaves in the list for as long as it was set.
TEST_F(PostgresqlLeaseTest, AServerThatDoesNotWaitAnyMoreIsNotListed) {
  change(
      "INSERT INTO store_standby (holder, described, seen) VALUES ('srv-9', 'dncd 9 on srv-9', "
      "clock_timestamp())");
  clock_of_database_->shift(-1h);
  const auto waiting = store_->waiting();
  ASSERT_TRUE(waiting) << waiting.error().what;
  EXPECT_TRUE(waiting->empty());
  auto watcher = standby();
  ASSERT_TRUE(watcher.look());
  EXPECT_EQ(store_->waiting()->size(), 1u);
}

/// The active server must know whether machines are there for the one that waits.
TEST_F(PostgresqlLeaseTest, AServerThatWaitsSaysHowManyGatewaysItHears) {
  auto watcher = standby();
  ASSERT_TRUE(watcher.look());
  const auto gateways = [&] {
    const auto waiting = store_->waiting();
    EXPECT_TRUE(waiting && waiting->size() == 1);
    return waiting && waiting->size() == 1 ? waiting->front().gateways : std::nullopt;
  };
  EXPECT_EQ(gateways(), std::nullopt);
  for (const int count : {3, 0}) {
    watcher.set_gateways(count);
    ASSERT_TRUE(watcher.look());
    EXPECT_EQ(gateways(), static_cast<std::uint64_t>(count)) << "at once, and not only each second";
  }
  watcher.set_gateways(std::nullopt);
  ASSERT_TRUE(watcher.look());
  EXPECT_EQ(gateways(), std::nullopt) << "it does not listen any more";
}

TEST_F(PostgresqlLeaseTest, HandOversOfServersAreKeptForTheNextOne) {
  EXPECT_EQ(*store_->own_hand_overs(), OwnHandOvers{});
  auto watcher = standby();
  ASSERT_TRUE(store_->note_own_hand_overs({.count = 2, .has_helped = false}));
  EXPECT_FALSE(watcher.look()->is_for_hearers) << "it is not free";
  store_.reset();
  EXPECT_TRUE(watcher.look()->is_for_hearers);
  const auto next = open_another();
  ASSERT_TRUE(next) << next.error().what;
  EXPECT_EQ(*(*next)->own_hand_overs(), (OwnHandOvers{2, false}));
}

}  // namespace
}  // namespace dripline::storage
