#pragma once

#include <gtest/gtest.h>

#include "tests/integration/system.hpp"

namespace dripline::integration {

/// One block, one line, one move: `blocks` of 1 mm.
inline std::string straight_program(int blocks, int feed) {
  std::string text = "G21 G90 G94 F" + std::to_string(feed) + "\n";
  for (int i = 1; i <= blocks; ++i) text += "G1 X" + std::to_string(i) + "\n";
  return text + "M2\n";
}

/// A server, and a gateway that drives a machine in real time.
class MotionSystem : public testing::Test {
 protected:
  void start_system(const std::string& control, const std::string& motion,
                    const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"--motion", motion, "--unattended", "yes"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    system.emplace(System::Options{.speed = "1x",
                                   .server_arguments = {},
                                   .gateway_arguments = std::move(arguments),
                                   .control = control,
                                   .gateway_environment = gateway_environment});
    system->start_server();
    start_gateway();
  }
  void start_gateway() {
    system->start_gateway();
    system->wait_connected();
  }
  test_support::RestClient::Reply post_run(const std::string& program) {
    return system->rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", program}});
  }
  /// The machine needs a moment to be ready.
  std::string start_run(const std::string& program) {
    std::string id, refusal;
    EXPECT_TRUE(test_support::eventually([&] {
      const auto reply = post_run(program);
      refusal = reply.body;
      id = reply.status == 201 ? reply.json().value("id", "") : "";
      return !id.empty();
    })) << refusal;
    return id;
  }
  test_support::RestClient::Reply post_command(const std::string& id, const char* action) {
    return system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", action}});
  }
  void command(const std::string& id, const char* action) {
    const auto reply = post_command(id, action);
    EXPECT_EQ(reply.status, 200) << reply.body;
  }
  test_support::Finished panel(const std::vector<std::string>& words) {
    std::vector<std::string> command{program_path("dncgw"), "panel", "--state",
                                     system->folder() / "gateway" / "lathe-1"};
    command.insert(command.end(), words.begin(), words.end());
    return test_support::run_to_end(command, system->folder() / "panel.out");
  }
  void press_emergency_stop(bool is_pressed) {
    const auto finished = panel({"emergency-stop", is_pressed ? "on" : "off"});
    EXPECT_EQ(finished.status, 0) << finished.output;
  }

  std::vector<std::string> gateway_environment;  ///< NAME=value, before `start_system`
  std::optional<System> system;
};

}  // namespace dripline::integration
