#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/app/position_fixture.hpp"
#include "tests/unit/gateway/app/toy_motion.hpp"

/// Machines that move by coordinates without tool lengths (MotionCapabilities::tool_lengths): the
/// tip would be deeper by the length.
namespace dripline::gateway {
namespace {

using interpreter::Dialect;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kTool = "[[tool]]\nnumber = 1\nlength = 50.0\n";
constexpr const char* kWithLength = "G21 G90 G94 F600\nG1 X3.\nG43 H1\nG0 Z5.\nM30\n";

std::unique_ptr<Shop> device(const Dialect& control, const std::string& toml, bool checks) {
  auto shop = std::make_unique<Shop>(control, toml, "1x");
  shop->motion = [=](machine::ExecutionSink& sink) {
    return std::make_unique<ToyMotion>(sink, checks);
  };
  shop->restart_gateway();
  return shop;
}

TEST(DeviceLength, InForceIsAnAlarmBeforeTheFirstMove) {
  for (const Dialect* control : {&interpreter::kFanucDialect, &interpreter::kRs274NgcDialect}) {
    auto shop = device(*control, kTool, true);
    EXPECT_THAT(shop->run(kWithLength),
                AllOf(StartsWith("MCH0008"), HasSubstr("Z 50.000 mm is in force"),
                      HasSubstr("(line 3, found before the first move)")))
        << control->name;
    EXPECT_EQ(shop->at(0), 0) << control->name;
  }
}

// A program that was not looked through, or not up to there: everything before is executed.
TEST(DeviceLength, IsAnAlarmInPlaceOfTheMove) {
  auto shop = device(interpreter::kFanucDialect, kTool, false);
  EXPECT_THAT(shop->run(kWithLength), AllOf(StartsWith("MCH0008"), HasSubstr("Z 50.000 mm")));
  EXPECT_EQ(shop->at(0), 3);
  EXPECT_EQ(shop->at(2), 0);
  EXPECT_THAT(shop->mdi("G21 G90 G94 F600 G43 H1 G1 Z5.\n"), StartsWith("MCH0008"));
  EXPECT_EQ(shop->at(2), 0);
}

// Compensation holds the motion back until after the length has ended.
TEST(DeviceLength, OfAMotionThatWaitsIsOneToo) {
  const std::string tools = std::string(kTool) + "[[tool]]\nnumber = 30\nradius = 1.0\n";
  for (const bool checks : {true, false}) {
    auto shop = device(interpreter::kFanucDialect, tools, checks);
    EXPECT_THAT(shop->run("G21 G90 G94 F600\nG1 X1. Y0 Z0\nG41 D30 X5.\nG43 H1 G1 Z-8.\nG49\n"
                          "X30.\nG40 X40.\nM30\n"),
                StartsWith("MCH0008"));
    EXPECT_EQ(shop->at(2), 0);
  }
}

TEST(DeviceLength, OfALatheIsOneToo) {
  auto shop = device(interpreter::kFanucLatheDialect, "[[tool]]\nnumber = 3\nX = 1.0\n", true);
  EXPECT_THAT(shop->run("G21 T0303\nG98 G1 X6. F600\nM30\n"),
              AllOf(StartsWith("MCH0008"), HasSubstr("X 1.000")));
}

TEST(DeviceLength, ThatIsNotInForceIsNone) {
  auto shop = device(interpreter::kFanucDialect, kTool, true);
  EXPECT_EQ(shop->run("G21 G90 G94 F600\nG1 X3.\nG43 H2\nG1 X4.\nG49\nM30\n"), "completed");
  EXPECT_EQ(shop->at(0), 4);
}

}  // namespace
}  // namespace dripline::gateway
