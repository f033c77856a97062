#include "gateway/machine/grbl/board_link.hpp"

#include <gtest/gtest.h>
#include <array>
#include <thread>

#include "gateway/machine/grbl/grbl_machine.hpp"
#include "protocol/base/clock.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/unit/gateway/machine/test_machine.hpp"

/// The line itself, at a pseudo terminal in real time.
namespace dripline::machine::grbl::test {
namespace {

using test_support::eventually;
using test_support::Pty;

/// What has come out of the line until now.
class Listener {
 public:
  explicit Listener(Pty& pty) : pty_(pty) {}
  bool has(std::string_view text) {
    heard_ += pty_.read_available();
    return heard_.find(text) != std::string::npos;
  }

 private:
  Pty& pty_;
  std::string heard_;
};

class GrblLine : public testing::Test {
 protected:
  GrblLine() { machine.connect(pty.path()); }
  Pty pty;
  machine::test::Recorder recorder;
  GrblMachine machine{{.sink = recorder, .clock = std::make_shared<SystemClock>()}};
  Listener listener{pty};
};

TEST_F(GrblLine, AFloodDelaysNoEmergencyStop) {
  ASSERT_TRUE(eventually([&] { return listener.has("?"); }));
  std::atomic<bool> stops = false;
  std::thread flood([&] {
    const std::string noise(4096, 'x');
    while (!stops) pty.write(noise);
  });
  machine.set_panel({.emergency_stop = true});
  EXPECT_TRUE(eventually([&] { return listener.has("!"); }));
  EXPECT_TRUE(eventually([&] { return listener.has("\x18"); }));
  stops = true;
  flood.join();
}

TEST_F(GrblLine, IsOpenedAgainAfterItWasLost) {
  ASSERT_TRUE(eventually([&] { return listener.has("?"); }));
  pty.unplug();
  EXPECT_TRUE(eventually([&] { return machine.notice().find(pty.path()) != std::string::npos; }))
      << machine.notice();
  pty.plug_in();
  Listener again(pty);
  EXPECT_TRUE(eventually([&] { return again.has("?"); }));
}

TEST(BoardAddress, HasADeviceAndTheFormOfItsLine) {
  EXPECT_EQ(parse_board_address("/dev/ttyACM0")->settings.baud, 115'200);
  EXPECT_EQ(parse_board_address("/dev/ttyUSB0,57600")->settings.baud, 57'600);
  EXPECT_EQ(parse_board_address("tcp://board:23")->channel, "tcp://board:23");
  EXPECT_FALSE(parse_board_address("/dev/ttyUSB0,fast"));
  EXPECT_FALSE(parse_board_address(""));
}

}  // namespace
}  // namespace dripline::machine::grbl::test
