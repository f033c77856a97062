// What becomes of connections when the server ends. All on loopback.
#include <thread>

#include "tests/unit/server/api/http_attack.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

class HttpDrain : public HttpAttack {
 protected:
  ~HttpDrain() override {
    gate_.open();
    if (ending_.joinable()) ending_.join();
  }
  /// Returns when it reads nothing more; handlers are still waiting.
  void begin_to_end() {
    RawPeer silent = peer();
    silent.send(get("/health", ""));
    silent.read_until("fine\n");
    ending_ = std::thread([this] { server_.reset(); });
    EXPECT_TRUE(silent.wait_for_end()) << "an idle connection is closed at once";
  }
  void end() {
    gate_.open();
    ending_.join();
  }

 private:
  std::thread ending_;
};

TEST_F(HttpDrain, AnswersWhatIsCarriedOut) {
  start();
  RawPeer stored = peer(), at_machine = peer();
  stored.send(get("/wait"));
  at_machine.send(post("/stop/wait", R"({"action":"hold"})"));
  gate_.wait_for(2);
  begin_to_end();
  end();
  for (RawPeer* one : {&stored, &at_machine}) {
    const std::string answer = one->read_until("served");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
    EXPECT_NE(answer.find("Connection: close"), std::string::npos) << answer;
    EXPECT_TRUE(one->wait_for_end());
  }
}

TEST_F(HttpDrain, ClosesWhatIsNotWholeWhileAHandlerStillWaits) {
  start();
  RawPeer waiting = peer(), half = peer(), stream = peer();
  half.send(
      "POST /x HTTP/1.1\r\nHost: h\r\nAuthorization: Bearer right\r\nContent-Length: 900\r\n");
  half.send("\r\n{");
  stream.send(get("/events"));
  stream.read_until("events follow");
  waiting.send(get("/machine"));
  gate_.wait_for(1);
  begin_to_end();
  EXPECT_TRUE(half.wait_for_end());
  EXPECT_TRUE(stream.wait_for_end());
  end();
  EXPECT_TRUE(waiting.read_until("served").starts_with("HTTP/1.1 200"));
}

TEST_F(HttpDrain, TakesNoOtherRequestOfAConnection) {
  start();
  RawPeer one = peer();
  one.send(get("/machine") + post("/x", "second"));
  gate_.wait_for(1);
  begin_to_end();
  end();
  const std::string answers = one.read_until("second");
  EXPECT_TRUE(answers.starts_with("HTTP/1.1 200")) << answers;
  EXPECT_EQ(answers.find("second"), std::string::npos) << answers;
}

TEST_F(HttpDrain, RefusesALongAnswerThatItWouldBreakOff) {
  start();
  RawPeer one = peer();
  one.send(get("/pieces/wait"));
  gate_.wait_for(1);
  begin_to_end();
  end();
  const std::string answer = one.read_until("stopping");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 503")) << answer;
}

TEST_F(HttpDrain, DoesNotWaitLongForAClientThatReadsNothing) {
  constexpr std::size_t kMoreThanSocketsKeep = 24 << 20;
  constexpr int kSmall = 4096;
  options_.max_body = kMoreThanSocketsKeep;
  start();
  RawPeer one(server_->port(), kSmall);
  one.send(post("/x/wait", std::string(kMoreThanSocketsKeep, 'x')));
  gate_.wait_for(1);
  begin_to_end();
  const auto opened = std::chrono::steady_clock::now();
  end();
  EXPECT_LT(std::chrono::steady_clock::now() - opened, 20s) << "and not as long as for a write";
}

}  // namespace
}  // namespace dripline::server_test
