#include "gateway/app/restart/in_hand.hpp"

#include <gtest/gtest.h>

#include "gateway/app/restart/checkpoint.hpp"

namespace dripline::gateway {
namespace {

using machine::GivenAction;
using Kind = GivenAction::Kind;

/// Moves to these X, a block each from block 11 on; the axes begin at X 0.
InHand moves(const std::vector<double>& to) {
  InHand in_hand;
  double at = 0;
  for (const double x : to) {
    report::MotionJournal::Entry entry;
    entry.place.executed = entry.action.origin.block = 11 + in_hand.size();
    entry.place.path = 100 + entry.place.executed;
    entry.action.kind = Kind::Motion;
    entry.action.ends_block = true;
    entry.action.from[0] = at;
    entry.action.end[0] = at = x;
    in_hand.push_back(entry);
  }
  return in_hand;
}

report::Progress executed(std::uint64_t block) {
  report::Progress progress;
  progress.executed = block;
  progress.sent = 4096;
  return progress;
}

TEST(InHand, IsSettledByThePlaceWhereTheAxesRest) {
  InHand in_hand = moves({1, 2, 3});
  report::Progress progress = executed(10);
  ASSERT_TRUE(resolve(in_hand, GivenAction::Point{2.5}, progress));
  EXPECT_EQ(progress.executed, 12u);
  EXPECT_EQ(progress.path, 112u);
  EXPECT_EQ(progress.sent, 4096u);
  EXPECT_TRUE(in_hand.empty());
}

TEST(InHand, BlocksThatDoNothingFollowTheMotion) {
  InHand in_hand = moves({1, 2, 3});
  in_hand[1].action.kind = Kind::BlockEnd;
  in_hand[2].action.from[0] = 1;
  report::Progress progress = executed(10);
  ASSERT_TRUE(resolve(in_hand, GivenAction::Point{1}, progress));
  EXPECT_EQ(progress.executed, 12u);
}

TEST(InHand, IsUncertainWhereThePathComesBack) {
  InHand in_hand = moves({1, 2, 1, 0});
  report::Progress progress = executed(10);
  EXPECT_FALSE(resolve(in_hand, GivenAction::Point{1}, progress));
  EXPECT_EQ(progress.executed, 11u) << "no more than was done in any case";
  EXPECT_EQ(last_block(in_hand), 14u);
}

TEST(InHand, IsUncertainWithoutAPositionOrElsewhere) {
  InHand in_hand = moves({1, 2});
  report::Progress progress = executed(10);
  EXPECT_FALSE(resolve(in_hand, std::nullopt, progress));
  EXPECT_FALSE(resolve(in_hand, GivenAction::Point{1, 5}, progress));
  EXPECT_EQ(progress.executed, 10u);
  EXPECT_EQ(last_block(in_hand), 12u);
}

TEST(InHand, EndsWhereTheMachineWaits) {
  InHand in_hand = moves({1, 2, 3});
  in_hand[1].action.kind = Kind::Other;
  EXPECT_EQ(motion_of(in_hand).size(), 1u);
  in_hand[0].action.kind = Kind::BlockEnd;
  EXPECT_TRUE(motion_of(in_hand).empty()) << "nothing moves";
}

TEST(InHand, IsPartOfAnEnding) {
  RunEnding ending;
  ending.in_hand = moves({1, 2});
  ending.in_hand[1].action.arc.emplace();
  ending.in_hand[1].action.arc->center_first = 3;
  const auto read = decode_ending("run-1", encode("run-1", ending));
  ASSERT_TRUE(read) << read.error().what;
  ASSERT_EQ(read->in_hand.size(), 2u);
  EXPECT_EQ(read->in_hand[1].place, ending.in_hand[1].place);
  EXPECT_EQ(read->in_hand[1].action.end, ending.in_hand[1].action.end);
  EXPECT_EQ(read->in_hand[1].action.arc->center_first, 3);
}

}  // namespace
}  // namespace dripline::gateway
