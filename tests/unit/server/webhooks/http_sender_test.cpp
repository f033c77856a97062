#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <thread>

#include "protocol/base/descriptor.hpp"
#include "server/webhooks/delivery.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/silent_lookup.hpp"

namespace dripline::webhooks {
namespace {

/// A socket of this computer's that listens.
class Listener {
 public:
  Listener() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own;
    auto* const address = reinterpret_cast<sockaddr*>(&own);
    EXPECT_EQ(::bind(socket_.get(), address, size), 0);
    EXPECT_EQ(::listen(socket_.get(), 1), 0);
    EXPECT_EQ(::getsockname(socket_.get(), address, &size), 0);
    port_ = ntohs(own.sin_port);
  }
  int port() const { return port_; }
  Descriptor accept() const {
    return Descriptor(::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC));
  }

 private:
  Descriptor socket_;
  int port_ = 0;
};

/// Sends `head`, then `piece` again and again, with a pause after each.
class EndlessReceiver {
 public:
  EndlessReceiver(std::string head, std::string piece, std::chrono::milliseconds pause)
      : head_(std::move(head)), piece_(std::move(piece)), pause_(pause) {
    thread_ = std::thread([this] { answer(); });
  }
  ~EndlessReceiver() {
    is_over_ = true;
    thread_.join();
  }
  int port() const { return listener_.port(); }
  std::size_t written() const { return written_; }

 private:
  void answer() {
    const Descriptor connection = listener_.accept();
    // A peer that closed with its window full answers the kernel's probes only now and then.
    const timeval patience{.tv_sec = 0, .tv_usec = 20'000};
    ::setsockopt(connection.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    std::string next = head_ + piece_;
    const auto begun = std::chrono::steady_clock::now();
    // A sender that is never cut off fails its test, and ends.
    while (!is_over_ && std::chrono::steady_clock::now() - begun < std::chrono::seconds(30)) {
      const auto sent = ::send(connection.get(), next.data(), next.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno != EAGAIN) return;
      if (sent > 0) written_ += static_cast<std::size_t>(sent);
      if (sent > 0) next = piece_;
      std::this_thread::sleep_for(pause_);
    }
  }
  const std::string head_, piece_;
  const std::chrono::milliseconds pause_;
  Listener listener_;
  std::atomic<std::size_t> written_ = 0;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

/// A TLS record, a byte at a time.
EndlessReceiver dripping_handshake() {
  return {std::string("\x16\x03\x03\x3f\xff"), "\x02", std::chrono::milliseconds(50)};
}

/// The real sender, against a real receiver.
class HttpSenderTest : public testing::Test {
 protected:
  HttpSenderTest() {
    server_.Post("/hook", [this](const httplib::Request& request, httplib::Response& response) {
      seen_ = request;
      response.status = 204;
    });
    server_.Post("/moved", [](const httplib::Request&, httplib::Response& response) {
      response.set_redirect("/hook");
    });
    server_.Post("/long", [](const httplib::Request& request, httplib::Response& response) {
      response.set_content(std::string(10'000'000, 'x'), "text/plain");
      response.status = request.has_param("bad") ? 500 : 200;
    });
    server_.Post("/drip", [](const httplib::Request&, httplib::Response& response) {
      response.set_chunked_content_provider("text/plain", [](std::size_t, httplib::DataSink& sink) {
        test_support::wait_a_little();
        return sink.write("x", 1);
      });
    });
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) test_support::wait_a_little();
  }
  ~HttpSenderTest() override {
    server_.stop();
    thread_.join();
  }
  Result<void> send(const std::string& path, const std::stop_token& stop = {},
                    std::chrono::milliseconds timeout = std::chrono::milliseconds(300)) {
    Delivery delivery;
    delivery.url = fmt::format("http://127.0.0.1:{}{}", port_, path);
    delivery.id = "db-1";
    delivery.kind = "run";
    delivery.timestamp = "42";
    delivery.signature = "sha256=00";
    delivery.body = "{}";
    return make_http_sender(timeout)->send(delivery, stop);
  }
  httplib::Server server_;
  httplib::Request seen_;
  int port_ = 0;
  std::thread thread_;
};

TEST_F(HttpSenderTest, PostsTheBodyWithItsHeader) {
  ASSERT_TRUE(send("/hook"));
  EXPECT_EQ(seen_.body, "{}");
  EXPECT_EQ(seen_.get_header_value("Content-Type"), "application/json");
  EXPECT_EQ(seen_.get_header_value("Dripline-Delivery"), "db-1");
  EXPECT_EQ(seen_.get_header_value("Dripline-Signature"), "sha256=00");
}

TEST_F(HttpSenderTest, FollowsNoRedirectionAndNamesTheStatus) {
  const auto moved = send("/moved");
  ASSERT_FALSE(moved);
  EXPECT_NE(moved.error().what.find("302"), std::string::npos) << moved.error().what;
  EXPECT_EQ(seen_.body, "");
  EXPECT_NE(send("/nothing").error().what.find("404"), std::string::npos);
}

TEST_F(HttpSenderTest, TakesTheStatusOfAnAnswerThatIsTooLong) {
  constexpr std::chrono::seconds kPatience{10};  // of a busy computer
  const auto sent = send("/long", {}, kPatience);
  EXPECT_TRUE(sent) << sent.error().what;
  const auto refused = send("/long?bad=1", {}, kPatience);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("500"), std::string::npos) << refused.error().what;
}

TEST_F(HttpSenderTest, AReceiverThatDripsIsCutOff) {
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_FALSE(send("/drip"));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(send("/drip", stop.get_token()));
}

/// A head without an end: nothing of it is a reason to grow.
TEST_F(HttpSenderTest, AHeadWithoutAnEndIsCutOff) {
  const auto begun = std::chrono::steady_clock::now();
  EndlessReceiver receiver("", std::string(65536, 'x'), {});
  Delivery delivery;
  delivery.url = fmt::format("http://127.0.0.1:{}/", receiver.port());
  const auto sent = make_http_sender(std::chrono::seconds(5))->send(delivery, {});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, Errc::LimitExceeded) << sent.error().what;
  EXPECT_LT(receiver.written(), 64u * 1024 * 1024);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
}

constexpr std::chrono::milliseconds kShort{300};
constexpr std::chrono::seconds kPrompt{10};  ///< on a busy computer

Delivery to(const std::string& url) {
  Delivery delivery;
  delivery.url = url;
  delivery.body = "{}";
  return delivery;
}

TEST_F(HttpSenderTest, AHandshakeThatDripsIsCutOff) {
  const auto begun = std::chrono::steady_clock::now();
  EndlessReceiver receiver = dripping_handshake();
  const auto sent =
      make_http_sender(kShort)->send(to(fmt::format("https://127.0.0.1:{}/", receiver.port())), {});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, Errc::Timeout) << sent.error().what;
  EXPECT_LT(std::chrono::steady_clock::now() - begun, kPrompt);
}

TEST_F(HttpSenderTest, AStopEndsAHandshakeThatDrips) {
  const auto begun = std::chrono::steady_clock::now();
  EndlessReceiver receiver = dripping_handshake();
  std::stop_source stop;
  const std::jthread stopper([&] {
    EXPECT_TRUE(test_support::eventually([&] { return receiver.written() > 8; }));
    stop.request_stop();
  });
  EXPECT_FALSE(
      make_http_sender(std::chrono::minutes(1))
          ->send(to(fmt::format("https://127.0.0.1:{}/", receiver.port())), stop.get_token()));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, kPrompt);
}

/// Its queue is full: what connects to it waits.
class FullListener : public Listener {
 public:
  FullListener() {
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    there.sin_port = htons(static_cast<std::uint16_t>(port()));
    for (Descriptor& one : waiting_) {
      one = Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
      (void)::connect(one.get(), reinterpret_cast<const sockaddr*>(&there), sizeof there);
    }
  }

 private:
  std::array<Descriptor, 8> waiting_;
};

NameLookup fixed(std::vector<std::string> addresses) {
  return [all = std::move(addresses)](const std::string&) -> Result<std::vector<std::string>> {
    return all;
  };
}

TEST_F(HttpSenderTest, AllAddressesOfANameShareOneLimit) {
  const FullListener nowhere;
  const std::vector<std::string> addresses(100, "127.0.0.1");
  const auto sender = make_http_sender(kShort, fixed(addresses));
  const auto begun = std::chrono::steady_clock::now();
  const auto sent = sender->send(to(fmt::format("http://many.example:{}/", nowhere.port())), {});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, Errc::Timeout) << sent.error().what;
  EXPECT_LT(std::chrono::steady_clock::now() - begun, kPrompt);
}

TEST_F(HttpSenderTest, TriesTheNextAddressWhereOneIsNotReached) {
  // The server listens at the second one.
  const auto sender = make_http_sender(kPrompt, fixed({"127.0.0.2", "127.0.0.1"}));
  const auto sent = sender->send(to(fmt::format("http://two.example:{}/hook", port_)), {});
  ASSERT_TRUE(sent) << sent.error().what;
  EXPECT_EQ(seen_.get_header_value("Host"), fmt::format("two.example:{}", port_));
  EXPECT_EQ(seen_.body, "{}");
}

TEST_F(HttpSenderTest, TakesAnAddressOfIPv6WithLetters) {
  if (!Descriptor(::socket(AF_INET6, SOCK_STREAM | SOCK_CLOEXEC, 0))) GTEST_SKIP() << "no IPv6";
  const auto sent = make_http_sender(kPrompt)->send(
      to(fmt::format("http://[::ffff:127.0.0.1]:{}/hook", port_)), {});
  ASSERT_TRUE(sent) << sent.error().what;
  EXPECT_EQ(seen_.body, "{}");
}

TEST_F(HttpSenderTest, ANameServerThatIsSilentIsNotWaitedForLonger) {
  const test_support::SilentLookup silent;
  const auto sender = make_http_sender(kShort, silent.lookup());
  const auto begun = std::chrono::steady_clock::now();
  const auto sent = sender->send(to("http://erp.example/"), {});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, Errc::Timeout);
  EXPECT_NE(sent.error().what.find("name server"), std::string::npos) << sent.error().what;
  EXPECT_LT(std::chrono::steady_clock::now() - begun, kPrompt);
}

TEST_F(HttpSenderTest, NobodyThereIsATimeout) {
  Delivery nowhere;
  nowhere.url = "http://127.0.0.1:1/";
  const auto sent = make_http_sender(std::chrono::milliseconds(300))->send(nowhere, {});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, Errc::Timeout);
}

}  // namespace
}  // namespace dripline::webhooks
