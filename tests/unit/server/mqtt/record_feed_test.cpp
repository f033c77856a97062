#include "server/mqtt/record_feed.hpp"

#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::mqtt {
namespace {

class RecordFeedTest : public server_test::ServerTest {
 protected:
  RecordFeedTest() { EXPECT_TRUE(store_->record_readers.begin("mqtt", clock_.now())); }

  void store(const std::string& machine, std::uint64_t last, std::uint64_t epoch = 7,
             const std::string& kind = "output") {
    storage::RecordBatch batch;
    batch.machine = machine;
    batch.epoch = epoch;
    auto& stored = stored_[{machine, epoch}];
    while (stored < last) {
      storage::Record record;
      record.machine = machine;
      record.epoch = epoch;
      record.number = ++stored;
      record.kind = kind;
      record.time = clock_.now();
      batch.records.push_back(record);
    }
    ASSERT_TRUE(store_->records.store(batch));
  }
  RecordFeed make(RecordFeed::Options options = {}) { return {*store_, "mqtt", options}; }
  /// Until there is nothing more, or the window is full.
  std::string fill(RecordFeed& feed) {
    std::string published;
    for (bool is_more = true; is_more && feed.under_way() < window_;) {
      const auto filled = feed.fill([&](const storage::Record& record) -> Result<std::uint64_t> {
        published += fmt::format("{}{} ", record.machine, record.number);
        return ++message_;
      });
      EXPECT_TRUE(filled) << filled.error().what;
      is_more = filled.value_or(false);
    }
    return published;
  }
  void acknowledge_all(RecordFeed& feed) {
    while (acknowledged_ < message_) feed.acknowledge(++acknowledged_);
    ASSERT_TRUE(feed.commit());
  }
  std::uint64_t cursor(const std::string& machine) {
    const auto unread = store_->record_readers.unread("mqtt").value();
    for (const auto& journal : unread)
      if (journal.cursor.machine == machine) return journal.cursor.number;
    return stored_[{machine, 7}];
  }

  std::size_t window_ = 100;
  std::uint64_t message_ = 0, acknowledged_ = 0;
  std::map<std::pair<std::string, std::uint64_t>, std::uint64_t> stored_;
};

TEST_F(RecordFeedTest, PublishesEveryRecordOnceAndInOrder) {
  auto feed = make();
  store("a", 3);
  EXPECT_EQ(fill(feed), "a1 a2 a3 ");
  EXPECT_EQ(fill(feed), "") << "they are in progress";
  store("a", 4);
  store("b", 1);
  EXPECT_EQ(fill(feed), "b1 a4 ");
  acknowledge_all(feed);
  EXPECT_EQ(fill(feed), "");
  EXPECT_EQ(feed.under_way(), 0u);
}

TEST_F(RecordFeedTest, MovesTheCursorOverWhatIsAcknowledgedWithoutAGap) {
  auto feed = make();
  store("a", 4);
  fill(feed);
  ASSERT_TRUE(feed.commit());
  EXPECT_EQ(cursor("a"), 0u);
  feed.acknowledge(1);
  feed.acknowledge(3);
  ASSERT_TRUE(feed.commit());
  EXPECT_EQ(cursor("a"), 1u);
  feed.acknowledge(2);
  EXPECT_TRUE(feed.has_uncommitted());
  EXPECT_EQ(cursor("a"), 1u);
  ASSERT_TRUE(feed.commit());
  EXPECT_EQ(cursor("a"), 3u);
}

TEST_F(RecordFeedTest, RepeatsAfterALostConnectionWhatWasNotAcknowledged) {
  auto feed = make();
  store("a", 4);
  fill(feed);
  feed.acknowledge(1);
  feed.acknowledge(3);
  feed.restart();
  EXPECT_EQ(fill(feed), "a2 a3 a4 ");
  EXPECT_FALSE(feed.acknowledge(2)) << "a message of the connection before";
  ASSERT_TRUE(feed.commit());
  EXPECT_EQ(cursor("a"), 1u);
}

TEST_F(RecordFeedTest, ContinuesAfterAKillFromTheStoredCursor) {
  store("a", 4);
  {
    auto feed = make();
    fill(feed);
    feed.acknowledge(1);
    feed.acknowledge(2);
    ASSERT_TRUE(feed.commit());
    feed.acknowledge(3);
  }
  reopen();
  auto feed = make();
  EXPECT_EQ(fill(feed), "a3 a4 ");
}

TEST_F(RecordFeedTest, HasAWindow) {
  window_ = 30;
  auto feed = make({.window = window_});
  store("a", 1000);
  store("b", 1000);
  fill(feed);
  EXPECT_EQ(message_, 30u);
  EXPECT_EQ(feed.under_way(), 30u);
  for (int i = 0; i < 100; ++i) {
    acknowledge_all(feed);
    fill(feed);
    ASSERT_LE(feed.under_way(), 30u);
  }
  acknowledge_all(feed);
  EXPECT_EQ(message_, 2000u);
  EXPECT_EQ(cursor("a"), 1000u);
}

TEST_F(RecordFeedTest, LetsNoMachineWaitForAnother) {
  window_ = 40;
  auto feed = make({.window = window_});
  store("a", 1000);
  store("b", 1);
  EXPECT_NE(fill(feed).find("b1"), std::string::npos);
}

TEST_F(RecordFeedTest, PassesOverKindsThatAreNotWanted) {
  auto feed = make({.kinds = {"alarm"}});
  store("a", 50);
  store("a", 52, 7, "alarm");
  store("a", 53);
  EXPECT_EQ(fill(feed), "a51 a52 ");
  ASSERT_TRUE(feed.commit());
  EXPECT_EQ(cursor("a"), 50u);
  acknowledge_all(feed);
  EXPECT_EQ(cursor("a"), 53u);
}

TEST_F(RecordFeedTest, EndsOneJournalOfAMachineBeforeTheNext) {
  auto feed = make();
  store("a", 50, 9);
  store("a", 2, 4);
  storage::Machine machine = store_->machines.find("a").value();
  machine.epoch = 4;  // the gateway lost its journal, and began another
  ASSERT_TRUE(store_->machines.save(machine));
  std::string expected;
  for (int i = 1; i <= 50; ++i) expected += fmt::format("a{} ", i);
  EXPECT_EQ(fill(feed), expected + "a1 a2 ");
}

TEST_F(RecordFeedTest, ReportsAFailureAndRepeats) {
  auto feed = make();
  store("a", 3);
  int calls = 0;
  const auto filled = feed.fill([&](const storage::Record&) -> Result<std::uint64_t> {
    if (++calls == 2) return fail(Errc::Io, "gone");
    return 1;
  });
  EXPECT_EQ(filled.error().what, "gone");
  feed.restart();
  EXPECT_EQ(fill(feed), "a1 a2 a3 ");
}

}  // namespace
}  // namespace dripline::mqtt
