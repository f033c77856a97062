#pragma once

#include "tests/integration/line/serial_system.hpp"
#include "tests/support/line/host_line.hpp"

namespace dripline::integration {

/// O9999 with (PRG=0077) asks for O0077; the answer comes as O9998.
inline constexpr const char* kSendRules = R"(reply = "O9998"
[[rule]]
name = "send"
program = "O9999"
trigger = "PRG"
action = "send"
argument = "O{}"
)";

/// A server and the gateway beside a control; the test has the control's end of the line.
class ControlInHand : public testing::Test {
 protected:
  void start(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{
        "--motion",        "line:" + cable_.host(), "--line-template",
        "centurion",       "--line-setting",        "115200e72",
        "--line-setting",  "idle_end_ms=300",       "--line-setting",
        "rest_gap_ms=300", "--unattended",          "yes"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    system_.emplace(System::Options{
        .speed = "1x", .server_arguments = {}, .gateway_arguments = std::move(arguments)});
    system_->start_server();
    start_gateway();
    wire::LineSettings settings = (*wire::find_template("centurion"))->settings;
    EXPECT_TRUE(wire::set_value(settings, "line", "115200e72"));
    EXPECT_TRUE(wire::set_value(settings, "idle_end_ms", "300"));
    control_.emplace(cable_.control(), settings);
  }
  void start_gateway() {
    system_->start_gateway();
    system_->wait_connected();
    EXPECT_TRUE(test_support::eventually([&] { return port().value("open", false); }))
        << port().dump();
  }
  nlohmann::json port() const { return system_->rest().get("/api/v1/ports/lathe-1").json(); }
  nlohmann::json revisions(const std::string& program) const {
    return system_->rest()
        .get("/api/v1/programs/" + program + "/revisions")
        .json()
        .value("revisions", nlohmann::json::array());
  }
  test_support::Finished dnc(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_path("dnc"), "--state", system_->server_state()});
    return test_support::run_to_end(arguments, system_->folder() / "dnc.out");
  }
  bool waits_for_approval(const std::string& program) {
    return test_support::eventually([&] {
      const auto all = system_->rest().get("/api/v1/imports").json().dump();
      return all.find("\"" + program + "\"") != std::string::npos;
    });
  }

  test_support::PtyCable cable_;
  std::optional<System> system_;
  std::optional<test_support::HostLine> control_;  ///< any end that sends and receives
};

}  // namespace dripline::integration
