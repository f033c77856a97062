#include "gateway/report/record_sender.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <random>

#include "gateway/report/status_publisher.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::report {
namespace {

using std::chrono::milliseconds;

/// Stores each number once and in order, as a server does, after a link that loses and doubles.
struct LossyServer {
  std::vector<std::string> stored;
  std::uint64_t epoch = 0;

  void take(const dds::Record& record) {
    if (record.epoch == epoch && record.number == stored.size() + 1) stored.push_back(record.text);
  }
};

class RecordSenderTest : public testing::Test {
 protected:
  void append(int count) {
    for (int i = 0; i < count; ++i) {
      dds::Record record;
      record.text = std::to_string(++appended);
      outbox.append(record);
    }
    ASSERT_TRUE(outbox.commit());
  }
  RecordSender make() {
    return RecordSender("lathe-1", outbox, {}, [this](const dds::Record& record) {
      if (!takes) return false;
      sent.push_back(record.number);
      return true;
    });
  }
  void poll(RecordSender& sender) { ASSERT_TRUE(sender.poll(now)); }

  test_support::TemporaryFolder folder;
  Outbox outbox = std::move(Outbox::open(folder.path() / "outbox.sqlite").value());
  SteadyTime now{std::chrono::hours(1)};
  std::vector<std::uint64_t> sent;
  bool takes = true;
  int appended = 0;
};

TEST_F(RecordSenderTest, SendsNothingWithoutAServer) {
  RecordSender sender = make();
  append(3);
  poll(sender);
  EXPECT_TRUE(sent.empty());
  sender.on_server(true);
  poll(sender);
  EXPECT_EQ(sent, (std::vector<std::uint64_t>{1, 2, 3}));
}

TEST_F(RecordSenderTest, KeepsToItsWindow) {
  RecordSender sender = make();
  append(600);
  sender.on_server(true);
  poll(sender);
  EXPECT_EQ(sent.size(), 128u);
  sender.on_ack({"lathe-1", outbox.epoch(), 100}, now);
  poll(sender);
  EXPECT_EQ(sent.size(), 228u);
}

TEST_F(RecordSenderTest, GoesBackAfterASilence) {
  RecordSender sender = make();
  append(2);
  sender.on_server(true);
  poll(sender);
  now += milliseconds(499);
  poll(sender);
  EXPECT_EQ(sent.size(), 2u);
  now += milliseconds(1);
  poll(sender);
  EXPECT_EQ(sent, (std::vector<std::uint64_t>{1, 2, 1, 2}));
}

TEST_F(RecordSenderTest, AFullNetworkIsTriedAgainSoon) {
  RecordSender sender = make();
  append(2);
  sender.on_server(true);
  takes = false;
  poll(sender);
  ASSERT_TRUE(sender.next_poll().has_value());
  EXPECT_LE(*sender.next_poll() - now, milliseconds(5));
  takes = true;
  poll(sender);
  EXPECT_EQ(sent, (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(RecordSenderTest, AcknowledgmentsOfAnotherEpochMeanNothing) {
  RecordSender sender = make();
  append(2);
  sender.on_ack({"lathe-1", outbox.epoch() + 1, 2}, now);
  EXPECT_EQ(outbox.unacknowledged(), 2u);
}

TEST_F(RecordSenderTest, AServerWithAnotherPastGetsANewEpoch) {
  RecordSender sender = make();
  append(5);
  sender.on_server(true);
  poll(sender);
  sender.on_ack({"lathe-1", outbox.epoch(), 3}, now);
  const std::uint64_t before = outbox.epoch();
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(sender.take_epoch_change());
    sender.on_ack({"lathe-1", before, 0}, now);  // a new server's empty store
    poll(sender);
  }
  EXPECT_TRUE(sender.take_epoch_change());
  EXPECT_NE(outbox.epoch(), before);
  EXPECT_EQ(outbox.unacknowledged(), 2u);
}

TEST_F(RecordSenderTest, AServerThatIsAheadOfUsGetsANewEpochAtOnce) {
  RecordSender sender = make();
  append(2);
  sender.on_server(true);
  const std::uint64_t before = outbox.epoch();
  sender.on_ack({"lathe-1", before, 3}, now);
  append(5);  // our numbers pass the one it named
  sender.on_ack({"lathe-1", before, 3}, now);
  poll(sender);
  EXPECT_TRUE(sender.take_epoch_change());
  EXPECT_EQ(outbox.unacknowledged(), 7u);
}

TEST_F(RecordSenderTest, TheRecordsOfALaterEpochAreReadAfterThoseOfAnEarlierOne) {
  for (int i = 0; i < 20; ++i) {
    const std::uint64_t before = outbox.epoch();
    ASSERT_TRUE(outbox.begin_epoch());
    EXPECT_GT(outbox.epoch(), before);
    EXPECT_LT(outbox.epoch(), 1ULL << 63);
  }
}

class LossyLink : public RecordSenderTest, public testing::WithParamInterface<unsigned> {};

TEST_P(LossyLink, DeliversEveryRecordOnceAndInOrder) {
  std::mt19937 random(GetParam());
  const auto chance = [&](int percent) {
    return std::uniform_int_distribution<>(0, 99)(random) < percent;
  };
  LossyServer server;
  server.epoch = outbox.epoch();
  RecordSender sender("lathe-1", outbox, {}, [&](const dds::Record& record) {
    if (chance(5)) return false;
    if (chance(20)) return true;  // lost
    server.take(record);
    if (chance(10)) server.take(record);
    return true;
  });
  sender.on_server(true);
  for (int turn = 0; turn < 5000; ++turn) {
    if (turn < 20) append(30);
    now += milliseconds(100);
    if (chance(3)) sender.on_server(false);
    if (chance(50)) sender.on_server(true);
    poll(sender);
    if (chance(60)) sender.on_ack({"lathe-1", server.epoch, server.stored.size()}, now);
    if (turn >= 20 && outbox.unacknowledged() == 0) break;
  }
  ASSERT_EQ(server.stored.size(), 600u);
  for (std::size_t i = 0; i < server.stored.size(); ++i)
    EXPECT_EQ(server.stored[i], std::to_string(i + 1));
  EXPECT_EQ(outbox.unacknowledged(), 0u);
}

INSTANTIATE_TEST_SUITE_P(, LossyLink, testing::Range(0u, 5u));

TEST(StatusPublisher, SendsOnChangeAtMostTenTimesASecondAndAHeartbeat) {
  int sent = 0;
  StatusPublisher publisher([&](const dds::Status&) { return ++sent > 0; });
  SteadyTime now{std::chrono::hours(1)};
  dds::Status status;
  for (int ms = 0; ms < 1000; ms += 5) {
    status.executed = static_cast<std::uint64_t>(ms);
    publisher.offer(status, now + milliseconds(ms));
  }
  EXPECT_EQ(sent, 10);
  for (int ms = 1000; ms < 4000; ms += 5) publisher.offer(status, now + milliseconds(ms));
  EXPECT_GE(sent, 13);
  EXPECT_LE(sent, 14);
}

/// A switch that is released changes nothing else when no run is there.
TEST(StatusPublisher, SendsSwitchesAndCoordinatesAsTheyChange) {
  int sent = 0;
  StatusPublisher publisher([&](const dds::Status&) { return ++sent > 0; });
  SteadyTime now{std::chrono::hours(1)};
  dds::Status status;
  publisher.offer(status, now);
  status.emergency_stop = true;
  publisher.offer(status, now += milliseconds(200));
  EXPECT_EQ(sent, 2);
  status.coordinates.emplace();
  publisher.offer(status, now += milliseconds(200));
  EXPECT_EQ(sent, 3);
  publisher.offer(status, now += milliseconds(200));
  EXPECT_EQ(sent, 3);
  status.waits_for = dds::WaitsFor::CycleStart;
  publisher.offer(status, now += milliseconds(200));
  EXPECT_EQ(sent, 4);
  status.remote_enable = dds::RemoteEnable::Given;
  publisher.offer(status, now += milliseconds(200));
  EXPECT_EQ(sent, 5);
}

}  // namespace
}  // namespace dripline::report
