#include "clients/cli/port/port_text.hpp"

#include <gtest/gtest.h>
#include <cstdlib>

namespace dripline::cli {
namespace {

client::Port open_port() {
  client::Port port;
  port.name = "line-1";
  port.open = true;
  port.line.phase = "idle";
  port.effective = {{"line", "9600e72"}, {"flow", "rtscts"}};
  return port;
}

TEST(PortText, SaysHowTheLineIsSet) {
  EXPECT_EQ(line_text(open_port().effective), "9600e72 rtscts");
}

// HD-081
TEST(PortText, WarnsOfAControlAtAnotherRate) {
  auto port = open_port();
  port.machine = "mill-3";
  EXPECT_EQ(baud_warning(port, 4800), "") << "the line's rate is not known";
  port.effective["baud"] = "9600";
  EXPECT_EQ(baud_warning(port, std::nullopt), "");
  EXPECT_EQ(baud_warning(port, 9600), "");
  EXPECT_EQ(baud_warning(port, 4800),
            "The setup of mill-3 has 4800 baud for the control, and the line has 9600.");
}

TEST(PortText, SaysWhatTheLineDoes) {
  auto port = open_port();
  EXPECT_EQ(state_text(port), "open");
  EXPECT_EQ(style_of_state(port), Style::Good);
  port.line.phase = "sending";
  EXPECT_EQ(state_text(port), "sending");
  port.line.stopped = true;
  EXPECT_EQ(state_text(port), "sending, stopped by the control");
  EXPECT_EQ(style_of_state(port), Style::Busy);
  port.open = false;
  EXPECT_EQ(state_text(port), "opening");
  EXPECT_EQ(style_of_state(port), Style::Busy);
  port.fault = "there is no such device";
  EXPECT_EQ(state_text(port), "closed");
  EXPECT_EQ(style_of_state(port), Style::Bad);
  port.enabled = false;
  EXPECT_EQ(state_text(port), "disabled");
}

TEST(PortText, ShowsAWaitWithoutLimitAndSinceWhen) {
  ::setenv("TZ", "UTC", 1);
  auto port = open_port();
  port.line = {"sending", false, false, "ACK", true};
  port.waiting_since = "2026-11-21T07:40:06.5Z";
  EXPECT_EQ(state_text(port), "sending, waits for ACK without limit since 2026-11-21 07:40:06");
}

TEST(PortText, SaysInAListingHowLongALineWaits) {
  auto port = open_port();
  EXPECT_EQ(wait_text(port, "2026-11-21T07:52:40Z"), "");
  port.line = {"sending", true, false, "DC1", true};
  port.waiting_since = "2026-11-21T07:40:06.5Z";
  EXPECT_EQ(short_state(port), "sending, stopped");
  EXPECT_EQ(wait_text(port, "2026-11-21T07:52:40.6Z"), "DC1 for 12:34, no limit");
  port.line.without_limit = false;
  port.waiting_since.clear();
  EXPECT_EQ(wait_text(port, "2026-11-21T07:52:40Z"), "DC1");
  port.open = false;
  EXPECT_EQ(short_state(port), "opening");
  port.fault = "hung up";
  EXPECT_EQ(short_state(port), "closed");
}

TEST(PortText, ShowsWhatTheControlAskedForInVain) {
  ::setenv("TZ", "UTC", 1);
  auto port = open_port();
  port.request = {.since = "2026-11-21T07:40:06.5Z", .program = "", .answer = ""};
  EXPECT_EQ(wait_text(port, "2026-11-21T07:52:40Z"), "asked: no run waits");
  EXPECT_EQ(request_text(port.request),
            "the control asked for a program at 2026-11-21 07:40:06; no run waits");
  port.request->program = "15";
  port.request->answer = "NO RUN WAITS";
  EXPECT_EQ(wait_text(port, "2026-11-21T07:52:40Z"), "asked: refused");
  EXPECT_EQ(request_text(port.request),
            "the control asked for program 15 at 2026-11-21 07:40:06; refused: NO RUN WAITS");
}

TEST(PortText, ShowsOwnSettingsOfAPort) {
  auto port = open_port();
  port.settings = {{"baud", "9600"}, {"eob", "lf"}};
  EXPECT_NE(port_details(port).render(false).find("own settings  baud=9600 eob=lf\n"),
            std::string::npos);
}

}  // namespace
}  // namespace dripline::cli
