#include "server/webhooks/webhooks.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/child_process.hpp"
#include "tests/support/silent_lookup.hpp"
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

/// `remove` and the server's end wait for neither.
TEST_F(WebhooksTest, AreStoppedWhateverTheirNameServerDoes) {
  const test_support::SilentLookup silent;
  const auto sender = make_http_sender(std::chrono::minutes(1), silent.lookup());
  Webhooks hooks({.store = store_->webhooks, .sender = *sender, .clock = clock_, .server = "db"},
                 {.look = std::chrono::milliseconds(5)});
  ASSERT_TRUE(hooks.add({.name = "erp", .url = "http://erp.example/"}, "admin"));
  push("O1", "%C1\n");
  ASSERT_TRUE(test_support::eventually([&] { return silent.is_asked(); }));
  const auto begun = std::chrono::steady_clock::now();
  EXPECT_TRUE(hooks.remove("erp", "admin"));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
}

TEST_F(WebhooksTest, AStopEndsATestThatIsInProgress) {
  const test_support::SilentLookup silent;
  const auto sender = make_http_sender(std::chrono::minutes(1), silent.lookup());
  Webhooks hooks({.store = store_->webhooks, .sender = *sender, .clock = clock_, .server = "db"},
                 {});
  ASSERT_TRUE(hooks.add({.name = "erp", .url = "http://erp.example/"}, "admin"));
  const auto begun = std::chrono::steady_clock::now();
  const std::jthread stopper([&] {
    EXPECT_TRUE(test_support::eventually([&] { return silent.is_asked(); }));
    hooks.stop();
  });
  EXPECT_FALSE(hooks.test("erp"));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(10));
}

}  // namespace
}  // namespace dripline::webhooks
