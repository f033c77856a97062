// The link over real sockets, to a broker of bytes.
#include <gtest/gtest.h>
#include <thread>

#include "server/mqtt/broker_link.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/silent_lookup.hpp"
#include "tests/unit/protocol/serial/tcp_peer.hpp"

namespace dripline::mqtt {
namespace {

using namespace std::string_literals;
using std::chrono::milliseconds;

const std::string kAccepted = "\x20\x03\x00\x00\x00"s;

class MqttLinkTest : public testing::Test {
 protected:
  MqttLinkTest() {
    const auto address = "127.0.0.1:" + std::to_string(broker_.port());
    auto settings = read_mqtt("[mqtt]\nbroker='mqtt://" + address + "'\n");
    EXPECT_TRUE(settings);
    link_ = make_mqtt_link(*settings, "me");
  }
  void open() {
    ASSERT_TRUE(link_->open({"w", "gone", 1, true}, ""));
    ASSERT_TRUE(broker_.accept());
  }
  void connect(const std::string& connack = kAccepted) {
    open();
    broker_.write(connack);
    ASSERT_TRUE(test_support::eventually([&] { return look().is_connected; }));
  }
  const BrokerLink::Progress& look() {
    auto now = link_->wait(milliseconds(20));
    for (const auto& one : now.acknowledged) acknowledged_.push_back(one.message);
    return progress_ = std::move(now);
  }
  std::string fault() {
    EXPECT_TRUE(test_support::eventually([&] { return look().is_lost; }));
    return progress_.fault;
  }

  serial::TcpPeer broker_;
  std::unique_ptr<BrokerLink> link_;
  BrokerLink::Progress progress_;
  std::vector<std::uint64_t> acknowledged_;
};

TEST_F(MqttLinkTest, PublishesAndTakesLeave) {
  connect();
  const std::string connect = broker_.read(32);
  EXPECT_EQ(connect.substr(0, 1), "\x10");
  ASSERT_TRUE(link_->publish({"t", "x", 1, false}));
  look();
  EXPECT_EQ(broker_.read(9), "\x32\x07\x00\x01t\x00\x02\x00x"s);
  EXPECT_TRUE(acknowledged_.empty());
  broker_.write("\x40\x02\x00\x02"s);
  EXPECT_TRUE(
      test_support::eventually([&] { return look().is_connected && !acknowledged_.empty(); }));
  link_->close();
  EXPECT_EQ(broker_.read(100), "\xe0\x00"s);
}

TEST_F(MqttLinkTest, NamesWhatItCannotRead) {
  open();
  broker_.write("\x20\x05\x00\x00\x02\x7f\x01"s);
  EXPECT_NE(fault().find(": CONNACK with property 127, which MQTT 5 does not define"),
            std::string::npos)
      << progress_.fault;
}

TEST_F(MqttLinkTest, NamesAPacketThatIsTooLong) {
  connect();
  broker_.write("\x30\xff\xff\xff\x7f" + std::string(1000, 'x'));
  EXPECT_NE(fault().find(": a packet of 268435455 bytes: at most 262144"), std::string::npos)
      << progress_.fault;
}

TEST_F(MqttLinkTest, ReportsWhatWasAcknowledgedBeforeTheEnd) {
  connect();
  ASSERT_TRUE(link_->publish({"t", "x", 1, false}));
  broker_.write("\x40\x02\x00\x02\xe0\x01\x8e"s);
  EXPECT_NE(fault().find(": Session taken over"), std::string::npos) << progress_.fault;
  EXPECT_EQ(acknowledged_, std::vector<std::uint64_t>{1});
}

TEST_F(MqttLinkTest, AcknowledgesQos0WhenTheConnectionHasIt) {
  connect();
  std::size_t published = 0;
  for (; published < 24; ++published)
    ASSERT_TRUE(link_->publish({"t", std::string(1 << 20, 'x'), 0, false}));
  for (int i = 0; i < 20; ++i) look();
  EXPECT_LT(acknowledged_.size(), published) << "the broker reads nothing";
  ASSERT_TRUE(test_support::eventually(
      [&] {
        broker_.read(1 << 20);
        return look().is_connected && acknowledged_.size() == published;
      },
      std::chrono::seconds(60)));
}

TEST_F(MqttLinkTest, EndsWithABrokerThatReadsNothing) {
  connect();
  Result<std::uint64_t> published = 0;
  for (int i = 0; i < 100 && published; ++i)
    published = link_->publish({"t", std::string(1 << 20, 'x'), 0, false});
  ASSERT_FALSE(published);
  EXPECT_NE(published.error().what.find("does not take what is sent"), std::string::npos);
}

TEST_F(MqttLinkTest, SaysThatNoOneIsThere) {
  const auto address = "127.0.0.1:" + std::to_string(broker_.port() == 1 ? 2 : 1);
  link_ = make_mqtt_link(*read_mqtt("[mqtt]\nbroker='mqtt://" + address + "'\n"), "me");
  const auto opened = link_->open({"w", "gone", 1, true}, "");
  const auto why = opened ? fault() : opened.error().what;
  EXPECT_NE(why.find("Connection refused"), std::string::npos) << why;
}

TEST_F(MqttLinkTest, WaitsForNoNameServer) {
  const test_support::SilentLookup silent;
  link_ =
      make_mqtt_link(*read_mqtt("[mqtt]\nbroker='mqtt://broker.example'\n"), "me", silent.lookup());
  ASSERT_TRUE(link_->open({"w", "gone", 1, true}, ""));
  EXPECT_TRUE(test_support::eventually([&] { return silent.is_asked(); }));
  EXPECT_FALSE(look().is_lost) << progress_.fault;
  link_->wake();
  link_->wait(milliseconds(60'000));
  link_->close();
}

TEST_F(MqttLinkTest, ConnectsWhenItsHostIsLookedUp) {
  const auto port = std::to_string(broker_.port());
  link_ = make_mqtt_link(*read_mqtt("[mqtt]\nbroker='mqtt://broker.example:" + port + "'\n"), "me",
                         [](const std::string& host) {
                           EXPECT_EQ(host, "broker.example");
                           return Result<HostAddresses>(HostAddresses{"127.0.0.2", "127.0.0.1"});
                         });
  ASSERT_TRUE(link_->open({"w", "gone", 1, true}, ""));
  std::jthread accepting([this] { ASSERT_TRUE(broker_.accept()); });
  for (int i = 0; i < 10; ++i) look();
  accepting.join();
  broker_.write(kAccepted);
  EXPECT_TRUE(test_support::eventually([&] { return look().is_connected; })) << progress_.fault;
}

TEST_F(MqttLinkTest, NamesAHostThatIsNotKnown) {
  link_ = make_mqtt_link(*read_mqtt("[mqtt]\nbroker='mqtt://broker.example'\n"), "me",
                         [](const std::string&) {
                           return Result<HostAddresses>(fail(Errc::NotFound, "no address: none"));
                         });
  const auto opened = link_->open({"w", "gone", 1, true}, "");
  const auto why = opened ? fault() : opened.error().what;  // it may be known at once
  EXPECT_NE(why.find("broker.example: no address: none"), std::string::npos) << why;
}

TEST_F(MqttLinkTest, EndsAWaitWhenItIsWoken) {
  connect();
  link_->wake();
  const auto begun = std::chrono::steady_clock::now();
  for (int i = 0; i < 3; ++i) link_->wait(milliseconds(i == 0 ? 60'000 : 0));
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(30));
}

TEST_F(MqttLinkTest, SpeaksNoPlainTextWhereTlsIsWanted) {
  const auto address = "127.0.0.1:" + std::to_string(broker_.port());
  link_ = make_mqtt_link(*read_mqtt("[mqtt]\nbroker='mqtts://" + address + "'\n"), "me");
  open();
  for (int i = 0; i < 3; ++i) look();
  EXPECT_EQ(broker_.read(3).substr(0, 2), "\x16\x03") << "a handshake";
  broker_.write(kAccepted);
  EXPECT_NE(fault().find(": TLS: "), std::string::npos) << progress_.fault;
}

}  // namespace
}  // namespace dripline::mqtt
