#include "gateway/app/memory/control_memory.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include "gateway/interpreter/core/dialects.hpp"
#include "storage/sqlite/database.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// What a control keeps from one program to the next. Rows: CEN-074, CEN-171, NGC-016.
namespace dripline::gateway {
namespace {

using dds::RunOutcome;

interpreter::Setup setup_of(const interpreter::Dialect& control, const std::string& toml) {
  auto setup = interpreter::parse_setup(toml, control.units);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

/// Runs programs one after the other, each pushed under a name of its own.
class MemoryFixture : public GatewayFixture {
 public:
  explicit MemoryFixture(const interpreter::Dialect& control, const std::string& toml = "",
                         const std::string& speed = "max")
      : GatewayFixture(control, setup_of(control, toml), speed) {}

  dds::RunEndText run(const std::string& text, const std::string& setup_toml = "") {
    const std::string name = "P" + std::to_string(++programs_);
    push(name, text);
    dds::Command command = start_command(name);
    command.setup = setup_toml;
    const auto result = send(command);
    EXPECT_TRUE(result.accepted) << result.reason;
    return ended();
  }
  /// The lines that the last program printed.
  std::vector<std::string> printed(const std::string& text, const std::string& setup_toml = "") {
    const std::size_t before = lines().size();
    const auto end = run(text, setup_toml);
    EXPECT_EQ(end.outcome, RunOutcome::Completed) << end.reason;
    auto all = lines();
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(before));
    return all;
  }
  /// What was reported last of the memory.
  std::string reported() const {
    for (auto record = records.rbegin(); record != records.rend(); ++record) {
      if (record->device == "memory") return record->text;
    }
    return {};
  }

 private:
  int programs_ = 0;
};

using Lines = std::vector<std::string>;

constexpr const char* kChange = "O0001\nP10=7.5\nPB50=2\nG10\nP500=1.25\nP511=.5\nG11\nM30\n";
constexpr const char* kPrint =
    "O0002\nP1=PB50\nP2=P500\nP3=P511\nPOPEN P0\nDPRNT[A#10 B#1 C#2 D#3]\nPCLOS\nM30\n";

TEST(CenturionMemory, OutlivesTheProgram) {
  MemoryFixture fixture(interpreter::kCenturionDialect);
  const Lines before = fixture.printed(kPrint);
  fixture.run(kChange);
  const Lines after = fixture.printed(kPrint);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_NE(after, before);
  EXPECT_NE(after[0].find("7.5"), std::string::npos) << after[0];
  EXPECT_NE(after[0].find("1.25"), std::string::npos) << after[0];
  EXPECT_NE(after[0].find("2.0"), std::string::npos) << after[0];
}

TEST(CenturionMemory, OutlivesTheGateway) {
  MemoryFixture fixture(interpreter::kCenturionDialect);
  fixture.run(kChange);
  const Lines after = fixture.printed(kPrint);
  fixture.restart_gateway();
  EXPECT_EQ(fixture.printed(kPrint), after);
}

TEST(CenturionMemory, IsReportedBeforeTheEndOfTheRun) {
  MemoryFixture fixture(interpreter::kCenturionDialect);
  fixture.run(kChange);
  EXPECT_EQ(fixture.reported(),
            R"({"part":1,"parts":1,"cells":{"P10":[7.5,0],"P500":[1.25,0],"P511":[0.5,0],)"
            R"("PB50":[2,1]}})");
  ASSERT_GE(fixture.records.size(), 2U);
  EXPECT_EQ(fixture.records.back().kind, dds::RecordKind::RunEnded);
  const auto reports = [&] {
    return std::count_if(fixture.records.begin(), fixture.records.end(),
                         [](const dds::Record& record) { return record.device == "memory"; });
  };
  ASSERT_EQ(reports(), 1);
  fixture.run("O0003\nG0 X1\nM30\n");
  EXPECT_EQ(reports(), 1) << "there is nothing new";
}

constexpr const char* kSlow = "O0001\nP10=1\nG0 X40\nX0\nX40\nX0\nP10=2\nM30\n";
constexpr const char* kPrintP10 = "O0002\nPOPEN P0\nDPRNT[A#10]\nPCLOS\nM30\n";

/// A part that was not made is not counted.
TEST(CenturionMemory, IsThatOfTheBlocksThatWereExecuted) {
  MemoryFixture fixture(interpreter::kCenturionDialect, "", "1x");
  fixture.push("O1", kSlow);
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status && fixture.status->position[0] > 100; }));
  ASSERT_TRUE(fixture.send(fixture.command(dds::CommandAction::Abort)).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Aborted);
  EXPECT_EQ(fixture.reported(), R"({"part":1,"parts":1,"cells":{"P10":[1,0]}})");
  EXPECT_NE(fixture.printed(kPrintP10).at(0).find('1'), std::string::npos);
}

TEST(CenturionMemory, IsKeptThroughAKillInTheMiddle) {
  MemoryFixture fixture(interpreter::kCenturionDialect, "", "1x");
  fixture.push("O1", kSlow);
  ASSERT_TRUE(fixture.start("O1").accepted);
  const SteadyTime begun = fixture.clock.steady;
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.clock.steady > begun + std::chrono::milliseconds(1500); }));
  fixture.restart_gateway();
  ASSERT_TRUE(fixture.run_until([&] { return fixture.count(dds::RecordKind::RunEnded) == 1; }));
  EXPECT_EQ(fixture.reported(), R"({"part":1,"parts":1,"cells":{"P10":[1,0]}})");
  EXPECT_NE(fixture.printed(kPrintP10).at(0).find('1'), std::string::npos);
}

TEST(CenturionMemory, IsKeptInTheUnitOfTheSetup) {
  MemoryFixture fixture(interpreter::kCenturionDialect);
  fixture.run("O0001\nG21\nG10\nP500=25.4\nG11\nM30\n");
  EXPECT_EQ(fixture.reported(), R"({"part":1,"parts":1,"cells":{"P500":[1,0]}})");
}

/// A change of the setup is intended; all else stays as the control has it.
TEST(CenturionMemory, GivesWayToASetupThatWasChanged) {
  MemoryFixture fixture(interpreter::kCenturionDialect);
  const std::string setup = "[[variable]]\nname = \"P10\"\nvalue = 3\n";
  fixture.run("O0001\nP10=7\nP11=8\nM30\n", setup);
  const std::string print = "O0002\nPOPEN P0\nDPRNT[A#10 B#11]\nPCLOS\nM30\n";
  const Lines kept = fixture.printed(print, setup);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_NE(kept[0].find('7'), std::string::npos) << kept[0];
  const Lines changed = fixture.printed(print, "[[variable]]\nname = \"P10\"\nvalue = 4\n");
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_NE(changed[0].find('4'), std::string::npos) << changed[0];
  EXPECT_NE(changed[0].find('8'), std::string::npos) << changed[0];
  EXPECT_EQ(fixture.reported(), R"({"part":1,"parts":1,"cells":{"P11":[8,0]}})");
}

TEST(CenturionMemory, IsLeftAsItIsByAStartThatIsRefused) {
  MemoryFixture fixture(interpreter::kCenturionDialect);
  const std::string setup = "[[variable]]\nname = \"P10\"\nvalue = 3\n";
  fixture.run("O0001\nP10=7\nM30\n", setup);
  fixture.push("P9", "O0009\nN40 M30\n");
  dds::Command start = fixture.start_command("P9");
  start.argument = "N40 memory=begin";
  start.setup = "[[variable]]\nname = \"P10\"\nvalue = 4\n";
  ASSERT_FALSE(fixture.send(start).accepted);
  const Lines kept = fixture.printed("O0002\nPOPEN P0\nDPRNT[A#10]\nPCLOS\nM30\n", setup);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_NE(kept[0].find('7'), std::string::npos) << kept[0];
}

TEST(CenturionMemory, IsClearedByASetupThatNamesIt) {
  MemoryFixture fixture(interpreter::kCenturionDialect);
  fixture.run("O0001\nP10=7\nM30\n");
  const Lines cleared = fixture.printed("O0002\nPOPEN P0\nDPRNT[A#10]\nPCLOS\nM30\n",
                                        "[[variable]]\nname = \"P10\"\nvalue = 0\n");
  ASSERT_EQ(cleared.size(), 1U);
  EXPECT_EQ(cleared[0].find('7'), std::string::npos) << cleared[0];
}

/// A start in the middle looks through what comes before it; what that part counts has been
/// counted.
class CenturionStart : public testing::Test {
 protected:
  static constexpr const char* kCount =
      "O0001\nG98 F900 P140=2\nP10=P10+1\nG0 X1 Z1\nN30 G1 X2\nP11=P11+1\nN40 G1 X3\nM30\n";

  CenturionStart() { fixture.push("O1", kCount); }
  dds::RunEndText run_from(const std::string& place) {
    dds::Command command = fixture.start_command("O1");
    command.argument = place;
    const std::size_t ended = fixture.count(dds::RecordKind::RunEnded);
    const auto result = fixture.send(command);
    EXPECT_TRUE(result.accepted) << result.reason;
    // The approach stops for the operator.
    const auto is_stopped = [&] {
      return fixture.status && fixture.status->execution == dds::Execution::ProgramStopped;
    };
    const auto is_over = [&] { return fixture.count(dds::RecordKind::RunEnded) > ended; };
    EXPECT_TRUE(fixture.run_until([&] { return is_stopped() || is_over(); }));
    if (!is_over()) (void)fixture.send(fixture.command(dds::CommandAction::Resume));
    EXPECT_TRUE(fixture.run_until(is_over));
    return fixture.ended();
  }
  std::string kept() {
    return fixture.printed("O0002\nPOPEN P0\nDPRNT[#10[20] #11[20]]\nPCLOS\nM30\n").at(0);
  }
  void run_whole() {
    ASSERT_TRUE(fixture.start("O1").accepted);
    ASSERT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  }
  MemoryFixture fixture{interpreter::kCenturionDialect};
};

TEST_F(CenturionStart, IsRefusedWhereWhatWasCountedWouldCountTwice) {
  run_whole();
  const auto end = run_from("N30");
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_NE(end.reason.find("CEN1013"), std::string::npos) << end.reason;
  EXPECT_NE(end.reason.find("P10"), std::string::npos) << end.reason;
  EXPECT_EQ(kept(), "01 01");
}

TEST_F(CenturionStart, CountsOnceMoreWhenThatIsMeant) {
  run_whole();
  EXPECT_EQ(run_from("N30 memory=now").outcome, RunOutcome::Completed);
  EXPECT_EQ(kept(), "02 02");
}

TEST_F(CenturionStart, GoesThroughTheProgramWithTheMemoryOfItsBegin) {
  run_whole();
  EXPECT_EQ(run_from("N40 memory=begin").outcome, RunOutcome::Completed);
  EXPECT_EQ(kept(), "01 01");
}

TEST_F(CenturionStart, KnowsTheMemoryOfTheBeginAfterARestart) {
  run_whole();
  fixture.restart_gateway();
  EXPECT_EQ(run_from("N40 memory=begin").outcome, RunOutcome::Completed);
  EXPECT_EQ(kept(), "01 01");
}

TEST_F(CenturionStart, KnowsNoMemoryOfTheBeginOfAnotherProgram) {
  run_whole();
  EXPECT_EQ(kept(), "01 01");  // another program has begun since
  dds::Command command = fixture.start_command("O1");
  command.argument = "N40 memory=begin";
  const auto result = fixture.send(command);
  EXPECT_FALSE(result.accepted);
  EXPECT_NE(result.reason.find("last run that began at its first block"), std::string::npos)
      << result.reason;
}

/// What an aborted start would have changed is as it was.
TEST_F(CenturionStart, ChangesNothingBeforeItsFirstBlockIsExecuted) {
  run_whole();
  for (const char* place : {"N40 memory=begin", "N40 memory=now"}) {
    dds::Command command = fixture.start_command("O1");
    command.argument = place;
    ASSERT_TRUE(fixture.send(command).accepted);
    ASSERT_TRUE(fixture.run_until([&] {
      return fixture.status && fixture.status->execution == dds::Execution::ProgramStopped;
    }));
    ASSERT_TRUE(fixture.send(fixture.command(dds::CommandAction::Abort)).accepted);
    EXPECT_EQ(fixture.ended().outcome, RunOutcome::Aborted);
    run_whole();  // the begin of the next start
  }
  EXPECT_EQ(kept(), "03 03");
}

TEST_F(CenturionStart, TakesNothingThatItDoesNotKnow) {
  dds::Command command = fixture.start_command("O1");
  command.argument = "N30 speed=9";
  EXPECT_FALSE(fixture.send(command).accepted);
}

/// A row that was changed after the gateway's back, and a file that is gone.
class DamagedMemory : public testing::Test {
 protected:
  void SetUp() override { fixture.run(kChange); }
  void expect_refused(const std::string& why) {
    fixture.push("O9", kPrint);
    const auto result = fixture.start("O9");
    EXPECT_FALSE(result.accepted);
    EXPECT_NE(result.reason.find(why), std::string::npos) << result.reason;
    ASSERT_TRUE(fixture.run_until([&] { return fixture.status.has_value(); }));
    EXPECT_NE(fixture.status->message.find(why), std::string::npos) << fixture.status->message;
  }
  void change(const std::string& sql) {
    fixture.gateway.reset();
    auto database = storage::sqlite::Database::open(fixture.folder() / "outbox.sqlite");
    ASSERT_TRUE(database) << database.error().what;
    const auto done = database->execute(sql);
    ASSERT_TRUE(done) << done.error().what;
  }
  MemoryFixture fixture{interpreter::kCenturionDialect};
};

TEST_F(DamagedMemory, BeginsNothingUntilItIsDiscarded) {
  change("UPDATE memory SET value = '1.35' WHERE name = 'P500'");
  fixture.restart_gateway();
  expect_refused("not as it was written");
  fixture.restart_gateway();
  expect_refused("not as it was written");
  EXPECT_EQ(fixture.panel("discard-memory"), "ok");
  const Lines after = fixture.printed(kPrint);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].find("1.35"), std::string::npos) << after[0];
  EXPECT_EQ(after[0].find("7.5"), std::string::npos) << after[0];
}

TEST_F(DamagedMemory, WithARowLessIsNoticed) {
  change("DELETE FROM memory WHERE name = 'P10'");
  fixture.restart_gateway();
  expect_refused("not as it was written");
}

TEST_F(DamagedMemory, OfARunsBeginIsNoticed) {
  fixture.run("O0003\nM30\n");  // begins with what the first one left
  change("UPDATE memory_beginning SET value = '9' WHERE name = 'P10'");
  fixture.restart_gateway();
  expect_refused("not as it was written");
}

TEST_F(DamagedMemory, IsNotDiscardedUnderARun) {
  fixture.push("O1", kSlow);
  MemoryFixture slow(interpreter::kCenturionDialect, "", "1x");
  slow.push("O1", kSlow);
  ASSERT_TRUE(slow.start("O1").accepted);
  EXPECT_TRUE(slow.panel("discard-memory").starts_with("refused run"));
}

TEST(FanucMemory, KeepsVariablesFrom500AndOffsets) {
  MemoryFixture fixture(interpreter::kFanucDialect);
  fixture.run("O0001\n#500=7.5\n#100=9\n#1=8\nG10 L2 P1 X1.5\nG10 L10 P3 R2.5\n#3901=4\nM30\n");
  fixture.restart_gateway();
  const Lines after = fixture.printed(
      "O0002\nPOPEN\nDPRNT[#500[33]*#5221[33]*#2003[33]*#3901[33]*#100[33]]\nPCLOS\nM30\n");
  ASSERT_EQ(after.size(), 1U);
  for (const char* number : {"7.500", "1.500", "2.500", "4.000"})
    EXPECT_NE(after[0].find(number), std::string::npos) << number << " in " << after[0];
  EXPECT_EQ(after[0].find("9.000"), std::string::npos) << after[0];
  EXPECT_NE(fixture.reported().find(R"("#500":[7.5,null])"), std::string::npos)
      << fixture.reported();
  EXPECT_NE(fixture.reported().find(R"("G54.X":[1.5,0])"), std::string::npos) << fixture.reported();
}

TEST(FanucMemory, KeepsVariablesFrom100UntilPowerOffIfResetLeavesThem) {
  MemoryFixture fixture(interpreter::kFanucDialect, "[control]\nreset_clears_commons = false\n");
  const std::string print = "O0002\nPOPEN\nDPRNT[#100[33]]\nPCLOS\nM30\n";
  fixture.run("O0001\n#100=9\nM30\n");
  EXPECT_NE(fixture.printed(print).at(0).find("9.000"), std::string::npos);
  fixture.restart_gateway();
  EXPECT_EQ(fixture.printed(print).at(0).find("9.000"), std::string::npos);
}

TEST(Rs274Memory, KeepsWhatItsParameterFileLists) {
  const std::string setup =
      "[control]\nprofile = \"linuxcnc\"\n[[variable]]\nname = \"#100\"\nvalue = 0\n"
      "[[tool]]\nnumber = 1\nlength = 10\nradius = 2\n";
  MemoryFixture fixture(interpreter::kRs274NgcDialect, setup);
  fixture.run("#100=7.5\n#101=8.5\nG10 L2 P2 X1.25\nG10 L1 P1 Z12.5\nM2\n");
  const std::string print = "(LOGOPEN,a)\n(LOG,#100 #101 #5241)\n(LOGCLOSE)\nT1 M6\n(LOG,x)\nM2\n";
  const Lines same_session = fixture.printed(print);
  ASSERT_FALSE(same_session.empty());
  EXPECT_NE(same_session[0].find("7.5"), std::string::npos) << same_session[0];
  EXPECT_NE(same_session[0].find("8.5"), std::string::npos) << same_session[0];
  EXPECT_NE(same_session[0].find("1.25"), std::string::npos) << same_session[0];
  fixture.restart_gateway();
  const Lines next_session = fixture.printed(print);
  ASSERT_FALSE(next_session.empty());
  EXPECT_NE(next_session[0].find("7.5"), std::string::npos) << next_session[0];
  EXPECT_EQ(next_session[0].find("8.5"), std::string::npos) << next_session[0];
  EXPECT_NE(fixture.reported().find(R"("tool.1.Z":[12.5,10])"), std::string::npos)
      << fixture.reported();
}

TEST(TncMemory, BeginsEveryProgramWithoutQParameters) {
  MemoryFixture fixture(interpreter::kTnc155Dialect);
  fixture.run("0 BEGIN PGM 1 MM\n1 FN 0: Q1 = +7,5\n2 L C+730 R0 F9999 M94\n3 END PGM 1 MM\n");
  EXPECT_EQ(fixture.reported().find("Q1"), std::string::npos) << fixture.reported();
}

/// M94 moves the datum of the rotary axis by whole revolutions: what is C+730 when its block begins
/// is C+10 then.
TEST(TncMemory, KeepsTheDatumThatM94Moves) {
  MemoryFixture fixture(interpreter::kTnc155Dialect);
  const std::string turn =
      "0 BEGIN PGM 1 MM\n1 L C+730 R0 F9999\n2 L C+20 R0 F9999 M94\n3 END PGM 1 MM\n";
  fixture.run(turn);
  EXPECT_NE(fixture.reported().find(R"("datum.C":[720,0])"), std::string::npos)
      << fixture.reported();
  fixture.restart_gateway();
  fixture.run(turn);  // from the datum that is kept
  EXPECT_NE(fixture.reported().find(R"("datum.C":[1440,0])"), std::string::npos)
      << fixture.reported();
}

}  // namespace
}  // namespace dripline::gateway
