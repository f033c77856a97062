#include "server/webhooks/webhooks.hpp"

#include <arpa/inet.h>
#include <httplib.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <atomic>
#include <cerrno>
#include <deque>
#include <nlohmann/json.hpp>
#include <set>

#include "protocol/base/descriptor.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::webhooks {
namespace {

using Json = nlohmann::json;

TEST(WebhookSignature, IsHmacSha256) {
  // RFC 4231, cases 1, 2 and 6.
  EXPECT_EQ(hmac_sha256(std::string(20, '\x0b'), "Hi There").hex(),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hmac_sha256("Jefe", "what do ya want for nothing?").hex(),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmac_sha256(std::string(131, '\xaa'),
                        "Test Using Larger Than Block-Size Key - Hash Key First")
                .hex(),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
}

TEST(WebhookUrl, IsHttpOrHttpsWithAHost) {
  for (const char* good : {"http://erp", "https://erp.example:8443/a/b?c=d", "http://[::1]:80/x",
                           "http://127.0.0.1:9/"})
    EXPECT_TRUE(check_url(good)) << good;
  for (const char* bad :
       {"", "erp", "ftp://erp/", "file:///etc/passwd", "http://", "http:///x",
        "https://user:pw@erp/", "http://erp/#x", "http://erp/ x", "HTTP://erp", "http://erp:0/",
        "http://erp:99999/", "http://erp:80:80/", "http://erp:/", "http://[::1", "http://[::1]x/"})
    EXPECT_FALSE(check_url(bad)) << bad;
  EXPECT_EQ(check_url("http://" + std::string(600, 'a')).error().code, Errc::LimitExceeded);
}

TEST(WebhookDelivery, IsJsonWhateverAMachineSent) {
  storage::Webhook hook;
  hook.secret = "s";
  const storage::Event event{.id = 7, .time = {}, .kind = "alarm", .data = "{\"text\":\"\xff!\"}"};
  const auto delivery = make_delivery(hook, event, "db", UtcTime(std::chrono::seconds(42)));
  const Json body = Json::parse(delivery.body, nullptr, false);
  ASSERT_TRUE(body.is_object()) << delivery.body;
  EXPECT_EQ(body["id"], "db-7");
  EXPECT_EQ(body["data"]["text"], "\xef\xbf\xbd!");
  EXPECT_EQ(delivery.timestamp, "42");
  EXPECT_EQ(delivery.signature, "sha256=" + hmac_sha256("s", "42." + delivery.body).hex());
}

/// A receiver in the test's hands.
class FakeSender final : public Sender {
 public:
  Result<void> send(const Delivery& delivery, const std::stop_token&) override {
    const std::lock_guard lock(mutex_);
    tries.push_back(delivery);
    if (failing.contains(delivery.url)) return fail(Errc::Timeout, "nothing there");
    got[delivery.url].push_back(delivery.id);
    return {};
  }
  std::size_t number_got(const std::string& url) {
    const std::lock_guard lock(mutex_);
    return got[url].size();
  }
  std::size_t number_of_tries() {
    const std::lock_guard lock(mutex_);
    return tries.size();
  }
  void set_failing(std::set<std::string> urls) {
    const std::lock_guard lock(mutex_);
    failing = std::move(urls);
  }
  std::vector<std::string> ids(const std::string& url) {
    const std::lock_guard lock(mutex_);
    return got[url];
  }
  std::vector<Delivery> tries;

 private:
  std::mutex mutex_;
  std::set<std::string> failing;
  std::map<std::string, std::vector<std::string>> got;
};

constexpr const char* kErp = "http://erp/";
constexpr const char* kMes = "http://mes/";

class WebhooksTest : public server_test::ServerTest {
 protected:
  void make() {
    hooks_.reset();
    using std::chrono::milliseconds;
    hooks_ = std::make_unique<Webhooks>(
        Webhooks::Parts{.store = store_->webhooks,
                        .sender = sender_,
                        .clock = clock_,
                        .server = "db",
                        .on_fault =
                            [this](const std::string&, const std::string& fault) {
                              const std::lock_guard lock(mutex_);
                              fault_ = fault;
                            }},
        Webhooks::Options{.look = milliseconds(5),
                          .first_retry = milliseconds(5),
                          .longest_retry = milliseconds(20)});
    hooks_->begin();
  }
  void add(const std::string& name, const std::string& url, std::vector<std::string> kinds = {}) {
    const auto added = hooks_->add({.name = name, .url = url, .kinds = std::move(kinds)}, "admin");
    ASSERT_TRUE(added) << added.error().what;
    EXPECT_EQ(added->secret.size(), 64u);
  }
  bool gets(const std::string& url, std::size_t number) {
    return test_support::eventually([&] { return sender_.number_got(url) >= number; });
  }
  std::string fault() {
    const std::lock_guard lock(mutex_);
    return fault_;
  }

  std::mutex mutex_;
  std::string fault_;
  FakeSender sender_;
  std::unique_ptr<Webhooks> hooks_;
};

TEST_F(WebhooksTest, GetEveryEventInOrder) {
  make();
  add("erp", kErp);
  for (int i = 1; i <= 5; ++i) push("O1", "%C" + std::to_string(i) + "\n");
  ASSERT_TRUE(gets(kErp, 5));
  const auto ids = sender_.ids(kErp);
  EXPECT_EQ(ids, (std::vector<std::string>{"db-1", "db-2", "db-3", "db-4", "db-5"}));
  EXPECT_TRUE(test_support::eventually([&] { return store_->webhooks.events(0, 9)->empty(); }));
}

TEST_F(WebhooksTest, OneThatFailsDelaysNoOtherAndLosesNothing) {
  make();
  add("erp", kErp);
  add("mes", kMes);
  sender_.set_failing({kErp});
  push("O1", "%C1\n");
  push("O1", "%C2\n");
  ASSERT_TRUE(gets(kMes, 2));
  EXPECT_TRUE(test_support::eventually([&] { return store_->webhooks.find("erp")->failures > 2; }));
  EXPECT_EQ(store_->webhooks.find("erp")->fault, "nothing there");
  EXPECT_EQ(store_->webhooks.find("erp")->waiting, 2u);
  EXPECT_EQ(fault(), "") << "not for long";
  clock_.advance(std::chrono::minutes(20));
  EXPECT_TRUE(test_support::eventually([&] { return fault() == "nothing there"; }));
  sender_.set_failing({});
  ASSERT_TRUE(gets(kErp, 2));
  EXPECT_EQ(sender_.ids(kErp), (std::vector<std::string>{"db-1", "db-2"}));
  EXPECT_TRUE(test_support::eventually([&] { return fault().empty(); }));
}

TEST_F(WebhooksTest, ContinueFromTheStoredCursorAfterARestart) {
  make();
  add("erp", kErp, {"revision"});
  push("O1", "%C1\n");
  ASSERT_TRUE(gets(kErp, 1));
  sender_.set_failing({kErp});
  push("O1", "%C2\n");
  ASSERT_TRUE(test_support::eventually([&] { return store_->webhooks.find("erp")->failures > 0; }));
  hooks_.reset();
  push("O1", "%C3\n");
  sender_.set_failing({});
  make();
  ASSERT_TRUE(gets(kErp, 3));
  EXPECT_EQ(sender_.ids(kErp), (std::vector<std::string>{"db-1", "db-2", "db-3"}));
}

TEST_F(WebhooksTest, GetOnlyTheirKindsAndNothingOnceRemoved) {
  make();
  add("erp", kErp, {"run"});
  push("O1", "%C1\n");
  EXPECT_TRUE(test_support::eventually([&] {
    return store_->webhooks.find("erp")->delivered == 1;
  })) << "passed over";
  EXPECT_EQ(sender_.number_of_tries(), 0u);
  ASSERT_TRUE(hooks_->remove("erp", "admin"));
  EXPECT_EQ(hooks_->remove("erp", "admin").error().code, Errc::NotFound);
  EXPECT_EQ(hooks_->add({.name = "erp", .url = kErp, .kinds = {"all"}}, "admin").error().code,
            Errc::Syntax);
  EXPECT_EQ(hooks_->add({.name = "ERP", .url = kErp}, "admin").error().code, Errc::Syntax);
}

TEST_F(WebhooksTest, ATestIsDeliveredAtOnce) {
  make();
  add("erp", kErp);
  EXPECT_TRUE(hooks_->test("erp"));
  EXPECT_EQ(sender_.tries.back().kind, "test");
  sender_.set_failing({kErp});
  EXPECT_EQ(hooks_->test("erp").error().what, "nothing there");
  EXPECT_EQ(hooks_->test("none").error().code, Errc::NotFound);
}

/// Answers with a status line that never ends.
class EndlessReceiver {
 public:
  EndlessReceiver() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own;
    auto* const address = reinterpret_cast<sockaddr*>(&own);
    EXPECT_EQ(::bind(listener_.get(), address, size), 0);
    EXPECT_EQ(::listen(listener_.get(), 1), 0);
    EXPECT_EQ(::getsockname(listener_.get(), address, &size), 0);
    port_ = ntohs(own.sin_port);
    thread_ = std::thread([this] { answer(); });
  }
  ~EndlessReceiver() {
    is_over_ = true;
    thread_.join();
  }
  int port() const { return port_; }
  std::size_t written() const { return written_; }

 private:
  void answer() {
    const Descriptor connection(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    // A peer that closed with its window full answers the kernel's probes only now and then.
    const timeval patience{.tv_sec = 0, .tv_usec = 20'000};
    ::setsockopt(connection.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    const std::string piece(65536, 'x');
    while (!is_over_) {
      const auto sent = ::send(connection.get(), piece.data(), piece.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno != EAGAIN) return;
      if (sent > 0) written_ += static_cast<std::size_t>(sent);
    }
  }
  Descriptor listener_;
  int port_ = 0;
  std::atomic<std::size_t> written_ = 0;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

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
  EndlessReceiver receiver;
  Delivery delivery;
  delivery.url = fmt::format("http://127.0.0.1:{}/", receiver.port());
  const auto sent = make_http_sender(std::chrono::seconds(5))->send(delivery, {});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().code, Errc::LimitExceeded) << sent.error().what;
  EXPECT_LT(receiver.written(), 64u * 1024 * 1024);
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
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
