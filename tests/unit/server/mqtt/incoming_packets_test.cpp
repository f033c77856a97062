#include "server/mqtt/incoming_packets.hpp"

#include <gtest/gtest.h>

namespace dripline::mqtt {
namespace {

using namespace std::string_literals;

std::string fault_of_connack(const std::string& body, bool is_version_5 = true) {
  const auto read =
      read_connack({.type = PacketType::Connack, .flags = 0, .body = body}, is_version_5);
  return read ? "" : read.error().what;
}

TEST(PacketReader, CutsPacketsOutOfPiecesOfAnySize) {
  const std::string bytes =
      "\x30\x03"s + "abc" + "\xd0\x00"s + "\x32\xc8\x01"s + std::string(200, 'x');
  for (std::size_t size = 1; size <= bytes.size(); ++size) {
    PacketReader reader;
    std::vector<std::string> bodies;
    for (std::size_t at = 0; at < bytes.size(); at += size) {
      reader.add(std::string_view(bytes).substr(at, size));
      while (true) {
        const auto packet = reader.next();
        ASSERT_TRUE(packet);
        if (!*packet) break;
        bodies.emplace_back((*packet)->body);
      }
    }
    EXPECT_EQ(bodies, (std::vector<std::string>{"abc", "", std::string(200, 'x')})) << size;
  }
}

TEST(PacketReader, RefusesALongPacketByItsHeader) {
  PacketReader reader;
  reader.add("\x30\xff\xff\xff\x7f");
  const auto packet = reader.next();
  ASSERT_FALSE(packet);
  EXPECT_EQ(packet.error().code, Errc::LimitExceeded);
  EXPECT_EQ(packet.error().what, "a packet of 268435455 bytes: at most 262144");
}

TEST(PacketReader, TakesAPacketOfTheGreatestSize) {
  PacketReader reader;
  reader.add("\x30\x80\x80\x10"s + std::string(PacketReader::kMaxPacket, 'x'));
  const auto packet = reader.next();
  ASSERT_TRUE(packet && *packet);
  EXPECT_EQ((*packet)->body.size(), PacketReader::kMaxPacket);
  PacketReader other;
  other.add("\x30\x81\x80\x10");
  EXPECT_FALSE(other.next());
}

TEST(PacketReader, RefusesALengthOfFiveBytes) {
  PacketReader reader;
  reader.add("\x30\xff\xff\xff\xff");
  const auto packet = reader.next();
  ASSERT_FALSE(packet);
  EXPECT_EQ(packet.error().code, Errc::Syntax);
}

TEST(ReadConnack, TakesTheLimitsOfABroker) {
  const std::string body =
      "\x00\x00\x10\x21\x00\x05\x13\x00\x09\x24\x01\x25\x00\x27\x00\x00\x01\x00"s;
  const auto read = read_connack({.type = PacketType::Connack, .flags = 0, .body = body}, true);
  ASSERT_FALSE(read) << "the length of the properties is one too many";
  std::string fit = body;
  fit[2] = 15;
  const auto connack = read_connack({.type = PacketType::Connack, .flags = 0, .body = fit}, true);
  ASSERT_TRUE(connack) << connack.error().what;
  EXPECT_EQ(connack->reason, 0);
  EXPECT_EQ(connack->receive_maximum, 5);
  EXPECT_EQ(connack->keep_alive, 9);
  EXPECT_EQ(connack->max_qos, 1);
  EXPECT_FALSE(connack->has_retain);
  EXPECT_EQ(connack->max_packet, 256u);
}

TEST(ReadConnack, PassesOverPropertiesThatSayNothingToUs) {
  EXPECT_EQ(
      fault_of_connack("\x00\x00\x11\x1f\x00\x02hi\x26\x00\x01k\x00\x01v\x28\x01\x12\x00\x00"s),
      "");
  EXPECT_EQ(fault_of_connack("\x00\x87"s), "") << "a broker without MQTT 5 refuses";
  EXPECT_EQ(fault_of_connack("\x00\x05"s, false), "");
}

TEST(ReadConnack, RefusesWhatTheProtocolDoesNotHave) {
  EXPECT_EQ(fault_of_connack("\x00\x00\x02\x7f\x01"s),
            "CONNACK with property 127, which MQTT 5 does not define");
  for (const auto& body :
       {""s, "\x00"s, "\x00\x00"s, "\x00\x00\x05"s, "\x00\x00\x00\x00"s, "\x00\x00\x01\x13"s,
        "\x00\x00\x03\x21\x00\x00"s, "\x00\x00\x05\x27\x00\x00\x00\x00"s,
        "\x00\x00\x03\x1f\x00\x02"s, "\x00\x00\x02\x24\x03"s, "\x00\x00\xff\xff\xff\xff\x01"s})
    EXPECT_EQ(fault_of_connack(body), "malformed CONNACK") << testing::PrintToString(body);
  EXPECT_EQ(fault_of_connack("\x00\x00\x00"s, false), "malformed CONNACK");
}

TEST(ReadConnack, RefusesEachPropertyThatIsNotDefined) {
  int defined = 0;
  for (int id = 0; id < 128; ++id) {
    const auto fault = fault_of_connack("\x00\x00\x01"s + static_cast<char>(id));
    const bool is_unknown = fault.find("does not define") != std::string::npos;
    defined += is_unknown ? 0 : 1;
    EXPECT_NE(fault, "") << id << ": a property has a value";
  }
  EXPECT_EQ(defined, 27);
}

TEST(ReadPublication, IsTopicAndPayload) {
  const std::string body = "\x00\x01t\x00\x07\x00pay"s;
  const auto read = read_publication({.type = PacketType::Publish, .flags = 3, .body = body}, true);
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->topic, "t");
  EXPECT_EQ(read->payload, "pay");
  EXPECT_EQ(read->packet, 7);
  EXPECT_EQ(read->qos, 1);
  EXPECT_TRUE(read->is_retained);
}

TEST(ReadPublication, RefusesWhatWasNotOffered) {
  const auto fault = [](std::uint8_t flags, const std::string& body) {
    const auto read =
        read_publication({.type = PacketType::Publish, .flags = flags, .body = body}, true);
    return read ? "" : read.error().what;
  };
  EXPECT_EQ(fault(0, "\x00\x01t\x03\x23\x00\x01x"s),
            "PUBLISH with a topic alias, which is not offered");
  EXPECT_EQ(fault(4, "\x00\x01t\x00\x07\x00x"s), "PUBLISH with QoS 2: at most 1 is asked for");
  EXPECT_EQ(fault(0, "\x00\x00\x00x"s), "malformed PUBLISH") << "no topic";
  EXPECT_EQ(fault(2, "\x00\x01t\x00\x00\x00x"s), "malformed PUBLISH") << "no number";
  EXPECT_EQ(fault(0, "\x00\x05t\x00"s), "malformed PUBLISH");
  EXPECT_EQ(fault(0, "\x00\x01t"s), "malformed PUBLISH") << "no properties";
}

TEST(ReadAnswer, HasAReasonWithMqtt5Alone) {
  const auto read = [](const std::string& body, bool is_version_5) {
    return read_answer({.type = PacketType::Puback, .flags = 0, .body = body}, is_version_5);
  };
  EXPECT_EQ(read("\x01\x02"s, true)->packet, 0x102);
  EXPECT_EQ(read("\x01\x02\x87"s, true)->reason, 0x87);
  EXPECT_EQ(read("\x01\x02\x87\x00"s, true)->reason, 0x87);
  EXPECT_FALSE(read("\x01\x02\x87"s, false));
  EXPECT_FALSE(read("\x01"s, true));
  EXPECT_FALSE(read("\x01\x02\x00\x02\x7f\x01"s, true));
}

TEST(ReadDisconnect, HasAReason) {
  const auto read = [](const std::string& body) {
    return read_disconnect({.type = PacketType::Disconnect, .flags = 0, .body = body});
  };
  EXPECT_EQ(read("").value(), 0);
  EXPECT_EQ(reason_text(read("\x8e\x00"s).value()), "Session taken over");
  EXPECT_EQ(reason_text(0xfe), "reason 254");
  EXPECT_FALSE(read("\x8e\x02\x7f\x01"s));
}

}  // namespace
}  // namespace dripline::mqtt
