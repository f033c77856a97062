#include <gmock/gmock.h>

#include "tests/support/fault_runs.hpp"

/// Both ends of a line together, without faults: the rate of the line, and how soon it stops.
namespace dripline::wire {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::LineSimulator;

std::unique_ptr<Discipline> end_of(const LineSettings& settings, Role role) {
  auto made = make_discipline(settings, role);
  EXPECT_TRUE(made);
  return std::move(*made);
}

LineSettings line_of(std::string_view name) {
  const auto found = find_template(name);
  EXPECT_TRUE(found);
  return (*found)->settings;
}

LineSimulator simulated(const LineSettings& settings, test_support::LineFaults faults = {}) {
  return LineSimulator({settings, end_of(settings, Role::Host), end_of(settings, Role::Control),
                        std::move(faults), 7});
}

std::string long_program(std::size_t blocks) {
  test_support::FaultDice dice(3);
  return test_support::random_program(dice, blocks);
}

TEST(SimulatedLine, IsUsedWithoutAGap) {
  LineSettings settings = line_of("plain");
  settings.end_character = '%';
  LineSimulator line = simulated(settings);
  const std::string text = long_program(200);
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  ASSERT_EQ(line.run(hours(1)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(line.control().received, text);
  const auto characters = static_cast<std::int64_t>(line.from_host().characters);
  EXPECT_EQ(line.now(), characters * character_time(settings));
}

TEST(SimulatedLine, HoldsAtMostTwoCharactersAfterDc3) {
  LineSettings settings = line_of("plain");
  LineSimulator line = simulated(settings);
  line.control().hold_rate = 0.05;
  const std::string text = long_program(200);
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  ASSERT_EQ(line.run(hours(1)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(line.control().received, text);
  EXPECT_GT(line.from_host().left_after_stop, 0u) << "or nothing was counted";
  EXPECT_LE(line.from_host().left_after_stop, 2u);
  EXPECT_EQ(line.from_host().given_after_stop, 0u);
}

TEST(SimulatedLine, StopsWhenCtsGoesOff) {
  LineSimulator line = simulated(line_of("rtscts"));
  line.control().hold_rate = 0.05;
  const std::string text = long_program(100);
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  ASSERT_EQ(line.run(hours(1)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(line.control().received, text);
  EXPECT_GT(line.from_host().left_after_stop, 0u);
  EXPECT_LE(line.from_host().left_after_stop, 2u);
}

TEST(SimulatedLine, StaysBelowTheTenCharactersOfAFanuc) {
  LineSettings settings = line_of("fanuc");
  LineSimulator line = simulated(settings);
  line.control().hold_rate = 0.05;
  const std::string text = long_program(100);
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  ASSERT_EQ(line.run(hours(1)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(line.control().received, text);
  EXPECT_TRUE(line.control().failures.empty());
}

TEST(SimulatedLine, PacesWhatNothingHolds) {
  const LineSettings settings = line_of("prototrak");
  LineSimulator line = simulated(settings);
  std::string text;
  for (int i = 0; i < 20; ++i) text += "N1 G101 XB1 ;\n";
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  ASSERT_EQ(line.run(hours(1)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(line.control().received, text + "%\n");
  EXPECT_GE(line.now(), 20 * settings.line_delay);
}

TEST(SimulatedLine, WaitsForAControlThatHoldsForHours) {
  LineSettings settings = line_of("plain");
  LineSimulator line = simulated(settings);
  line.control().hold_rate = 0.001;
  line.control().hold_time = hours(3);
  const std::string text = long_program(50);
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  line.run(hours(24 * 30));
  EXPECT_EQ(line.control().received, text);
  EXPECT_GT(line.now(), hours(3)) << "it was never held";
}

TEST(SimulatedLine, CarriesReportsWhileItFeeds) {
  LineSettings settings = line_of("centurion");
  LineSimulator line = simulated(settings);
  const std::string text = long_program(100), report = "X 1.0000\nX 2.0000\n";
  std::string reported;
  line.host().on_event = [&](test_support::LineEnd&, const Event& event, LineTime) {
    if (const auto* received = std::get_if<TextReceived>(&event)) reported += received->text;
  };
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  line.run_until(milliseconds(500));
  ASSERT_TRUE(line.control().send(report, line.now()));
  ASSERT_EQ(line.run(hours(1)), LineSimulator::Outcome::Idle);
  EXPECT_EQ(line.control().received, text);
  EXPECT_EQ(reported, report);
}

TEST(SimulatedLine, LosesTheSelectedCharacters) {
  LineSettings settings = line_of("plain");
  LineSimulator line =
      simulated(settings, {.rate = 0.05, .kinds = {test_support::LineFaults::Kind::Drop}});
  const std::string text = long_program(100);
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(text, line.now()));
  line.run(seconds(3600));
  EXPECT_GT(line.from_host().faults, 0u);
  EXPECT_EQ(line.from_host().silent, line.from_host().faults);
  EXPECT_LT(line.control().received.size(), text.size());
}

TEST(SimulatedLine, ReportsParityErrorsWhereTheLineHasParity) {
  LineSettings settings = line_of("fanuc");
  LineSimulator line =
      simulated(settings, {.rate = 0.05, .kinds = {test_support::LineFaults::Kind::Flip}});
  ASSERT_TRUE(line.control().line->begin_receive("", line.now()));
  ASSERT_TRUE(line.host().send(long_program(100), line.now()));
  line.run(seconds(3600));
  EXPECT_GT(line.from_host().reported, 0u);
  EXPECT_EQ(line.from_host().silent, 0u);
  ASSERT_FALSE(line.control().failures.empty());
  EXPECT_THAT(line.control().failures.front().what, testing::HasSubstr("085"));
}

}  // namespace
}  // namespace dripline::wire
