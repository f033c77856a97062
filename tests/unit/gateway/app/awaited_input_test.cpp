#include "gateway/app/run/awaited_input.hpp"

#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

namespace dripline::gateway {
namespace {

using interpreter::InputWait;
using namespace std::chrono_literals;

constexpr SteadyTime kBegin{};

AwaitedInput wait_for(InputWait wait) {
  return {{.pin = 1, .wait = wait, .seconds = 2}, kBegin};
}

TEST(AwaitedInput, IsFulfilledByTheStateAtOnce) {
  EXPECT_EQ(wait_for(InputWait::High).look(true, kBegin), true);
  EXPECT_EQ(wait_for(InputWait::Low).look(false, kBegin), true);
}

TEST(AwaitedInput, IsOverAfterItsTime) {
  AwaitedInput high = wait_for(InputWait::High);
  EXPECT_EQ(high.look(false, kBegin + 1999ms), std::nullopt);
  EXPECT_EQ(high.look(false, kBegin + 2s), false);
}

TEST(AwaitedInput, AChangeNeedsTheOtherStateFirst) {
  AwaitedInput rise = wait_for(InputWait::Rise);
  EXPECT_EQ(rise.look(true, kBegin), std::nullopt);
  EXPECT_EQ(rise.look(false, kBegin), std::nullopt);
  EXPECT_EQ(rise.look(true, kBegin), true);
  AwaitedInput fall = wait_for(InputWait::Fall);
  EXPECT_EQ(fall.look(false, kBegin), std::nullopt);
  EXPECT_EQ(fall.look(true, kBegin), std::nullopt);
  EXPECT_EQ(fall.look(false, kBegin), true);
}

TEST(AwaitedInput, AnEndlessTimeIsLong) {
  AwaitedInput high({.pin = 1, .wait = InputWait::High, .seconds = 1e300}, kBegin);
  EXPECT_EQ(high.look(false, kBegin + 24h), std::nullopt);
}

// The simulated machine has inputs that are low.
TEST(AwaitedInputOfAProgram, TakesItsTimeAndItsResult) {
  GatewayFixture fixture(interpreter::kRs274NgcDialect,
                         setup_from("[control]\nprofile = \"linuxcnc\"\n"), "1x");
  fixture.push("1",
               "G21 M66 P1 L3 Q2\n(PRINT,a#5399)\nM66 P1 L4 Q2\n(PRINT,b#5399)\n"
               "M66 P1\n(PRINT,c#5399)\nM2\n");
  const auto begin = fixture.steady_time();
  EXPECT_TRUE(fixture.start("1").accepted);
  EXPECT_EQ(fixture.ended().outcome, dds::RunOutcome::Completed);
  EXPECT_EQ(fixture.lines(), (std::vector<std::string>{"a-1.000000", "b0.000000", "c0.000000"}));
  EXPECT_GE(fixture.steady_time() - begin, 2s);
  EXPECT_LT(fixture.steady_time() - begin, 4s);
}

}  // namespace
}  // namespace dripline::gateway
