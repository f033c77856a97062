#include "tests/unit/gateway/app/serial/serial_fixture.hpp"

namespace dripline::gateway {
namespace {

using ProcessEndOfALine = SerialGatewayTest;

TEST_F(ProcessEndOfALine, TakesStopsAndNothingElse) {
  options_.is_unattended = true;
  begin("flow=dc_codes");
  stop();
  order("%\nO77\nM30\n%\n");
  EXPECT_EQ(result_->reason, "the gateway is stopping");
  for (const char* verb : {"hold", "abort"})
    EXPECT_TRUE(panel(verb).starts_with("ok the gateway is stopping")) << verb;
  EXPECT_EQ(panel("emergency-stop on"), "ok");
}

}  // namespace
}  // namespace dripline::gateway
