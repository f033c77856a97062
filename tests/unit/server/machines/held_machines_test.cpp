#include "server/machines/held_machines.hpp"

#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/api/fake_machines.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::machines {
namespace {

using server_test::FakeMachines;

/// lathe-1 with an active run r1.
class HeldMachinesTest : public server_test::ServerTest {
 protected:
  HeldMachinesTest() {
    add_machine("lathe-1");
    EXPECT_TRUE(store_->runs.create(run_of(push("O0100", "O0100\nM30\n"), "r1")));
    EXPECT_TRUE(store_->runs.set_state("r1", storage::RunState::Active, ""));
    MachineView view;
    view.machine = *store_->machines.find("lathe-1");
    view.is_connected = true;
    inner_.views = {view};
    start();
    shows(dds::Execution::Active);
  }
  /// As a server that begins.
  void start() {
    reasons_ = std::make_unique<HoldReasons>(HoldReasons::Parts{
        .store = *store_, .clock = clock_, .on_change = [this](const std::string& machine) {
          changes_.push_back(machine);
        }});
    ASSERT_TRUE(reasons_->load());
    machines_ = std::make_unique<HeldMachines>(store_->runs, inner_, *reasons_);
  }
  void shows(dds::Execution execution, const std::string& run = "r1") {
    dds::Status status;
    status.execution = execution;
    status.run = run;
    inner_.views[0].status = status;
  }
  Result<void> command(dds::CommandAction action, const std::string& who,
                       const std::string& reason = "") {
    CommandRequest request;
    request.run = "r1";
    request.action = action;
    request.who = who;
    request.reason = reason;
    return machines_->command(request);
  }
  Result<void> hold_for_scrap() {
    return command(dds::CommandAction::Hold, "report template bore version 1", "part 1 is scrap");
  }
  std::optional<storage::MachineHold> held() {
    const auto listed = machines_->machines().at(0).held;
    const auto one = machines_->machine("lathe-1")->held;
    EXPECT_EQ(listed.has_value(), one.has_value());
    return one;
  }
  std::string reason() {
    const auto hold = held();
    return hold ? hold->who + ": " + hold->reason : "not held";
  }

  FakeMachines inner_;
  std::vector<std::string> changes_;
  std::unique_ptr<HoldReasons> reasons_;
  std::unique_ptr<HeldMachines> machines_;
};

TEST_F(HeldMachinesTest, ShowWhoHoldsThemAndWhyUntilTheyAreResumed) {
  ASSERT_TRUE(hold_for_scrap());
  ASSERT_EQ(inner_.commands.size(), 1U);
  EXPECT_EQ(changes_, std::vector<std::string>{"lathe-1"});
  EXPECT_EQ(reason(), "not held") << "it still moves";
  shows(dds::Execution::FeedHold);
  EXPECT_EQ(reason(), "report template bore version 1: part 1 is scrap");
  EXPECT_EQ(held()->run, "r1");
  EXPECT_EQ(held()->since, clock_.now());
  ASSERT_TRUE(command(dds::CommandAction::Resume, "anna"));
  EXPECT_EQ(reason(), "not held") << "whatever its last status says";
  EXPECT_TRUE(store_->machines.holds()->empty());
  EXPECT_EQ(changes_.size(), 2U);
}

TEST_F(HeldMachinesTest, AResumeAtTheMachineItselfEndsIt) {
  ASSERT_TRUE(hold_for_scrap());
  shows(dds::Execution::FeedHold);
  EXPECT_NE(reason(), "not held");
  shows(dds::Execution::Active);
  EXPECT_EQ(reason(), "not held");
  shows(dds::Execution::FeedHold);
  EXPECT_EQ(reason(), "not held") << "the next one is another's";
  EXPECT_TRUE(store_->machines.holds()->empty());
}

TEST_F(HeldMachinesTest, AHoldThatStoppedNothingIsForgotten) {
  ASSERT_TRUE(hold_for_scrap());
  clock_.advance(HoldReasons::kTakesEffect / 2);
  EXPECT_EQ(reason(), "not held");
  EXPECT_EQ(store_->machines.holds()->size(), 1U) << "its status may be late";
  clock_.advance(HoldReasons::kTakesEffect);
  EXPECT_EQ(reason(), "not held");
  EXPECT_TRUE(store_->machines.holds()->empty());
}

TEST_F(HeldMachinesTest, ARestartedServerKnowsWhy) {
  ASSERT_TRUE(hold_for_scrap());
  shows(dds::Execution::FeedHold);
  start();
  EXPECT_EQ(reason(), "report template bore version 1: part 1 is scrap");
  inner_.views[0].status.reset();
  EXPECT_NE(reason(), "not held") << "before its gateway is heard";
  shows(dds::Execution::Active);
  EXPECT_EQ(reason(), "not held") << "it was resumed meanwhile";
}

TEST_F(HeldMachinesTest, ARunThatHasEndedIsNotHeld) {
  ASSERT_TRUE(hold_for_scrap());
  shows(dds::Execution::FeedHold);
  ASSERT_TRUE(store_->runs.set_state("r1", storage::RunState::Aborted, ""));
  reasons_->note(*store_->runs.find("r1"));
  EXPECT_EQ(reason(), "not held");
}

TEST_F(HeldMachinesTest, ARefusedHoldLeavesWhatWasThere) {
  inner_.refusal = Error{Errc::Busy, "tapping"};
  EXPECT_FALSE(hold_for_scrap());
  shows(dds::Execution::FeedHold);
  EXPECT_EQ(reason(), "not held");
  inner_.refusal.reset();
  ASSERT_TRUE(hold_for_scrap());
  inner_.refusal = Error{Errc::Busy, "tapping"};
  EXPECT_FALSE(command(dds::CommandAction::Hold, "anna"));
  EXPECT_EQ(reason(), "report template bore version 1: part 1 is scrap");
}

TEST_F(HeldMachinesTest, ATimeoutMayHaveHeldIt) {
  inner_.refusal = Error{Errc::Timeout, "no answer"};
  EXPECT_FALSE(hold_for_scrap());
  shows(dds::Execution::FeedHold);
  EXPECT_NE(reason(), "not held");
}

/// Asks, while the reason is stored, whether the hold is out already; and refuses.
class RefusingStore final : public test_support::MachineStoreDecorator {
 public:
  RefusingStore(const storage::Store& inner, const FakeMachines& machines)
      : MachineStoreDecorator(inner), machines_(machines) {}
  Result<void> hold(const storage::MachineHold&) override {
    commands = machines_.commands.size();
    return fail(Errc::Io, "the disk is full");
  }
  std::optional<std::size_t> commands;

 private:
  const FakeMachines& machines_;
};

TEST_F(HeldMachinesTest, NoHoldWaitsForAStore) {
  RefusingStore refusing(*store_, inner_);
  const storage::Store store = test_support::with(*store_, refusing);
  HoldReasons reasons({.store = store, .clock = clock_});
  HeldMachines machines(store_->runs, inner_, reasons);
  CommandRequest request;
  request.run = "r1";
  request.action = dds::CommandAction::Hold;
  request.who = "anna";
  ASSERT_TRUE(machines.command(request));
  EXPECT_EQ(refusing.commands, 1U) << "it went out first";
  shows(dds::Execution::FeedHold);
  EXPECT_EQ(machines.machine("lathe-1")->held->who, "anna") << "known, though not stored";
}

TEST_F(HeldMachinesTest, APersonsHoldHasHisNameAndHidesNoVerdict) {
  ASSERT_TRUE(command(dds::CommandAction::Hold, "anna"));
  shows(dds::Execution::FeedHold);
  EXPECT_EQ(reason(), "anna: ");
  ASSERT_TRUE(hold_for_scrap());
  EXPECT_EQ(reason(), "report template bore version 1: part 1 is scrap");
  ASSERT_TRUE(command(dds::CommandAction::Hold, "anna"));
  EXPECT_EQ(reason(), "report template bore version 1: part 1 is scrap");
}

TEST_F(HeldMachinesTest, AnotherRunsHoldIsNotShown) {
  ASSERT_TRUE(hold_for_scrap());
  shows(dds::Execution::FeedHold, "r2");
  EXPECT_EQ(reason(), "not held");
}

TEST_F(HeldMachinesTest, TheQueuesHoldIsThereAndOverARestartToo) {
  storage::JobHold hold{
      .machine = "lathe-1", .who = "quality", .reason = "bore is wide", .since = clock_.now()};
  ASSERT_TRUE(store_->jobs.hold(hold, "quality"));
  EXPECT_FALSE(machines_->machine("lathe-1")->queue_hold);
  reasons_->set_queue_hold("lathe-1", hold);
  EXPECT_EQ(machines_->machine("lathe-1")->queue_hold->reason, "bore is wide");
  start();
  EXPECT_EQ(machines_->machine("lathe-1")->queue_hold->who, "quality");
  reasons_->set_queue_hold("lathe-1", {});
  EXPECT_FALSE(machines_->machine("lathe-1")->queue_hold);
}

}  // namespace
}  // namespace dripline::machines
