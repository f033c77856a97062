#include <gtest/gtest.h>
#include <algorithm>

#include "tests/integration/line/line_gateway.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/line/pty.hpp"

/// A port with `offer = repeat` and a gateway that plays a Tektronix 1704 with the port in its
/// reader's place: the control winds the tape back (M30) or runs on over its end (M02), and the
/// program runs again, as often as the control asks.
namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::PtyCable;

class RepeatedTape {
 public:
  RepeatedTape() {
    system.start_server();
    const nlohmann::json port{
        {"machine", "mill-9"},
        {"address", cable.host()},
        {"template", "tektronix1704-iso"},
        {"settings", {{"offer", "repeat"}, {"reader_cps", "2000"}, {"trailer", "20"}}}};
    const auto reply = system.rest().put_bytes("/api/v1/ports/port-1", port.dump());
    EXPECT_EQ(reply.status, 201) << reply.body;
    EXPECT_TRUE(eventually([&] { return port_view().value("open", false); })) << port_view().dump();
    gateway.emplace(LineGateway::Options{.address = cable.control(),
                                         .settings = {},
                                         .speed = "max",
                                         .arguments = {"--line-template", "tektronix1704-iso"},
                                         .control = "tektronix-1704"});
  }
  nlohmann::json port_view() const { return system.rest().get("/api/v1/ports/port-1").json(); }
  nlohmann::json runs() const {
    return system.rest().get("/api/v1/runs?limit=100").json().at("runs");
  }
  std::size_t completed() const {
    const auto all = runs();
    return static_cast<std::size_t>(std::ranges::count_if(
        all, [](const nlohmann::json& run) { return run.value("state", "") == "completed"; }));
  }
  /// What is shown when the tape does not go on.
  std::string state() const {
    return runs().dump() + "\n" + port_view().dump() + "\n" +
           system.rest().get("/api/v1/ports/port-1/recording").body;
  }
  void start(const std::string& text) {
    system.push("TK1", text);
    system.start_run("TK1", "mill-9");
  }

  System system{{.speed = "max",
                 .server_arguments = {},
                 .gateway_arguments = {},
                 .control = "tektronix-1704"}};
  PtyCable cable;
  std::optional<LineGateway> gateway;
};

constexpr std::size_t kPasses = 8;

class TapeEnd : public testing::TestWithParam<const char*> {};

TEST_P(TapeEnd, IsFollowedByTheNextPassEachTime) {
  RepeatedTape tape;
  tape.start(GetParam());
  ASSERT_FALSE(HasFailure());
  ASSERT_TRUE(eventually([&] { return tape.completed() >= kPasses; }, std::chrono::seconds(25)))
      << tape.state();
  EXPECT_TRUE(tape.gateway->wait_ended(kPasses)) << tape.gateway->log();
  for (const auto& run : tape.runs()) {
    const std::string state = run.value("state", "");
    EXPECT_TRUE(state == "completed" || state == "active" || state == "ordered") << run.dump();
  }
  const auto endings = tape.gateway->endings();
  ASSERT_GE(endings.size(), kPasses);
  for (std::size_t i = 0; i < kPasses; ++i) {
    EXPECT_EQ(endings[i].outcome, dds::RunOutcome::Completed) << i << ": " << endings[i].reason;
    EXPECT_EQ(endings[i].executed, 3U) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(, TapeEnd,
                         testing::Values("%\nN1G00F9000X100\nN2X0\nN3M30\n",
                                         "%\nN1G00F9000X100\nN2X0\nN3M30\n%\n",
                                         "%\nN1G00F9000X100\nN2X0\nN3M02\n"));

}  // namespace
}  // namespace dripline::integration
