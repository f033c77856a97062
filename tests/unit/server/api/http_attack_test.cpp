// The HTTP server against clients that are hostile, broken or only slow. All on loopback.
#include <sys/resource.h>
#include <atomic>
#include <thread>

#include "tests/support/sanitized.hpp"
#include "tests/unit/server/api/http_attack.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

TEST_F(HttpAttack, AThousandResetsLeaveItServing) {
  start();
  for (int i = 0; i < 1000; ++i) peer().reset();
  expect_health();
  expect_served();
}

TEST_F(HttpAttack, IdleConnectionsDoNotKeepOutWhoAsks) {
  start();
  const auto silent = idle(600);
  expect_served();
  expect_health();
}

TEST_F(HttpAttack, ASilentConnectionIsClosed) {
  options_.limits.head = 200ms;
  start();
  RawPeer silent = peer();
  EXPECT_TRUE(silent.wait_for_end());
}

TEST_F(HttpAttack, AHeadMustBeThereInTimeHoweverItComes) {
  options_.limits.head = 500ms;
  start();
  RawPeer slow = peer();
  slow.send("GET /x HTTP/1.1\r\n");
  bool is_open = true;
  const auto end = std::chrono::steady_clock::now() + 30s;
  while (is_open && std::chrono::steady_clock::now() < end) {
    is_open = slow.send("X: y\r\n") && !slow.wait_for_end(50ms);
  }
  EXPECT_FALSE(is_open);
  expect_served();
}

TEST_F(HttpAttack, ABodyWithoutTheTokenIsRefusedBeforeItIsRead) {
  options_.max_body = 4 << 20;
  start();
  std::vector<RawPeer> peers = idle(100);
  for (auto& one : peers) {
    one.send("PUT /x HTTP/1.1\r\nHost: h\r\nContent-Length: 4194304\r\n\r\nabc");
  }
  for (auto& one : peers) {
    const std::string text = one.read_until("\r\n\r\n");
    EXPECT_EQ(text.substr(0, 12), "HTTP/1.1 401");
    EXPECT_NE(text.find("Connection: close"), std::string::npos);
  }
  expect_served();
}

TEST_F(HttpAttack, ARefusedBodyThatIsSentAllTheSameDoesNotLoseTheAnswer) {
  options_.max_body = 4 << 20;
  start();
  RawPeer one = peer();
  one.send("PUT /x HTTP/1.1\r\nHost: h\r\nContent-Length: 4194304\r\n\r\n");
  one.send(std::string(4 << 20, 'x'));
  EXPECT_EQ(one.read_until("\r\n\r\n").substr(0, 12), "HTTP/1.1 401");
}

TEST_F(HttpAttack, BodiesWaitForMemoryAndSilentOnesAreCutOff) {
  options_.limits.body_memory = 1 << 20;
  options_.limits.body = 500ms;
  start();
  RawPeer stuck = peer();
  stuck.send(
      fmt::format("PUT /x HTTP/1.1\r\nHost: h\r\n{}Content-Length: 1000000\r\n\r\nabc", kToken));
  RawPeer next = peer();
  const std::string body(500'000, 'y');
  next.send(fmt::format("PUT /x HTTP/1.1\r\nHost: h\r\n{}Content-Length: 500000\r\n\r\n{}", kToken,
                        body));
  const std::string text = next.read_until("y\n");
  EXPECT_TRUE(text.starts_with("HTTP/1.1 200") || text.starts_with("HTTP/1.1 503")) << text;
  EXPECT_TRUE(stuck.wait_for_end());
  const std::string again = exchange(
      fmt::format("PUT /x HTTP/1.1\r\nHost: h\r\n{}Content-Length: 500000\r\n\r\n{}", kToken, body),
      "y\n");
  EXPECT_TRUE(again.starts_with("HTTP/1.1 200"));
}

TEST_F(HttpAttack, HealthAnswersWhileEveryHandlerWaits) {
  options_.handler_threads = 1;
  start();
  RawPeer waits = peer();
  waits.send(get("/wait"));
  gate_.wait_for(1);
  expect_health();
}

TEST_F(HttpAttack, CommandsThatWaitForAMachineDelayNoOtherRequest) {
  options_.handler_threads = 2;
  start();
  std::vector<RawPeer> peers = idle(40);
  for (auto& one : peers) one.send(get("/machine"));
  gate_.wait_for(40);
  expect_served();
  gate_.open();
  for (auto& one : peers) EXPECT_EQ(one.read_until("served").substr(0, 12), "HTTP/1.1 200");
}

TEST_F(HttpAttack, ThereIsAnEndToCommandsThatWait) {
  options_.limits.waiting_commands = 3;
  start();
  std::vector<RawPeer> peers = idle(3);
  for (auto& one : peers) one.send(get("/machine"));
  gate_.wait_for(3);
  EXPECT_EQ(status_of(get("/machine")), "HTTP/1.1 503");
}

TEST_F(HttpAttack, HealthHasSeatsOfItsOwn) {
  options_.limits.connections = 4;
  options_.limits.per_address = 4;
  start();
  std::vector<RawPeer> peers = idle(4);
  for (auto& one : peers) one.send(get("/machine"));
  gate_.wait_for(4);
  const std::string refused = exchange(get("/x"), "}");
  EXPECT_EQ(refused.substr(0, 12), "HTTP/1.1 503");
  EXPECT_NE(refused.find("Retry-After: 1"), std::string::npos);
  const auto silent = idle(100);  // may not take the reserve for good either
  expect_health();
}

TEST_F(HttpAttack, EventStreamsLeaveRoomForRequests) {
  options_.limits.connections = 8;
  options_.limits.per_address = 8;
  start();
  std::vector<RawPeer> streams = idle(4);
  for (auto& one : streams) {
    one.send(get("/events"));
    EXPECT_EQ(one.read_until("follow").substr(0, 12), "HTTP/1.1 200");
  }
  EXPECT_EQ(status_of(get("/events")), "HTTP/1.1 503");
  expect_served();
}

TEST_F(HttpAttack, AStreamWithoutAReaderIsCutOff) {
  options_.limits.event_streams = 1;
  options_.limits.write = 500ms;
  options_.heartbeat = 50ms;
  start();
  RawPeer unread(server_->port(), 4096);
  unread.send(get("/events"));
  const auto end = std::chrono::steady_clock::now() + 30s;
  const std::string data(100'000, 'x');
  std::string status;
  while (status != "HTTP/1.1 200" && std::chrono::steady_clock::now() < end) {
    hub_.publish({.kind = "record", .machine = "m", .data = data});
    status = status_of(get("/events"));
  }
  EXPECT_EQ(status, "HTTP/1.1 200");
}

TEST_F(HttpAttack, AListenerThatLeavesIsNoticedWithoutAnEvent) {
  options_.limits.event_streams = 1;
  start();
  {
    RawPeer leaves = peer();
    leaves.send(get("/events"));
    leaves.read_until("follow");
  }
  std::string status;
  const auto end = std::chrono::steady_clock::now() + 10s;  // before the heartbeat
  while (status != "HTTP/1.1 200" && std::chrono::steady_clock::now() < end) {
    status = status_of(get("/events"));
  }
  EXPECT_EQ(status, "HTTP/1.1 200");
}

TEST_F(HttpAttack, ComesBackWhenDescriptorsRanOut) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "a sanitizer looks at memory through a pipe";
  start();
  expect_served();
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  rlimit low = before;
  low.rlim_cur = 120;
  ::setrlimit(RLIMIT_NOFILE, &low);
  {
    std::vector<RawPeer> peers;
    peers.reserve(300);
    for (int i = 0; i < 300; ++i) peers.push_back(peer());
    EXPECT_FALSE(peers.back().is_connected());
  }
  expect_health();
  expect_served();
  ::setrlimit(RLIMIT_NOFILE, &before);
}

TEST_F(HttpAttack, PipelinedRequestsAreAnsweredInOrder) {
  start();
  RawPeer one = peer();
  std::string many;
  for (int i = 0; i < 50; ++i) {
    const std::string body = std::to_string(100 + i);
    many +=
        fmt::format("PUT /x HTTP/1.1\r\nHost: h\r\n{}Content-Length: 3\r\n\r\n{}", kToken, body);
  }
  one.send(many);
  const std::string text = one.read_until("served 149");
  std::size_t at = 0;
  for (int i = 0; i < 50; ++i) {
    at = text.find(fmt::format("served {}", 100 + i), at);
    ASSERT_NE(at, std::string::npos) << i;
  }
}

TEST_F(HttpAttack, AChunkedBodyAndOneThatWaitsForLeaveAreRead) {
  start();
  EXPECT_NE(
      exchange(fmt::format("PUT /x HTTP/1.1\r\nHost: h\r\n{}Transfer-Encoding: chunked\r\n\r\n"
                           "3\r\nabc\r\n2\r\nde\r\n0\r\n\r\n",
                           kToken),
               "abcde\n")
          .find("served abcde"),
      std::string::npos);
  RawPeer one = peer();
  one.send(fmt::format(
      "PUT /x HTTP/1.1\r\nHost: h\r\n{}Expect: 100-continue\r\nContent-Length: 3\r\n\r\n", kToken));
  EXPECT_EQ(one.read_until("\r\n\r\n"), "HTTP/1.1 100 Continue\r\n\r\n");
  one.send("abc");
  EXPECT_NE(one.read_until("abc\n").find("served abc"), std::string::npos);
}

TEST_F(HttpAttack, AnOldClientGetsABodyUntilTheEndOfTheConnection) {
  start();
  RawPeer one = peer();
  one.send(fmt::format("GET /pieces HTTP/1.0\r\n{}\r\n", kToken));
  const std::string text = one.read_until("piece\n3");
  EXPECT_NE(text.find("\r\n\r\npiece\n1piece\n2piece\n3"), std::string::npos) << text;
  EXPECT_TRUE(one.wait_for_end());
}

TEST_F(HttpAttack, AnswersAreNeitherGuessedNorKept) {
  start();
  const std::string answer = exchange(get("/health", ""), "fine");
  EXPECT_NE(answer.find("X-Content-Type-Options: nosniff\r\n"), std::string::npos) << answer;
  EXPECT_NE(answer.find("Cache-Control: no-store\r\n"), std::string::npos) << answer;
}

struct BadCase {
  const char* name;
  std::string request;
  const char* status;
};
class HttpRefusal : public HttpAttack, public testing::WithParamInterface<BadCase> {};

TEST_P(HttpRefusal, ReportsTheReason) {
  start();
  RawPeer one = peer();
  one.send(GetParam().request);
  EXPECT_EQ(one.read_until("\r\n\r\n").substr(9, 3), GetParam().status);
  EXPECT_TRUE(one.wait_for_end());
  expect_served();
}

const std::string kHead = fmt::format("PUT /x HTTP/1.1\r\nHost: h\r\n{}", kToken);

INSTANTIATE_TEST_SUITE_P(
    , HttpRefusal,
    testing::Values(
        BadCase{"garbage", "\x16\x03\x01 hello\r\n\r\n", "400"},
        BadCase{"version", "GET / HTTP/9.9\r\n\r\n", "400"},
        BadCase{"no_host", "GET /x HTTP/1.1\r\n\r\n", "400"},
        BadCase{"two_hosts", "GET /x HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", "400"},
        BadCase{"two_tokens",
                get("/x", "Authorization: Bearer right\r\nAuthorization: Bearer wrong\r\n"), "400"},
        BadCase{"list_of_lengths", kHead + "Content-Length: 4, 4\r\n\r\nabcd", "400"},
        BadCase{"two_lengths", kHead + "Content-Length: 3\r\nContent-Length: 4\r\n\r\nabcd", "400"},
        BadCase{"length_and_chunks",
                kHead + "Content-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n", "400"},
        BadCase{"other_coding", kHead + "Transfer-Encoding: gzip\r\nContent-Length: 3\r\n\r\nabc",
                "400"},
        BadCase{"bad_chunk", kHead + "Transfer-Encoding: chunked\r\n\r\nzz\r\n", "400"},
        BadCase{"bad_url", "GET /%zz HTTP/1.1\r\nHost: h\r\n\r\n", "400"},
        BadCase{"large_field", get("/x", "X: " + std::string(20'000, 'x') + "\r\n"), "431"},
        BadCase{"long_url", "GET /" + std::string(5000, 'x') + " HTTP/1.1\r\nHost: h\r\n\r\n",
                "431"},
        BadCase{"large_body", kHead + "Content-Length: 99999999999\r\n\r\n", "413"},
        BadCase{"large_chunk", kHead + "Transfer-Encoding: chunked\r\n\r\nfffffff\r\n", "413"}),
    [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dripline::server_test
