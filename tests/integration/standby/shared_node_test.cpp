// A Sparkplug node whose server ends: one death, one birth, and never two publishers.
#include <csignal>

#include "tests/integration/mqtt_broker.hpp"
#include "tests/integration/standby/standby_fixture.hpp"

namespace dripline::integration {
namespace {

using std::chrono::milliseconds;
using test_support::eventually;

/// Of a birth or a death of a node (Sparkplug 3.0, chapter 6.4): datatype and value of this metric.
std::uint64_t bd_seq(const std::string& payload) {
  const std::string head = "\x20\x08\x58";
  const auto at = payload.find(head, payload.find("bdSeq"));
  if (at == std::string::npos) return UINT64_MAX;
  std::uint64_t value = 0;
  int shift = 0;
  for (auto byte = at + head.size(); byte < payload.size(); ++byte, shift += 7) {
    const auto part = static_cast<std::uint8_t>(payload[byte]);
    value |= static_cast<std::uint64_t>(part & 0x7F) << shift;
    if (part < 0x80) break;
  }
  return value;
}

enum class End { Kill, Drain, Freeze };

class SharedNode : public TwoServersTest, public testing::WithParamInterface<End> {
 protected:
  void begin_with_node() {
    const auto file = folder_.path() / "dncd.toml";
    shop_.emplace(TwoServers::Options{.stores = {store('a'), store('b')},
                                      .arguments = {"--config=" + file.string()}});
    broker_.emplace(folder_.path() / "broker", 21000 + shop_->domain());
    broker_->start();
    std::ofstream(file) << "[mqtt]\nprefix = \"shop\"\nbroker = \"mqtt://127.0.0.1:"
                        << broker_->port()
                        << "\"\nkinds = []\nsparkplug_group = \"hall\"\nsparkplug_node = \"dnc\"\n";
    host_.emplace(broker_->port(), "spBv1.0/#");
    start_both();
    shop_->start_gateway();
    ASSERT_TRUE(eventually([&] { return seen().ends_with("DBIRTH "); })) << seen();
  }
  void end_first() {
    if (GetParam() == End::Kill) return shop_->server(0).kill();
    if (GetParam() == End::Freeze) return shop_->freeze(0);
    const auto drained = shop_->rest(0).post("/api/v1/server/drain", nlohmann::json::object());
    ASSERT_EQ(drained.status, 202) << drained.body;
  }
  /// Births and deaths of the node and of its device, in their order. A device is born again when
  /// it has other metrics: that is one birth here.
  std::string seen() {
    std::string types;
    for (const auto& message : host_->received("spBv1.0/hall/")) {
      const auto type = message.topic.substr(13, message.topic.find('/', 13) - 13);
      if (type == "DDATA" || (type == "DBIRTH" && types.ends_with("DBIRTH "))) continue;
      types += type + " ";
    }
    return types;
  }

  const test_support::TemporaryFolder folder_;
  std::optional<Broker> broker_;
  std::optional<Subscriber> host_;
};

TEST_P(SharedNode, DiesOnceAndIsBornAgainWithAnotherNumber) {
  begin_with_node();
  const std::string before = seen();
  end_first();
  ASSERT_TRUE(shop_->wait_active(1)) << shop_->log(1);
  ASSERT_TRUE(eventually([&] {
    return seen().size() > before.size() && seen().ends_with("NBIRTH DBIRTH ");
  })) << seen();
  const std::string after = seen();
  EXPECT_EQ(after, before + "NDEATH NBIRTH DBIRTH ");
  const auto births = host_->received("NBIRTH"), deaths = host_->received("NDEATH");
  ASSERT_GE(births.size(), 2u);
  EXPECT_EQ(bd_seq(deaths.back().payload), bd_seq(births[births.size() - 2].payload));
  EXPECT_NE(bd_seq(births.back().payload), bd_seq(deaths.back().payload))
      << "a death that comes late is not this one's";
  EXPECT_LT(bd_seq(births.back().payload), 256u);
  if (GetParam() == End::Freeze) {
    shop_->thaw(0);
    EXPECT_EQ(shop_->server(0).wait(), 1) << shop_->log(0);
  }
  std::this_thread::sleep_for(milliseconds(700));  // in which no one may say more
  EXPECT_EQ(seen(), after);
}

INSTANTIATE_TEST_SUITE_P(, SharedNode, testing::Values(End::Kill, End::Drain, End::Freeze),
                         [](const auto& i) {
                           return std::string(i.param == End::Kill    ? "Kill"
                                              : i.param == End::Drain ? "Drain"
                                                                      : "Freeze");
                         });

}  // namespace
}  // namespace dripline::integration
