#include "tests/unit/gateway/app/serial/serial_fixture.hpp"

namespace dripline::gateway {
namespace {

using KeptStopOfALine = SerialGatewayTest;

TEST_F(KeptStopOfALine, OutlivesTheGatewayUntilItIsReleasedAtThePanel) {
  options_.is_unattended = true;
  begin("flow=dc_codes");
  ASSERT_EQ(panel("emergency-stop on"), "ok");
  end();
  begin("flow=dc_codes");
  order("%\nO77\nM30\n%\n");
  EXPECT_FALSE(result_->accepted);
  EXPECT_NE(panel("status").find("emergency_stop=pressed"), std::string::npos);
  ASSERT_EQ(panel("emergency-stop off"), "ok");
  end();
  begin("flow=dc_codes");
  EXPECT_NE(panel("status").find("emergency_stop=released"), std::string::npos);
}

TEST_F(KeptStopOfALine, SaysWhereItCannotBeKept) {
  begin("flow=dc_codes");
  const auto file = folder_.path() / "emergency-stop";
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  const std::string answer = panel("emergency-stop on");
  EXPECT_TRUE(answer.starts_with("ok pressed and in force, but it does not outlive")) << answer;
  EXPECT_NE(panel("status").find("emergency_stop=pressed"), std::string::npos);
}

}  // namespace
}  // namespace dripline::gateway
