// Which length of a tool the reported position leaves out, block by block.
#include <gtest/gtest.h>

#include "gateway/app/run/tool_in_position.hpp"

namespace dripline::gateway {
namespace {

using interpreter::ActiveModes;
using interpreter::Axis;

ActiveModes with_length(double z, bool is_plain = true) {
  ActiveModes modes;
  modes.tool_length_z = Length::mm(z);
  modes.is_length_plain = is_plain;
  return modes;
}

/// Of one axis, in one block.
EventTracker::Moves moved(Axis axis, std::uint64_t block, bool has_tool = false) {
  EventTracker::Moves moves;
  moves.axes[static_cast<std::size_t>(axis)] = {block, block};
  moves.has_tool = has_tool;
  return moves;
}

/// Block 1 moves Z without a tool; 2 brings a length of 10; 3 moves X, 4 moves Z, 5 and 6 move X.
ToolHistory history(bool shifts) {
  ToolHistory history(shifts);
  history.begin(std::nullopt, with_length(0));
  history.note(1, with_length(0), moved(Axis::Z, 1));
  history.note(2, with_length(10), {});
  history.note(3, with_length(10), moved(Axis::X, 3));
  history.note(4, with_length(10), moved(Axis::Z, 4));
  history.note(5, with_length(10), moved(Axis::X, 5));
  history.note(6, with_length(10), moved(Axis::X, 6));
  return history;
}

struct Case {
  std::string name;
  bool shifts;
  std::optional<std::uint64_t> cut_off;
  double in_force, left_out;
  bool is_known;
};
void PrintTo(const Case& shown, std::ostream* out) {
  *out << shown.name;
}
class ToolHistoryOfARun : public testing::TestWithParam<Case> {};

TEST_P(ToolHistoryOfARun, KnowsTheLengthOrThatItDoesNot) {
  const Case& given = GetParam();
  const ToolInPosition end = history(given.shifts).at_end(given.cut_off);
  EXPECT_EQ(end.in_force[2], given.in_force);
  EXPECT_EQ(end.left_out[2], given.left_out);
  EXPECT_EQ(end.length_fault(Axis::Z).empty(), given.is_known);
  EXPECT_TRUE(end.length_fault(Axis::X).empty());
}

INSTANTIATE_TEST_SUITE_P(, ToolHistoryOfARun,
                         testing::Values(Case{"before", false, 1, 0, 0, true},
                                         Case{"axes_follow", false, 2, 10, 10, true},
                                         Case{"another_axis_moves", false, 3, 10, 10, true},
                                         Case{"within_the_move", false, 4, 10, 10, false},
                                         Case{"the_block_after_it_may_be_counted_one_less", false,
                                              5, 10, 10, false},
                                         Case{"later", false, 6, 10, 10, true},
                                         Case{"completed", false, std::nullopt, 10, 10, true},
                                         Case{"shift_shows_later", true, 2, 10, 0, true},
                                         Case{"shift_shows_later_still", true, 3, 10, 0, true},
                                         Case{"shift_within_the_move", true, 4, 10, 10, false},
                                         Case{"shift_later", true, 6, 10, 10, true},
                                         Case{"shift_completed", true, std::nullopt, 10, 10, true}),
                         [](const auto& i) { return i.param.name; });

// The move of block 2, which brings the length, is given when block 4 has ended the length.
TEST(ToolHistory, KnowsTheBlockOfAMoveThatHasWaited) {
  for (const bool shifts : {false, true}) {
    ToolHistory history(shifts);
    history.begin(std::nullopt, with_length(0));
    history.note(1, with_length(0), moved(Axis::Z, 1));
    history.note(2, with_length(10), {});
    history.note(3, with_length(10), {});
    history.note(4, with_length(0), moved(Axis::Z, 2));
    EXPECT_FALSE(history.at_end(2).length_fault(Axis::Z).empty()) << "in the middle of it";
    EXPECT_FALSE(history.at_end(3).length_fault(Axis::Z).empty());
    EXPECT_TRUE(history.at_end(4).length_fault(Axis::Z).empty());
    EXPECT_EQ(history.at_end(4).left_out[2], shifts ? 10 : 0);
    history.note(5, with_length(0), moved(Axis::Z, 5));
    EXPECT_FALSE(history.at_end(5).length_fault(Axis::Z).empty());
    EXPECT_EQ(history.at_end(std::nullopt).left_out[2], 0);
  }
}

TEST(ToolHistory, GoesOverToTheNextRun) {
  ToolHistory first(true);
  first.begin(std::nullopt, with_length(0));
  first.note(1, with_length(10), {});
  const ToolInPosition between = first.at_end(std::nullopt);
  EXPECT_EQ(between.left_out[2], 0);
  EXPECT_FALSE(between.datum_fault(Axis::Z, false).empty()) << "the shift shows with the next move";
  ToolHistory second(true);
  second.begin(between, with_length(10));
  EXPECT_EQ(second.at_end(std::nullopt).left_out[2], 0);
  second.note(1, with_length(10), moved(Axis::Z, 1));
  EXPECT_EQ(second.at_end(std::nullopt).left_out[2], 10);
}

TEST(ToolHistory, DoesNotKnowATiltedTool) {
  ToolHistory tilted(false);
  tilted.begin(std::nullopt, with_length(0));
  tilted.note(1, with_length(10, false), moved(Axis::X, 1));
  EXPECT_FALSE(tilted.at_end(std::nullopt).length_fault(Axis::X).empty());
}

TEST(ToolHistory, IsAsGoodWithoutTheBlocksThatAreOver) {
  for (const std::uint64_t executing : {2, 3, 4, 5, 6}) {
    ToolHistory pruned = history(true);
    pruned.drop(executing);
    const ToolInPosition end = pruned.at_end(executing), whole = history(true).at_end(executing);
    EXPECT_EQ(end.left_out, whole.left_out) << executing;
    EXPECT_EQ(end.unknown, whole.unknown) << executing;
  }
}

// The axes stay: what the position has left out is in it.
TEST(ToolInPosition, OfADroppedToolIsThatOfTheAxes) {
  ToolInPosition tool;
  tool.in_force = tool.left_out = {2, 0, -10};
  interpreter::Position at;
  at.set_raw(Axis::X, 40);
  at.set_raw(Axis::Z, 5);
  tool.drop_tool(at);
  EXPECT_EQ(at.raw(Axis::X), 42);
  EXPECT_EQ(at.raw(Axis::Z), -5);
  EXPECT_EQ(tool.left_out, ToolLengths{});
  EXPECT_NE(tool.datum_fault(Axis::X, true).find("(X 4 mm)"), std::string::npos);
  ToolHistory next(false);
  next.begin(tool, with_length(0));
  next.note(1, with_length(0), moved(Axis::X, 1));
  EXPECT_FALSE(next.at_end(std::nullopt).datum_fault(Axis::X, true).empty())
      << "no tool was called";
  next.note(2, with_length(0), moved(Axis::X, 2, true));
  EXPECT_TRUE(next.at_end(std::nullopt).datum_fault(Axis::X, true).empty());
}

}  // namespace
}  // namespace dripline::gateway
