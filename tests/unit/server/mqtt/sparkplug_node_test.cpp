#include "server/mqtt/sparkplug_node.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/child_process.hpp"
#include "tests/unit/server/mqtt/fake_link.hpp"

namespace dripline::mqtt {
namespace {

using std::chrono::milliseconds;
using test_support::eventually;

machines::MachineView view(const std::string& name, const std::string& text,
                           bool is_connected = true) {
  machines::MachineView made;
  made.machine.name = name;
  made.machine.description = text;
  made.is_connected = is_connected;
  return made;
}
std::string rebirth_command() {
  return encode(
      {.time = UtcTime{}, .seq = {}, .metrics = {{kRebirth, Metric::Type::Boolean, true}}});
}

class SparkplugNodeTest : public testing::Test {
 protected:
  void make() {
    MqttSettings settings;
    settings.broker = "mqtt://127.0.0.1";
    settings.sparkplug_group = "hall";
    settings.sparkplug_node = "dnc";
    settings.status_interval = milliseconds(1);
    node_ = std::make_unique<SparkplugNode>(
        SparkplugNode::Parts{.link = link_,
                             .clock = clock_,
                             .version = "1",
                             .machines =
                                 [] {
                                   return std::vector{view("a", "first"), view("b", "", false)};
                                 },
                             .status_json =
                                 [](const auto& machine) {
                                   return nlohmann::json{{"text", machine.machine.description}};
                                 },
                             .on_fault = {}},
        settings, options_);
    node_->begin();
  }
  bool gets(const std::string& type, std::size_t number) {
    return eventually([&] { return link_.received("/" + type + "/").size() >= number; });
  }

  SparkplugNode::Options options_{
      .look = milliseconds(20),
      .rebirth_interval = milliseconds(1),
      .farewell = milliseconds(100),
      .state = {.first_retry = milliseconds(5), .longest_retry = milliseconds(20)}};
  SystemClock clock_;
  FakeLink link_;
  std::unique_ptr<SparkplugNode> node_;
};

TEST_F(SparkplugNodeTest, IsBornBeforeItsDevicesAndReportsChanges) {
  make();
  ASSERT_TRUE(gets("DBIRTH", 1));
  const auto all = link_.received("spBv1.0/hall/");
  ASSERT_GE(all.size(), 2U);
  EXPECT_EQ(all[0].topic, "spBv1.0/hall/NBIRTH/dnc");
  EXPECT_EQ(all[1].topic, "spBv1.0/hall/DBIRTH/dnc/a") << "b is not connected";
  EXPECT_EQ(link_.will().topic, "spBv1.0/hall/NDEATH/dnc");
  node_->note(view("a", "second"));
  ASSERT_TRUE(gets("DDATA", 1));
  node_->note(view("a", "second", false));
  ASSERT_TRUE(gets("DDEATH", 1));
  EXPECT_TRUE(link_.received("/dnc/b").empty());
  node_->note(view("b", "there"));
  ASSERT_TRUE(gets("DBIRTH", 2));
  EXPECT_EQ(link_.received("/DBIRTH/").back().topic, "spBv1.0/hall/DBIRTH/dnc/b");
  EXPECT_TRUE(node_->state().is_connected);
  EXPECT_EQ(node_->state().node, "hall/dnc");
}

TEST_F(SparkplugNodeTest, IsBornAgainWhenAHostAsks) {
  make();
  ASSERT_TRUE(gets("DBIRTH", 1));
  EXPECT_EQ(link_.subscribed(), "spBv1.0/hall/NCMD/dnc");
  link_.send("no payload");
  link_.send(rebirth_command());
  ASSERT_TRUE(gets("DBIRTH", 2));
  EXPECT_EQ(link_.received("/NBIRTH/").size(), 2U);
  EXPECT_EQ(node_->state().rebirths, 1U);
}

TEST_F(SparkplugNodeTest, IsNotBornMoreOftenThanItsInterval) {
  options_.rebirth_interval = std::chrono::hours(1);
  make();
  ASSERT_TRUE(gets("DBIRTH", 1));
  for (int i = 0; i < 20; ++i) link_.send(rebirth_command());
  node_->note(view("a", "second"));
  ASSERT_TRUE(gets("DDATA", 1));
  EXPECT_EQ(link_.received("/NBIRTH/").size(), 1U);
}

TEST_F(SparkplugNodeTest, IsBornAgainAfterAnOutage) {
  make();
  ASSERT_TRUE(gets("DBIRTH", 1));
  link_.set(&FakeLink::is_down, true);
  ASSERT_TRUE(eventually([&] { return !node_->state().is_connected; }));
  EXPECT_NE(node_->state().fault, "");
  link_.set(&FakeLink::is_down, false);
  ASSERT_TRUE(gets("DBIRTH", 2));
  EXPECT_EQ(link_.received("/NBIRTH/").size(), 2U);
  EXPECT_TRUE(eventually([&] { return node_->state().fault.empty(); }));
}

TEST_F(SparkplugNodeTest, SaysThatItLeaves) {
  make();
  ASSERT_TRUE(gets("DBIRTH", 1));
  node_->end();
  EXPECT_EQ(link_.received("").back().topic, "spBv1.0/hall/NDEATH/dnc");
  EXPECT_EQ(link_.closed, 1);
}

TEST_F(SparkplugNodeTest, HoldsNothingThatASlowBrokerDoesNotTake) {
  options_.window = 4;
  make();
  ASSERT_TRUE(gets("DBIRTH", 1));
  link_.set(&FakeLink::is_silent, true);
  for (int i = 0; i < 200; ++i) node_->note(view("m" + std::to_string(i), "x"));
  node_->note(view("a", "last"));
  link_.set(&FakeLink::is_silent, false);
  ASSERT_TRUE(gets("DBIRTH", 201));
  EXPECT_LE(link_.most_pending, options_.window + 1);
}

}  // namespace
}  // namespace dripline::mqtt
