#include "clients/lib/shared_http.hpp"

#include <gtest/gtest.h>

namespace dripline::client {
namespace {

/// One server of a library.
struct Server {
  enum class State { Active, NotReady, Standby, Down, Stranger };
  State state = State::Standby;
  std::optional<Failure> next;  ///< of its next request, and it is down afterwards
  std::string piece;            ///< passed on before that
  std::vector<std::string> requests;
  int probes = 0, age = 0;
  std::function<void()> on_probe = {};
};

class ServerHttp final : public Http {
 public:
  ServerHttp(Server& server, std::string url, bool is_probe)
      : server_(server), url_(std::move(url)), is_probe_(is_probe) {}
  Reply<HttpResponse> send(const HttpRequest& request) override {
    using State = Server::State;
    if (is_probe_) {
      ++server_.probes;
      if (server_.on_probe) server_.on_probe();
    } else {
      server_.requests.push_back(request.method + " " + request.path);
    }
    for (const auto& [name, value] : request.headers)
      if (name == "Dripline-Age") server_.age = std::stoi(value);
    if (server_.state == State::Down)
      return failed(Failure{Failure::Kind::Unreachable, Errc::Timeout,
                            fmt::format("server {} is not reachable", url_), true});
    if (server_.state == State::Stranger) return HttpResponse{404, {}, "<html>"};
    if (!is_probe_ && server_.next) {
      server_.state = State::Down;
      if (!server_.piece.empty()) request.on_body(server_.piece);
      return failed(*std::exchange(server_.next, std::nullopt));
    }
    if (server_.state == State::Standby)
      return HttpResponse{503, {{"dripline-role", "standby"}}, R"({"ready":false})"};
    return HttpResponse{
        200, {}, server_.state == State::Active ? R"({"ready":true})" : R"({"ready":false})"};
  }
  void stop() override {}

 private:
  Server& server_;
  const std::string url_;
  const bool is_probe_;
};

class SharedServers : public testing::Test {
 protected:
  using State = Server::State;
  SharedServers() { begin(std::chrono::milliseconds(0)); }
  void begin(std::chrono::milliseconds patience) {
    std::vector<SharedHttp::Member> members;
    for (std::size_t i = 0; i < servers_.size(); ++i) {
      const std::string url = fmt::format("http://srv-{}:1", i + 1);
      members.push_back({{.url = url, .token = {}, .ca_file = {}},
                         std::make_unique<ServerHttp>(servers_[i], url, false),
                         std::make_unique<ServerHttp>(servers_[i], url, true)});
    }
    http_.emplace(std::move(members), patience);
  }
  Reply<HttpResponse> send(const std::string& method) {
    HttpRequest request;
    request.method = method;
    request.path = "/api/v1/runs";
    request.on_body = [this](std::string_view piece) {
      seen_ += piece;
      return true;
    };
    return http_->send(request);
  }
  static Failure cut() { return {Failure::Kind::Unreachable, Errc::Timeout, "srv is cut off"}; }

  std::array<Server, 3> servers_;
  std::optional<SharedHttp> http_;
  std::string seen_;
};

TEST_F(SharedServers, AreAskedUntilOneHasTheLibraryWhichIsRemembered) {
  servers_[0].state = State::Down;
  servers_[2].state = State::Active;
  EXPECT_EQ(http_->answering(), nullptr);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(send("POST"));
  EXPECT_EQ(http_->answering()->url, "http://srv-3:1");
  EXPECT_EQ(servers_[2].requests.size(), 3u);
  EXPECT_EQ(servers_[2].probes, 1);
  EXPECT_TRUE(servers_[1].requests.empty()) << "a server that waits is not sent what changes";
}

TEST_F(SharedServers, AreNamedWithTheirReasonsWhenNoneHasTheLibrary) {
  servers_[0].state = State::Down;
  servers_[2].state = State::Stranger;
  const auto reply = send("GET");
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().kind, Failure::Kind::Unreachable);
  EXPECT_EQ(reply.error().what,
            "none of the servers has the library now: server http://srv-1:1 is not reachable; "
            "http://srv-2:1 stands by; http://srv-3:1 answered with status 404; is it a Dripline "
            "server?");
}

/// The first one is frozen, and its standby is between waiting and being ready.
TEST_F(SharedServers, AreAskedAgainInTheMiddleOfATakeover) {
  begin(std::chrono::seconds(10));
  servers_[0].state = State::Down;
  servers_[2].state = State::Down;
  servers_[1].on_probe = [this] {
    if (servers_[1].probes == 1) servers_[1].state = State::Standby;
    if (servers_[1].probes == 2) servers_[1].state = State::Down;
    if (servers_[1].probes == 3) servers_[1].state = State::Active;
  };
  ASSERT_TRUE(send("POST"));
  EXPECT_EQ(servers_[1].requests.size(), 1u);
  EXPECT_GE(servers_[1].age, 500) << "what was done meanwhile is later than this request";
}

TEST_F(SharedServers, ThatAreAllDownAreNotWaitedFor) {
  begin(std::chrono::hours(1));
  for (Server& server : servers_) server.state = State::Down;
  EXPECT_FALSE(send("POST"));
}

TEST_F(SharedServers, AreFollowedAfterAHandOver) {
  servers_[0].state = State::Active;
  ASSERT_TRUE(send("POST"));
  servers_[0].state = State::Standby;
  servers_[1].state = State::Active;
  ASSERT_TRUE(send("POST")) << "the one that stands by has done nothing";
  EXPECT_EQ(servers_[1].requests.size(), 1u);
}

TEST_F(SharedServers, DoNotDoTwiceWhatTheFirstMayHaveDone) {
  servers_[0].state = State::Active;
  ASSERT_TRUE(send("GET"));
  servers_[0].next = cut();
  servers_[1].state = State::Active;
  const auto reply = send("POST");
  ASSERT_FALSE(reply);
  EXPECT_EQ(reply.error().what,
            "srv is cut off; it may have done what it was asked for, so no other server was asked");
  EXPECT_TRUE(servers_[1].requests.empty());
  EXPECT_TRUE(send("POST")) << "the next request";
}

TEST_F(SharedServers, AreAskedInTurnWhereNothingWasSent) {
  servers_[0].state = State::Active;
  ASSERT_TRUE(send("GET"));
  servers_[0].state = State::Down;
  servers_[1].state = State::Active;
  EXPECT_TRUE(send("POST"));
}

TEST_F(SharedServers, AreAskedInTurnByWhatReads) {
  servers_[0].state = State::Active;
  servers_[0].next = cut();
  servers_[1].state = State::Active;
  EXPECT_TRUE(send("GET"));
  EXPECT_EQ(http_->answering()->url, "http://srv-2:1");
}

/// Otherwise the caller would have the beginning twice.
TEST_F(SharedServers, DoNotBeginAnAnswerAgainThatWasPassedOn) {
  servers_[0].state = State::Active;
  servers_[0].next = cut();
  servers_[0].piece = "half";
  servers_[1].state = State::Active;
  EXPECT_FALSE(send("GET"));
  EXPECT_EQ(seen_, "half");
  EXPECT_TRUE(servers_[1].requests.empty());
}

/// It does not know yet that another one has taken over.
TEST_F(SharedServers, ArePreferredWhenTheyAreReady) {
  servers_[0].state = State::NotReady;
  servers_[1].state = State::Active;
  ASSERT_TRUE(send("POST"));
  EXPECT_EQ(http_->answering()->url, "http://srv-2:1");
  servers_[1].state = State::Down;
  ASSERT_TRUE(send("POST"));
  EXPECT_EQ(http_->answering()->url, "http://srv-1:1") << "its answer has the reason";
}

}  // namespace
}  // namespace dripline::client
