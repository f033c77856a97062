#include <limits>

#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class RecordTest : public ContractTest {
 protected:
  std::string numbers(const std::string& run = "r1", const std::string& kind = "", Page page = {}) {
    std::string text;
    const auto found = store_->records.of_run(run, kind, page);
    for (const Record& record : *found) {
      text += fmt::format("{} ", record.number);
    }
    return text;
  }
  static RunEnding ending(RunState state) {
    RunEnding ending;
    ending.run = "r1";
    ending.state = state;
    ending.counters = {12, 2, 2};
    ending.line = 2;
    ending.sequence = 20;
    ending.reason = "M30";
    ending.executed_content = std::string(64, 'a');
    ending.content_verified = true;
    ending.ended = UtcTime{std::chrono::microseconds{5}};
    return ending;
  }
};

TEST_P(RecordTest, ComesBackAsItWasReported) {
  RecordBatch batch = make_batch(1, 1);
  batch.records[0].text = "DPRNT \"quoted\", \xff and\ttabs";
  ASSERT_EQ(store_->records.store(batch), 1u);
  reopen();
  const auto found = store_->records.of_run("r1", "output", {});
  ASSERT_TRUE(found) << found.error().what;
  ASSERT_EQ(found->size(), 1u);
  const Record& record = found->front();
  EXPECT_EQ(record.machine, "m1");
  EXPECT_EQ(record.epoch, 7u);
  EXPECT_EQ(record.number, 1u);
  EXPECT_EQ(record.time, batch.records[0].time);
  EXPECT_EQ(record.run, "r1");
  EXPECT_EQ(record.kind, "output");
  EXPECT_EQ(record.block, 10u);
  EXPECT_EQ(record.line, 11u);
  EXPECT_EQ(record.sequence, 12);
  EXPECT_EQ(record.device, "port1");
  EXPECT_EQ(record.text, batch.records[0].text);
}

TEST_P(RecordTest, OfManyMachinesAreStoredTogether) {
  RecordBatch first = make_batch(1, 3), second = make_batch(1, 2);
  second.machine = "m2";
  for (auto& one : second.records) one.machine = "m2";
  const auto stored = store_->records.store_all({first, second});
  ASSERT_EQ(stored.size(), 2U);
  EXPECT_EQ(stored[0], 3U);
  EXPECT_EQ(stored[1], 2U);
  reopen();
  EXPECT_EQ(store_->records.of_machine_after("m1", {7, 0}, 100)->size(), 3U);
  EXPECT_EQ(store_->records.of_machine_after("m2", {7, 0}, 100)->size(), 2U);
}

TEST_P(RecordTest, ThatCannotBeStoredDoNotKeepOthersFromTheDisk) {
  RecordBatch good = make_batch(1, 3), bad = make_batch(1, 2);
  bad.machine = "m2";  // and its records another's
  const auto stored = store_->records.store_all({good, bad});
  ASSERT_EQ(stored.size(), 2U);
  EXPECT_EQ(stored[0], 3U);
  EXPECT_EQ(stored[1].error().code, Errc::Syntax);
  EXPECT_EQ(store_->records.of_machine_after("m1", {7, 0}, 100)->size(), 3U);
}

TEST_P(RecordTest, OutsideAnyRunAreTheMachinesReport) {
  RecordBatch batch = make_batch(1, 5);
  for (const std::size_t i : {0u, 1u, 2u, 3u}) batch.records[i].run.clear();
  batch.records[1].kind = "probe";
  batch.records[2].kind = "message";
  ASSERT_EQ(store_->records.store(batch), 5u);
  RecordBatch later = make_batch(1, 1);
  later.epoch = later.records[0].epoch = 8;
  later.records[0].run.clear();
  later.records[0].time = batch.records[0].time - std::chrono::hours(1);  // the clock was put back
  ASSERT_EQ(store_->records.store(later), 1u);
  reopen();
  const auto lines = store_->records.machine_report("m1", {}, 100);
  ASSERT_TRUE(lines) << lines.error().what;
  std::string places;
  for (const auto& line : *lines) {
    places += fmt::format("{}.{} {} ", line.epoch, line.number, line.kind);
    EXPECT_EQ(line.machine, "m1");
    EXPECT_EQ(line.run, "");
  }
  EXPECT_EQ(places, "7.1 output 7.2 probe 7.4 output 8.1 output ");
  EXPECT_EQ(store_->records.machine_report("m1", {lines->front().epoch, 1}, 1)->at(0).number, 2u);
  EXPECT_TRUE(store_->records.machine_report("unknown", {}, 100)->empty());
  const auto reports = store_->records.machine_reports();
  ASSERT_EQ(reports->size(), 1u);
  EXPECT_EQ(reports->at(0).machine, "m1");
  EXPECT_EQ(reports->at(0).lines, 4u);
  EXPECT_EQ(reports->at(0).first, later.records[0].time);
}

/// Runs that the server knows and runs that were begun at the machine; the journal of a gateway
/// that lost its own has any epoch.
TEST_P(RecordTest, OfTheControlsMemoryAreFoundByMachineNewestFirst) {
  const auto memory = [](RecordBatch batch, std::initializer_list<std::size_t> places) {
    for (const std::size_t i : places) {
      batch.records[i].kind = "message";
      batch.records[i].device = "memory";
    }
    return batch;
  };
  ASSERT_EQ(store_->records.store(memory(make_batch(1, 4, "r1"), {1, 2})), 4u);
  clock_.advance(std::chrono::seconds(1));
  ASSERT_EQ(store_->records.store(memory(make_batch(5, 6, "line-1"), {0})), 6u);
  clock_.advance(std::chrono::seconds(1));
  RecordBatch other = memory(make_batch(1, 1, "r9"), {0});
  other.epoch = other.records[0].epoch = 3;
  ASSERT_EQ(store_->records.store(other), 1u);
  reopen();
  const auto all = store_->records.memory_reports("m1", std::nullopt, {});
  ASSERT_TRUE(all) << all.error().what;
  ASSERT_EQ(all->size(), 3u);
  EXPECT_EQ(all->at(0).run, "r9");
  EXPECT_EQ(all->at(1).run, "line-1");
  EXPECT_EQ(all->at(2).run, "r1");
  EXPECT_EQ(all->at(2).texts, (std::vector<std::string>{"X2", "X3"}));
  EXPECT_EQ(store_->records.memory_reports("m1", "line-1", {})->at(0).texts,
            std::vector<std::string>{"X5"});
  EXPECT_EQ(
      store_->records.memory_reports("m1", std::nullopt, {.limit = 1, .offset = 1})->at(0).run,
      "line-1");
  EXPECT_TRUE(store_->records.memory_reports("m1", "r2", {})->empty());
  const auto changes = store_->records.memory_changes("m1", "line-", {});
  ASSERT_EQ(changes->size(), 1u) << "of what begins so alone";
  EXPECT_EQ(changes->at(0).run, "line-1");
  EXPECT_TRUE(store_->records.memory_changes("m1", "set-", {})->empty());
  EXPECT_TRUE(store_->records.memory_reports("unknown", std::nullopt, {})->empty());
}

TEST_P(RecordTest, SentAgainAreStoredOnce) {
  EXPECT_EQ(store_->records.store(make_batch(1, 5)), 5u);
  EXPECT_EQ(store_->records.store(make_batch(1, 5)), 5u);
  EXPECT_EQ(store_->records.store(make_batch(3, 8)), 8u);
  EXPECT_EQ(store_->records.store(make_batch(2, 2)), 8u);
  EXPECT_EQ(numbers(), "1 2 3 4 5 6 7 8 ");
}

TEST_P(RecordTest, AfterAGapAreLeftOut) {
  EXPECT_EQ(store_->records.store(make_batch(2, 4)), 0u) << "number 1 is missing";
  EXPECT_EQ(numbers(), "");
  RecordBatch batch = make_batch(1, 6);
  batch.records.erase(batch.records.begin() + 3);
  EXPECT_EQ(store_->records.store(batch), 3u);
  EXPECT_EQ(numbers(), "1 2 3 ");
  EXPECT_EQ(store_->records.store(make_batch(4, 6)), 6u);
  EXPECT_EQ(numbers(), "1 2 3 4 5 6 ");
}

TEST_P(RecordTest, EpochsHaveNumbersOfTheirOwnAndComeInOrder) {
  ASSERT_TRUE(store_->records.store(make_batch(1, 2)));
  RecordBatch later = make_batch(1, 2);
  later.epoch = 8;
  for (Record& record : later.records) record.epoch = 8;
  EXPECT_EQ(store_->records.store(later), 2u);
  EXPECT_EQ(numbers(), "1 2 1 2 ");
  EXPECT_EQ(store_->records.of_run("r1", "", {})->back().epoch, 8u);
}

TEST_P(RecordTest, AreFilteredByKindAndPaged) {
  RecordBatch batch = make_batch(1, 6);
  batch.records[1].kind = batch.records[4].kind = "probe";
  batch.records[5].run = "";
  ASSERT_TRUE(store_->records.store(batch));
  EXPECT_EQ(numbers("r1", "probe"), "2 5 ");
  EXPECT_EQ(numbers("r1", "output"), "1 3 4 ");
  EXPECT_EQ(numbers("r1", "", {.limit = 2, .offset = 1}), "2 3 ");
  EXPECT_EQ(numbers("r1", "output", {.limit = 9, .offset = 2}), "4 ");
  EXPECT_EQ(numbers("unknown"), "");
}

TEST_P(RecordTest, OfAnUnknownMachineOrRunAreKept) {
  EXPECT_EQ(store_->records.store(make_batch(1, 2, "never-heard-of")), 2u);
  EXPECT_EQ(numbers("never-heard-of"), "1 2 ");
  EXPECT_EQ(store_->machines.find("m1")->last_record, 2u);
}

TEST_P(RecordTest, OutputsAreCountedOnceForTheRun) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  RecordBatch batch = make_batch(1, 5);
  batch.records[0].kind = "run_started";
  ASSERT_TRUE(store_->records.store(batch));
  ASSERT_TRUE(store_->records.store(batch));
  EXPECT_EQ(store_->runs.find("r1")->outputs, 4u);
}

TEST_P(RecordTest, BeginAndEndTheRunTheySpeakOf) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  RecordBatch batch = make_batch(1, 1);
  batch.records[0].kind = "run_started";
  const UtcTime started = clock_.now() + std::chrono::seconds(3);
  batch.beginnings.push_back({"r1", started});
  ASSERT_TRUE(store_->records.store(batch));
  EXPECT_EQ(store_->runs.find("r1")->state, RunState::Active);
  EXPECT_EQ(store_->runs.find("r1")->started, started);

  RecordBatch end = make_batch(2, 3);
  end.records[1].kind = "run_ended";
  end.endings.push_back(ending(RunState::Completed));
  end.endings[0].ended = started + std::chrono::seconds(2);
  ASSERT_TRUE(store_->records.store(end));
  const auto run = store_->runs.find("r1");
  EXPECT_EQ(run->state, RunState::Completed);
  EXPECT_EQ(run->counters.sent, 12u);
  EXPECT_EQ(run->counters.executed, 2u);
  EXPECT_EQ(run->line, 2u);
  EXPECT_EQ(run->sequence, 20);
  EXPECT_EQ(run->reason, "M30");
  EXPECT_EQ(run->executed_content, std::string(64, 'a'));
  EXPECT_EQ(run->content_verified, true);
  EXPECT_EQ(run->ended, started + std::chrono::seconds(2));

  ASSERT_TRUE(store_->records.store(batch)) << "an old beginning comes again";
  EXPECT_EQ(store_->runs.find("r1")->state, RunState::Completed);
}

/// A gateway's clock may be anywhere.
TEST_P(RecordTest, NeverEndARunBeforeItBegan) {
  const Run made = make_run("r1");
  ASSERT_TRUE(store_->runs.create(made));
  RecordBatch batch = make_batch(1, 2);
  batch.records[0].kind = "run_started";
  batch.records[1].kind = "run_ended";
  batch.beginnings.push_back({"r1", UtcTime{std::chrono::microseconds{3}}});
  batch.endings.push_back(ending(RunState::Completed));
  clock_.advance(std::chrono::seconds(10));
  ASSERT_TRUE(store_->records.store(batch));
  EXPECT_EQ(store_->runs.find("r1")->started, made.created);
  EXPECT_EQ(store_->runs.find("r1")->ended, made.created);
  EXPECT_EQ(store_->records.of_run("r1", "", {})->at(0).received, clock_.now())
      << "our own time of it";
}

/// A mixed-up or stolen gateway: what it says of another machine's run is kept, and that is all.
TEST_P(RecordTest, OfAnotherMachinesRunChangeNothingOfIt) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  RecordBatch stray = make_batch(1, 3);
  stray.machine = "m2";
  for (Record& record : stray.records) record.machine = "m2";
  stray.records[0].kind = "run_started";
  stray.records[2].kind = "run_ended";
  stray.beginnings.push_back({"r1", clock_.now()});
  stray.endings.push_back(ending(RunState::Completed));
  EXPECT_EQ(store_->records.store(stray), 3u) << "acknowledged, so not lost";
  EXPECT_EQ(store_->runs.find("r1")->state, RunState::Ordered);
  EXPECT_EQ(store_->runs.find("r1")->outputs, 0u);
  EXPECT_EQ(numbers(), "");
  EXPECT_EQ(query("SELECT count(*) FROM record"), 3);
  ASSERT_TRUE(store_->records.store(make_batch(1, 2)));
  EXPECT_EQ(numbers(), "1 2 ");
  EXPECT_EQ(store_->runs.find("r1")->outputs, 2u);
}

TEST_P(RecordTest, EndARunThatWasNeverSeenActive) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  RecordBatch batch = make_batch(1, 1);
  batch.endings.push_back(ending(RunState::Alarmed));
  ASSERT_TRUE(store_->records.store(batch));
  EXPECT_EQ(store_->runs.find("r1")->state, RunState::Alarmed);
}

TEST_P(RecordTest, DoNotChangeARunThatHasEnded) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Refused, "no answer in time"));
  RecordBatch batch = make_batch(1, 1);
  batch.beginnings.push_back({"r1", clock_.now()});
  batch.endings.push_back(ending(RunState::Completed));
  EXPECT_EQ(store_->records.store(batch), 1u) << "the records themselves are kept";
  EXPECT_EQ(store_->runs.find("r1")->state, RunState::Refused);
  EXPECT_EQ(store_->runs.find("r1")->reason, "no answer in time");
}

TEST_P(RecordTest, EndingAfterAGapWaitsForItsRecord) {
  ASSERT_TRUE(store_->runs.create(make_run("r1")));
  RecordBatch batch = make_batch(2, 3);
  batch.records[1].kind = "run_ended";
  batch.endings.push_back(ending(RunState::Completed));
  EXPECT_EQ(store_->records.store(batch), 0u);
  EXPECT_EQ(store_->runs.find("r1")->state, RunState::Ordered);
  ASSERT_TRUE(store_->records.store(make_batch(1, 1)));
  EXPECT_EQ(store_->records.store(batch), 3u);
  EXPECT_EQ(store_->runs.find("r1")->state, RunState::Completed);
}

TEST_P(RecordTest, BatchesThatContradictThemselvesAreRefused) {
  RecordBatch batch = make_batch(1, 2);
  batch.records[1].machine = "m2";
  EXPECT_EQ(store_->records.store(batch).error().code, Errc::Syntax);
  batch = make_batch(1, 2);
  batch.epoch = 8;
  EXPECT_EQ(store_->records.store(batch).error().code, Errc::Syntax);
  batch = make_batch(1, 1);
  batch.epoch = batch.records[0].epoch = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(store_->records.store(batch).error().code, Errc::LimitExceeded);
  batch = make_batch(1, 1);
  batch.endings.push_back(ending(RunState::Active));
  EXPECT_EQ(store_->records.store(batch).error().code, Errc::Syntax);
  EXPECT_EQ(query("SELECT count(*) FROM record"), 0);
}

TEST_P(RecordTest, NumbersOfAnySizeComeBack) {
  RecordBatch batch = make_batch(1, 1);
  batch.records[0].block = batch.records[0].line = std::numeric_limits<std::uint64_t>::max();
  batch.records[0].sequence = std::numeric_limits<std::int64_t>::min();
  ASSERT_TRUE(store_->records.store(batch));
  EXPECT_EQ(store_->records.of_run("r1", "", {})->front().block,
            std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(store_->records.of_run("r1", "", {})->front().sequence,
            std::numeric_limits<std::int64_t>::min());
}

ON_BOTH_ENGINES(RecordTest);

}  // namespace
}  // namespace dripline::storage
