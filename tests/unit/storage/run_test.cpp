#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class RunTest : public ContractTest {
 protected:
  void SetUp() override {
    run_ = make_run("r1");
    ASSERT_TRUE(store_->runs.create(run_));
  }
  RunState state() { return store_->runs.find("r1").value().state; }
  Run run_;
};

TEST_P(RunTest, ComesBackAsItWasCreated) {
  const auto found = store_->runs.find("r1");
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_EQ(found->machine, "m1");
  EXPECT_EQ(found->program, "p.nc");
  EXPECT_EQ(found->revision, 1u);
  EXPECT_EQ(found->content, run_.content);
  EXPECT_EQ(found->size, run_.size);
  EXPECT_EQ(found->control, "centurion");
  EXPECT_EQ(found->state, RunState::Ordered);
  EXPECT_EQ(found->sequence, -1);
  EXPECT_EQ(found->author, "operator");
  EXPECT_EQ(found->created, clock_.now());
  EXPECT_FALSE(found->started || found->ended || found->executed_content ||
               found->content_verified);
}

TEST_P(RunTest, OneUnfinishedRunPerMachine) {
  Run second = run_;
  second.id = "r2";
  const auto refused = store_->runs.create(second);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Busy);
  EXPECT_NE(refused.error().what.find("r1"), std::string::npos) << refused.error().what;
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Refused, "no answer"));
  EXPECT_TRUE(store_->runs.create(second));
}

TEST_P(RunTest, NeedsAKnownMachineRevisionAndItsVeryContent) {
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Refused, ""));
  Run run = run_;
  run.id = "r2";
  run.machine = "nowhere";
  EXPECT_EQ(store_->runs.create(run).error().code, Errc::NotFound);
  run.machine = "m1";
  run.revision = 9;
  EXPECT_EQ(store_->runs.create(run).error().code, Errc::NotFound);
  run.revision = 1;
  run.content = sha256("other");
  EXPECT_EQ(store_->runs.create(run).error().code, Errc::Conflict);
  run.content = run_.content;
  run.id = "r1";
  EXPECT_EQ(store_->runs.create(run).error().code, Errc::Conflict);
  EXPECT_EQ(store_->runs.list({}, {})->size(), 1u);
}

TEST_P(RunTest, KeepsItsRevisionWhenTheProgramIsReplaced) {
  ASSERT_TRUE(push("p.nc", "G00 X99.\n"));
  EXPECT_EQ(store_->runs.find("r1")->revision, 1u);
  EXPECT_EQ(pull(store_->runs.find("r1")->content), "G00 X1.\nM30\n");
}

TEST_P(RunTest, GoesFromOrderedToActiveToAnEnd) {
  clock_.advance(std::chrono::seconds(1));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Active, ""));
  EXPECT_EQ(store_->runs.find("r1")->started, clock_.now());
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Active, "")) << "again is no error";
  EXPECT_EQ(store_->runs.set_state("r1", RunState::Ordered, "").error().code, Errc::Conflict);
  clock_.advance(std::chrono::seconds(1));
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Interrupted, "power"));
  EXPECT_EQ(store_->runs.find("r1")->ended, clock_.now());
  EXPECT_EQ(store_->runs.find("r1")->reason, "power");
}

TEST_P(RunTest, NeverLeavesAFinalState) {
  for (const RunState end : {RunState::Completed, RunState::Aborted, RunState::Alarmed,
                             RunState::Interrupted, RunState::Refused}) {
    if (end != RunState::Completed) {
      Run next = run_;
      next.id = std::string(to_string(end));
      ASSERT_TRUE(store_->runs.create(next));
    }
    const std::string id = end == RunState::Completed ? "r1" : std::string(to_string(end));
    ASSERT_TRUE(store_->runs.set_state(id, end, "why"));
    for (const RunState other : {RunState::Ordered, RunState::Active, RunState::Completed,
                                 RunState::Aborted, RunState::Refused}) {
      if (other == end) continue;
      EXPECT_EQ(store_->runs.set_state(id, other, "x").error().code, Errc::Conflict)
          << to_string(end) << " to " << to_string(other);
    }
    EXPECT_EQ(store_->runs.find(id)->state, end);
    EXPECT_EQ(store_->runs.find(id)->reason, "why");
  }
}

TEST_P(RunTest, UnknownOnesAreNotFound) {
  EXPECT_EQ(store_->runs.find("x").error().code, Errc::NotFound);
  EXPECT_EQ(store_->runs.set_state("x", RunState::Active, "").error().code, Errc::NotFound);
  EXPECT_EQ(store_->runs.update_counters({"m1", "x", {}, 0, 0}).error().code, Errc::NotFound);
}

TEST_P(RunTest, HasTheProgramsThatItCalled) {
  const auto second = push("O0002", "M99\n");
  const RunCall call{"2", "O0002", 1, second->content};
  ASSERT_TRUE(store_->runs.add_call("r1", call));
  ASSERT_TRUE(store_->runs.add_call("r1", call)) << "again changes nothing";
  EXPECT_EQ(store_->runs.calls("r1").value(), std::vector{call});
  RunCall other = call;
  other.content = sha256("other");
  EXPECT_EQ(store_->runs.add_call("r1", other).error().code, Errc::Conflict);
  EXPECT_EQ(store_->runs.add_call("x", call).error().code, Errc::NotFound);
  EXPECT_EQ(store_->runs.add_call("r1", {"3", "O0003", 1, {}}).error().code, Errc::NotFound);
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Aborted, ""));
  EXPECT_EQ(store_->runs.add_call("r1", {"O2", "O0002", 1, call.content}).error().code,
            Errc::Conflict);
  reopen();
  EXPECT_EQ(store_->runs.calls("r1").value(), std::vector{call});
  EXPECT_TRUE(store_->runs.calls("x").value().empty());
}

TEST_P(RunTest, CallsAtMost128Programs) {
  const auto called = push("O0002", "M99\n");
  for (std::size_t i = 0; i < RunCall::kMax; ++i)
    ASSERT_TRUE(store_->runs.add_call("r1", {fmt::format("{}", i), "O0002", 1, called->content}));
  const auto refused = store_->runs.add_call("r1", {"one more", "O0002", 1, called->content});
  EXPECT_EQ(refused.error().code, Errc::LimitExceeded);
}

TEST_P(RunTest, CountersOnlyGoForward) {
  ASSERT_TRUE(store_->runs.update_counters({"m1", "r1", {1000, 50, 40}, 41, 400}));
  ASSERT_TRUE(store_->runs.update_counters({"m1", "r1", {900, 60, 30}, 31, 300}));
  const auto run = store_->runs.find("r1");
  EXPECT_EQ(run->counters.sent, 1000u);
  EXPECT_EQ(run->counters.accepted, 60u);
  EXPECT_EQ(run->counters.executed, 40u);
  EXPECT_EQ(run->line, 41u) << "belongs to the block executed last";
  EXPECT_EQ(run->sequence, 400);
  EXPECT_EQ(run->state, RunState::Ordered);
}

TEST_P(RunTest, CountersOfManyAreUpdatedAtOnce) {
  const auto updated = store_->runs.update_all_counters(
      {{"m1", "unknown", {}, 0, 0}, {"m2", "r1", {1, 1, 1}, 1, 1}, {"m1", "r1", {9, 8, 7}, 6, 5}});
  ASSERT_EQ(updated.size(), 3U);
  EXPECT_EQ(updated[0].error().code, Errc::NotFound);
  EXPECT_EQ(updated[1].error().code, Errc::Conflict);
  EXPECT_TRUE(updated[2]) << "one that fails does not undo the others";
  EXPECT_EQ(store_->runs.find("r1")->counters.sent, 9U);
}

TEST_P(RunTest, CountersOfAnEndedRunStay) {
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Aborted, ""));
  ASSERT_TRUE(store_->runs.update_counters({"m1", "r1", {1000, 50, 40}, 41, 400}));
  EXPECT_EQ(store_->runs.find("r1")->counters.sent, 0u);
}

TEST_P(RunTest, CountersOfAnotherMachineAreRefused) {
  const auto refused = store_->runs.update_counters({"m2", "r1", {1000, 50, 40}, 41, 400});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_EQ(refused.error().what, "run r1 is machine m1's, not m2's");
  EXPECT_EQ(store_->runs.find("r1")->counters.sent, 0u);
}

TEST_P(RunTest, ListingIsNewestFirstAndFiltered) {
  ASSERT_TRUE(store_->runs.set_state("r1", RunState::Completed, ""));
  Machine other{"m2", "tnc155", "", "", 1, 0, clock_.now(), clock_.now()};
  ASSERT_TRUE(store_->machines.save(other));
  const auto revision = push("q.nc", "M2\n");
  Run run = run_;
  run.id = "r2";
  run.machine = "m2";
  run.program = "q.nc";
  run.content = revision->content;
  ASSERT_TRUE(store_->runs.create(run));
  const auto ids = [&](const RunFilter& filter, Page page = {}) {
    std::string text;
    const auto all = store_->runs.list(filter, page);
    for (const Run& found : *all) text += found.id + " ";
    if (page.limit > 1) {
      EXPECT_EQ(store_->runs.count(filter).value_or(99), all->size());
    }
    return text;
  };
  EXPECT_EQ(ids({}), "r2 r1 ");
  EXPECT_EQ(ids({}, {.limit = 1, .offset = 1}), "r1 ");
  EXPECT_EQ(ids({.machine = "m1", .program = {}, .state = {}}), "r1 ");
  EXPECT_EQ(ids({.machine = {}, .program = "q.nc", .state = {}}), "r2 ");
  EXPECT_EQ(ids({.machine = {}, .program = {}, .state = RunState::Completed}), "r1 ");
  EXPECT_EQ(ids({.machine = "m2", .program = "p.nc", .state = {}}), "");
  EXPECT_EQ(ids({.machine = {}, .program = {}, .state = {}, .with_outputs = true}), "");
  ASSERT_TRUE(store_->records.store(make_batch(1, 3)));
  EXPECT_EQ(ids({.machine = {}, .program = {}, .state = {}, .with_outputs = true}), "r1 ");
}

TEST_P(RunTest, EveryStateHasAWordOfItsOwn) {
  for (int i = 0; i <= static_cast<int>(RunState::Refused); ++i) {
    const auto state = static_cast<RunState>(i);
    EXPECT_EQ(parse_run_state(to_string(state)), state);
  }
  EXPECT_EQ(parse_run_state("dreaming").error().code, Errc::Syntax);
}

class MachineTest : public ContractTest {};

TEST_P(MachineTest, IsAddedOnceAndThenUpdated) {
  Machine machine{"m1", "centurion", "lathe", "0.1", 7, 99, clock_.now(), clock_.now()};
  ASSERT_TRUE(store_->machines.save(machine));
  const auto first_seen = clock_.now();
  clock_.advance(std::chrono::hours(1));
  machine.description = "the lathe";
  machine.first_seen = machine.last_seen = clock_.now();
  ASSERT_TRUE(store_->machines.save(machine));
  const auto found = store_->machines.find("m1");
  ASSERT_TRUE(found) << found.error().what;
  EXPECT_EQ(found->description, "the lathe");
  EXPECT_EQ(found->first_seen, first_seen);
  EXPECT_EQ(found->last_seen, clock_.now());
  EXPECT_EQ(found->last_record, 0u) << "no record is stored, whatever the caller says";
  EXPECT_EQ(store_->machines.list()->size(), 1u);
}

TEST_P(MachineTest, KnowsTheLastRecordOfEachEpoch) {
  Machine machine{"m1", "centurion", "", "", 7, 0, clock_.now(), clock_.now()};
  ASSERT_TRUE(store_->machines.save(machine));
  ASSERT_TRUE(store_->records.store(make_batch(1, 5)));
  EXPECT_EQ(store_->machines.find("m1")->last_record, 5u);
  machine.epoch = 8;
  ASSERT_TRUE(store_->machines.save(machine));
  EXPECT_EQ(store_->machines.find("m1")->last_record, 0u);
  machine.epoch = 7;
  ASSERT_TRUE(store_->machines.save(machine));
  EXPECT_EQ(store_->machines.find("m1")->last_record, 5u);
}

TEST_P(MachineTest, BadNamesAndUnknownOnesAreRefused) {
  EXPECT_EQ(store_->machines.save({"../m", "", "", "", 0, 0, {}, {}}).error().code, Errc::Syntax);
  EXPECT_EQ(store_->machines.find("m9").error().code, Errc::NotFound);
}

class AuditTest : public ContractTest {};

TEST_P(AuditTest, EntriesComeNewestFirst) {
  for (const char* what : {"push", "start", "abort"}) {
    ASSERT_TRUE(store_->audit.add({clock_.now(), "cam", what, "p.nc", "{}"}));
  }
  reopen();
  const auto page = store_->audit.list({.limit = 2, .offset = 0});
  ASSERT_TRUE(page);
  ASSERT_EQ(page->size(), 2u);
  EXPECT_EQ(page->at(0).action, "abort");
  EXPECT_EQ(page->at(1).action, "start");
  EXPECT_EQ(page->at(0).time, clock_.now());
  EXPECT_EQ(page->at(0).who.name, "cam");
}

ON_BOTH_ENGINES(RunTest);
ON_BOTH_ENGINES(MachineTest);
ON_BOTH_ENGINES(AuditTest);

}  // namespace
}  // namespace dripline::storage
