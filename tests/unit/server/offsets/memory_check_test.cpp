// A control's memory goes before the setup: a correction must not go from a value that is not in
// force at the machine.
#include "tests/unit/server/offsets/offsets_fixture.hpp"

namespace dripline::offsets {
namespace {

using storage::OffsetState;

class KeptOffsets : public OffsetsTest {
 protected:
  KeptOffsets() { add_machine("lathe-1", "fanuc-t"); }

  /// The control's memory after a run: what its gateway reports then.
  void report_memory(const std::string& run, const std::string& cells) {
    report_text(run, R"({"part":1,"parts":1,"cells":{)" + cells + "}}");
  }
  void report_text(const std::string& run, const std::string& text) {
    ++measured_;
    storage::Record record;
    record.machine = "lathe-1";
    record.epoch = 7;
    record.number = measured_;
    record.time = clock_.now() + std::chrono::seconds(measured_);
    record.run = run;
    record.kind = "message";
    record.device = "memory";
    record.text = text;
    const auto stored = store_->records.store(
        {.machine = "lathe-1", .epoch = 7, .records = {record}, .beginnings = {}, .endings = {}});
    EXPECT_TRUE(stored) << stored.error().what;
  }
  std::string measure_three() {
    measure(40.02);
    measure(40.02);
    return measure(40.02);
  }
  /// Looks, expects nothing to be proposed, and returns the reasons.
  std::string reasons_of_no_proposal() {
    const auto looked = offsets_->look("lathe-1");
    EXPECT_TRUE(looked) << looked.error().what;
    if (!looked || looked->size() != 1) return {};
    EXPECT_FALSE(looked->front().proposal);
    return fmt::format("{}", fmt::join(looked->front().outcome.reasons, "\n"));
  }
  void expect(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
      EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
  }
};

TEST_F(KeptOffsets, NothingIsProposedFromAValueThatTheMemoryHasNot) {
  use_rules("automatic = 0.05\n");
  const std::string run = measure_three();
  report_memory(run, R"("tool.3.x_wear":[0.125,0.1])");
  expect(reasons_of_no_proposal(), {"T3.wear.X is 0.125 in the memory of lathe-1", "tool.3.x_wear",
                                    "0.1 in the setup", "dnc memory clear lathe-1", run});
  EXPECT_EQ(wear(), 0.1);
  EXPECT_TRUE(all().empty());
}

/// Set at the machine, without a run: the same doubt, and it is in the history.
TEST_F(KeptOffsets, WhatAnOperatorHasSetAtTheMachineIsKnown) {
  use_rules("automatic = 0.05\n");
  measure_three();
  report_text("set-order-1",
              R"({"part":1,"parts":2,"cells":{"tool.3.x":[25,1],"tool.3.x_wear":[0,0.1]}})");
  report_text("set-order-1",
              R"({"part":2,"parts":2,"cells":{},"change":{"what":"tool 3 X 30 mm G54","by":"bert",)"
              R"("at":80,"cells":{"tool.3.x":[1,25],"tool.3.x_wear":[0.1,0]}}})");
  expect(reasons_of_no_proposal(),
         {"T3.wear.X is 0 in the memory of lathe-1", "set by bert: tool 3 X 30 mm G54"});
  const auto changes = offsets_->history().at_machine({"lathe-1", "set-", "T3"}, {});
  ASSERT_TRUE(changes) << changes.error().what;
  ASSERT_EQ(changes->size(), 1U);
  const MachineChange& change = changes->front();
  EXPECT_EQ(change.target, "T3.X");
  EXPECT_EQ(change.change, "set-order-1");
  EXPECT_EQ(change.what.by, "bert");
  EXPECT_EQ(change.what.cells.at("tool.3.x"), std::pair(std::optional(1.0), 25.0));
  EXPECT_TRUE(offsets_->history().at_machine({"lathe-1", "set-", "G54"}, {})->empty());
  EXPECT_TRUE(offsets_->history().at_machine({"lathe-1", "set-", "T3.Z"}, {})->empty());
}

TEST_F(KeptOffsets, APendingOneIsNotApprovedWhenTheMemoryHasAnotherValueByNow) {
  use_rules();
  const std::string run = measure_three();
  const auto proposal = only_proposal();
  report_memory(run, R"("tool.3.x_wear":[0.125,0.1])");
  const auto approved = offsets_->approve({.id = proposal.id, .who = "anna", .time = {}});
  ASSERT_FALSE(approved);
  EXPECT_EQ(approved.error().code, Errc::Conflict);
  expect(approved.error().what, {"0.125 in the memory", "0.1 in the setup", "dnc memory restore"});
  EXPECT_EQ(wear(), 0.1);
  ASSERT_TRUE(offsets_->look("lathe-1"));
  EXPECT_EQ(store_->offsets.find(proposal.id)->state, OffsetState::Superseded);
}

TEST_F(KeptOffsets, OtherCellsAndTheSameValueAreNoReason) {
  use_rules();
  const std::string run = measure_three();
  report_memory(run, R"("tool.3.x_wear":[0.1,0.1],"tool.4.x_wear":[0.5,0],"#500":[7,null])");
  const auto proposal = only_proposal();
  const auto approved = offsets_->approve({.id = proposal.id, .who = "anna", .time = {}});
  ASSERT_TRUE(approved) << approved.error().what;
  EXPECT_DOUBLE_EQ(wear(), 0.09);
}

/// The gateway drops a kept number when the setup gives the cell something else.
TEST_F(KeptOffsets, AMemoryUnderAnEarlierValueOfTheSetupIsDroppedAtTheMachine) {
  use_rules();
  const std::string run = measure_three();
  report_memory(run, R"("tool.3.x_wear":[0.125,0.1])");
  save_setup("units = \"mm\"\n[[tool]]\nnumber = 3\nwear = { X = 0.15 }\n", "as it is there");
  measure_three();
  EXPECT_DOUBLE_EQ(only_proposal().new_value, 0.14);
}

/// A program has set it back: what was cut meanwhile was cut under the other number.
TEST_F(KeptOffsets, WhatWasCutUnderAnotherNumberOfTheMemoryNeverCounts) {
  use_rules();
  const std::string run = measure_three();
  report_memory(run, R"("tool.3.x_wear":[0.125,0.1])");
  measure_three();
  report_memory(measure(40.02), R"("tool.3.x_wear":[0.1,0.1])");
  expect(reasons_of_no_proposal(),
         {"7 measurements of D40 are left out: cut while the control's memory had, or may have "
          "had, another number for T3.wear.X",
          "0 measurements under the value in force"});
  measure_three();
  EXPECT_EQ(only_proposal().used, 3U);
}

/// As the reason advises: the setup gives the memory its number for a start.
TEST_F(KeptOffsets, NorAfterTheMemoryWasClearedByASetup) {
  use_rules();
  const std::string run = measure_three();
  report_memory(run, R"("tool.3.x_wear":[0.125,0.1])");
  measure_three();
  save_setup(std::string(kSetup) + "[[variable]]\nname = \"tool.3.x_wear\"\nvalue = 0.1\n",
             "memory cleared");
  report_memory(measure(40.02), R"("tool.3.x_wear":[0.1,0.1])");
  save_setup(kSetup, "the variable taken out");
  expect(reasons_of_no_proposal(),
         {"7 measurements of D40 are left out: cut before setup 3, when variable tool.3.x_wear was "
          "0.1"});
}

TEST_F(KeptOffsets, AMemoryWhoseSetupCannotBeToldIsADoubt) {
  use_rules();
  measure_three();
  report_memory("at-the-machine", R"("tool.3.x_wear":[0.125,0.07])");
  expect(reasons_of_no_proposal(), {"T3.wear.X is 0.125 in the memory of lathe-1"});
}

TEST_F(KeptOffsets, AMemoryThatCannotBeReadIsADoubt) {
  use_rules();
  const std::string run = measure_three();
  report_text(run, R"({"part":1,"parts":2,"cells":{}})");
  expect(reasons_of_no_proposal(), {"is not known", run, "1 of 2 parts of a memory"});
}

TEST_F(KeptOffsets, AVariableThatGoesBeforeTheToolIsNamed) {
  use_rules();
  save_setup(std::string(kSetup) + "[[variable]]\nname = \"tool.3.x_wear\"\nvalue = 0.1\n",
             "memory cleared");
  measure_three();
  expect(reasons_of_no_proposal(), {"the variable tool.3.x_wear of the setup decides"});
}

TEST_F(KeptOffsets, NothingIsAppliedWhileARunMayChangeTheMemory) {
  use_rules("automatic = 0.05\n");
  measure_three();
  Run run = run_of(revision_, "run-now");
  run.setup = 1;
  ASSERT_TRUE(store_->runs.create(run));
  const auto proposal = only_proposal();
  EXPECT_EQ(proposal.state, OffsetState::Pending);
  const auto approved = offsets_->approve({.id = proposal.id, .who = "anna", .time = {}});
  ASSERT_FALSE(approved);
  expect(approved.error().what, {"run run-now is", "known at its end"});
  ASSERT_TRUE(store_->runs.set_state(run.id, storage::RunState::Completed, ""));
  EXPECT_EQ(only_proposal().state, OffsetState::Applied);
}

/// Its control keeps a tool's data in parameters.
TEST_F(KeptOffsets, ACenturionsParametersAreItsMemory) {
  add_machine("lathe-1", "centurion");
  use_rules();
  const std::string run = measure_three();
  report_memory(run, R"("P625":[0.125,0.1])");
  expect(reasons_of_no_proposal(), {"T3.wear.X is 0.125 in the memory of lathe-1 (P625"});
}

}  // namespace
}  // namespace dripline::offsets
