#include <gtest/gtest.h>
#include <algorithm>
#include <thread>

#include "protocol/base/digest.hpp"
#include "tests/integration/line/line_gateway.hpp"
#include "tests/integration/line/line_protocols.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/line/host_line.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/support/program_generator.hpp"

/// End to end: a real server feeds a real gateway, which plays a control at the other end of a
/// line; what the program prints comes back over the line into the report.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;
using test_support::PtyCable;

/// A server with one port, and the control at its end.
class ServedLine {
 public:
  explicit ServedLine(std::vector<std::string> settings, const std::string& request = "") {
    settings.insert(settings.end(), {"line=115200n81", "idle_end_ms=300", "rest_gap_ms=300"});
    system.start_server();
    nlohmann::json changes = nlohmann::json::object();
    for (const std::string& setting : settings) {
      const std::size_t equals = setting.find('=');
      changes[setting.substr(0, equals)] = setting.substr(equals + 1);
    }
    const nlohmann::json port{{"machine", "old-lathe"},
                              {"address", cable.host()},
                              {"template", "centurion"},
                              {"settings", changes}};
    const auto reply = system.rest().put_bytes("/api/v1/ports/port-1", port.dump());
    EXPECT_EQ(reply.status, 201) << reply.body;
    EXPECT_TRUE(eventually([&] { return port_view().value("open", false); })) << port_view().dump();
    settings_ = std::move(settings);
    request_ = request;
    if (request.empty()) switch_on();
  }
  void switch_on() {
    std::vector<std::string> arguments;
    if (!request_.empty()) arguments = {"--line-request", request_};
    gateway.emplace(LineGateway::Options{.address = cable.control(),
                                         .settings = settings_,
                                         .speed = "max",
                                         .arguments = std::move(arguments)});
  }
  nlohmann::json port_view() const { return system.rest().get("/api/v1/ports/port-1").json(); }
  std::string start(const std::string& name, const std::string& text) {
    system.push(name, text);
    std::string id = system.start_run(name, "old-lathe");
    // Its operator asks when the host is ready, as at the real ones: a DC1 comes only once.
    if (!gateway) switch_on();
    return id;
  }

  System system;
  PtyCable cable;
  std::optional<LineGateway> gateway;

 private:
  std::vector<std::string> settings_;
  std::string request_;
};

std::string contour(std::uint64_t bytes) {
  std::string text;
  test_support::write_contour_of_size(bytes, [&](std::string_view piece) { text += piece; });
  return text;
}

std::uint64_t blocks_of(std::string_view text) {
  return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

nlohmann::json status(const System& system) {
  return system.rest().get("/api/v1/machines/lathe-1").json().value("status", nlohmann::json());
}

class LineSystem : public testing::TestWithParam<Protocol> {};

TEST_P(LineSystem, FromTheServerOverTheLineToTheMachineAndBackIntoTheReport) {
  ServedLine line(GetParam().settings, GetParam().request);
  std::string text = "O0077\nG20 G98\nPOPEN P1\n";
  std::vector<std::string> expected;
  for (int i = 1; i <= 60; ++i) {
    text += "G1 X1. Z-." + std::to_string(i % 9 + 1) + " F50.\n";
    if (i % 6 != 0) continue;
    text += "DPRNT [FLANGE " + std::to_string(i) + "]\n";
    expected.push_back("FLANGE " + std::to_string(i));
  }
  text += "PCLOS\nM30\n";
  const std::string id = line.start("O0077", text);
  const auto run = line.system.wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("sent", 0U), text.size()) << run.dump();
  ASSERT_TRUE(line.gateway->wait_ended(1));
  if (GetParam().prints_back) {
    EXPECT_TRUE(eventually([&] { return line.system.report_lines(id) == expected; }))
        << testing::PrintToString(line.system.report_lines(id)) << "\n"
        << line.system.rest().get("/api/v1/ports/port-1/recording").body;
  }
  const auto endings = line.gateway->endings();
  ASSERT_GE(endings.size(), 1U);
  EXPECT_EQ(endings[0].outcome, dds::RunOutcome::Completed) << endings[0].reason;
  EXPECT_EQ(endings[0].executed, blocks_of(text));
  EXPECT_EQ(line.gateway->outputs(), expected);
}

INSTANTIATE_TEST_SUITE_P(, LineSystem, every_protocol(),
                         [](const auto& i) { return std::string(i.param.name); });

/// A control that asks when it is switched on, before any command.
TEST(LineSystemCommands, RunsNothingThatWasNotCommandedAndThenWhatIsStarted) {
  const std::vector<std::vector<std::string>> lines{
      {"flow=dc_codes", "start_char=%", "end_char=%", "control=plain"},
      {"flow=xmodem", "control=plain"}};
  for (const auto& settings : lines) {
    const std::string& flow = settings.front();
    ServedLine line(settings);
    line.system.push("O0001", "G20 G98\nG1 X9. Z-9. F50.\nM30\n");
    ASSERT_TRUE(eventually([&] { return line.port_view()["request"].is_object(); })) << flow;
    EXPECT_TRUE(line.port_view()["request"]["answer"].is_null()) << line.port_view().dump();
    EXPECT_EQ(line.system.rest().get("/api/v1/runs").json().at("runs").size(), 0U);
    EXPECT_EQ(line.port_view().value("sent", 1U), 0U) << "not one character";
    const std::string text = "G20 G98\nG1 X1. Z-1. F50.\nM30\n";
    const std::string id = line.start("O0077", text);
    EXPECT_EQ(line.system.wait_ended(id).value("state", ""), "completed") << flow;
    ASSERT_TRUE(line.gateway->wait_ended(1)) << flow;
    const auto endings = line.gateway->endings();
    ASSERT_EQ(endings.size(), 1U) << flow;
    EXPECT_EQ(endings[0].executed, 3U) << flow;
  }
}

TEST(LineSystemLoss, EndsTheRunAtAKnownBlockWhenTheCableIsPulled) {
  ServedLine line({"flow=xonxoff"});
  const std::string text = contour(150'000);
  const std::string id = line.start("contour", text);
  ASSERT_TRUE(eventually([&] { return line.cable.passed() > 5000; }));
  line.cable.unplug();
  const auto run = line.system.wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
  const std::string reason = run.value("reason", "");
  EXPECT_NE(reason.find("block"), std::string::npos) << reason;
  EXPECT_FALSE(line.port_view().value("open", true));

  // The server's sent counter and the control's text differ by what is in transit. A line end is
  // sent when its LF is; the control has it with the CR, when the cut falls between the two.
  const auto endings = line.gateway->endings();
  ASSERT_EQ(endings.size(), 1U);
  const auto& ending = endings[0];
  const auto sent = run.value("sent", std::uint64_t{0});
  ASSERT_LT(sent, text.size());
  EXPECT_LE(ending.content_length, sent + (text[sent] == '\n' ? 1 : 0));
  EXPECT_LE(sent, ending.content_length + 64)
      << "sent " << sent << ", held by the control " << ending.content_length;
  const auto held = std::string_view(text).substr(0, ending.content_length);
  EXPECT_EQ(ending.content_sha256, sha256(held).hex());
  EXPECT_EQ(ending.accepted, blocks_of(held));
  // The lathe looks one block ahead: the last one is executed when the next has come.
  EXPECT_LE(ending.executed, ending.accepted);
  EXPECT_GE(ending.executed + 1, ending.accepted);
  EXPECT_EQ(run.value("executed", std::uint64_t{9}), 0U)
      << "a line does not report what is executed";
}

TEST(LineSystemLoss, ResumesACheckedProtocolWhenTheCableIsBack) {
  ServedLine line({"flow=xmodem", "control=plain", "answer_limit_ms=3000"});
  const std::string text = contour(40'000);
  const std::string id = line.start("contour", text);
  ASSERT_TRUE(eventually([&] { return line.cable.passed() > 5000; }));
  line.cable.unplug();
  ASSERT_TRUE(eventually([&] { return !line.port_view().value("open", true); }));
  line.cable.plug_in();
  const auto run = line.system.wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  ASSERT_TRUE(line.gateway->wait_ended(1));
  const auto endings = line.gateway->endings();
  ASSERT_GE(endings.size(), 1U);
  EXPECT_EQ(endings[0].outcome, dds::RunOutcome::Completed) << endings[0].reason;
  EXPECT_EQ(endings[0].executed, blocks_of(text));
  EXPECT_EQ(endings[0].content_sha256,
            sha256(std::string_view(text).substr(0, endings[0].content_length)).hex());
}

/// The machine's panel belongs to the server, its text to the line: what comes while the emergency
/// stop is pressed is neither run nor lost.
TEST(LineSystemPanel, TextWaitsForTheReleaseOfTheEmergencyStop) {
  PtyCable cable;
  System::Options options;
  options.gateway_arguments = {
      "--line",          cable.control(),  "--line-template", "centurion",    "--line-setting",
      "idle_end_ms=300", "--line-setting", "baud=115200",     "--unattended", "yes"};
  System system(options);
  system.start_server();
  system.start_gateway();
  system.wait_connected();
  const auto press = [&](bool is_on) {
    const nlohmann::json command{
        {"action", "switch"}, {"name", "emergency_stop"}, {"value", is_on ? 1 : 0}};
    const auto reply = system.rest().post("/api/v1/machines/lathe-1/commands", command);
    EXPECT_EQ(reply.status, 200) << reply.body;
    EXPECT_TRUE(
        eventually([&] { return status(system).value("emergency_stop", !is_on) == is_on; }));
  };
  press(true);
  wire::LineSettings settings = (*wire::find_template("centurion"))->settings;
  ASSERT_TRUE(wire::set_value(settings, "idle_end_ms", "300"));
  ASSERT_TRUE(wire::set_value(settings, "baud", "115200"));
  test_support::HostLine host(cable.host(), settings);
  const std::string text = "G20 G98\nG1 X1. Z-1. F50.\nM30\n";
  host.send(text);
  ASSERT_TRUE(eventually([&] { return host.is_idle(); }));
  std::this_thread::sleep_for(700ms);  // longer than the silence that ends a program
  EXPECT_NE(status(system).value("execution", ""), "PROGRAM_COMPLETED");
  press(false);
  EXPECT_TRUE(eventually([&] {
    return status(system).value("execution", "") == "PROGRAM_COMPLETED";
  })) << status(system).dump();
  EXPECT_NEAR(status(system).at("coordinates").at("target").at("Z").get<double>(), -25.4, 1e-6)
      << "all of the text was run";
}

}  // namespace
}  // namespace dripline::integration
