#pragma once

#include <gtest/gtest.h>
#include <thread>

#include "tests/integration/system.hpp"
#include "tests/support/grbl_board_port.hpp"

namespace dripline::integration {

/// One block, one line, one move: `blocks` of 1 mm.
inline std::string straight_program(int blocks, int feed = 3000) {
  std::string text = "G21 G90 G94 F" + std::to_string(feed) + "\n";
  for (int i = 1; i <= blocks; ++i) text += "G1 X" + std::to_string(i) + "\n";
  return text + "M2\n";
}

class GrblSystem : public testing::Test {
 protected:
  /// `speed`: of the board's time.
  void start(const std::string& control = "rs274ngc", test_support::GrblBoard::Options options = {},
             double speed = 20, const std::vector<std::string>& more = {}) {
    board.emplace(std::move(options), speed);
    std::vector<std::string> arguments{"--motion", "grbl:" + board->path(), "--unattended", "yes"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    system.emplace(System::Options{.speed = "1x",
                                   .server_arguments = {},
                                   .gateway_arguments = std::move(arguments),
                                   .control = control});
    system->start_server();
    system->start_gateway();
    system->wait_connected();
  }
  /// The board needs a moment to be identified.
  std::string start_run(const std::string& program) {
    std::string id;
    EXPECT_TRUE(test_support::eventually([&] {
      const auto reply =
          system->rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", program}});
      refusal = reply.body;
      id = reply.status == 201 ? reply.json().value("id", "") : "";
      return !id.empty();
    })) << refusal;
    return id;
  }
  void command(const std::string& id, const char* action) {
    const auto reply =
        system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", action}});
    EXPECT_EQ(reply.status, 200) << reply.body;
  }
  test_support::Finished panel(std::vector<std::string> words) {
    std::vector<std::string> command{program_path("dncgw"), "panel", "--state",
                                     system->folder() / "gateway" / "lathe-1"};
    command.insert(command.end(), words.begin(), words.end());
    return test_support::run_to_end(std::move(command), system->folder() / "panel.out");
  }
  void press_emergency_stop(bool is_pressed) {
    const auto finished = panel({"emergency-stop", is_pressed ? "on" : "off"});
    EXPECT_EQ(finished.status, 0) << finished.output;
  }
  double traveled() {
    return board->with([](test_support::GrblBoard& peer) { return peer.traveled(); });
  }
  /// The axes stay where they are for a while.
  bool rests() {
    const double before = traveled();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // 6 s at speed 20
    return traveled() == before;
  }
  std::size_t done() {
    return board->with([](test_support::GrblBoard& peer) { return peer.done.size(); });
  }

  std::optional<test_support::GrblBoardPort> board;
  std::optional<System> system;
  std::string refusal;
};

}  // namespace dripline::integration
