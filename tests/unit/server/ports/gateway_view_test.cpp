#include "server/ports/gateways/gateway_view.hpp"

#include <gtest/gtest.h>

namespace dripline::ports {
namespace {

dds::LineStatus line_status() {
  dds::LineStatus line;
  line.address = "/dev/ttyUSB0";
  line.line_template = "tnc155";
  line.settings = "4800e71\neob=lf";
  line.is_open = true;
  return line;
}

PortView view_of_line(const dds::LineStatus& line, bool is_connected = true) {
  machines::MachineView machine;
  machine.machine.name = "mill-3";
  machine.is_connected = is_connected;
  return view_of(machine, line);
}

TEST(GatewayView, HasTheLineAsItIsSetUpAtTheGateway) {
  const auto view = view_of_line(line_status());
  EXPECT_EQ(view.port.name, "mill-3");
  EXPECT_EQ(view.port.machine, "mill-3");
  EXPECT_EQ(wire::short_form(view.settings), "4800e71");
  EXPECT_TRUE(view.is_open);
  EXPECT_FALSE(view.waiting_since || view.request || view.transfer);
}

TEST(GatewayView, HasWhatTheControlAskedForAndSinceWhenTheLineWaits) {
  auto line = line_status();
  line.waiting_for = "DC1";
  line.waits_without_limit = true;
  line.waiting_since = UtcTime(std::chrono::hours(400'000));
  line.asked = dds::LineAsked{UtcTime(std::chrono::hours(400'001)), "15", "no program is left"};
  const auto view = view_of_line(line);
  EXPECT_EQ(view.line.waiting_for, "DC1");
  EXPECT_EQ(view.waiting_since, line.waiting_since);
  ASSERT_TRUE(view.request);
  EXPECT_EQ(view.request->since, line.asked->since);
  EXPECT_EQ(view.request->program, "15");
  EXPECT_EQ(view.request->answer, "no program is left");
}

/// A word of a newer gateway is not kept: it would have to outlive the status.
TEST(GatewayView, NamesAWaitThatItDoesNotKnow) {
  auto line = line_status();
  line.waiting_for = "DC9";
  EXPECT_EQ(view_of_line(line).line.waiting_for, "the control");
}

TEST(GatewayView, HasTheLastTransfer) {
  auto line = line_status();
  line.transfer = dds::LineTransfer{.id = "transfer-1",
                                    .programs = "O0077 revision 1\nO0078 revision 3",
                                    .size = 90,
                                    .sent = 40,
                                    .state = dds::LineTransferState::Aborted,
                                    .reason = "stopped"};
  const auto view = view_of_line(line);
  ASSERT_TRUE(view.transfer);
  EXPECT_EQ(view.transfer->id, "transfer-1");
  EXPECT_EQ(view.transfer->programs,
            (std::vector<std::string>{"O0077 revision 1", "O0078 revision 3"}));
  EXPECT_EQ(view.transfer->size, 90U);
  EXPECT_EQ(view.transfer->sent, 40U);
  EXPECT_EQ(view.transfer->state, TransferState::Aborted);
  EXPECT_EQ(view.transfer->reason, "stopped");
}

TEST(GatewayView, OfAGatewayThatIsAwayIsNotOpen) {
  const auto view = view_of_line(line_status(), false);
  EXPECT_FALSE(view.is_open);
  EXPECT_EQ(view.fault, "its gateway is not connected");
}

}  // namespace
}  // namespace dripline::ports
