// Stops between clients that take all they can get. All on loopback.
#include "tests/unit/server/api/http_attack.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view kOtherToken = "Authorization: Bearer other\r\n";
constexpr std::string_view kHold = R"({"action":"hold"})";

std::string post(std::string_view path, std::string_view body, std::string_view fields = kToken) {
  return fmt::format("POST {} HTTP/1.1\r\nHost: h\r\n{}Content-Length: {}\r\n\r\n{}", path, fields,
                     body.size(), body);
}
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
  void settle() { expect_health(); }
};

TEST_F(HttpStop, WaitsForNoLargeBody) {
  options_.limits.body_memory = 1 << 20;
  start();
  const auto some = send_each(1, slow_post("/x", 512 * 1024));
  const auto others = send_each(1, slow_post("/x", 512 * 1024, kOtherToken));
  settle();
  expect_stopped();
}

}  // namespace
}  // namespace dripline::server_test
