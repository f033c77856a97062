#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <array>
#include <memory>
#include <thread>

#include "protocol/serial/channel.hpp"
#include "protocol/serial/impl/tcp_socket.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/silent_lookup.hpp"
#include "tests/unit/protocol/serial/tcp_peer.hpp"

namespace dripline::serial {

namespace {

TEST(ParseAddress, TakesADevice) {
  EXPECT_EQ(*parse_address("/dev/ttyUSB0"), Address(TtyAddress{"/dev/ttyUSB0"}));
}

TEST(ParseAddress, TakesADeviceServer) {
  EXPECT_EQ(*parse_address("tcp://moxa-3:4001"), Address(TcpAddress{"moxa-3", 4001, false}));
  EXPECT_EQ(*parse_address("rfc2217://10.0.0.7:2001"), Address(TcpAddress{"10.0.0.7", 2001, true}));
  EXPECT_EQ(*parse_address("tcp://[fd00::3]:4001"), Address(TcpAddress{"fd00::3", 4001, false}));
}

struct Refused {
  const char* name;
  const char* text;
  Errc code;
  const char* named;
};
class ParseAddressRefuses : public testing::TestWithParam<Refused> {};

TEST_P(ParseAddressRefuses, AndReportsTheError) {
  const auto parsed = parse_address(GetParam().text);
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.error().code, GetParam().code);
  EXPECT_NE(parsed.error().what.find(GetParam().named), std::string::npos) << parsed.error().what;
}

INSTANTIATE_TEST_SUITE_P(
    , ParseAddressRefuses,
    testing::Values(Refused{"relative", "ttyUSB0", Errc::Syntax, "ttyUSB0"},
                    Refused{"empty", "", Errc::Syntax, "neither"},
                    Refused{"slash", "/", Errc::Syntax, "neither"},
                    Refused{"other_scheme", "http://a:1", Errc::Syntax, "http"},
                    Refused{"no_port", "tcp://moxa", Errc::Syntax, "host:port"},
                    Refused{"no_host", "tcp://:4001", Errc::Syntax, "host:port"},
                    Refused{"empty_brackets", "tcp://[]:4001", Errc::Syntax, "host"},
                    Refused{"bare_ipv6", "tcp://fd00::3:4001", Errc::Syntax, "[address]:port"},
                    Refused{"word", "tcp://moxa:telnet", Errc::Syntax, "telnet"},
                    Refused{"port_0", "tcp://moxa:0", Errc::LimitExceeded, "0"},
                    Refused{"port_65536", "tcp://moxa:65536", Errc::LimitExceeded, "65536"},
                    Refused{"port_huge", "tcp://moxa:99999999999999999999999", Errc::LimitExceeded,
                            "65535"}),
    [](const auto& i) { return std::string(i.param.name); });

using namespace std::chrono_literals;
using test_support::eventually;

TEST(ConnectTcp, WaitsForNoNameServerBeyondItsLimit) {
  const test_support::SilentLookup silent;
  const auto opened = connect_tcp({"moxa-3.example", 4001, false}, 50ms, silent.lookup());
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::Timeout);
  EXPECT_NE(opened.error().what.find("host moxa-3.example: the name server"), std::string::npos)
      << opened.error().what;
}

TEST(TcpChannel, CarriesCharactersBothWays) {
  TcpPeer peer;
  auto channel = open_channel(peer.address(), {}, 1s);
  ASSERT_TRUE(channel) << channel.error().what;
  ASSERT_TRUE(peer.accept());
  const std::string_view text = "G1 X5\r\n\xFF";
  ASSERT_EQ(*(*channel)->write(std::as_bytes(std::span(text))), text.size());
  EXPECT_EQ(peer.read(text.size()), text);
  peer.write("OK");
  std::array<std::byte, 8> room;
  std::size_t got = 0;
  EXPECT_TRUE(eventually([&] { return (got = (*channel)->read(room)->bytes) > 0; }, 2s));
  EXPECT_EQ(got, 2U);
}

TEST(TcpChannel, ReportsThatTheServerClosed) {
  TcpPeer peer;
  auto channel = open_channel(peer.address(), {}, 1s);
  ASSERT_TRUE(peer.accept());
  peer.hang_up();
  std::array<std::byte, 8> room;
  std::string what;
  EXPECT_TRUE(eventually(
      [&] {
        const auto got = (*channel)->read(room);
        if (!got) what = got.error().what;
        return !got;
      },
      2s));
  EXPECT_NE(what.find(peer.address()), std::string::npos);
}

TEST(TcpChannel, IsRefusedWhereNoServerListens) {
  std::string address;
  {
    const TcpPeer gone;
    address = gone.address();
  }
  const auto channel = open_channel(address, {}, 1s);
  ASSERT_FALSE(channel);
  EXPECT_EQ(channel.error().code, Errc::Io);
}

TEST(TcpChannel, NoticesAPulledCable) {
  TcpPeer peer;
  auto channel = open_channel(peer.address(), {}, 1s);
  ASSERT_TRUE(channel);
  int keepalive = 0, timeout = 0;
  socklen_t size = sizeof keepalive;
  ASSERT_EQ(::getsockopt((*channel)->descriptor(), SOL_SOCKET, SO_KEEPALIVE, &keepalive, &size), 0);
  ASSERT_EQ(::getsockopt((*channel)->descriptor(), IPPROTO_TCP, TCP_USER_TIMEOUT, &timeout, &size),
            0);
  EXPECT_EQ(keepalive, 1);
  EXPECT_EQ(timeout, 10'000);
}

/// A device server (RFC 2217) that has agreed to rate and format, in the test's hands.
class DeviceServer : public testing::Test {
 protected:
  DeviceServer() {
    std::thread server([this] { agree(); });
    wire::LineSettings settings;
    settings.baud = 9600;
    auto opened =
        open_channel("rfc2217://127.0.0.1:" + std::to_string(peer_.port()), settings, 10s);
    server.join();
    EXPECT_TRUE(opened) << opened.error().what;
    if (opened) channel_ = *std::move(opened);
  }
  static std::string answer(char code, const std::string& value) {
    return "\xff\xfa\x2c" + std::string(1, static_cast<char>(code + 100)) + value + "\xff\xf0";
  }
  /// What the channel fails with; empty: it does not.
  std::string fault() {
    std::array<std::byte, 8> room;
    std::string what;
    EXPECT_TRUE(eventually([&] {
      const auto got = channel_->read(room);
      if (!got) what = got.error().what;
      return !got || got->bytes > 0;
    }));
    return what;
  }

  TcpPeer peer_;
  std::unique_ptr<Channel> channel_;

 private:
  void agree() {
    ASSERT_TRUE(peer_.accept());
    peer_.write("\xff\xfd\x2c");  // DO COM-PORT
    std::string asked;
    while (asked.find("\xff\xfa\x2c\x04") == std::string::npos) {
      const std::string more = peer_.read(1);
      ASSERT_FALSE(more.empty());
      asked += more;
    }
    asked += peer_.read(3);
    for (char code = 1; code <= 4; ++code) {
      const auto at = asked.find("\xff\xfa\x2c" + std::string(1, code)) + 4;
      peer_.write(answer(code, asked.substr(at, asked.find("\xff\xf0", at) - at)));
    }
  }
};

const std::string kBaud9600("\0\0\x25\x80", 4), kBaud1200("\0\0\x04\xb0", 4);

TEST_F(DeviceServer, EndsTheLineWhereItsRateHasChanged) {
  ASSERT_TRUE(channel_);
  peer_.write(answer(1, kBaud1200));
  const std::string what = fault();
  EXPECT_NE(what.find("baud 1200"), std::string::npos) << what;
  EXPECT_NE(what.find("baud 9600"), std::string::npos) << what;
  EXPECT_FALSE(channel_->write(std::as_bytes(std::span("G1 X5\n", 6))));
}

TEST_F(DeviceServer, MayReportTheRateThatItHas) {
  ASSERT_TRUE(channel_);
  peer_.write(answer(1, kBaud9600) + "A");
  EXPECT_EQ(fault(), "");
}

TEST_F(DeviceServer, EndsTheLineWhereItIsNoDeviceServerAnyMore) {
  ASSERT_TRUE(channel_);
  peer_.write("\xff\xfe\x2c");  // DONT COM-PORT
  EXPECT_NE(fault().find("RFC 2217"), std::string::npos);
}

TEST(TcpChannel, GivesUpWaitingForAServerThatIsNoDeviceServer) {
  TcpPeer peer;
  const auto channel =
      open_channel("rfc2217://127.0.0.1:" + std::to_string(peer.port()), {}, 100ms);
  ASSERT_FALSE(channel);
  EXPECT_EQ(channel.error().code, Errc::Timeout);
}

}  // namespace

}  // namespace dripline::serial
