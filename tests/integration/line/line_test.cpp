#include <gtest/gtest.h>
#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "protocol/base/digest.hpp"
#include "tests/integration/line/line_gateway.hpp"
#include "tests/support/line/device_server.hpp"
#include "tests/support/line/host_line.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/support/program_generator.hpp"
#include "tests/unit/protocol/serial/tcp_peer.hpp"

/// A drip feed over a line: a host in the test's hands, a real gateway in the place of a Centurion.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::DeviceServer;
using test_support::eventually;
using test_support::HostLine;
using test_support::PtyCable;

const std::vector<std::string> kSettings{"baud=115200", "data_bits=7",     "parity=even",
                                         "stop_bits=1", "idle_end_ms=300", "rest_gap_ms=300"};

wire::LineSettings host_settings(const std::vector<std::string>& changes = kSettings) {
  wire::LineSettings settings = (*wire::find_template("centurion"))->settings;
  for (const std::string& change : changes) {
    const std::size_t equals = change.find('=');
    EXPECT_TRUE(wire::set_value(settings, change.substr(0, equals), change.substr(equals + 1)))
        << change;
  }
  return settings;
}

std::string contour(std::uint64_t bytes) {
  std::string text;
  test_support::write_contour_of_size(bytes, [&](std::string_view piece) { text += piece; });
  return text;
}

/// A program's name is also where the one before it ends.
std::string without_name(std::string text) {
  if (text.starts_with('O')) text.erase(0, text.find('\n') + 1);
  return text;
}

/// Prints at port 1, where the line is.
std::string printing(int lines) {
  std::string text = "O0077\nG20 G98\nPOPEN P1\n";
  for (int line = 1; line <= lines; ++line) {
    text += "G1 X1. Z-." + std::to_string(line % 9 + 1) + " F50.\n";
    text += "DPRNT [LINE " + std::to_string(line) + "]\n";
  }
  return text + "PCLOS\nM30\n";
}

std::string printed(int lines) {
  std::string text;
  for (int line = 1; line <= lines; ++line) text += "LINE " + std::to_string(line) + "\n";
  return text;
}

std::uint64_t blocks_of(const std::string& text) {
  return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(Line, DripFeedsAProgramLargerThanTheControlsMemory) {
  PtyCable cable;
  const test_support::TemporaryFolder folder;
  const auto setup = folder.path() / "setup.toml";
  std::ofstream(setup) << "units = \"in\"\nanswers = [\"1\"]\n";
  auto settings = kSettings;
  settings[0] = "baud=9600";  // a busy computer has a quarter of a second to let the host read XOFF
  LineGateway gateway({.address = cable.control(),
                       .settings = settings,
                       .speed = "100x",
                       .arguments = {"--line-buffer", "1024", "--setup", setup}});
  HostLine host(cable.host(), host_settings(settings));
  // At the question the control waits for the end of a long move, and its memory fills up.
  const std::string text =
      "G20 G98\nG0 X3. Z0\nG1 Z-5. F1.\nINPUT (GO ON) P1\n" + without_name(contour(8'000));
  host.send(text);
  EXPECT_TRUE(eventually([&] { return host.is_stopped(); })) << "the memory was never full";
  EXPECT_LT(host.sent(), 4096U);
  ASSERT_TRUE(gateway.wait_ended(1, 120s));
  EXPECT_TRUE(eventually([&] { return host.is_idle(); }));
  const auto endings = gateway.endings();
  ASSERT_EQ(endings.size(), 1U);
  EXPECT_EQ(endings[0].outcome, dds::RunOutcome::Completed) << endings[0].reason;
  EXPECT_EQ(endings[0].executed, blocks_of(text));
  EXPECT_EQ(endings[0].content_length, text.size());
  EXPECT_EQ(endings[0].content_sha256, sha256(text).hex());
}

TEST(Line, PrintsBackWhileItIsFed) {
  PtyCable cable;
  LineGateway gateway({.address = cable.control(), .settings = kSettings});
  HostLine host(cable.host(), host_settings());
  host.send(printing(200));
  ASSERT_TRUE(gateway.wait_ended(1));
  EXPECT_TRUE(eventually([&] { return host.received() == printed(200); })) << host.received();
  EXPECT_EQ(gateway.outputs().size(), 200U) << "and to the record";
}

TEST(Line, RunsOneProgramAfterTheOther) {
  PtyCable cable;
  LineGateway gateway({.address = cable.control(), .settings = kSettings});
  HostLine host(cable.host(), host_settings());
  for (std::size_t run = 1; run <= 3; ++run) {
    host.send(printing(static_cast<int>(run)) + "%\n");
    ASSERT_TRUE(gateway.wait_ended(run));
    // What is after the end of a program is not the beginning of the next: it has to be quiet.
    std::this_thread::sleep_for(700ms);
  }
  const auto endings = gateway.endings();
  ASSERT_EQ(endings.size(), 3U);
  for (const auto& ending : endings) EXPECT_EQ(ending.outcome, dds::RunOutcome::Completed);
}

TEST(Line, StopsAfterTheLastCompleteBlockWhenTheCableIsPulled) {
  PtyCable cable;
  LineGateway gateway({.address = cable.control(), .settings = kSettings});
  HostLine host(cable.host(), host_settings());
  const std::string text = contour(200'000);
  host.send(text);
  ASSERT_TRUE(eventually([&] { return host.sent() > 5000; }));
  cable.unplug_control();
  ASSERT_TRUE(gateway.wait_ended(1));
  const auto endings = gateway.endings();
  ASSERT_EQ(endings.size(), 1U);
  const auto& ending = endings[0];
  EXPECT_EQ(ending.outcome, dds::RunOutcome::Alarmed);
  EXPECT_NE(ending.reason.find("line: "), std::string::npos) << ending.reason;
  EXPECT_EQ(ending.content_sha256,
            sha256(std::string_view(text).substr(0, ending.content_length)).hex());
  // Every block that came complete was executed, and nothing of the one that was cut.
  EXPECT_EQ(ending.executed, blocks_of(text.substr(0, ending.content_length)));
}

/// A host without flow control: the rest of its text is no program that begins in the middle.
TEST(Line, BeginsNoRunWithTheRestOfATextThatBrokeOff) {
  PtyCable cable;
  const test_support::TemporaryFolder folder;
  const auto setup = folder.path() / "setup.toml";
  std::ofstream(setup) << "units = \"in\"\nanswers = [\"1\"]\n";
  LineGateway gateway({.address = cable.control(),
                       .settings = kSettings,
                       .speed = "100x",
                       .arguments = {"--line-buffer", "1024", "--setup", setup}});
  auto changes = kSettings;
  changes.emplace_back("flow=none");
  std::optional<HostLine> host(std::in_place, cable.host(), host_settings(changes));
  // At the question the control waits for the end of the move, and its memory is full, and over.
  host->send("G20 G98\nG0 X3. Z0\nG1 Z-5. F.6\nINPUT (GO ON) P1\n" +
             without_name(contour(600'000)));
  ASSERT_TRUE(gateway.wait_ended(1, 60s));
  std::this_thread::sleep_for(3s);
  EXPECT_FALSE(host->is_idle()) << "the host is in the middle of its text";
  host.reset();
  std::this_thread::sleep_for(2s);
  const std::string log = gateway.log();
  const std::string begins = "run begins with text from line";
  EXPECT_EQ(log.find(begins), log.rfind(begins)) << log;
  host.emplace(cable.host(), host_settings());
  host->send(printing(5));
  ASSERT_TRUE(gateway.wait_ended(2)) << gateway.log();
  EXPECT_TRUE(eventually([&] { return host->received() == printed(5); }));
  const auto endings = gateway.endings();
  ASSERT_EQ(endings.size(), 2U);
  EXPECT_EQ(endings[0].outcome, dds::RunOutcome::Alarmed);
  EXPECT_NE(endings[0].reason.find("line: "), std::string::npos) << endings[0].reason;
  EXPECT_EQ(endings[1].outcome, dds::RunOutcome::Completed);
}

TEST(Line, TakesTheNextProgramWhenTheHostsPortIsBack) {
  PtyCable cable;
  LineGateway gateway({.address = cable.control(), .settings = kSettings});
  HostLine host(cable.host(), host_settings());
  host.send(contour(200'000));
  ASSERT_TRUE(eventually([&] { return host.sent() > 3000; }));
  cable.unplug();
  ASSERT_TRUE(eventually([&] { return !host.is_open(); }));
  EXPECT_EQ(host.failures().size(), 1U);
  cable.plug_in();
  ASSERT_TRUE(eventually([&] { return host.is_open(); }));
  host.send("X[1\n");  // the operator's reset: what is left of the block cannot be
  ASSERT_TRUE(gateway.wait_ended(1));
  std::this_thread::sleep_for(700ms);
  host.send(printing(5));
  ASSERT_TRUE(gateway.wait_ended(2));
  EXPECT_TRUE(eventually([&] { return host.received() == printed(5); }));
}

/// The warnings of a log, each as often as it is there.
std::multiset<std::string> warnings_of(const std::string& log) {
  std::multiset<std::string> warnings;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find(" warning ");
    if (at != std::string::npos) warnings.insert(line.substr(at));
  }
  return warnings;
}

/// A device server whose port another client has takes a connection, and ends it. How the end
/// shows depends on the moment: each kind of it is logged once.
TEST(Line, ThatIsEndedAtOnceIsLoggedOnce) {
  serial::TcpPeer server;
  LineGateway gateway({.address = server.address(), .settings = kSettings});
  const auto end_one = [&] {
    ASSERT_TRUE(eventually([&] { return server.accept(); }));
    server.hang_up();
  };
  for (int time = 0; time < 3; ++time) end_one();
  ASSERT_TRUE(gateway.wait_logged("is opened and lost again and again"));
  EXPECT_TRUE(gateway.wait_logged("Another client may have the port"));
  for (int time = 0; time < 3; ++time) end_one();
  const auto warnings = warnings_of(gateway.log());
  for (const std::string& warning : warnings) EXPECT_EQ(warnings.count(warning), 1u) << warning;
}

TEST(Line, FollowsADeviceServer) {
  DeviceServer server;
  LineGateway gateway({.address = server.address(), .settings = kSettings});
  HostLine host(server.control(), host_settings());
  host.send(printing(20));
  ASSERT_TRUE(gateway.wait_ended(1));
  EXPECT_TRUE(eventually([&] { return host.received() == printed(20); }));
  server.switch_off();
  ASSERT_TRUE(gateway.wait_logged("closed the connection"));
  server.switch_on();
  ASSERT_TRUE(gateway.wait_logged("is open", 2));
  host.send(printing(3));
  ASSERT_TRUE(gateway.wait_ended(2));
  EXPECT_TRUE(eventually([&] { return host.received() == printed(20) + printed(3); }));
}

}  // namespace
}  // namespace dripline::integration
