#include "server/mqtt/sparkplug_session.hpp"

#include <gtest/gtest.h>

namespace dripline::mqtt {
namespace {

constexpr UtcTime kNow{std::chrono::milliseconds(1000)};

std::vector<Metric> state(double x, const std::string& program) {
  return {{"X", Metric::Type::Double, x}, {"program", Metric::Type::Text, program}};
}
std::string payload(std::optional<std::uint8_t> seq, std::vector<Metric> metrics) {
  return encode({.time = kNow, .seq = seq, .metrics = std::move(metrics)});
}
Metric bd_seq(std::uint64_t number) {
  return {"bdSeq", Metric::Type::Unsigned, number};
}

class SparkplugSessionTest : public testing::Test {
 protected:
  std::optional<Message> report(std::vector<Metric> metrics, bool is_connected = true) {
    return session_.report("mill", is_connected, std::move(metrics), kNow);
  }
  void begin() {
    (void)session_.begin(kNow);
    (void)session_.birth(kNow);
  }
  SparkplugSession session_{"hall", "dnc", "1", 0};
};

TEST_F(SparkplugSessionTest, HasTheSameNumberInBirthAndDeathOfAConnection) {
  for (std::uint64_t connection = 0; connection < 600; ++connection) {
    const auto will = session_.begin(kNow);
    EXPECT_EQ(will.topic, "spBv1.0/hall/NDEATH/dnc");
    EXPECT_EQ(will.payload, payload({}, {bd_seq(connection % 256)}));
    EXPECT_EQ(will.qos, 1);
    EXPECT_FALSE(will.is_retained);
    const auto birth = session_.birth(kNow);
    EXPECT_EQ(birth.topic, "spBv1.0/hall/NBIRTH/dnc");
    EXPECT_EQ(birth.qos, 0);
    EXPECT_EQ(birth.payload,
              payload(0, {bd_seq(connection % 256),
                          {kRebirth, Metric::Type::Boolean, false},
                          {"Properties/Software", Metric::Type::Text, "Dripline 1"}}));
  }
}

TEST_F(SparkplugSessionTest, CountsItsConnectionsFromTheOneItIsGiven) {
  SparkplugSession session{"hall", "dnc", "1", 255};
  EXPECT_EQ(session.begin(kNow).payload, payload({}, {bd_seq(255)}));
  EXPECT_EQ(session.begin(kNow).payload, payload({}, {bd_seq(0)}));
}

TEST_F(SparkplugSessionTest, BeginsADeviceWithAllAndContinuesWithWhatChanges) {
  begin();
  const auto birth = report(state(1, "O1"));
  ASSERT_TRUE(birth);
  EXPECT_EQ(birth->topic, "spBv1.0/hall/DBIRTH/dnc/mill");
  EXPECT_EQ(birth->payload, payload(1, state(1, "O1")));
  EXPECT_FALSE(report(state(1, "O1")));
  const auto data = report(state(2, "O1"));
  ASSERT_TRUE(data);
  EXPECT_EQ(data->topic, "spBv1.0/hall/DDATA/dnc/mill");
  EXPECT_EQ(data->payload, payload(2, {{"X", Metric::Type::Double, 2.0}}));
  EXPECT_EQ(data->qos, 0);
}

TEST_F(SparkplugSessionTest, NumbersMessagesWithoutAGap) {
  begin();
  for (int i = 1; i <= 600; ++i) {
    const auto message = report({{"X", Metric::Type::Double, static_cast<double>(i)}});
    ASSERT_TRUE(message);
    EXPECT_EQ(message->payload, payload(static_cast<std::uint8_t>(i),
                                        {{"X", Metric::Type::Double, static_cast<double>(i)}}));
  }
}

TEST_F(SparkplugSessionTest, SaysThatAValueIsNullWhereItIsNoMore) {
  begin();
  (void)report(state(1, "O1"));
  const auto data = report({{"X", Metric::Type::Double, 1.0}});
  ASSERT_TRUE(data);
  EXPECT_EQ(data->payload, payload(2, {{"program", Metric::Type::Text, std::nullopt}}));
  EXPECT_FALSE(report({{"X", Metric::Type::Double, 1.0}})) << "once";
}

TEST_F(SparkplugSessionTest, IsBornAgainWithAValueThatWasNotAnnounced) {
  begin();
  (void)report({{"X", Metric::Type::Double, 1.0}, {"old", Metric::Type::Text, "a"}});
  const auto birth = report(state(1, "O1"));
  ASSERT_TRUE(birth);
  EXPECT_EQ(birth->topic, "spBv1.0/hall/DBIRTH/dnc/mill");
  EXPECT_EQ(birth->payload, payload(2, {{"X", Metric::Type::Double, 1.0},
                                        {"old", Metric::Type::Text, std::nullopt},
                                        {"program", Metric::Type::Text, "O1"}}));
}

TEST_F(SparkplugSessionTest, IsBornAgainWithAValueOfAnotherType) {
  begin();
  (void)report({{"tool", Metric::Type::Double, 1.0}});
  const auto birth = report({{"tool", Metric::Type::Text, "MILL"}});
  ASSERT_TRUE(birth);
  EXPECT_EQ(birth->payload, payload(2, {{"tool", Metric::Type::Text, "MILL"}}));
}

TEST_F(SparkplugSessionTest, ReportsADeathOnceAndOnlyOfWhatWasBorn) {
  begin();
  EXPECT_FALSE(report(state(1, "O1"), false));
  (void)report(state(1, "O1"));
  const auto death = report(state(1, "O1"), false);
  ASSERT_TRUE(death);
  EXPECT_EQ(death->topic, "spBv1.0/hall/DDEATH/dnc/mill");
  EXPECT_EQ(death->payload, payload(2, {}));
  EXPECT_FALSE(report(state(2, "O1"), false));
  const auto birth = report(state(2, "O1"));
  ASSERT_TRUE(birth);
  EXPECT_EQ(birth->payload, payload(3, state(2, "O1")));
}

TEST_F(SparkplugSessionTest, ForgetsItsDevicesWithANewBirth) {
  begin();
  (void)report(state(1, "O1"));
  (void)session_.birth(kNow);
  const auto birth = report(state(1, "O1"));
  ASSERT_TRUE(birth);
  EXPECT_EQ(birth->topic, "spBv1.0/hall/DBIRTH/dnc/mill");
  EXPECT_EQ(birth->payload, payload(1, state(1, "O1")));
}

}  // namespace
}  // namespace dripline::mqtt
