// Datagrams in the name of a gateway, which anybody can send where there is no DDS Security: one
// with a high number makes all that the gateway itself sends later old.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "network.hpp"
#include "protocol/base/descriptor.hpp"
#include "protocol/dds/configuration.hpp"

namespace dripline::dds::test {
namespace {

constexpr const char* kMachine = "lathe-1";

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// Hears how a gateway announces itself, and speaks in its name.
class Forger {
 public:
  Forger() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    auto address = loopback(0);
    ::bind(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    const timeval limit{.tv_sec = 20, .tv_usec = 0};
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  }
  std::uint16_t port() const {
    sockaddr_in address{};
    socklen_t size = sizeof address;
    ::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }
  void hear_gateway() {
    char datagram[2048];
    const auto size = ::recv(socket_.get(), datagram, sizeof datagram, 0);
    ASSERT_GE(size, 20) << "no announcement came";
    prefix_.assign(datagram + 8, 12);
  }
  /// A sample of each writer that the gateway can have.
  void send_data(std::uint16_t server, std::int32_t high) {
    const std::string content("\x00\x01\x00\x00\x00\x00\x00\x00", 8);
    each_writer(server, [&](const std::string& writer) {
      return submessage(
          0x15, 0x05,
          std::string("\x00\x00\x10\x00\x00\x00\x00\x00", 8) + writer + number(high, 1) + content);
    });
  }
  /// "What is before this number cannot be had any more."
  void send_heartbeat(std::uint16_t server, std::int32_t high) {
    each_writer(server, [&](const std::string& writer) {
      return submessage(
          0x07, 0x03,
          std::string(4, '\0') + writer + number(high, 1) + number(high, 1) + word(++count_));
    });
  }

 private:
  static std::string word(std::uint32_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
    return bytes;
  }
  static std::string number(std::int32_t high, std::uint32_t low) {
    return word(static_cast<std::uint32_t>(high)) + word(low);
  }
  static std::string submessage(int id, int flags, const std::string& body) {
    const auto size = static_cast<std::uint32_t>(body.size());
    return std::string{static_cast<char>(id), static_cast<char>(flags)} + word(size).substr(0, 2) +
           body;
  }
  template <class Make>
  void each_writer(std::uint16_t server, Make make) {
    constexpr int kEntities = 64;
    for (int entity = 1; entity <= kEntities; ++entity) {
      for (const char kind : {'\x02', '\x03'}) {
        const std::string writer{'\0', '\0', static_cast<char>(entity), kind};
        const std::string datagram =
            std::string("RTPS\x02\x01\x01\x10", 8) + prefix_ + make(writer);
        for (const int port : {server + 0, server + 1}) {
          const auto to = loopback(static_cast<std::uint16_t>(port));
          ::sendto(socket_.get(), datagram.data(), datagram.size(), 0,
                   reinterpret_cast<const sockaddr*>(&to), sizeof to);
        }
      }
    }
  }

  Descriptor socket_;
  std::string prefix_;  ///< of the gateway's GUIDs
  std::uint32_t count_ = 1'000'000;
};

class ForgedNumber : public Network {
 protected:
  void connect() {
    server_ = open_server();
    const auto cell = cell_of(kMachine);
    server_port_ = static_cast<std::uint16_t>(server_port(options_.domain, cell));
    options_.server = fmt::format("127.0.0.1,127.0.0.1:{}", forger_.port() - 2 * cell);
    gateway_ = open_gateway(kMachine);
    ASSERT_TRUE(server_->announces.take());
    forger_.hear_gateway();
    ASSERT_TRUE(is_heard());
  }
  /// Whether what the gateway writes from now on arrives, in time.
  bool is_heard(std::chrono::milliseconds limit = kDeadline) {
    Status status;
    status.machine = kMachine;
    const auto first = ++time_;
    const auto end = std::chrono::steady_clock::now() + limit;
    while (std::chrono::steady_clock::now() < end) {
      status.steady = std::chrono::microseconds(++time_);
      EXPECT_TRUE(gateway_->endpoint->write(status));
      const auto taken = server_->statuses.take(50ms);
      if (taken && taken->steady.count() > first) return true;
    }
    return false;
  }
  bool falls_silent() {
    for (int tries = 0; tries < 20; ++tries) {
      if (!is_heard(1s)) return true;
    }
    return false;
  }

  Forger forger_;
  std::unique_ptr<TestServer> server_;
  std::unique_ptr<TestGateway> gateway_;
  std::uint16_t server_port_ = 0;
  std::int64_t time_ = 0;
};

TEST_F(ForgedNumber, OfAStatusIsGotAround) {
  ASSERT_NO_FATAL_FAILURE(connect());
  for (const std::int32_t high : {1, 2}) {
    forger_.send_data(server_port_, high);
    server_->endpoint->renew_status(kMachine);
    EXPECT_TRUE(is_heard()) << high;
    EXPECT_TRUE(is_heard()) << "and the next one";
  }
}

TEST_F(ForgedNumber, SilencesAMachineUntilItsReaderIsRenewed) {
  ASSERT_NO_FATAL_FAILURE(connect());
  forger_.send_data(server_port_, 1);
  EXPECT_TRUE(falls_silent());
  server_->endpoint->renew_status(kMachine);
  EXPECT_TRUE(is_heard());
  forger_.send_heartbeat(server_port_, 3);
  EXPECT_TRUE(falls_silent());
  server_->endpoint->renew_status(kMachine);
  EXPECT_TRUE(is_heard());
}

TEST_F(ForgedNumber, KeepsNoStopFromTheGateway) {
  ASSERT_NO_FATAL_FAILURE(connect());
  forger_.send_data(server_port_, 1);
  forger_.send_heartbeat(server_port_, 1);
  Command hold;
  hold.machine = kMachine;
  hold.id = "hold";
  hold.action = CommandAction::Hold;
  ASSERT_TRUE(server_->endpoint->write(hold));
  EXPECT_EQ(gateway_->commands.take(), hold);
}

}  // namespace
}  // namespace dripline::dds::test
