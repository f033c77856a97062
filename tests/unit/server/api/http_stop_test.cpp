// Stops between clients that take all they can get. All on loopback.
#include <thread>

#include "tests/unit/server/api/http_attack.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view kOtherToken = "Authorization: Bearer other\r\n";
constexpr std::string_view kHold = R"({"action":"hold"})";

/// The head, and the first byte of its body.
std::string slow_post(std::string_view path, std::size_t size, std::string_view fields = kToken) {
  return fmt::format("POST {} HTTP/1.1\r\nHost: h\r\n{}Content-Length: {}\r\n\r\n{{", path, fields,
                     size);
}

class HttpStop : public HttpAttack {
 protected:
  void expect_stopped() {
    const auto begun = std::chrono::steady_clock::now();
    const std::string text = exchange(post("/stop", kHold), "served");
    EXPECT_TRUE(text.starts_with("HTTP/1.1 200")) << text;
    EXPECT_LT(std::chrono::steady_clock::now() - begun, 5s);
  }
  std::vector<RawPeer> send_each(int number, const std::string& text) {
    std::vector<RawPeer> peers = idle(number);
    for (auto& one : peers) one.send(text);
    return peers;
  }
  /// The server has read what was sent before.
  void wait_until_served() { expect_health(); }
};

TEST_F(HttpStop, WaitsForNoLargeBody) {
  options_.limits.body_memory = 1 << 20;
  start();
  const auto some = send_each(1, slow_post("/x", 512 * 1024));
  const auto others = send_each(1, slow_post("/x", 512 * 1024, kOtherToken));
  wait_until_served();
  expect_stopped();
}

TEST_F(HttpStop, IsNotKeptOutByBodiesOfStrangers) {
  options_.limits.connections = 8;
  options_.limits.per_address = 8;
  start();
  auto strangers = send_each(8, slow_post("/session", 900, ""));
  wait_until_served();
  for (int i = 0; i < 20; ++i) {
    expect_served();
    expect_stopped();
  }
  EXPECT_TRUE(strangers.front().wait_for_end(1s)) << "the oldest one made room";
}

TEST_F(HttpStop, AStrangerWhoWasAnsweredGoesBeforeWhoHasAToken) {
  options_.limits.connections = 8;
  options_.limits.per_address = 8;
  start();
  RawPeer known = peer();
  known.send(get("/x"));
  known.read_until("served");
  std::vector<RawPeer> strangers = idle(7);
  for (auto& one : strangers) {
    one.send(get("/health", ""));
    one.read_until("fine\n");
  }
  const auto more = send_each(50, slow_post("/session", 900, ""));
  wait_until_served();
  known.send(post("/stop", kHold));
  EXPECT_NE(known.read_until("served").find("200 OK"), std::string::npos);
}

TEST_F(HttpStop, HasSeatsWhenAllAreTaken) {
  options_.limits.connections = 4;
  options_.limits.per_address = 4;
  start();
  const auto peers = send_each(4, get("/machine"));
  gate_.wait_for(4);
  expect_stopped();
  EXPECT_EQ(status_of(post("/stop", kHold, "")), "HTTP/1.1 401");
  EXPECT_EQ(status_of(post("/x", kHold)), "HTTP/1.1 503");
  expect_health();
}

TEST_F(HttpStop, IsNotKeptOutByOthersThatAreSentSlowly) {
  options_.limits.connections = 4;
  options_.limits.per_address = 4;
  start();
  const auto peers = send_each(4, slow_post("/x", 900));
  wait_until_served();
  const auto slow = send_each(100, slow_post("/stop", 900));
  expect_stopped();
  expect_health();
}

TEST_F(HttpStop, IsGivenWhenNoOtherCommandMayWait) {
  options_.limits.waiting_commands = 3;
  start();
  const auto peers = send_each(3, get("/machine"));
  gate_.wait_for(3);
  EXPECT_EQ(status_of(get("/machine")), "HTTP/1.1 503");
  expect_stopped();
}

TEST_F(HttpStop, MayBePreparedWhenAllSeatsAreTakenButNotKeptOutByThat) {
  options_.limits.connections = 4;
  options_.limits.per_address = 4;
  options_.limits.reserve = 8;
  start();
  const auto peers = send_each(4, get("/machine"));
  gate_.wait_for(4);
  const auto looks = send_each(4, get("/runs/wait"));
  gate_.wait_for(8);
  EXPECT_EQ(status_of(get("/runs")), "HTTP/1.1 503");
  expect_stopped();
  gate_.open();
  for (int i = 0; i < 100 && status_of(get("/runs")) != "HTTP/1.1 200"; ++i) {
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(status_of(get("/runs")), "HTTP/1.1 200");
}

TEST_F(HttpStop, LeavesSeatsForHealth) {
  options_.limits.connections = 4;
  options_.limits.per_address = 4;
  options_.limits.reserve = 8;
  start();
  const auto peers = send_each(4, get("/machine"));
  gate_.wait_for(4);
  auto waiting = send_each(6, post("/stop/wait", kHold));
  gate_.wait_for(10);
  EXPECT_EQ(status_of(post("/stop", kHold)), "HTTP/1.1 503");
  expect_health();
  gate_.open();
  for (auto& one : waiting) EXPECT_EQ(one.read_until("served").substr(0, 12), "HTTP/1.1 200");
  expect_stopped();
}

}  // namespace
}  // namespace dripline::server_test
