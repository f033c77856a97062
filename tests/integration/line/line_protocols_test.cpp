#include <gtest/gtest.h>

#include "protocol/base/digest.hpp"
#include "tests/integration/line/line_gateway.hpp"
#include "tests/support/line/host_line.hpp"
#include "tests/support/line/pty.hpp"

/// The same small job in every protocol that a line speaks: a host feeds, the control runs and
/// prints.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;
using test_support::HostLine;
using test_support::PtyCable;

struct Protocol {
  const char* name;
  std::vector<std::string> settings;
  const char* request = "";   ///< what the control asks for; nothing: the host begins
  bool host_expects = false;  ///< the host must announce that it takes the output
};

class LineProtocol : public testing::TestWithParam<Protocol> {};

TEST_P(LineProtocol, FeedsRunsAndPrintsBack) {
  std::vector<std::string> settings{"baud=38400", "idle_end_ms=300", "rest_gap_ms=300"};
  settings.insert(settings.end(), GetParam().settings.begin(), GetParam().settings.end());
  wire::LineSettings host_settings;
  for (const std::string& change : settings) {
    const std::size_t equals = change.find('=');
    const auto done =
        wire::set_value(host_settings, change.substr(0, equals), change.substr(equals + 1));
    ASSERT_TRUE(done) << done.error().what;
  }
  std::string text = "O0077\nG20 G98\nPOPEN P1\n", printed;
  for (int line = 1; line <= 40; ++line) {
    text += "G1 X1. Z-." + std::to_string(line % 9 + 1) + " F50.\n";
  }
  text += "DPRNT [DONE WELL]\nPCLOS\nM30\n";

  PtyCable cable;
  HostLine host(cable.host(), host_settings);
  std::vector<std::string> arguments{"--line-template", "plain"};
  const std::string request = GetParam().request;
  if (!request.empty()) {
    host.answer_with(text);
    arguments.insert(arguments.end(), {"--line-request", request});
  }
  LineGateway gateway(
      {.address = cable.control(), .settings = settings, .speed = "max", .arguments = arguments});
  if (request.empty()) host.send(text);
  ASSERT_TRUE(eventually([&] { return host.sent() > text.size() && host.is_idle(); }));
  if (GetParam().host_expects) host.receive();
  ASSERT_TRUE(gateway.wait_ended(1));
  EXPECT_TRUE(eventually([&] { return host.received().find("DONE WELL\n") != std::string::npos; }))
      << host.received() << testing::PrintToString(host.failures());
  const auto endings = gateway.endings();
  ASSERT_GE(endings.size(), 1U);
  EXPECT_EQ(endings[0].outcome, dds::RunOutcome::Completed) << endings[0].reason;
}

INSTANTIATE_TEST_SUITE_P(
    , LineProtocol,
    testing::Values(Protocol{"xonxoff", {"flow=xonxoff"}},
                    Protocol{"xonxoff_percent", {"flow=xonxoff", "end_char=%"}},
                    Protocol{"none", {"flow=none", "line_delay_ms=2"}},
                    Protocol{"rtscts", {"flow=rtscts"}},
                    Protocol{"dc_codes", {"flow=dc_codes", "start_char=%", "end_char=%"}, "next"},
                    Protocol{"xmodem", {"flow=xmodem"}, "", true},
                    Protocol{"heidenhain", {"flow=heidenhain"}, "next"},
                    Protocol{"heidenhain_bcc", {"flow=heidenhain_bcc"}, "77"}),
    [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dripline::integration
