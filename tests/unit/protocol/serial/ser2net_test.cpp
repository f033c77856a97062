#include <gtest/gtest.h>
#include <termios.h>
#include <filesystem>
#include <fstream>

#include "protocol/serial/channel.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/line/pty.hpp"
#include "tests/unit/protocol/serial/tcp_peer.hpp"

/// RFC 2217 against Debian's ser2net as a real peer, with a pty as its port.
namespace dripline::serial {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;

class Ser2net : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists("/usr/sbin/ser2net"))
      GTEST_SKIP() << "ser2net is not installed: RFC 2217 is not tried against a real server";
    start();
  }
  void start() {
    if (port_ == 0) port_ = TcpPeer().port();
    const auto config = folder_.path() / "ser2net.yaml";
    std::ofstream(config)
        << "%YAML 1.1\n---\nconnection: &port\n  accepter: telnet(rfc2217=true),tcp,127.0.0.1,"
        << port_ << "\n  connector: serialdev(nouucplock=true)," << pty_.device()
        << ",9600n81,local\n  options:\n    kickolduser: true\n";
    server_.emplace(std::vector<std::string>{"/usr/sbin/ser2net", "-n", "-u", "-c", config.string(),
                                             "-P", (folder_.path() / "pid").string()},
                    folder_.path() / "output");
  }
  Result<std::unique_ptr<Channel>> open(std::string_view format) {
    wire::LineSettings settings;
    EXPECT_TRUE(wire::apply_short_form(format, settings));
    Result<std::unique_ptr<Channel>> channel;
    eventually(
        [&] {
          channel = open_channel("rfc2217://127.0.0.1:" + std::to_string(port_), settings, 2s);
          return channel || channel.error().code == Errc::Unsupported;
        },
        10s);
    return channel;
  }

  test_support::TemporaryFolder folder_;
  test_support::Pty pty_;
  std::uint16_t port_ = 0;
  std::optional<test_support::ChildProcess> server_;
};

TEST_F(Ser2net, SetsTheLineOnTheFarSide) {
  const auto channel = open("4800n82");
  ASSERT_TRUE(channel) << channel.error().what << server_->output();
  termios modes{};
  ASSERT_EQ(::tcgetattr(pty_.slave(), &modes), 0);
  EXPECT_EQ(::cfgetospeed(&modes), static_cast<speed_t>(B4800));
  EXPECT_NE(modes.c_cflag & CSTOPB, 0U);
  EXPECT_EQ(modes.c_iflag & (IXON | IXOFF), 0U);
}

TEST_F(Ser2net, CarriesEveryCharacterBothWays) {
  const auto channel = open("9600n81");
  ASSERT_TRUE(channel) << channel.error().what << server_->output();
  std::string text;
  for (int i = 0; i < 256; ++i) text += static_cast<char>(i);
  std::size_t sent = 0;
  EXPECT_TRUE(eventually(
      [&] {
        const auto taken = (*channel)->write(std::as_bytes(std::span(text)).subspan(sent));
        return taken && (sent += *taken) == text.size();
      },
      5s));
  EXPECT_EQ(pty_.read(256), text);
  pty_.write(text);
  std::string got;
  std::array<std::byte, 100> room;
  EXPECT_TRUE(eventually(
      [&] {
        for (;;) {
          const auto piece = (*channel)->read(room);
          if (!piece || piece->bytes == 0) return got.size() >= 256;
          got.append(reinterpret_cast<const char*>(room.data()), piece->bytes);
        }
      },
      5s));
  EXPECT_EQ(got, text);
}

TEST_F(Ser2net, DetectsARestartedServer) {
  const auto channel = open("9600n81");
  ASSERT_TRUE(channel) << channel.error().what << server_->output();
  server_->kill();
  std::array<std::byte, 100> room;
  EXPECT_TRUE(eventually([&] { return !(*channel)->read(room); }, 5s));
  start();
  EXPECT_TRUE(open("9600n81"));
}

}  // namespace
}  // namespace dripline::serial
