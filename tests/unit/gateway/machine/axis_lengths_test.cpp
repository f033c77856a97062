#include "gateway/machine/axis_lengths.hpp"
#include "gateway/machine/capability_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dripline::machine {
namespace {

using interpreter::ActiveModes;
using interpreter::Axis;
using interpreter::Position;
using testing::HasSubstr;

Position at(double x, double z) {
  Position position;
  position.set_raw(Axis::X, x);
  position.set_raw(Axis::Z, z);
  return position;
}

ActiveModes with_length(double z, std::uint8_t bare_axes = 0) {
  ActiveModes modes;
  modes.tool_length_z = Length::mm(z);
  modes.bare_axes = bare_axes;
  return modes;
}

constexpr std::uint8_t kZ = 1 << 2;

class AxisLengthsTest : public testing::Test {
 protected:
  std::string take(AxisLengths& axes, const Position& to, std::uint64_t block,
                   bool is_arc = false) {
    return axes.take({to, block, is_arc}).value_or("");
  }
  AxisLengths follows{false}, shifts{true};
};

TEST_F(AxisLengthsTest, AreTakenInByTheNextMoveOfTheirAxis) {
  follows.begin(at(0, 0), {});
  follows.note(with_length(50), 1);
  EXPECT_EQ(take(follows, at(0, 10), 1), "");
  EXPECT_EQ(follows.lengths(), (ToolLengths{0, 0, 50}));
  EXPECT_EQ(take(follows, at(5, 10), 2), "") << "the other axes move freely from then on";
  EXPECT_EQ(take(follows, at(9, 10), 3, true), "") << "on arcs too";
}

TEST_F(AxisLengthsTest, AreNotMovedInByABlockThatLeavesTheirAxis) {
  follows.begin(at(0, 100), {});
  follows.note(with_length(50), 1);
  EXPECT_THAT(take(follows, at(5, 100), 2), HasSubstr("Z is 50.000 mm and was 0.000 mm"));
  EXPECT_THAT(take(follows, at(5, 100.01), 2), HasSubstr("leaves Z where it is"))
      << "the steps of a device are no move";
  EXPECT_EQ(follows.lengths(), ToolLengths{}) << "a refused move is not taken";
}

TEST_F(AxisLengthsTest, MayComeAndGoBetweenTwoMoves) {
  follows.begin(at(0, 100), {});
  follows.note(with_length(50), 1);
  follows.note(with_length(0), 2);
  EXPECT_EQ(take(follows, at(5, 100), 3), "");
}

TEST_F(AxisLengthsTest, AreNotTakenInOnAnArc) {
  follows.begin(at(0, 0), {});
  follows.note(with_length(50), 1);
  EXPECT_THAT(take(follows, at(5, -3), 1, true), HasSubstr("on an arc"));
}

TEST_F(AxisLengthsTest, OfAMoveThatIsGivenLaterAreNotThoseOfNow) {
  for (AxisLengths* axes : {&follows, &shifts}) {
    axes->begin(at(0, 0), {});
    axes->note(with_length(50), 7);
    EXPECT_THAT(take(*axes, at(5, -3), 6), HasSubstr("after the length of the tool has changed"));
    EXPECT_EQ(take(*axes, at(5, -3), 7), "");
  }
}

TEST_F(AxisLengthsTest, ThatShiftThePositionMoveNothing) {
  shifts.begin(at(0, 100), {});
  shifts.note(with_length(50), 1);
  EXPECT_EQ(shifts.shift(), (ToolLengths{0, 0, 50})) << "without a move";
  EXPECT_EQ(take(shifts, at(5, 50), 2), "");
  EXPECT_EQ(shifts.lengths(), (ToolLengths{0, 0, 50}));
  EXPECT_EQ(follows.shift(), ToolLengths{});
}

// G28 Z0 with a length in force, and the next tool's G43.
TEST_F(AxisLengthsTest, AreLeftOutInMachineCoordinates) {
  follows.begin(at(0, 0), {});
  follows.note(with_length(50), 1);
  ASSERT_EQ(take(follows, at(0, 10), 1), "");
  follows.note(with_length(50, kZ), 2);
  EXPECT_EQ(take(follows, at(0, 300), 2), "");
  EXPECT_EQ(follows.lengths(), ToolLengths{});
  EXPECT_EQ(take(follows, at(40, 300), 3), "") << "Z stays";
  follows.note(with_length(80), 4);
  EXPECT_EQ(take(follows, at(40, 10), 4), "");
  EXPECT_EQ(follows.lengths(), (ToolLengths{0, 0, 80}));
}

TEST_F(AxisLengthsTest, ContinueWithWhatTheAxesHave) {
  follows.begin(at(0, 10), {0, 0, 50});
  follows.note(with_length(50), 1);
  EXPECT_EQ(take(follows, at(5, 10), 1), "");
  follows.note_position(at(5, 4));
  follows.note(with_length(60), 2);
  EXPECT_THAT(take(follows, at(7, 4), 2), HasSubstr("Z is 60.000 mm and was 50.000 mm"))
      << "a probe has moved Z to 4";
}

// A spindle along U.
TEST(CapabilityFilter, AddsNoLengthToAnAxisBeyondZ) {
  class Alarms final : public interpreter::EventSink {
   public:
    void on_rapid(const interpreter::Rapid&) override { text += "moves"; }
    void on_alarm(const interpreter::Alarm& alarm) override { text += alarm.diagnostic.text; }
    std::string text;
  } sink;
  MotionCapabilities capabilities;
  capabilities.tool_lengths = capabilities.adds_lengths = true;
  ActiveModes modes = with_length(7);
  modes.length_axis = Axis::U;
  CapabilityFilter filter(capabilities, sink,
                          [&] {
                            return CapabilityFilter::Now{modes, 1};
                          },
                          {.shifts = false, .is_certain = true, .set = [](const ToolLengths&) {}});
  filter.on_rapid({.origin = {}, .to = at(1, 2)});
  EXPECT_THAT(sink.text, HasSubstr("of other axes than X, Y and Z"));
}

TEST(ToolLengths, OfAnotherAxisAreAddedThere) {
  ActiveModes modes = with_length(7);
  modes.length_axis = Axis::X;
  modes.tool_length_x = Length::mm(1);
  EXPECT_EQ(modes.lengths(), (ToolLengths{8, 0, 0}));
  modes.bare_axes = 1;
  EXPECT_EQ(axis_lengths_of(modes), ToolLengths{});
}

TEST(ToolLengths, AreAddedAndMarkNothing) {
  Position position = at(1, 2);
  position.unmark(Axis::Z);
  const Position moved = plus(position, {10, 20, 30});
  EXPECT_EQ(moved.raw(Axis::X), 11);
  EXPECT_EQ(moved.raw(Axis::Y), 20);
  EXPECT_EQ(moved.raw(Axis::Z), 32);
  EXPECT_TRUE(moved.has(Axis::X));
  EXPECT_FALSE(moved.has(Axis::Y));
  EXPECT_FALSE(moved.has(Axis::Z));
  EXPECT_TRUE(minus(moved, {10, 20, 30}).same_point(position));
}

}  // namespace
}  // namespace dripline::machine
