#include "protocol/serial/rfc2217.hpp"

#include <gtest/gtest.h>

namespace dripline::serial {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::uint8_t kIac = 255, kWill = 251, kWont = 252, kDo = 253, kDont = 254, kSb = 250,
                       kSe = 240, kBinary = 0, kEcho = 1, kComPort = 44;

struct Fed {
  std::string text;
  std::vector<TelnetEvent> events;  ///< without characters
};
Fed feed(Rfc2217Client& client, const Bytes& bytes) {
  Fed fed;
  for (const std::uint8_t byte : bytes) {
    const auto event = client.feed(std::byte{byte});
    if (!event) continue;
    if (const auto* character = std::get_if<std::byte>(&*event)) {
      fed.text += static_cast<char>(*character);
    } else {
      fed.events.push_back(*event);
    }
  }
  return fed;
}
Bytes replies(Rfc2217Client& client) {
  Bytes bytes;
  for (const std::byte byte : client.take_replies())
    bytes.push_back(std::to_integer<std::uint8_t>(byte));
  return bytes;
}
Bytes encoded(const ComPortCommand& command) {
  std::vector<std::byte> to;
  Rfc2217Client::encode(command, to);
  Bytes bytes;
  for (const std::byte byte : to) bytes.push_back(std::to_integer<std::uint8_t>(byte));
  return bytes;
}
Bytes sent(const Rfc2217Client& client, std::string_view text) {
  std::vector<std::byte> to;
  client.encode(std::as_bytes(std::span(text)), to);
  Bytes bytes;
  for (const std::byte byte : to) bytes.push_back(std::to_integer<std::uint8_t>(byte));
  return bytes;
}

TEST(Rfc2217Client, OffersTheComPortOptionFirst) {
  Rfc2217Client client;
  const Bytes opening = replies(client);
  const Bytes offer{kIac, kWill, kComPort};
  EXPECT_NE(std::search(opening.begin(), opening.end(), offer.begin(), offer.end()), opening.end());
}

TEST(Rfc2217Client, ReportsWhetherTheServerAgrees) {
  Rfc2217Client client;
  EXPECT_EQ(feed(client, {kIac, kDo, kComPort}).events,
            std::vector<TelnetEvent>{ComPortAgreed{true}});
  Rfc2217Client other;
  EXPECT_EQ(feed(other, {kIac, kDont, kComPort}).events,
            std::vector<TelnetEvent>{ComPortAgreed{false}});
}

TEST(Rfc2217Client, DoesNotAnswerAnAnswer) {
  Rfc2217Client client;
  replies(client);
  feed(client, {kIac, kDo, kComPort, kIac, kDo, kBinary, kIac, kWill, kBinary, kIac, kDo, kBinary});
  EXPECT_EQ(replies(client), Bytes());
}

TEST(Rfc2217Client, RefusesOptionsItDoesNotKnow) {
  Rfc2217Client client;
  replies(client);
  feed(client, {kIac, kWill, kEcho, kIac, kDo, kEcho});
  EXPECT_EQ(replies(client), (Bytes{kIac, kDont, kEcho, kIac, kWont, kEcho}));
}

TEST(Rfc2217Client, SendsAndTakesFfDoubled) {
  Rfc2217Client client;
  EXPECT_EQ(feed(client, {'A', kIac, kIac, 'B'}).text,
            "A\xFF"
            "B");
  feed(client, {kIac, kDo, kBinary});
  EXPECT_EQ(sent(client, "A\xFF\r"), (Bytes{'A', kIac, kIac, '\r'}));
}

TEST(Rfc2217Client, PadsReturnsUntilTheLineIsBinary) {
  Rfc2217Client client;
  EXPECT_EQ(sent(client, "\r\n"), (Bytes{'\r', 0, '\n'}));
  EXPECT_EQ(feed(client, {'\r', 0, '\r', '\n'}).text, "\r\r\n");
  feed(client, {kIac, kWill, kBinary, kIac, kDo, kBinary});
  EXPECT_EQ(sent(client, "\r\n"), (Bytes{'\r', '\n'}));
  EXPECT_EQ(feed(client, {'\r', 0, 'X'}).text, std::string("\r\0X", 3));
}

TEST(Rfc2217Client, EncodesCommandsWithDoubledFf) {
  EXPECT_EQ(encoded({ComPort::SetBaudRate, 9600}),
            (Bytes{kIac, kSb, 44, 1, 0, 0, 0x25, 0x80, kIac, kSe}));
  EXPECT_EQ(encoded({ComPort::SetModemStateMask, 255}),
            (Bytes{kIac, kSb, 44, 11, 255, 255, kIac, kSe}));
}

TEST(Rfc2217Client, UnderstandsAnswers) {
  Rfc2217Client client;
  EXPECT_EQ(feed(client, {kIac, kSb, 44, 101, 0, 0, 0x12, 0xC0, kIac, kSe}).events,
            std::vector<TelnetEvent>{(AnswerSeen{{ComPort::SetBaudRate, 4800}})});
  EXPECT_EQ(feed(client, {kIac, kSb, 44, 103, 3, kIac, kSe}).events,
            std::vector<TelnetEvent>{(AnswerSeen{{ComPort::SetParity, 3}})});
}

TEST(Rfc2217Client, UnderstandsNotices) {
  Rfc2217Client client;
  const Fed fed =
      feed(client, {'A', kIac, kSb,         44,   106, 4,    kIac, kSe, 'B', kIac, kSb,
                    44,  107,  0x10 | 0x80, kIac, kSe, kIac, kSb,  44,  108, kIac, kSe});
  EXPECT_EQ(fed.text, "AB");
  const std::vector<TelnetEvent> expected{LineStateSeen{wire::LineFault::Parity},
                                          wire::InputLines{.cts = true, .dsr = false, .dcd = true},
                                          FlowSeen{true}};
  EXPECT_EQ(fed.events, expected);
}

TEST(Rfc2217Client, DropsSubnegotiationsThatAreTooLongOrShort) {
  Rfc2217Client client;
  Bytes bytes{kIac, kSb, 44, 101};
  bytes.insert(bytes.end(), 1000, 7);
  bytes.insert(bytes.end(),
               {kIac, kSe, 'A', kIac, kSb, 44, 101, 1, kIac, kSe, 'B', kIac, kSb, kIac, kSe});
  const Fed fed = feed(client, bytes);
  EXPECT_EQ(fed.text, "AB");
  EXPECT_TRUE(fed.events.empty());
}

TEST(SetupCommands, LeaveXonXoffToTheDiscipline) {
  wire::LineSettings settings;
  ASSERT_TRUE(wire::apply_short_form("4800e72", settings));
  const auto commands = setup_commands(settings);
  EXPECT_EQ(commands[0], (ComPortCommand{ComPort::SetBaudRate, 4800}));
  EXPECT_EQ(commands[1], (ComPortCommand{ComPort::SetDataSize, 7}));
  EXPECT_EQ(commands[2], (ComPortCommand{ComPort::SetParity, 3}));
  EXPECT_EQ(commands[3], (ComPortCommand{ComPort::SetStopSize, 2}));
  EXPECT_EQ(commands[4], (ComPortCommand{ComPort::SetControl, 1}));
  settings.flow = wire::Flow::RtsCts;
  EXPECT_EQ(setup_commands(settings)[4], (ComPortCommand{ComPort::SetControl, 3}));
}

}  // namespace
}  // namespace dripline::serial
