// The emergency stop over the ends of a gateway's process.
#include <csignal>

#include "tests/integration/motion_system.hpp"
#include "tests/integration/small_disk.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;

class EmergencyStopOverLives : public MotionSystem {
 protected:
  void begin() {
    start_system("rs274ngc", "simulated");
    system->push("path", straight_program(20, 3000));
  }
  void end_gateway(int signal) {
    system->gateway().signal(signal);
    ASSERT_TRUE(system->gateway().wait());
    start_gateway();
  }
  void expect_pressed() {
    EXPECT_NE(panel({"status"}).output.find("emergency_stop=pressed"), std::string::npos);
    const auto refused = post_run("path");
    EXPECT_NE(refused.body.find("the emergency stop is pressed"), std::string::npos)
        << refused.body;
  }
};

TEST_F(EmergencyStopOverLives, IsReleasedByNothingButThePanel) {
  begin();
  press_emergency_stop(true);
  for (const int signal : {SIGKILL, SIGTERM, SIGKILL}) {
    end_gateway(signal);
    expect_pressed();
  }
  press_emergency_stop(false);
  end_gateway(SIGKILL);
  EXPECT_EQ(system->wait_ended(start_run("path")).value("state", ""), "completed");
}

TEST_F(EmergencyStopOverLives, IsKeptWhereNothingElseCanBeWritten) {
  system.emplace(System::Options{.speed = "1x",
                                 .server_arguments = {},
                                 .gateway_arguments = {"--unattended", "yes"},
                                 .control = "rs274ngc"});
  SmallDisk disk(system->folder() / "gateway");
  if (!disk.is_mounted()) GTEST_SKIP() << "mounting a tmpfs needs root";
  system->start_server();
  start_gateway();
  system->push("path", straight_program(20, 3000));
  disk.fill();
  const auto pressed = panel({"emergency-stop", "on"});
  EXPECT_EQ(pressed.output, "ok\n");
  system->gateway().kill();
  disk.empty();
  start_gateway();
  expect_pressed();
}

}  // namespace
}  // namespace dripline::integration
