#include "clients/cli/server/machine_text.hpp"

#include <gtest/gtest.h>

namespace dripline::cli {
namespace {

client::Run run() {
  client::Run run;
  run.id = "0192aabbccdd";
  run.machine = "lathe-1";
  run.program = "O0200";
  run.state = "completed";
  run.size = 2'000'000;
  run.executed = 200'000;
  run.started = "2026-11-21T07:40:00Z";
  run.ended = "2026-11-21T07:41:06Z";
  run.outputs = 12;
  run.content_verified = true;
  return run;
}

client::MachineStatus status() {
  client::MachineStatus status;
  status.execution = "ACTIVE";
  status.run = "0192aabbccdd";
  status.program = "O0200";
  status.sent = 1'500'000;
  status.accepted = 120'000;
  status.executed = 100'000;
  status.total_bytes = 2'000'000;
  status.offset = 1'000'000;
  status.line = 100'001;
  status.sequence = 42;
  status.position = {{"Z", -3}, {"X", 12.5}};
  status.feed_mm_per_min = 200;
  return status;
}

TEST(RunLine, ShowsAllThreeCountersAndThePlace) {
  const auto machine = status();
  client::Run active = run();
  active.state = "active";
  active.executed = 0;
  EXPECT_EQ(run_line(active, &machine),
            "O0200 on lathe-1 [########........]  50 %  ACTIVE  line 100001 N42  "
            "sent 1.5 MB  accepted 120000  executed 100000  X 12.500 Z -3.000  F 200");
}

client::Machine held_machine() {
  client::Machine machine;
  machine.name = "lathe-1";
  machine.connected = true;
  machine.status = status();
  machine.status->execution = "FEED_HOLD";
  machine.held = client::Hold{"report template bore version 1",
                              "part 12 is scrap: D40 is 40.300 mm", "0192aabbccdd", ""};
  return machine;
}

TEST(HeldMachine, SaysByWhomAndWhyWhereverItsStatusIsShown) {
  client::Machine machine = held_machine();
  const std::string why =
      "held by report template bore version 1: part 12 is scrap: D40 is 40.300 mm";
  EXPECT_EQ(status_of(machine).message, why);
  EXPECT_NE(status_line(machine).find(why), std::string::npos);
  const auto shown = status_of(machine);
  EXPECT_NE(run_line(run(), &shown).find(why), std::string::npos);
  EXPECT_NE(waiting_line(run(), shown).find(why), std::string::npos);
  machine.queue_hold = client::Hold{"quality", "bore is wide", "", ""};
  const std::string details = machine_details(machine).render(false);
  EXPECT_NE(details.find(why.substr(5)), std::string::npos) << details;
  EXPECT_NE(details.find("by quality: bore is wide"), std::string::npos) << details;
}

TEST(HeldMachine, KeepsWhatTheControlItselfReports) {
  client::Machine machine = held_machine();
  machine.status->message = "door is open";
  machine.held->reason.clear();
  EXPECT_EQ(status_of(machine).message, "door is open; held by report template bore version 1");
  machine.held.reset();
  EXPECT_EQ(status_of(machine).message, "door is open");
}

TEST(RunLine, IsInTheUnitsOfTheControlWithXAsItShowsIt) {
  auto machine = status();
  machine.position = {{"X", 12.7}, {"Z", -25.4}, {"C", 90}};
  machine.feed_mm_per_min = 254;
  client::Run active = run();
  active.state = "active";
  const std::string line = run_line(active, &machine, {.units = "inch", .x = "diameter"});
  EXPECT_TRUE(line.ends_with("X dia 1.0000 Z -1.0000 C 90.000 in  F 10.00")) << line;
  EXPECT_TRUE(run_line(active, &machine).ends_with("X 12.700 Z -25.400 C 90.000  F 254"));
}

TEST(MachineDetails, AreInTheUnitsOfTheControl) {
  client::Machine machine;
  machine.name = "lathe-1";
  machine.connected = true;
  machine.status = status();
  machine.status->position = {{"X", 12.7}, {"Z", -25.4}};
  machine.display = client::Display{.units = "inch", .x = "diameter"};
  EXPECT_NE(machine_details(machine).render(false).find("X dia 1.0000 Z -1.0000 in"),
            std::string::npos);
  EXPECT_NE(status_line(machine).find("X dia 1.0000 Z -1.0000 in  F 7.87 in/min"),
            std::string::npos)
      << status_line(machine);
}

TEST(RunLines, FitAnOrdinaryTerminal) {
  auto machine = status();
  machine.position["Y"] = 0;
  client::Run active = run();
  for (const auto& line : run_lines(active, &machine)) EXPECT_LT(columns(line), 80u) << line;
}

TEST(RunLines, SayFirstWhatIsAskedAndHowToAnswer) {
  auto machine = status();
  machine.execution = "WAIT";
  machine.message = "asks: DEPTH";
  const auto lines = run_lines(run(), &machine);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[0].ends_with("WAIT  line 100001 N42  asks: DEPTH")) << lines[0];
  EXPECT_EQ(lines[2], "dnc run answer 0192aabb TEXT answers it");
}

TEST(RunLines, SayHowAStoppedRunGoesOn) {
  auto machine = status();
  for (const char* stopped : {"PROGRAM_STOPPED", "OPTIONAL_STOP", "FEED_HOLD", "INTERRUPTED"}) {
    machine.execution = stopped;
    EXPECT_EQ(run_lines(run(), &machine).back(), "dnc run resume 0192aabb continues");
  }
  machine.execution = "WAIT";
  machine.message = "waiting for program text";
  EXPECT_EQ(run_lines(run(), &machine).size(), 2u);
}

/// CEN-228: what the control's status window has, in words.
TEST(MachineDetails, ShowTheStatusWindow) {
  client::Machine machine;
  machine.status = status();
  EXPECT_EQ(machine_details(machine).render(false).find("compensation"), std::string::npos);
  client::ActiveModes modes;
  modes.motion = "thread";
  modes.compensation = "left";
  modes.units = "inch";
  modes.feed_unit = "per_revolution";
  modes.feed = 1.5;
  modes.feed_limited = true;
  modes.tool = 3;
  modes.next_tool = 4;
  modes.tool_offset = 13;
  modes.tool_length_x = 12.25;
  modes.work_system = "G55";
  modes.cycle = "multiple thread cycle";
  modes.surface_speed = true;
  modes.spindle_speed = 120'000;
  modes.flood = true;
  machine.status->modes = modes;
  const std::string text = machine_details(machine).render(false);
  for (const char* line :
       {"tool lengths", "3, offset 13 (next 4)", "X 12.250 Z 0.000 mm",
        "1.500 mm/rev, limited by an axis", "absolute, inch", "multiple thread cycle",
        "120.0 m/min at the surface", "not measured", "G55", "thread", "left", "flood"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << " in\n" << text;
  }
}

/// HD-082, HD-084: the five position displays, and the rest of a TNC's status window.
TEST(MachineDetails, ShowPositionDisplaysAndTransformations) {
  client::Machine machine;
  machine.status = status();
  machine.status->modes.emplace().tool = 7;
  machine.status->modes->tool_axis = "Z";
  machine.status->modes->spindle = "counterclockwise";
  machine.status->coordinates = client::Coordinates{.target = {{"X", 20}, {"Z", -3}},
                                                    .distance_to_go = {{"X", 7.5}, {"Z", 0}},
                                                    .following_error = {{{"X", 0}, {"Z", 0}}},
                                                    .program = client::ProgramFrame{}};
  machine.status->screen = client::Screen{.position = "actual"};
  client::ProgramFrame& frame = *machine.status->coordinates->program;
  frame.position = {{"Z", 2}, {"X", 1}};
  frame.target = {{"X", 16}, {"Z", 2}};
  frame.datum = {{"X", 100}};
  frame.shift = {{"X", 10}};
  frame.rotation = 30;
  frame.basic_rotation = 2.5;
  frame.scale = {{"X", 0.5}, {"Y", 0.5}, {"Z", 1}};
  frame.mirrored = {"X", "Y"};
  frame.pole = {{"X", 3}, {"Y", 4}};
  std::string text = machine_details(machine).render(false);
  for (const char* line :
       {"X 1.000 Z 2.000 mm", "X 16.000 Z 2.000 mm", "X 12.500 Z -3.000 mm", "X 7.500 Z 0.000 mm",
        "X 0.000 Z 0.000 mm", "X 100.000 mm", "X 10.000 mm", "30.000 degrees, basic rotation 2.500",
        "X 0.5 Y 0.5 Z 1", "X Y", "X 3.000 Y 4.000 mm", "7, axis Z", "counterclockwise (M04)"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << " in\n" << text;
  }
  EXPECT_EQ(text.find("emergency"), std::string::npos);
  machine.status->coordinates->following_error.reset();
  machine.status->coordinates->program.reset();
  machine.status->emergency_stop = true;
  text = machine_details(machine).render(false);
  EXPECT_NE(text.find("not measured"), std::string::npos) << text;
  EXPECT_NE(text.find("emergency stop"), std::string::npos) << text;
  machine.status->remote_enable = "not_given";
  machine.status->waits_for = "cycle_start";
  text = machine_details(machine).render(false);
  EXPECT_NE(text.find("not given"), std::string::npos) << text;
  EXPECT_NE(text.find("cycle start"), std::string::npos) << text;
  EXPECT_EQ(text.find("ROT"), std::string::npos) << text;
}

/// HD-191: it flashes where a run is interrupted, and is off where it was terminated.
TEST(MachineDetails, ShowTheStarOfARunningProgram) {
  client::Machine machine;
  machine.status = status();
  const auto star = [&machine](const char* execution) {
    machine.status->execution = execution;
    const std::string text = machine_details(machine).render(false);
    const auto line = text.substr(text.find("program star"));
    return line.substr(0, line.find('\n'));
  };
  EXPECT_TRUE(star("ACTIVE").ends_with("* (running)"));
  for (const char* interrupted : {"FEED_HOLD", "INTERRUPTED", "PROGRAM_STOPPED"})
    EXPECT_TRUE(star(interrupted).ends_with("* flashing (interrupted)"));
  for (const char* over : {"STOPPED", "READY", "PROGRAM_COMPLETED"})
    EXPECT_TRUE(star(over).ends_with(" off"));
}

TEST(ExecutionCell, SaysWhatIsKnownOfAMachineThatIsAway) {
  client::Machine machine;
  machine.status = status();
  EXPECT_EQ(execution_cell(machine).text, "UNAVAILABLE (last ACTIVE)");
  machine.connected = true;
  EXPECT_EQ(execution_cell(machine).text, "ACTIVE");
}

TEST(FractionExecuted, IsAllOnceTheProgramIsCompleted) {
  auto machine = status();
  EXPECT_EQ(fraction_executed(machine), 0.5);
  machine.execution = "PROGRAM_COMPLETED";
  EXPECT_EQ(fraction_executed(machine), 1);
}

TEST(StyleOfExecution, KnowsTheWordsOfTheServer) {
  EXPECT_EQ(style_of_execution("ACTIVE"), Style::Busy);
  EXPECT_EQ(style_of_execution("READY"), Style::Good);
  EXPECT_EQ(style_of_execution("STOPPED"), Style::Bad);
}

TEST(RunLine, ManagesWithoutAStatus) {
  client::Run ordered = run();
  ordered.state = "ordered";
  ordered.executed = 0;
  EXPECT_EQ(run_line(ordered, nullptr),
            "O0200 on lathe-1  ordered  0 B of 2.0 MB sent  0 blocks executed");
}

TEST(RecordLine, IsForPeople) {
  client::Record record;
  record.kind = "alarm";
  record.line = 3;
  record.text = R"({"code":"MCH0004","text":"a feed per revolution"})";
  EXPECT_EQ(record_line(record), "alarm  line 3  MCH0004 a feed per revolution");
  record.kind = "warning";
  EXPECT_EQ(record_line(record), "warning  line 3  MCH0004 a feed per revolution");
  record.text = "not JSON";
  EXPECT_EQ(record_line(record), "warning  line 3  not JSON");
  record.kind = "message";
  record.text = "{DRILL}";
  EXPECT_EQ(record_line(record), "message  line 3  {DRILL}");
}

TEST(WaitingLine, NamesWhatARunWaitsForAndWhatGoesOn) {
  client::MachineStatus stopped = status();
  EXPECT_EQ(waiting_line(run(), stopped), "");
  stopped.execution = "PROGRAM_STOPPED";
  stopped.message = "operator stop: start at block 5";
  EXPECT_EQ(
      waiting_line(run(), stopped),
      "run 0192aabb waits: operator stop: start at block 5; dnc run resume 0192aabb continues");
}

TEST(OutcomeLine, SaysHowTheRunWent) {
  EXPECT_EQ(outcome_line(run()),
            "Run 0192aabb of O0200 on lathe-1 completed: 200000 blocks executed in 1:06, 12 report "
            "lines, content verified");
  client::Run short_one = run();
  short_one.executed = short_one.outputs = 1;
  EXPECT_NE(outcome_line(short_one).find("1 block executed in 1:06, 1 report line,"),
            std::string::npos);
  client::Run alarmed = run();
  alarmed.state = "alarmed";
  alarmed.reason = "CEN0103 bad word";
  alarmed.line = 7;
  alarmed.content_verified = std::nullopt;
  EXPECT_EQ(outcome_line(alarmed),
            "Run 0192aabb of O0200 on lathe-1 alarmed: 200000 blocks executed in 1:06, 12 report "
            "lines, last line 7; CEN0103 bad word");
  client::Run tested = run();
  tested.state = "tested";
  tested.reason = "test run: 4 blocks";
  tested.line = tested.executed = tested.outputs = 0;
  EXPECT_EQ(outcome_line(tested),
            "Run 0192aabb of O0200 on lathe-1 tested: 0 blocks executed in 1:06, content verified; "
            "test run: 4 blocks");
}

TEST(FractionExecuted, FollowsTheTextAndEndsAtOne) {
  client::MachineStatus machine = status();
  EXPECT_DOUBLE_EQ(fraction_executed(machine), 0.5);
  machine.execution = "PROGRAM_COMPLETED";
  EXPECT_EQ(fraction_executed(machine), 1);
  EXPECT_EQ(fraction_executed(client::MachineStatus{}), 0);
}

TEST(StatusLine, SaysWhatAMachineDoes) {
  client::Machine machine;
  machine.name = "lathe-1";
  EXPECT_EQ(status_line(machine), "lathe-1  not connected");
  machine.connected = true;
  EXPECT_EQ(status_line(machine), "lathe-1  connected, no status yet");
  machine.status = status();
  machine.status->message = "HELLO";
  EXPECT_EQ(status_line(machine),
            "lathe-1  ACTIVE  O0200  50 %  line 100001 N42  HELLO  X 12.500 Z -3.000 mm  F 200 "
            "mm/min");
}

}  // namespace
}  // namespace dripline::cli
