#include "tests/unit/gateway/app/serial/serial_fixture.hpp"

/// A hold that comes while the program is looked through for where it begins.
namespace dripline::gateway {
namespace {

using namespace std::chrono_literals;

class HeldStart : public SerialGatewayTest {
 protected:
  /// The text comes when the server is there.
  void begin_looking() {
    begin("line=9600n81\neob=lf\nflow=none");
    std::string program = "O0077\n";
    for (int i = 1; i <= 2000; ++i) program += fmt::format("N{} G1 X{}. F100\n", i, i % 999);
    connect(false);
    order(program + "M30\n", "N1500 head=send");
    ASSERT_TRUE(result_ && result_->accepted) << (result_ ? result_->reason : "no answer");
    pass(1s);
    ASSERT_NE(status().message.find("looking through the program"), std::string::npos)
        << status().message;
  }
};

TEST_F(HeldStart, SendsNothingBeforeCycleStart) {
  begin_looking();
  EXPECT_EQ(panel("hold", "its sender waits no longer"), "ok") << "however late";
  EXPECT_EQ(status().execution, dds::Execution::FeedHold);
  EXPECT_EQ(status().message.find("held; looking through the program"), 0u) << status().message;
  connect(true);
  pass(30s);
  EXPECT_EQ(wire_.sent, "");
  EXPECT_EQ(status().waits_for, dds::WaitsFor::CycleStart) << status().message;
  EXPECT_EQ(panel("cycle-start", "its sender waits no longer"),
            "refused too late: its sender waits no longer; give it again");
  pass(1s);
  EXPECT_EQ(wire_.sent, "");
  EXPECT_EQ(panel("cycle-start"), "ok");
  EXPECT_TRUE(pass_until([&] { return wire_.sent.find("N1500") != std::string::npos; }, 30s));
}

TEST_F(HeldStart, BeginsByItselfWithoutOne) {
  begin_looking();
  connect(true);
  EXPECT_TRUE(pass_until([&] { return wire_.sent.find("N1500") != std::string::npos; }, 30s))
      << status().message;
}

}  // namespace
}  // namespace dripline::gateway
