// A broker that two servers reach: only the one whose place is confirmed is connected to it.
#include <algorithm>
#include <thread>

#include "tests/integration/mqtt_broker.hpp"
#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using std::chrono::seconds;
using test_support::eventually;

class SharedBroker : public TwoServersTest {
 protected:
  /// Without records: a publisher of records needs the database, and would wait for it anyway.
  void begin_with_broker() {
    const auto file = folder_.path() / "dncd.toml";
    shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')},
                                      .arguments = {"--config=" + file.string()}});
    broker_.emplace(folder_.path() / "broker", 21000 + shop_->domain());
    broker_->start();
    std::ofstream(file) << "[mqtt]\nprefix = \"shop\"\nbroker = \"mqtt://127.0.0.1:"
                        << broker_->port() << "\"\nkinds = []\n";
    subscriber_.emplace(broker_->port());
    start_both();
    ASSERT_TRUE(is_online(true));
  }
  bool is_online(bool wanted) {
    return eventually(
        [&] { return subscriber_->last("/online").value("online", !wanted) == wanted; });
  }
  std::size_t changes() { return subscriber_->received("/online").size(); }

  const test_support::TemporaryFolder folder_;
  std::optional<Broker> broker_;
  std::optional<Subscriber> subscriber_;
};

/// Both have the same client id: a broker ends the connection of one when the other connects.
TEST_F(SharedBroker, IsLeftByAServerThatIsCutOffFromTheDatabase) {
  begin_with_broker();
  cables_[0]->pull();
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  ASSERT_TRUE(eventually([&] { return changes() >= 3; })) << "its will, and the other one";
  ASSERT_TRUE(is_online(true));
  const std::size_t before = changes();
  std::this_thread::sleep_for(seconds(4));
  EXPECT_EQ(changes(), before) << shop_->log(0);
  EXPECT_TRUE(shop_->server(0).is_running());
  EXPECT_NE(shop_->log(0).find("mqtt: not published: this server does not reach the database"),
            std::string::npos)
      << shop_->log(0);
}

TEST_F(SharedBroker, SeesAHandOverAsAnEndAndABeginning) {
  begin_with_broker();
  const auto drained = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
  ASSERT_EQ(drained.status, 202) << drained.body;
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  const auto seen = [&] {
    std::vector<bool> states;
    for (const auto& message : subscriber_->received("/online"))
      states.push_back(nlohmann::json::parse(message.payload).value("online", false));
    return states;
  };
  ASSERT_TRUE(eventually([&] { return seen().size() >= 3 && seen().back(); }));
  const auto states = seen();
  EXPECT_TRUE(states.front());
  // A server that is starved for seconds may lose the broker and come back besides.
  EXPECT_EQ(std::ranges::adjacent_find(states), states.end()) << "each once";
}

}  // namespace
}  // namespace dripline::integration
