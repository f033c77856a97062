#include <gtest/gtest.h>

#include <charconv>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// FAN-076: the clock that a program sees passes as the machine's time does.
namespace dripline::gateway {
namespace {

/// The numbers of the line that the program prints.
std::vector<long> printed(const std::string& speed, const std::string& program,
                          const std::string& toml = {}) {
  const auto setup = interpreter::parse_setup(toml);
  EXPECT_TRUE(setup);
  GatewayFixture fixture(interpreter::kFanucDialect, *setup, speed);
  fixture.push("1", program);
  EXPECT_TRUE(fixture.start("1").accepted);
  EXPECT_EQ(fixture.ended().outcome, dds::RunOutcome::Completed);
  std::vector<long> numbers;
  for (const std::string& line : fixture.lines()) {
    const char* end = line.data() + line.size();
    for (const char* at = line.data(); at != end;) {
      long number = 0;
      const auto [after, error] = std::from_chars(at, end, number);
      if (error == std::errc()) numbers.push_back(number);
      at = after == at ? at + 1 : after;
    }
  }
  return numbers;
}

constexpr const char* kTenSeconds = "#3001=0\nG04 X10.\nPOPEN\nDPRNT[#3001[60]]\nPCLOS\nM30\n";

class ProgramClock : public testing::TestWithParam<const char*> {};

TEST_P(ProgramClock, CountsTheMachinesTime) {
  const auto numbers = printed(GetParam(), kTenSeconds);
  ASSERT_EQ(numbers.size(), 1U);
  EXPECT_GE(numbers[0], 10'000);
  EXPECT_LE(numbers[0], 13'000) << "a few rounds of the gateway are more";
}
INSTANTIATE_TEST_SUITE_P(, ProgramClock, testing::Values("1x", "100x", "0.5x", "max"),
                         [](const auto& each) {
                           const std::string speed = each.param;
                           return speed == "0.5x" ? "half" : "as_" + speed;
                         });

TEST(ProgramClockOfASetup, RunsFromItsDateAndGoesPastMidnight) {
  const auto numbers =
      printed("100x", "G04 X10.\nPOPEN\nDPRNT[#3011[80]*#3012[60]]\nPCLOS\nM30\n",
              "date_time = \"2026-12-31T23:59:58\"\n[control]\nleading_zero_print = false\n");
  ASSERT_EQ(numbers.size(), 2U);
  EXPECT_EQ(numbers[0], 20'270'101);
  EXPECT_GE(numbers[1], 8);
  EXPECT_LE(numbers[1], 11);
}

}  // namespace
}  // namespace dripline::gateway
