// The agent at real sockets.
#include "server/api/http_server.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/raw_peer.hpp"
#include "tests/unit/server/mtconnect/agent_fixture.hpp"

namespace dripline::mtconnect_test {
namespace {

using server_test::RawPeer;

class AgentHttp : public AgentTest {
 protected:
  AgentHttp() { serve({}); }
  ~AgentHttp() override { server_.reset(); }

  void serve(mtconnect::Agent::Options options) {
    server_.reset();
    options.sender = "shop";
    options.plant = "plant";
    agent_ = std::make_unique<mtconnect::Agent>(std::move(options), system_clock_);
    api::HttpOptions http;
    http.address = api::parse_http_address("127.0.0.1:0").value();
    http.is_open = true;
    http.handler_threads = 2;
    auto server = api::HttpServer::start(
        http, {.handle = [this](const api::Request& request) { return agent_->handle(request); },
               .judge = [this](api::Request& head) { return agent_->judge(head); }});
    ASSERT_TRUE(server) << server.error().what;
    server_ = *std::move(server);
    add("lathe-1");
  }
  RawPeer send(const std::string& line, int receive_buffer = 0) const {
    RawPeer peer(server_->port(), receive_buffer);
    peer.send(line + " HTTP/1.1\r\nHost: shop\r\nConnection: close\r\n\r\n");
    return peer;
  }
  void move(double x, const std::string& message = "") {
    auto lathe = view("lathe-1");
    lathe.status.edit().position[0] = x;
    lathe.status.edit().message = message;
    observe(lathe);
  }

  SystemClock system_clock_;
  std::unique_ptr<api::HttpServer> server_;
};

TEST_F(AgentHttp, RefusesWhatWouldChangeSomethingBeforeItsBody) {
  RawPeer peer(server_->port());
  peer.send("PUT /lathe-1?x=1 HTTP/1.1\r\nHost: shop\r\nContent-Length: 1000000\r\n\r\n");
  const auto answer = peer.read_until("</MTConnectError>");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 405 ")) << answer;
  EXPECT_NE(answer.find("Allow: GET, HEAD\r\n"), std::string::npos);
}

TEST_F(AgentHttp, HeadHasNoBody) {
  for (const char* target : {"/probe", "/current", "/sample?interval=100"}) {
    auto peer = send(std::string("HEAD ") + target);
    const auto answer = peer.read_until("never");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 ")) << target;
    EXPECT_TRUE(answer.ends_with("\r\n\r\n")) << target << answer;
  }
}

TEST_F(AgentHttp, AStreamIsChunkedAndGoesOn) {
  auto peer = send("GET /sample?interval=10&heartbeat=50");
  const auto head = peer.read_until("</MTConnectStreams>");
  EXPECT_NE(head.find("Transfer-Encoding: chunked\r\n"), std::string::npos);
  EXPECT_NE(head.find("Content-Type: multipart/x-mixed-replace;boundary="), std::string::npos);
  EXPECT_NE(peer.read_until("<Streams></Streams>").find("Content-length: "), std::string::npos)
      << "a heartbeat";
  move(5);
  EXPECT_NE(peer.read_until(">5</Position>").find(">5</Position>"), std::string::npos);
}

TEST_F(AgentHttp, AStreamThatAsksForTooMuchIsAnOrdinaryAnswer) {
  auto peer = send("GET /sample?interval=10&from=99999");
  const auto answer = peer.read_until("never");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 404 ")) << answer;
  EXPECT_NE(answer.find("OUT_OF_RANGE"), std::string::npos);
}

/// It stops reading, the observations go on, and when it reads again it learns that it lost some.
TEST_F(AgentHttp, ASlowReaderIsToldAndHoldsUpNobody) {
  mtconnect::Agent::Options options;
  options.buffer_size = 256;
  serve(options);
  constexpr int kSmall = 4096;
  auto slow = send("GET /sample?interval=10&count=200", kSmall);
  ASSERT_NE(slow.read_until("<Streams>").find("<Streams>"), std::string::npos);
  auto quick = send("GET /sample?interval=10&path=//Axes");
  const std::string text(500, 'x');
  // More than its socket's buffers at both ends hold, and then more than the ring.
  double x = 1;
  for (int i = 0; i < 200; ++i) {
    for (int n = 0; n < 20; ++n, ++x) move(x, text + std::to_string(x));
    quick.read_until(">" + std::to_string(static_cast<int>(x - 1)) + "</Position>");
  }
  const auto rest = slow.read_until("\r\n0\r\n\r\n");
  EXPECT_NE(rest.find("errorCode=\"OUT_OF_RANGE\""), std::string::npos);
  EXPECT_TRUE(slow.wait_for_end());
}

TEST_F(AgentHttp, TooManyStreamsOfOneAddressAreRefused) {
  std::vector<RawPeer> streams;
  constexpr int kAllowed = 128;
  for (int i = 0; i < kAllowed; ++i) {
    streams.push_back(send("GET /sample?interval=100"));
    ASSERT_NE(streams.back().read_until("<Streams>").find("<Streams>"), std::string::npos) << i;
  }
  EXPECT_TRUE(send("GET /sample?interval=100").read_until("\r\n").starts_with("HTTP/1.1 503 "));
  EXPECT_TRUE(send("GET /current").read_until("\r\n").starts_with("HTTP/1.1 200 "));
}

TEST_F(AgentHttp, EndsWithItsStreams) {
  auto peer = send("GET /current?interval=10");
  peer.read_until("</MTConnectStreams>");
  server_.reset();
  EXPECT_TRUE(peer.wait_for_end());
}

}  // namespace
}  // namespace dripline::mtconnect_test
