#include <random>
#include <thread>

#include "tests/integration/line/serial_system.hpp"

/// Kills of what is between the server and an old control. The witness is the control itself: the
/// text that it received is the program's beginning, byte for byte, and ends where the run's record
/// states.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;

/// "at least 1234 bytes were sent, at most 1300".
struct Bounds {
  std::uint64_t least = 0, most = 0;
};
Bounds bounds_of(const std::string& reason) {
  Bounds bounds;
  const auto least = reason.find("at least "), most = reason.find("at most ");
  if (least == std::string::npos || most == std::string::npos) return bounds;
  bounds.least = std::stoull(reason.substr(least + 9));
  bounds.most = std::stoull(reason.substr(most + 8));
  return bounds;
}

TEST(SerialGatewayKill, OfTheGatewayLeavesTheControlBetweenTwoNumbers) {
  constexpr int kRounds = 6;
  constexpr std::uint64_t kInDriver = 2;  // characters that a closed port may take along
  std::mt19937 random(4711);
  for (int round = 0; round < kRounds; ++round) {
    SCOPED_TRACE(round);
    SerialSystem shop({.settings = {"flow=xonxoff"}});
    const std::string text = contour(150'000);
    const std::string id = shop.start("contour", text);
    const std::uint64_t goal = std::uniform_int_distribution<std::uint64_t>(1, 20'000)(random);
    ASSERT_TRUE(eventually([&] { return shop.cable.passed() >= goal; }));
    shop.system->gateway().kill();
    shop.start_gateway();
    const auto run = shop.system->wait_ended(id);
    EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
    const Bounds bounds = bounds_of(run.value("reason", ""));
    EXPECT_EQ(run.value("sent", std::uint64_t{1}), bounds.least) << run.dump();
    // Nobody orders more: nothing more comes.
    const std::uint64_t passed = shop.cable.passed();
    std::this_thread::sleep_for(500ms);
    EXPECT_EQ(shop.cable.passed(), passed);
    const std::uint64_t received = shop.check_received(text);
    EXPECT_LE(bounds.least, received + kInDriver) << run.dump();
    EXPECT_LE(received, bounds.most) << run.dump();
    EXPECT_LT(bounds.most, bounds.least + 20'000) << "as much as half a second of the line";
  }
}

TEST(SerialGatewayKill, OfTheServerIsNotFelt) {
  SerialSystem shop({.settings = {"flow=xonxoff"}});
  std::vector<std::string> printed;
  const std::string program = printing_program(printed);
  const std::string text = contour(120'000);
  const std::string all = ended_by(text, program);
  const std::string id = shop.start("contour", all);
  std::mt19937 random(11);
  for (int kill = 0; kill < 4; ++kill) {
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 700));
    shop.system->server().kill();
    shop.system->start_server();
  }
  shop.system->wait_connected();
  const auto run = shop.system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("sent", 0U), all.size());
  ASSERT_TRUE(shop.control->wait_ended(1));
  EXPECT_TRUE(eventually([&] { return shop.system->report_lines(id) == printed; }))
      << testing::PrintToString(shop.system->report_lines(id));
  EXPECT_EQ(shop.check_received(all), all.size());
}

/// With the server gone too, the gateway's record of the run waits on its disk.
TEST(SerialGatewayKill, OfBothIsOnRecordWhenTheyAreBack) {
  SerialSystem shop({.settings = {"flow=xonxoff"}});
  const std::string text = contour(150'000);
  const std::string id = shop.start("contour", text);
  ASSERT_TRUE(eventually([&] { return shop.cable.passed() >= 10'000; }));
  shop.system->server().kill();
  shop.system->gateway().kill();
  shop.system->start_server();
  shop.start_gateway();
  const auto run = shop.system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
  const Bounds bounds = bounds_of(run.value("reason", ""));
  const std::uint64_t received = shop.check_received(text);
  EXPECT_GE(bounds.least, 9'000U);
  EXPECT_LE(received, bounds.most);
}

}  // namespace
}  // namespace dripline::integration
