#pragma once

#include <string>

#include "tests/integration/standby/device_port.hpp"
#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {

/// Two servers and a control at the end of a device server, which the first one feeds until it
/// ends.
class LineTakeover : public TwoServersTest {
 protected:
  explicit LineTakeover(DevicePort::Kind kind = DevicePort::Kind::Raw) : device_(kind) {}
  void begin_with_port(nlohmann::json settings) {
    begin();
    settings["machine"] = "mill-1";
    settings["address"] = device_.address();
    const auto added = shop_->rest(0).put_bytes("/api/v1/ports/line-1", settings.dump());
    ASSERT_LT(added.status, 300) << added.body;
    expect_open(0);
  }
  /// At the server's end and at the control's.
  void expect_open(int server) {
    ASSERT_TRUE(test_support::eventually([&] { return port(server).value("open", false); }))
        << port(server).dump();
    const std::size_t until_now = server == 0 ? 1 : 2;
    ASSERT_TRUE(test_support::eventually([&] { return device_.connections() >= until_now; }));
  }
  /// The second server has the library and the line.
  void kill_first() {
    shop_->server(0).kill();
    expect_taken();
  }
  void expect_taken() {
    ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
    expect_open(1);
  }
  nlohmann::json port(int server) const {
    return shop_->rest(server).get("/api/v1/ports/line-1").json();
  }
  std::string start(int server, const std::string& program) const {
    const auto begun =
        shop_->rest(server).post("/api/v1/runs", {{"machine", "mill-1"}, {"program", program}});
    EXPECT_EQ(begun.status, 201) << begun.body;
    return begun.json().value("id", "none");
  }
  /// As a person at the control, which was in the middle of a program.
  void confirm_reset(int server) const {
    const auto confirmed =
        shop_->rest(server).post("/api/v1/ports/line-1/confirm-reset", nlohmann::json::object());
    EXPECT_EQ(confirmed.status, 204) << confirmed.body;
  }
  bool wait_state(int server, const std::string& id, const std::string& state) const {
    return test_support::eventually([&] { return run(server, id).value("state", "") == state; });
  }
  /// Whether the control has got this after byte `from`.
  bool wait_text(const std::string& text, std::size_t from = 0) const {
    return test_support::eventually(
        [&] { return device_.text(from).find(text) != std::string::npos; });
  }
  /// Once nothing more comes.
  std::size_t received_at_rest() const {
    EXPECT_TRUE(test_support::eventually(
        [&] { return device_.stays_silent(std::chrono::milliseconds(300)); }));
    return device_.received();
  }
  static std::string program(const std::string& head, int blocks) {
    std::string text = head;
    for (int i = 1; i <= blocks; ++i) text += fmt::format("N{} G1 X{} F100\n", i, i);
    return text + "M30\n";
  }

  DevicePort device_;
};

}  // namespace dripline::integration
