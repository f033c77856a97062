// MDI: a block keyed in at an idle machine, in the control's present state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RunOutcome;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class MdiFixture : public GatewayFixture {
 public:
  explicit MdiFixture(const interpreter::Dialect& control, const std::string& toml = "",
                      const std::string& speed = "max")
      : GatewayFixture(control, setup_from(toml), speed) {}
  dds::CommandResult key_in(const std::string& text) {
    const std::string name = "MDI " + std::to_string(++texts_);
    push(name, text);
    dds::Command command = start_command(name);
    command.argument = dds::kMdiStart;
    return send(command);
  }
  dds::RunEndText ends() {
    ++ended_runs_;
    (void)run_until([&] {
      return count(dds::RecordKind::RunEnded) == ended_runs_ && gateway->status().run.empty();
    });
    return *dds::decode_run_end(records.back().text);
  }
  /// Keys it in and lets it run; "completed", or why not.
  std::string mdi(const std::string& text) {
    const auto reply = key_in(text);
    if (!reply.accepted) return "refused: " + reply.reason;
    const auto end = ends();
    return end.outcome == RunOutcome::Completed ? "completed" : end.reason;
  }
  std::string run(const std::string& text) {
    push("1", text);
    const auto reply = start("1");
    if (!reply.accepted) return "refused: " + reply.reason;
    const auto end = ends();
    return end.outcome == RunOutcome::Completed ? "completed" : end.reason;
  }
  double at(std::size_t axis) const { return gateway->status().position[axis]; }
  double rpm() const { return gateway->status().spindle_rpm; }
  std::vector<std::string> messages() const {
    std::vector<std::string> texts;
    for (const auto& record : records)
      if (record.kind == dds::RecordKind::Message && record.device.empty())
        texts.push_back(record.text);
    return texts;
  }

 private:
  int texts_ = 0;
  std::size_t ended_runs_ = 0;
};

struct ModesCase {
  std::string name;
  const interpreter::Dialect& control;
  std::string setup;
  std::string incremental, move;  ///< the second is executed as the first has left the modes
  double after_one, after_two, after_three;  ///< X
};
void PrintTo(const ModesCase& shown, std::ostream* out) {
  *out << shown.name;
}
class MdiModes : public testing::TestWithParam<ModesCase> {};

// TK-51. Units, distances, feed and motion of one text are in force in the next.
TEST_P(MdiModes, GoOverToTheNextText) {
  const ModesCase& given = GetParam();
  MdiFixture fixture(given.control, given.setup);
  EXPECT_EQ(fixture.mdi(given.incremental), "completed");
  EXPECT_NEAR(fixture.at(0), given.after_one, 1e-9);
  EXPECT_THAT(fixture.messages(), Contains(HasSubstr("MDI begins with the modes of power on")));
  const std::size_t before = fixture.messages().size();
  EXPECT_EQ(fixture.mdi(given.move), "completed");
  EXPECT_NEAR(fixture.at(0), given.after_two, 1e-9);
  EXPECT_EQ(fixture.mdi(given.move), "completed") << "repeated";
  EXPECT_NEAR(fixture.at(0), given.after_three, 1e-9);
  EXPECT_EQ(fixture.messages().size(), before);
  const auto& end = fixture.records.back();
  EXPECT_EQ(dds::decode_run_end(end.text)->executed, 1U) << "counted for each text";
}

INSTANTIATE_TEST_SUITE_P(
    , MdiModes,
    testing::Values(ModesCase{"centurion", interpreter::kCenturionDialect, "",
                              "G21 G91 G98 G1 X10 F100\n", "X4\n", 5, 7, 9},
                    ModesCase{"fanuc", interpreter::kFanucDialect, "", "G91 G21 G1 X10. F100\n",
                              "X4.\n", 10, 14, 18},
                    ModesCase{"rs274ngc", interpreter::kRs274NgcDialect, "",
                              "G20 G91 G1 X10 F100\n", "X1\n", 254, 279.4, 304.8},
                    ModesCase{"tektronix", interpreter::kTektronix1704Dialect, "",
                              "G01X10000F500\n", "X20000\n", 25.4, 50.8, 50.8}),
    [](const auto& i) { return i.param.name; });

// HD-074, HD-075: one single-axis block, repeated as often as wanted, or TOOL CALL.
TEST(TncMdi, PositionsOneAxisAndCallsATool) {
  MdiFixture fixture(interpreter::kTnc155Dialect,
                     "[[tool]]\nnumber = 5\nlength = 12.0\nradius = 3.0\n"
                     "[control]\ncentral_tool_file = true\n");
  EXPECT_EQ(fixture.mdi("IX+10 R0 F500 M03\n"), "completed");
  EXPECT_EQ(fixture.mdi("IX+10 R0 F500\n"), "completed");
  EXPECT_EQ(fixture.at(0), 20);
  EXPECT_EQ(fixture.mdi("TOOL CALL 5 Z S800\n"), "completed");
  EXPECT_EQ(fixture.rpm(), 800) << "M03 is in force, and the spindle stays on";
  EXPECT_EQ(fixture.mdi("Z+50 R0 F500\n"), "completed");
  EXPECT_EQ(fixture.at(2), 50);
  EXPECT_EQ(fixture.rpm(), 800);
  EXPECT_THAT(fixture.mdi("L X+1 Y+1 R0 F100\n"),
              HasSubstr("positioning with MDI takes a single-axis block or TOOL CALL"));
  EXPECT_EQ(fixture.at(0), 20) << "nothing of it was executed";
}

// Modes, the tool's length and the offset of the program before are in force.
TEST(Mdi, FollowsAProgramInTheStateItsEndLeaves) {
  MdiFixture fixture(interpreter::kFanucDialect,
                     "[[tool]]\nnumber = 1\nlength = 30.0\n"
                     "[[offset]]\nname = \"G54\"\nX = 100.0\n");
  EXPECT_EQ(fixture.run("O1\nG21 G90 G54\nG43 H1 G0 X1. Z5.\nM30\n"), "completed");
  EXPECT_EQ(fixture.at(0), 101);
  EXPECT_EQ(fixture.mdi("X2. Z10.\nDPRNT[L#5083[32]]\n"), "completed");
  EXPECT_EQ(fixture.at(0), 102);
  EXPECT_EQ(fixture.at(2), 10);
  EXPECT_THAT(fixture.lines(), Contains(HasSubstr("30"))) << "the length of the tool";
  EXPECT_THAT(fixture.messages(), Not(Contains(HasSubstr("MDI begins"))));
  EXPECT_EQ(fixture.run("O1\nG21 G90 G0 Z5.\nM30\n"), "completed");
  EXPECT_EQ(fixture.at(2), 5) << "a program begins as always";
}

TEST(Mdi, BeginsAnewWhereTheLastRunWasCutOff) {
  MdiFixture fixture(interpreter::kFanucDialect);
  EXPECT_EQ(fixture.mdi("G21 G91 G1 X10. F1000\n"), "completed");
  EXPECT_NE(fixture.mdi("G123\n"), "completed");
  EXPECT_EQ(fixture.mdi("G90 G0 X4.\n"), "completed");
  EXPECT_EQ(fixture.at(0), 4) << "from where the machine is";
  EXPECT_THAT(fixture.messages(), Contains("MDI begins with the modes of power on, and without a "
                                           "tool: the last run was cut off"));
}

TEST(Mdi, IsRefusedDuringARunAndTheRunGoesOn) {
  MdiFixture fixture(interpreter::kFanucDialect, "", "1x");
  fixture.push("1", "O1\nG21 G90 G1 X10. F1000\nM30\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  const auto reply = fixture.key_in("G0 X50.\n");
  EXPECT_FALSE(reply.accepted);
  EXPECT_THAT(reply.reason, HasSubstr("busy with run run-1"));
  EXPECT_EQ(fixture.ends().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.at(0), 10);
}

TEST(Mdi, IsHeldAndAbortedAsAProgramIs) {
  MdiFixture fixture(interpreter::kFanucDialect, "", "1x");
  ASSERT_TRUE(fixture.key_in("G21 G90 G1 X100. F1000\n").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.at(0) > 1; }));
  EXPECT_EQ(fixture.gateway->status().mode, dds::ControllerMode::ManualDataInput);
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Hold)).accepted);
  ASSERT_TRUE(fixture.run_until([&] {
    const auto now = fixture.gateway->status();
    return now.execution == Execution::FeedHold && now.feed_mm_per_min == 0;
  }));
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Abort)).accepted);
  EXPECT_EQ(fixture.ends().outcome, RunOutcome::Aborted);
  EXPECT_LT(fixture.at(0), 50);
  EXPECT_EQ(fixture.gateway->status().mode, dds::ControllerMode::Automatic);
}

TEST(Mdi, WaitsForCycleStartAtAnAttendedMachine) {
  MdiFixture fixture(interpreter::kFanucDialect);
  fixture.make_attended();
  fixture.restart_gateway();
  ASSERT_TRUE(fixture.key_in("G21 G90 G0 X3.\n").accepted);
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.gateway->status().waits_for == dds::WaitsFor::CycleStart; }));
  EXPECT_EQ(fixture.at(0), 0);
  EXPECT_EQ(fixture.panel("cycle-start"), "ok");
  EXPECT_EQ(fixture.ends().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.at(0), 3);
}

// Everything that a program's block is checked for.
TEST(Mdi, ObeysTheLimitsOfTheControl) {
  MdiFixture fixture(interpreter::kFanucDialect,
                     "[control]\nstroke_limits = [{ X = 0.0 }, { X = 200.0 }]\n");
  EXPECT_THAT(fixture.mdi("G21 G90 G0 X-1.\n"), HasSubstr("X"));
  EXPECT_EQ(fixture.at(0), 0);
}

// CEN-223 and as the other manuals have it: alarm 123; one block; M98 from a program only; no MDI.
TEST(Mdi, RefusesWhatIsNotKeyedIn) {
  MdiFixture fanuc(interpreter::kFanucDialect);
  EXPECT_THAT(fanuc.mdi("N1 G21\nGOTO 1\n"), HasSubstr("123"));
  MdiFixture centurion(interpreter::kCenturionDialect);
  EXPECT_THAT(centurion.mdi("G0 X1\nG0 X2\n"), HasSubstr("a second block in MDI"));
  EXPECT_THAT(centurion.mdi("M98 P1\n"), HasSubstr("M98 in MDI"));
  MdiFixture prototrak(interpreter::kProtoTrakDialect);
  EXPECT_EQ(prototrak.mdi("X1;"), "refused: control prototrak-plus has no MDI");
}

// Positioning with manual data input of an iTNC 530: any block but labels, calls and contours; what
// a text has shifted is shifted in the next one, and a program begins without. Rows: IT-046.
TEST(Mdi, KeysInBlocksOfALaterTnc) {
  MdiFixture fixture(interpreter::kItncDialect);
  EXPECT_EQ(fixture.mdi("L X+12.5 Y+1 R0 FMAX M3\n"), "completed");
  EXPECT_EQ(fixture.mdi("CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+10\nQ1 = 2 + 3\n"), "completed");
  EXPECT_EQ(fixture.mdi("L X+Q1 F1000\nL IX+1\n"), "completed");
  EXPECT_EQ(fixture.at(0), 16);
  EXPECT_THAT(fixture.mdi("LBL 1\n"), HasSubstr("a label in positioning with MDI"));
  EXPECT_THAT(fixture.mdi("CALL LBL 1\n"), HasSubstr("a label in positioning with MDI"));
  EXPECT_THAT(fixture.mdi("CALL PGM A\n"), HasSubstr("CALL PGM in positioning with MDI"));
  EXPECT_THAT(fixture.mdi("L X+1 RL F100\n"), HasSubstr("RL or RR in positioning with MDI"));
  EXPECT_THAT(fixture.mdi("CYCL DEF 7.0 DATUM SHIFT\n"), HasSubstr("CYCL DEF 7"));
  EXPECT_EQ(fixture.run("BEGIN PGM A MM\nL X+1 Y+1 R0 FMAX\nEND PGM A MM\n"), "completed");
  EXPECT_EQ(fixture.at(0), 1);
}

// What it changes in the memory is kept, and a restart is not offered.
TEST(Mdi, ChangesTheControlsMemory) {
  MdiFixture fixture(interpreter::kFanucDialect);
  EXPECT_EQ(fixture.mdi("#500=7\n"), "completed");
  EXPECT_EQ(fixture.run("O1\nDPRNT[V#500[32]]\nM30\n"), "completed");
  EXPECT_THAT(fixture.lines(), Contains(HasSubstr("7")));
}

}  // namespace
}  // namespace dripline::gateway
