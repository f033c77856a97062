#include "server/machines/record_ingest.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/api/server_fixture.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

// What the machines report, and when it is acknowledged.

namespace dripline::server_test {

namespace {

using machines::RecordWriter;

/// Refuses with `error` while it has one.
struct RefusingRecords final : test_support::RecordStoreDecorator {
  using RecordStoreDecorator::RecordStoreDecorator;
  Result<std::uint64_t> store(const storage::RecordBatch& batch) override {
    if (error) return fail(*error);
    return RecordStoreDecorator::store(batch);
  }
  std::optional<Error> error;
};

class RecordWriterTest : public ServerTest {
 protected:
  RecordWriterTest() { batch_.machine = "lathe-1"; }

  RefusingRecords records_{*store_};
  std::vector<std::string> faults_;
  RecordWriter writer_{{.store = records_,
                        .machine = "lathe-1",
                        .consequence = "the test waits",
                        .on_fault = [this](const std::string& f) { faults_.push_back(f); }}};
  storage::RecordBatch batch_;
};

TEST_F(RecordWriterTest, PausesLongerFromTryToTryWhileTheStoreRefuses) {
  records_.error = Error{Errc::Io, "disk full"};
  std::vector<std::int64_t> pauses;
  for (int i = 0; i < 7; ++i) {
    EXPECT_FALSE(writer_.store(batch_));
    pauses.push_back(writer_.pause().count());
  }
  EXPECT_EQ(pauses, (std::vector<std::int64_t>{250, 500, 1000, 2000, 4000, 5000, 5000}));
  EXPECT_EQ(faults_, std::vector<std::string>(7, "disk full"));
}

TEST_F(RecordWriterTest, ReportsOnceThatTheStoreTakesRecordsAgain) {
  records_.error = Error{Errc::Io, "disk full"};
  EXPECT_FALSE(writer_.store(batch_));
  records_.error.reset();
  EXPECT_TRUE(writer_.store(batch_));
  EXPECT_TRUE(writer_.store(batch_));
  EXPECT_EQ(writer_.pause().count(), 0);
  EXPECT_EQ(faults_, (std::vector<std::string>{"disk full", ""}));
}

TEST_F(RecordWriterTest, NeverPausesForRecordsThatCannotBeStoredAtAll) {
  records_.error = Error{Errc::Syntax, "a bad name"};
  EXPECT_FALSE(writer_.store(batch_));
  EXPECT_EQ(writer_.pause().count(), 0);
  EXPECT_TRUE(faults_.empty());
}

/// A store on a disk that is full while `is_full`.
struct FullDisk final : test_support::RecordStoreDecorator {
  using RecordStoreDecorator::RecordStoreDecorator;
  Result<std::uint64_t> store(const storage::RecordBatch& batch) override {
    if (is_full && !batch.records.empty()) {
      ++refused;
      return fail(Errc::Io, "database or disk is full");
    }
    return RecordStoreDecorator::store(batch);
  }
  std::atomic<bool> is_full{false};
  std::atomic<int> refused{0};
};

class RecordIngestTest : public MachineServiceTest {
 protected:
  std::string running(const std::string& text) {
    push("O0100", text);
    if (!service_) start_service();
    announce();
    answer_commands(true);
    const auto run = start("O0100");
    EXPECT_TRUE(run) << run.error().what;
    return run ? run->id : "";
  }
};

TEST_F(RecordIngestTest, AreAcknowledgedOnceTheyAreStored) {
  const std::string run = running("M30\n");
  for (std::uint64_t n = 1; n <= 100; ++n) {
    record(n, run, dds::RecordKind::Output, fmt::format("LINE {}", n));
  }
  ASSERT_TRUE(wait_ack(100));
  const auto stored = store_->records.of_run(run, "output", {.limit = 1000, .offset = 0});
  ASSERT_TRUE(stored);
  ASSERT_EQ(stored->size(), 100u);
  EXPECT_EQ(stored->back().text, "LINE 100");
}

/// Of many machines at once: each has its own acknowledgment.
TEST_F(RecordIngestTest, OfManyMachinesAreStoredTogetherAndAcknowledgedEach) {
  start_service();
  constexpr std::uint64_t kMachines = 300, kRecords = 5;
  for (std::uint64_t n = 1; n <= kRecords; ++n) {
    for (std::uint64_t m = 1; m <= kMachines; ++m) {
      dds::Record record;
      record.machine = fmt::format("mill-{}", m);
      record.epoch = kEpoch;
      record.number = n;
      record.kind = dds::RecordKind::Output;
      record.text = "X";
      network_.on_record(record);
    }
  }
  const auto acknowledged = [&] {
    std::set<std::string> machines;
    for (const auto& ack : written_->acks) {
      if (ack.number == kRecords) machines.insert(ack.machine);
    }
    return machines.size();
  };
  ASSERT_TRUE(written_->wait([&] { return acknowledged() == kMachines; }));
  EXPECT_EQ(store_->records.of_machine_after("mill-300", {kEpoch, 0}, 100)->size(), kRecords);
}

TEST_F(RecordIngestTest, AreStoredOnceHoweverOftenTheyCome) {
  const std::string run = running("M30\n");
  for (int i = 0; i < 3; ++i) {
    for (std::uint64_t n = 1; n <= 5; ++n) record(n, run, dds::RecordKind::Output, "X");
  }
  ASSERT_TRUE(wait_ack(5));
  service_->end();
  EXPECT_EQ(store_->records.of_run(run, "output", {.limit = 1000, .offset = 0})->size(), 5u);
}

TEST_F(RecordIngestTest, AfterAGapAreNotAcknowledged) {
  const std::string run = running("M30\n");
  record(1, run, dds::RecordKind::Output, "one");
  record(3, run, dds::RecordKind::Output, "three");
  ASSERT_TRUE(wait_ack(1));
  record(2, run, dds::RecordKind::Output, "two");
  record(3, run, dds::RecordKind::Output, "three");
  ASSERT_TRUE(wait_ack(3));
  EXPECT_EQ(store_->records.of_run(run, "output", {})->size(), 3u);
}

TEST_F(RecordIngestTest, OfAnUnknownRunAreKept) {
  start_service();
  announce();
  record(1, "a-run-of-another-server", dds::RecordKind::Output, "X");
  record(2, "a-run-of-another-server", dds::RecordKind::RunEnded, completed("X", 1));
  EXPECT_TRUE(wait_ack(2));
}

TEST_F(RecordIngestTest, AreKeptBackWhileTheDiskIsFullAndStoredAfterwards) {
  FullDisk disk(*store_);
  storage::Store store = test_support::with(*store_, disk);
  start_service(store);
  const std::string run = running("M30\n");
  disk.is_full = true;
  for (std::uint64_t n = 1; n <= 5; ++n) record(n, run, dds::RecordKind::Output, "X");
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (disk.refused == 0 && std::chrono::steady_clock::now() < limit) std::this_thread::yield();
  EXPECT_GT(disk.refused, 0);
  EXPECT_TRUE(written_->acks.empty());
  disk.is_full = false;
  EXPECT_TRUE(wait_ack(5));
  EXPECT_EQ(store_->records.of_run(run, "output", {})->size(), 5u);
  service_.reset();  // before the store it uses
}

TEST_F(RecordIngestTest, ThatCanNeverBeStoredDoNotHoldUpTheOthers) {
  const std::string run = running("M30\n");
  dds::Record impossible;
  impossible.machine = "lathe-1";
  impossible.epoch = 1ULL << 63;
  impossible.number = 1;
  network_.on_record(impossible);
  record(1, run, dds::RecordKind::Output, "X");
  ASSERT_TRUE(wait_ack(1));
  EXPECT_EQ(written_->acks.back().epoch, kEpoch);
}

TEST_F(RecordIngestTest, TellANewcomerWhatIsOnDiskAlready) {
  const std::string run = running("M30\n");
  record(1, run, dds::RecordKind::Output, "X");
  ASSERT_TRUE(wait_ack(1));
  {
    const std::lock_guard lock(written_->mutex);
    written_->acks.clear();
  }
  announce();
  EXPECT_TRUE(wait_ack(1));
}

TEST_F(RecordIngestTest, EndARunWithItsCountersAndAVerdictOnItsBytes) {
  const std::string text = "O1\nM30\n";
  const std::string run = running(text);
  record(1, run, dds::RecordKind::RunStarted,
         dds::encode(dds::RunStartText{.program = "O0100",
                                       .revision = sha256(text).hex(),
                                       .control = "centurion",
                                       .setup = sha256("[[tool]]").hex()}));
  record(2, run, dds::RecordKind::RunEnded, completed(text, 2));
  ASSERT_TRUE(wait_ack(2));
  const auto ended = store_->runs.find(run);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->state, storage::RunState::Completed);
  EXPECT_EQ(ended->counters.executed, 2u);
  EXPECT_TRUE(ended->started.has_value());
  EXPECT_EQ(ended->gateway_setup, sha256("[[tool]]").hex());
  EXPECT_EQ(ended->content_verified, true);
  EXPECT_TRUE(
      wait_notified(runs_, [](const Run& r) { return r.state == storage::RunState::Completed; }));
}

TEST_F(RecordIngestTest, VerifyTheBytesOfARunThatWasCutOff) {
  const std::string text = "O1\nG0 X1\nM30\n";
  const std::string run = running(text);
  dds::RunEndText cut;
  cut.outcome = dds::RunOutcome::Interrupted;
  cut.reason = "interrupted at block 1";
  cut.executed = 1;
  cut.motion_seconds = 1.5;
  cut.path_mm = 20;
  cut.content_length = 5;
  cut.content_sha256 = sha256(text.substr(0, 5)).hex();
  record(1, run, dds::RecordKind::RunEnded, dds::encode(cut));
  ASSERT_TRUE(wait_ack(1));
  const auto ended = store_->runs.find(run);
  EXPECT_EQ(ended->state, storage::RunState::Interrupted);
  EXPECT_EQ(ended->reason, "interrupted at block 1");
  EXPECT_EQ(ended->statistics, (storage::RunStatistics{1.5, 20}));
  EXPECT_EQ(ended->content_verified, true);
}

/// The gateway's clock is an hour off; what the run shows is in our time.
TEST_F(RecordIngestTest, OfAGatewayWithAnotherTimeOfDayAreSetRight) {
  const std::string run = running("M30\n");
  const UtcTime created = store_->runs.find(run)->created;
  gateway_ahead_ = std::chrono::hours(-1);
  for (int i = 0; i < 4; ++i) heartbeat();
  clock_.advance(std::chrono::seconds(10));
  record(1, run, dds::RecordKind::RunStarted, dds::encode(dds::RunStartText{}));
  clock_.advance(std::chrono::seconds(10));
  record(2, run, dds::RecordKind::RunEnded, completed("M30\n", 1));
  ASSERT_TRUE(wait_ack(2));
  const auto ended = store_->runs.find(run);
  ASSERT_TRUE(ended->started && ended->ended);
  EXPECT_GE(*ended->started, created);
  EXPECT_EQ(*ended->ended, created + std::chrono::seconds(20));
  EXPECT_EQ(store_->records.of_run(run, "", {})->at(1).time, *ended->ended - std::chrono::hours(1))
      << "the record keeps the gateway's own";
}

TEST_F(RecordIngestTest, OfAnotherMachinesRunNeitherEndItNorAreItsLines) {
  const std::string run = running("M30\n");
  announce("mill-9");
  dds::Record forged;
  forged.machine = "mill-9";
  forged.epoch = kEpoch;
  forged.number = 1;
  forged.time = clock_.now();
  forged.run = run;
  forged.kind = dds::RecordKind::Output;
  forged.text = "FORGED";
  network_.on_record(forged);
  forged.number = 2;
  forged.kind = dds::RecordKind::RunEnded;
  forged.text = completed("M30\n", 1);
  network_.on_record(forged);
  ASSERT_TRUE(wait_ack(2)) << "kept";
  dds::Status status;
  status.machine = "mill-9";
  status.session = kSession;
  status.run = run;
  status.sent = 1000;
  status.executed = 77;
  network_.on_status(status);
  EXPECT_EQ(store_->runs.find(run)->state, storage::RunState::Active);
  EXPECT_TRUE(store_->records.of_run(run, "", {})->empty());
  record(1, run, dds::RecordKind::RunEnded, completed("M30\n", 1));
  EXPECT_TRUE(wait_notified(
      runs_, [&](const Run& r) { return r.id == run && r.state == storage::RunState::Completed; }));
  service_->end();
  EXPECT_EQ(store_->runs.find(run)->counters.executed, 1u);
  for (const auto& record : records_) EXPECT_NE(record.text, "FORGED");
}

/// A list of chunks that is not the revision's: nothing is begun.
TEST_F(RecordIngestTest, DoNotComeOfARunWhoseProgramIsDamaged) {
  const auto revision = push("O0100", "O1\nM30\n");
  ASSERT_TRUE(revision.size > 0);
  struct DamagedContent final : test_support::ProgramStoreDecorator {
    using ProgramStoreDecorator::ProgramStoreDecorator;
    Result<void> verify_content(const Digest& content) override {
      return fail(Errc::Corrupt, "content {}: chunk 3 is not the one that was stored there",
                  content.hex());
    }
  };
  DamagedContent programs(*store_);
  storage::Store damaged = test_support::with(*store_, programs);
  start_service(damaged);
  announce();
  answer_commands(true);
  const auto run = start("O0100");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Corrupt);
  EXPECT_NE(run.error().what.find("chunk 3"), std::string::npos);
  EXPECT_TRUE(written_->commands.empty());
  EXPECT_TRUE(store_->runs.list({}, {})->empty());
  service_.reset();
}

TEST_F(RecordIngestTest, ReportThatTheMachineExecutedOtherBytes) {
  const std::string run = running("O1\nM30\n");
  record(1, run, dds::RecordKind::RunEnded, completed("O1\nM31\n", 2));
  ASSERT_TRUE(wait_ack(1));
  EXPECT_EQ(store_->runs.find(run)->content_verified, false);
}

TEST_F(RecordIngestTest, WithAnUnreadableTextAreStoredAllTheSame) {
  const std::string run = running("M30\n");
  record(1, run, dds::RecordKind::RunEnded, "{broken");
  ASSERT_TRUE(wait_ack(1));
  EXPECT_EQ(store_->runs.find(run)->state, storage::RunState::Active);
}

}  // namespace

}  // namespace dripline::server_test
