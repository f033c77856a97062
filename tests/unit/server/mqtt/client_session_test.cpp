#include "server/mqtt/client_session.hpp"

#include <gtest/gtest.h>

namespace dripline::mqtt {
namespace {

using namespace std::string_literals;
using std::chrono::seconds;

class ClientSessionTest : public testing::Test {
 protected:
  void make(bool is_version_5 = true, const std::string& subscribed = "") {
    session_.emplace(Introduction{.client_id = "me",
                                  .user = "u",
                                  .password = "p",
                                  .keep_alive = 20,
                                  .is_version_5 = is_version_5});
    ASSERT_TRUE(session_->begin({"w", "gone", 1, true}, subscribed, now_));
  }
  void connect(const std::string& connack = "\x20\x03\x00\x00\x00"s) {
    sent();
    EXPECT_EQ(receive(connack), "");
    ASSERT_TRUE(session_->is_connected());
  }
  std::string sent() {
    std::string bytes(session_->output());
    session_->written(bytes.size(), now_);
    return bytes;
  }
  /// The fault.
  std::string receive(const std::string& bytes) {
    const auto received = session_->receive(bytes, now_);
    return received ? "" : received.error().what;
  }
  std::uint64_t publish(int qos, const std::string& payload = "x") {
    const auto number = session_->publish({"t", payload, qos, false});
    EXPECT_TRUE(number) << number.error().what;
    return number.value_or(0);
  }
  /// MESSAGE or MESSAGE:REFUSAL for each.
  std::string acknowledged() {
    std::string text;
    for (const auto& [message, refusal] : session_->take_acknowledged())
      text += std::to_string(message) + (refusal.empty() ? "" : ":" + refusal) + " ";
    return text;
  }

  SteadyTime now_{};
  std::optional<ClientSession> session_;
};

TEST_F(ClientSessionTest, IntroducesItself) {
  make();
  EXPECT_EQ(sent(),
            "\x10\x24\x00\x04MQTT\x05\xee\x00\x14\x05\x27\x00\x04\x00\x00\x00\x02me\x00\x00\x01w"
            "\x00\x04gone"
            "\x00\x01u\x00\x01p"s);
  make(false);
  EXPECT_EQ(
      sent(),
      "\x10\x1d\x00\x04MQTT\x04\xee\x00\x14\x00\x02me\x00\x01w\x00\x04gone\x00\x01u\x00\x01p"s);
}

TEST_F(ClientSessionTest, PublishesWithEachQos) {
  make();
  EXPECT_FALSE(session_->publish({"t", "x", 1, false})) << "before the broker has accepted us";
  connect();
  EXPECT_EQ(publish(0), 1u);
  EXPECT_EQ(acknowledged(), "");
  EXPECT_EQ(sent(), "\x30\x05\x00\x01t\x00x"s);
  EXPECT_EQ(acknowledged(), "1 ") << "written";
  EXPECT_EQ(publish(1), 2u);
  EXPECT_EQ(sent(), "\x32\x07\x00\x01t\x00\x02\x00x"s);
  EXPECT_EQ(receive("\x40\x02\x00\x02"s), "");
  EXPECT_EQ(acknowledged(), "2 ");
  EXPECT_EQ(publish(2), 3u);
  EXPECT_EQ(sent(), "\x34\x07\x00\x01t\x00\x03\x00x"s);
  EXPECT_EQ(receive("\x50\x02\x00\x03"s), "");
  EXPECT_EQ(sent(), "\x62\x02\x00\x03"s);
  EXPECT_EQ(receive("\x50\x02\x00\x03"s), "") << "a repeat";
  EXPECT_EQ(sent(), "");
  EXPECT_EQ(acknowledged(), "");
  EXPECT_EQ(receive("\x70\x02\x00\x03"s), "");
  EXPECT_EQ(acknowledged(), "3 ");
}

TEST_F(ClientSessionTest, ReportsRefusals) {
  make();
  connect();
  publish(1);
  publish(2);
  publish(2);
  EXPECT_EQ(receive("\x40\x03\x00\x02\x87"s), "");
  EXPECT_EQ(receive("\x50\x03\x00\x03\x97"s), "");
  EXPECT_EQ(receive("\x50\x02\x00\x04\x70\x03\x00\x04\x92"s), "");
  EXPECT_EQ(acknowledged(), "1:Not authorized 2:Quota exceeded 3:Packet identifier not found ");
}

TEST_F(ClientSessionTest, TakesNoAnswerThatDoesNotFit) {
  const auto fault = [&](const std::string& answer) {
    make();
    connect();
    publish(1);
    publish(2);
    const auto text = receive(answer);
    EXPECT_EQ(acknowledged(), "") << testing::PrintToString(answer);
    return text;
  };
  EXPECT_EQ(fault("\x40\x02\x00\x63"s),
            "an acknowledgment of message 99, which is not in progress");
  for (const auto& answer :
       {"\x40\x02\x00\x03"s, "\x50\x02\x00\x02"s, "\x70\x02\x00\x02"s, "\x70\x02\x00\x03"s})
    EXPECT_NE(fault(answer).find("not expected"), std::string::npos)
        << testing::PrintToString(answer);
}

TEST_F(ClientSessionTest, EndsWithWhatIsNoAnswerOfABroker) {
  for (const auto& bytes : {"\x10\x00"s, "\x00\x00"s, "\xf0\x00"s, "\x80\x00"s, "\x62\x02\x00\x01"s,
                            "\x20\x03\x00\x00\x00"s, "\x90\x04\x00\x01\x00\x00"s}) {
    make();
    connect();
    EXPECT_NE(receive(bytes), "") << testing::PrintToString(bytes);
  }
  make();
  EXPECT_NE(receive("\x40\x02\x00\x02"s), "") << "not connected";
}

TEST_F(ClientSessionTest, EndsAtAPropertyThatIsNotDefined) {
  make();
  EXPECT_EQ(receive("\x20\x05\x00\x00\x02\x7f\x01"s),
            "CONNACK with property 127, which MQTT 5 does not define");
  EXPECT_FALSE(session_->is_connected());
}

TEST_F(ClientSessionTest, SaysWhyABrokerRefuses) {
  make();
  EXPECT_EQ(receive("\x20\x03\x00\x87\x00"s), "refused: Not authorized");
  make(false);
  EXPECT_EQ(receive("\x20\x02\x00\x05"s), "refused: not authorized");
  make();
  connect();
  EXPECT_EQ(receive("\xe0\x01\x8e"s), "Session taken over");
}

TEST_F(ClientSessionTest, HasNoMoreInFlightThanTheBrokerTakes) {
  make();
  connect("\x20\x06\x00\x00\x03\x21\x00\x02"s);
  for (int i = 0; i < 5; ++i) publish(1);
  EXPECT_EQ(sent().size(), 2u * 9);
  EXPECT_EQ(receive("\x40\x02\x00\x02"s), "");
  EXPECT_EQ(sent(), "\x32\x07\x00\x01t\x00\x04\x00x"s);
  make();
  connect();
  for (int i = 0; i < 100; ++i) publish(2);
  EXPECT_EQ(sent().size(), ClientSession::kMaxInFlight * 9);
}

TEST_F(ClientSessionTest, KeepsToTheLimitsOfTheBroker) {
  make();
  connect("\x20\x0c\x00\x00\x09\x24\x01\x25\x00\x27\x00\x00\x00\x32"s);
  const auto long_one = session_->publish({"t", std::string(50, 'x'), 1, false});
  ASSERT_FALSE(long_one);
  EXPECT_EQ(long_one.error().code, Errc::LimitExceeded);
  EXPECT_EQ(long_one.error().what, "takes no message of 58 bytes (t): at most 50");
  EXPECT_EQ(session_->publish({"t", "x", 2, false}).error().code, Errc::Unsupported);
  ASSERT_TRUE(session_->publish({"t", std::string(42, 'x'), 1, true}));
  EXPECT_EQ(sent().substr(0, 1), "\x32") << "not retained";
}

TEST_F(ClientSessionTest, KeepsTheConnectionAlive) {
  make();
  connect();
  now_ += seconds(19);
  EXPECT_TRUE(session_->look(now_));
  EXPECT_EQ(sent(), "");
  now_ += seconds(1);
  EXPECT_TRUE(session_->look(now_));
  EXPECT_EQ(sent(), "\xc0\x00"s);
  now_ += seconds(19);
  EXPECT_TRUE(session_->look(now_));
  EXPECT_EQ(receive("\xd0\x00"s), "");
  now_ += seconds(20);
  EXPECT_TRUE(session_->look(now_));
  now_ += seconds(20);
  const auto silent = session_->look(now_);
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error().code, Errc::Timeout);
}

/// A broker on a slow line gets the ping after what was sent before it.
TEST_F(ClientSessionTest, AwaitsTheAnswerFromWhenThePingIsWritten) {
  make();
  connect();
  publish(0, std::string(3000, 'x'));
  now_ += seconds(20);
  ASSERT_TRUE(session_->look(now_));
  for (int i = 0; i < 3; ++i) {
    now_ += seconds(15);
    session_->written(1000, now_);
    EXPECT_TRUE(session_->look(now_)) << i;
  }
  sent();
  now_ += seconds(19);
  EXPECT_TRUE(session_->look(now_));
  now_ += seconds(1);
  EXPECT_EQ(session_->look(now_).error().code, Errc::Timeout);
}

TEST_F(ClientSessionTest, TakesMessagesOfItsTopicAlone) {
  make(true, "wish");
  connect();
  EXPECT_EQ(sent(), "\x82\x0a\x00\x01\x00\x00\x04wish\x01"s);
  EXPECT_EQ(receive("\x90\x04\x00\x01\x00\x87"s), "");
  EXPECT_EQ(receive("\x32\x0a\x00\x04wish\x00\x09\x00x"s), "");
  EXPECT_EQ(sent(), "\x40\x02\x00\x09"s);
  EXPECT_EQ(receive("\x30\x08\x00\x04none\x00x"s + "\x31\x08\x00\x04wish\x00x"s), "");
  EXPECT_EQ(session_->take_received(), std::vector<std::string>{"x"});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(receive("\x30\x08\x00\x04wish\x00x"s), "");
  EXPECT_EQ(session_->take_received().size(), ClientSession::kMaxReceived);
}

TEST_F(ClientSessionTest, EndsWhenABrokerSendsAndReadsNothing) {
  make(true, "wish");
  connect();
  const std::size_t megabytes = ClientSession::kMaxOutput / ClientSession::kMaxPayload;
  for (std::size_t i = 1; i < megabytes; ++i)
    publish(0, std::string(ClientSession::kMaxPayload - 20, 'x'));
  std::string many;
  for (int i = 0; i < 10'000; ++i) many += "\x32\x0a\x00\x04wish\x00\x09\x00x"s;
  std::string fault;
  for (int i = 0; i < 100 && fault.empty(); ++i) fault = receive(many);
  EXPECT_EQ(fault, "does not take what is sent");
  EXPECT_LT(session_->output().size(), ClientSession::kMaxOutput + 100);
}

}  // namespace
}  // namespace dripline::mqtt
