#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <string>

#include "clients/tools/offline/check_summary.hpp"
#include "clients/tools/offline/forecast.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/machine/simulated_machine.hpp"

/// Times with acceleration: by closed formulas, and those of the simulated machine. Row TK-60.
namespace dripline::interpreter {
namespace {

constexpr std::string_view kMachine =
    "[machine]\nX = { rate = 6000.0, acceleration = 500.0 }\n"
    "Y = { rate = 6000.0, acceleration = 800.0 }\nZ = { rate = 3000.0, acceleration = 300.0 }\n";

MachineData machine_data(std::string_view toml = kMachine) {
  const auto data = parse_machine_data(toml, Units::Millimeter);
  EXPECT_TRUE(data) << data.error().what;
  return *data;
}

Summary checked(std::string_view control, const std::string& text, const MachineData& machine) {
  MemorySource source(text);
  CheckSummary check({}, {}, machine);
  const auto outcome = run_offline(**find_dialect(control), {}, source, check);
  EXPECT_TRUE(outcome && outcome->ended) << (outcome && outcome->alarm ? outcome->alarm->text : "");
  return check.summary();
}

/// What the simulated machine needs for the same program.
double simulated(std::string_view control, const std::string& text) {
  class NoSink final : public machine::ExecutionSink {
    void on_block_executed(const Origin&) override {}
  } sink;
  machine::MachineLimits limits;
  limits.spindle.assumed_rpm = 1000;
  const MachineData stated = machine_data();
  for (std::size_t i = 0; i < 3; ++i) {
    limits.axes[i] = machine::AxisLimits{.rapid_per_minute = *stated.axes[i]->max_rate,
                                         .feed_per_minute = *stated.axes[i]->max_rate,
                                         .acceleration = *stated.axes[i]->acceleration};
  }
  machine::SimulatedMachine machine(limits, {}, sink);
  machine.begin({});
  MemorySource source(text);
  auto interpreter = *(*find_dialect(control))->make({}, source, machine.events());
  double seconds = 0;
  for (StepState state = StepState::Ran; state == StepState::Ran;) {
    while (machine.has_room() && state == StepState::Ran) state = interpreter->step(1);
    seconds += machine
                   .poll(machine::Seconds{std::numeric_limits<double>::infinity()},
                         machine::MotionBackend::kNoLimit)
                   .count();
  }
  while (machine.resume()) {  // from the stops of its operator
    seconds += machine
                   .poll(machine::Seconds{std::numeric_limits<double>::infinity()},
                         machine::MotionBackend::kNoLimit)
                   .count();
  }
  EXPECT_TRUE(machine.drained());
  return seconds;
}

struct ClockCase {
  const char* name;
  const char* control;
  std::string text;
};
class ClockOfTheMachine : public testing::TestWithParam<ClockCase> {};

TEST_P(ClockOfTheMachine, IsTheCheckersToo) {
  const auto& row = GetParam();
  const double expected = simulated(row.control, row.text);
  ASSERT_GT(expected, 0.1);
  const Summary with = checked(row.control, row.text, machine_data());
  EXPECT_TRUE(with.has_acceleration);
  EXPECT_NEAR(with.seconds, expected, 1e-6 * expected);
  EXPECT_LT(checked(row.control, row.text, {}).seconds, expected) << "ramps take time";
}

/// A circle of short chords, longer than the clock's window.
std::string chords() {
  std::string text = "G21 F3000\n";
  for (int i = 1; i <= 5000; ++i) {
    const double angle = i * 0.01;
    text += "G1 X" + std::to_string(std::cos(angle) * 20 - 20) + " Y" +
            std::to_string(std::sin(angle) * 20) + "\n";
  }
  return text + "M2\n";
}

INSTANTIATE_TEST_SUITE_P(
    , ClockOfTheMachine,
    testing::Values(
        ClockCase{"tektronix_stops_and_flow", "tektronix-1704",
                  "%\nN1G00X10000F1000M03\nN2G01X20000Y2000\nX30000Y4000\nG00Y0\nG50X0\nN3M02\n"},
        ClockCase{
            "tektronix_arcs", "tektronix-1704",
            "%\nG01X10000F1000\nG02X20000Y-10000I10000J-10000\nG20X10000Y-20000I10000J-10000\n"
            "G00X0Y0\nM02\n"},
        ClockCase{
            "prototrak_events", "prototrak-plus",
            "PN1 G21;\nG100 X10.A Y10.A;\nG101 XB10.A YB10.A XE60.A YE10.A TC0 D0 F300 CR-;\n%\n"},
        ClockCase{"corners_and_arcs", "rs274ngc",
                  "G21 F2000\nG0 X10 Y10 Z-5\nG1 X60\nY40\nG3 X50 Y50 I-10\nG1 X10\nX10 Y10\n"
                  "G2 X10 Y10 I15 Z-8\nG0 Z20\nM2\n"},
        ClockCase{"a_curve_of_chords", "rs274ngc", chords()}),
    [](const auto& row) { return std::string{row.param.name}; });

// 100 mm at 100 mm/s with 500 mm/s^2: 1 s, and 0.2 s for the two ramps.
TEST(MotionClock, AddsTheRampsOfAMove) {
  const auto machine = machine_data("[machine]\nX = { acceleration = 500.0 }\n");
  EXPECT_NEAR(checked("rs274ngc", "G21 G1 X100 F6000\nM2\n", machine).seconds, 1.2, 1e-9);
  EXPECT_NEAR(checked("rs274ngc", "G21 G1 Y100 F6000\nM2\n", machine).seconds, 1.0, 1e-6)
      << "an axis that states none";
}

// A move too short for its feed: 2 * sqrt(s / a).
TEST(MotionClock, KnowsMovesThatDoNotReachTheirFeed) {
  EXPECT_NEAR(checked("rs274ngc", "G21 G1 X5 F6000\nM2\n", machine_data()).seconds, 0.2, 1e-9);
}

TEST(MotionClock, NeedsAnAccelerationInTheSetup) {
  EXPECT_FALSE(MotionClock::is_stated(machine_data("[machine]\nX = { rate = 100.0 }\n")));
  const auto bad = parse_machine_data("[machine]\nX = { acceleration = -1.0 }\n");
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().what.find("acceleration"), std::string::npos);
}

TEST(MotionClock, RefusesAnAccelerationThatNoMachineHasWithTheLimit) {
  const auto slow = parse_machine_data("[machine]\nX = { acceleration = 1e-300 }\n");
  ASSERT_FALSE(slow);
  EXPECT_THAT(slow.error().what, testing::HasSubstr("1e-300 mm/s2 is below the least, 0.1 mm/s2"));
  const auto rotary = parse_machine_data("[machine]\nC = { acceleration = 0.09 }\n");
  ASSERT_FALSE(rotary);
  EXPECT_THAT(rotary.error().what,
              testing::HasSubstr("0.09 degrees/s2 is below the least, 0.1 degrees/s2"));
  EXPECT_TRUE(parse_machine_data("[machine]\nX = { acceleration = 0.1 }\n"));
}

// The reader has the ramps' time to read: 0.5 inch at 200 inch/min are 0.15 s, and longer from rest
// to rest.
TEST(MotionClock, GivesTheReaderMoreTime) {
  const std::string tape = "%\nN1F2000G00X5000\nN2G00X10000" + std::string(40, ' ') + "\nN3M30\n";
  const auto forecast = [&](const MachineData& machine) {
    MemorySource source(tape);
    Forecast sink({100, 0.010, 0}, tape.size(), {}, {}, machine);
    EXPECT_TRUE(run_offline(**find_dialect("tektronix-1704"), {}, source, sink));
    return sink.finish();
  };
  const auto without = forecast({}), with = forecast(machine_data());
  ASSERT_EQ(without.worst.size(), with.worst.size());
  ASSERT_GE(with.worst.size(), 1U);
  // 12.7 mm at 84.67 mm/s and 500 mm/s^2: it just does not reach the feed.
  EXPECT_NEAR(with.worst[0].move_seconds, 2 * std::sqrt(12.7 / 500), 1e-6);
  EXPECT_NEAR(without.worst[0].move_seconds, 0.15, 1e-6);
  EXPECT_LT(with.wait_seconds, without.wait_seconds);
  EXPECT_EQ(with.blocks, without.blocks);
}

}  // namespace
}  // namespace dripline::interpreter
