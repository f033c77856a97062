// A held jog: one that moves only while it is kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/app/jog_fixture.hpp"

namespace dripline::gateway {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using namespace std::chrono_literals;

class HeldJog : public testing::Test {
 protected:
  /// 10 mm a second.
  dds::Command begin() { return shop.begin("X 60 mm F600 hold=a1"); }
  std::string keep(const std::string& word = "a1") { return shop.jog("keep=" + word); }
  /// Ten times a second.
  void keep_for(std::chrono::milliseconds time) {
    for (auto passed = 0ms; passed < time; passed += 100ms) {
      shop.pass(100ms);
      ASSERT_EQ(keep(), "");
    }
  }

  JogShop shop{interpreter::kFanucDialect};
};

TEST_F(HeldJog, MovesWhileItIsKeptAndStopsSoonAfter) {
  const auto command = begin();
  keep_for(2s);
  const double at = shop.at(0);
  EXPECT_NEAR(at, 20, 2.5) << "it moved all the time";
  EXPECT_THAT(shop.end_of(command), HasSubstr("stopped since it was no longer held"));
  EXPECT_GT(shop.at(0), at);
  EXPECT_LT(shop.at(0) - at, 4) << "300 ms at 10 mm/s, and the braking";
  shop.pass(2s);
  EXPECT_LT(shop.at(0) - at, 4);
}

TEST_F(HeldJog, StopsWhereNothingEverKeepsIt) {
  const auto command = begin();
  EXPECT_THAT(shop.end_of(command), HasSubstr("no longer held"));
  EXPECT_LT(shop.at(0), 4);
}

TEST_F(HeldJog, EndsAtItsDistance) {
  const auto command = shop.begin("X 5 mm F600 hold=a1");
  for (int i = 0; i < 8; ++i) {
    shop.pass(100ms);
    (void)keep();
  }
  EXPECT_EQ(shop.end_of(command), "X 5 mm");
  EXPECT_EQ(keep(), "refused: no jog is held by that word");
  shop.pass(1s);
  EXPECT_EQ(shop.at(0), 5) << "nothing begins it again";
}

TEST_F(HeldJog, IsNotKeptByTheWordOfAnother) {
  const auto command = begin();
  for (int i = 0; i < 6; ++i) {
    shop.pass(100ms);
    EXPECT_THAT(keep("a2"), StartsWith("refused: "));
  }
  EXPECT_THAT(shop.end_of(command), HasSubstr("no longer held"));
  EXPECT_LT(shop.at(0), 4);
}

TEST_F(HeldJog, IsNotKeptOnceItStops) {
  const auto command = begin();
  keep_for(500ms);
  (void)shop.send(shop.stop());
  EXPECT_THAT(keep(), StartsWith("refused: "));
  EXPECT_THAT(shop.end_of(command), HasSubstr("by command"));
  const double at = shop.at(0);
  EXPECT_THAT(keep(), StartsWith("refused: "));
  shop.pass(1s);
  EXPECT_EQ(shop.at(0), at);
}

/// The network had them: what comes late keeps nothing.
TEST_F(HeldJog, IsNotKeptByWhatComesLate) {
  const auto command = begin();
  shop.pass(100ms);
  dds::Command late = shop.jog_command("keep=a1");
  late.deadline = shop.steady_time();
  shop.pass(150ms);
  EXPECT_THAT(shop.answer_to(late), AllOf(StartsWith("refused: "), HasSubstr("deadline")));
  EXPECT_THAT(shop.end_of(command), HasSubstr("no longer held"));
  EXPECT_LT(shop.at(0), 4);
}

TEST_F(HeldJog, HasTheLimitsOfAStep) {
  shop.allow_jogs(10, 600);
  EXPECT_THAT(shop.jog("X 60 mm F600 hold=a1"), HasSubstr("a step of 60 mm"));
  shop.allow_jogs(0, 600);
  EXPECT_THAT(shop.jog("X 1 mm F600 hold=a1"), HasSubstr("allows no jog"));
  EXPECT_THAT(keep(), StartsWith("refused: "));
  EXPECT_EQ(shop.at(0), 0);
}

/// Without a word a step ends by itself, and nothing keeps or stops it.
TEST_F(HeldJog, IsNoStep) {
  const auto command = shop.begin("X 8 mm F600");
  EXPECT_THAT(keep(), StartsWith("refused: "));
  EXPECT_EQ(shop.end_of(command), "X 8 mm");
}

}  // namespace
}  // namespace dripline::gateway
