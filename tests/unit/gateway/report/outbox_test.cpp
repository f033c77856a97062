#include "gateway/report/outbox.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <filesystem>
#include <random>
#include <thread>

#include "gateway/report/outbox_schema.hpp"
#include "storage/sqlite/transaction.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::report {
namespace {

dds::Record output(const std::string& text) {
  dds::Record record;
  record.machine = "lathe-1";
  record.run = "run-1";
  record.kind = dds::RecordKind::Output;
  record.block = 12;
  record.line = 3;
  record.sequence = 10;
  record.device = "file";
  record.text = text;
  record.time = UtcTime(std::chrono::microseconds(1'700'000'000'000'001));
  return record;
}

class OutboxTest : public testing::Test {
 protected:
  Outbox open(OutboxOptions options = {}) {
    auto outbox = Outbox::open(file, options);
    if (!outbox) throw std::runtime_error(outbox.error().what);
    return std::move(*outbox);
  }
  static std::vector<std::string> texts(Outbox& outbox, std::uint64_t after = 0) {
    std::vector<std::string> all;
    const auto records = outbox.read("lathe-1", after, 1'000'000);
    for (const auto& record : records.value()) all.push_back(record.text);
    return all;
  }
  test_support::TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "outbox.sqlite";
};

TEST_F(OutboxTest, ShowsRecordsOnlyWhenCommitted) {
  Outbox outbox = open();
  outbox.append(output("A"));
  EXPECT_TRUE(texts(outbox).empty());
  EXPECT_EQ(outbox.last_number(), 0u);
  ASSERT_TRUE(outbox.commit());
  const auto records = outbox.read("lathe-1", 0, 10).value();
  ASSERT_EQ(records.size(), 1u);
  dds::Record expected = output("A");
  expected.epoch = outbox.epoch();
  expected.number = 1;
  EXPECT_EQ(records[0].text, expected.text);
  EXPECT_EQ(records[0].number, 1u);
  EXPECT_EQ(records[0].epoch, outbox.epoch());
  EXPECT_EQ(records[0].time, expected.time);
  EXPECT_EQ(records[0].sequence, 10);
  EXPECT_EQ(records[0].device, "file");
}

TEST_F(OutboxTest, NumbersGoOnAfterARestartEvenWhenAllWasAcknowledged) {
  std::uint64_t epoch = 0;
  {
    Outbox outbox = open();
    epoch = outbox.epoch();
    EXPECT_NE(epoch, 0u);
    for (int i = 0; i < 3; ++i) outbox.append(output("A"));
    ASSERT_TRUE(outbox.commit());
    outbox.acknowledge(3);
    ASSERT_TRUE(outbox.flush());
  }
  Outbox outbox = open();
  EXPECT_EQ(outbox.epoch(), epoch);
  EXPECT_EQ(outbox.unacknowledged(), 0u);
  outbox.append(output("B"));
  ASSERT_TRUE(outbox.commit());
  EXPECT_EQ(outbox.last_number(), 4u);
  EXPECT_EQ(outbox.unacknowledged(), 1u);
}

TEST_F(OutboxTest, AcknowledgedRecordsAreForgotten) {
  Outbox outbox = open();
  for (const char* text : {"A", "B", "C"}) outbox.append(output(text));
  ASSERT_TRUE(outbox.commit());
  outbox.acknowledge(2);
  ASSERT_TRUE(outbox.flush());
  EXPECT_EQ(texts(outbox), std::vector<std::string>{"C"});
  outbox.acknowledge(99);  // more than was ever given
  EXPECT_EQ(outbox.acknowledged(), 3u);
}

TEST_F(OutboxTest, AFullDiskKeepsWhatWasStaged) {
  Outbox outbox = open({.max_bytes = 128 * 1024});
  std::uint64_t kept = 0;
  Result<void> done;
  while (done) {
    outbox.append(output(std::string(4000, 'x')));
    done = outbox.commit();
    if (done) ++kept;
    ASSERT_LT(kept, 1000u);
  }
  EXPECT_EQ(done.error().code, Errc::Io) << done.error().what;
  EXPECT_EQ(outbox.last_number(), kept);
  outbox.acknowledge(kept);
  ASSERT_TRUE(outbox.flush());
  ASSERT_TRUE(outbox.commit());
  EXPECT_EQ(outbox.last_number(), kept + 1);
  EXPECT_EQ(texts(outbox, kept).size(), 1u);
}

TEST_F(OutboxTest, ARunEndsTogetherWithItsRecord) {
  {
    Outbox outbox = open();
    outbox.begin_run({"run-1", "O1", "aa", "centurion", 100});
    ASSERT_TRUE(outbox.commit());
    outbox.append(output("A"));
    outbox.note_progress({50, 9, 7, 3, 10, 42});
    ASSERT_TRUE(outbox.commit());
  }
  {
    Outbox outbox = open();
    ASSERT_TRUE(outbox.active_run().has_value());
    EXPECT_EQ(outbox.active_run()->run, "run-1");
    EXPECT_EQ(outbox.active_run()->size, 100u);
    EXPECT_EQ(outbox.committed_progress(), (Progress{50, 9, 7, 3, 10, 42}));
    outbox.append(output("END"));
    outbox.end_run();
    ASSERT_TRUE(outbox.commit());
  }
  EXPECT_FALSE(open().active_run().has_value());
}

TEST_F(OutboxTest, EveryEpochFitsASignedNumber) {
  Outbox outbox = open();
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(outbox.begin_epoch());
    EXPECT_LT(outbox.epoch(), 1ULL << 63);
  }
}

TEST_F(OutboxTest, RemembersHowOrdersWereAnswered) {
  {
    Outbox outbox = open();
    outbox.add_command_result("order-1", false, "busy");
    outbox.add_command_result("order-1", true, "");  // the first answer is kept
    ASSERT_TRUE(outbox.commit());
  }
  Outbox outbox = open();
  const auto answer = outbox.command_result("order-1").value();
  ASSERT_TRUE(answer.has_value());
  EXPECT_FALSE(answer->is_accepted);
  EXPECT_EQ(answer->reason, "busy");
  EXPECT_FALSE(outbox.command_result("order-2").value().has_value());
}

TEST_F(OutboxTest, AFileOfAnEarlierVersionKeepsItsAnswersAndRecords) {
  {
    auto earlier = storage::sqlite::Database::open(file, {}).value();
    ASSERT_TRUE(storage::sqlite::migrate(earlier, std::span(kOutboxMigrations).first(3)));
    ASSERT_TRUE(earlier.execute(
        "INSERT INTO outbox VALUES (1, 77, 1);"
        "INSERT INTO record VALUES (1, 1700000000000001, 'run-1', 1, 12, 3, 10, 'file', 'A');"
        "INSERT INTO order_result VALUES (1, 'hold-1', 0, 'not running')"));
  }
  Outbox outbox = open();
  EXPECT_EQ(outbox.epoch(), 77u);
  EXPECT_EQ(texts(outbox), std::vector<std::string>{"A"});
  const auto answer = outbox.command_result("hold-1").value();
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->is_accepted);
  EXPECT_EQ(answer->reason, "not running");
}

TEST_F(OutboxTest, ANewEpochNumbersTheRestFromOne) {
  Outbox outbox = open();
  const std::uint64_t before = outbox.epoch();
  for (const char* text : {"A", "B", "C", "D"}) outbox.append(output(text));
  ASSERT_TRUE(outbox.commit());
  outbox.acknowledge(1);
  outbox.append(output("E"));
  ASSERT_TRUE(outbox.begin_epoch());
  EXPECT_NE(outbox.epoch(), before);
  ASSERT_TRUE(outbox.commit());
  EXPECT_EQ(outbox.last_number(), 4u);
  EXPECT_EQ(texts(outbox), (std::vector<std::string>{"B", "C", "D", "E"}));
  EXPECT_EQ(open().last_number(), 4u);
}

/// A child appends and commits in batches of two until it is killed; what is found is a whole
/// number of batches, and the counters fit.
TEST_F(OutboxTest, SurvivesKillsAtAnyMoment) {
  std::mt19937 random(20261121);
  std::uint64_t last = 0;
  { (void)open(); }
  for (int kill_count = 0; kill_count < 12; ++kill_count) {
    const pid_t child = ::fork();
    if (child == 0) {
      auto outbox = Outbox::open(file);
      if (!outbox) ::_exit(1);
      if (!outbox->active_run()) outbox->begin_run({"run-1", "O1", "aa", "centurion", 100});
      for (;;) {
        outbox->append(output("A"));
        outbox->append(output("B"));
        Progress progress;
        progress.executed = outbox->last_number() + 2;
        outbox->note_progress(progress);
        if (!outbox->commit()) ::_exit(1);
      }
    }
    std::this_thread::sleep_for(std::chrono::microseconds(5000 + random() % 30'000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    Outbox outbox = open();
    EXPECT_GE(outbox.last_number(), last);
    last = outbox.last_number();
    EXPECT_EQ(last % 2, 0u);
    EXPECT_EQ(outbox.committed_progress().executed, last);
    const auto all = texts(outbox);
    ASSERT_EQ(all.size(), last);
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i], i % 2 == 0 ? "A" : "B");
  }
  EXPECT_GT(last, 0u);
}

}  // namespace
}  // namespace dripline::report
