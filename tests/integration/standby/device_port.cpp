#include "tests/integration/standby/device_port.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <array>

namespace dripline::integration {
namespace {

constexpr char kIac = '\xff', kDont = '\xfe', kDo = '\xfd', kWont = '\xfc', kWill = '\xfb',
               kSub = '\xfa', kSubEnd = '\xf0';
constexpr char kBinary = 0, kGoAhead = 3, kComPort = 44;
constexpr int kAnswer = 100;

void say(const Descriptor& socket, std::string_view bytes) {
  EXPECT_EQ(::send(socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL),
            static_cast<ssize_t>(bytes.size()));
}

std::string doubled(std::string_view bytes) {
  std::string escaped;
  for (const char byte : bytes)
    escaped += byte == kIac ? std::string(2, kIac) : std::string(1, byte);
  return escaped;
}

}  // namespace

DevicePort::DevicePort(Kind kind)
    : kind_(kind), listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  auto* address = reinterpret_cast<sockaddr*>(&place);
  EXPECT_EQ(::bind(listener_.get(), address, size), 0);
  EXPECT_EQ(::listen(listener_.get(), 4), 0);
  ::getsockname(listener_.get(), address, &size);
  address_ = (kind == Kind::Raw ? "tcp" : "rfc2217") + std::string("://127.0.0.1:") +
             std::to_string(ntohs(place.sin_port));
  thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

DevicePort::~DevicePort() = default;

void DevicePort::serve(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<pollfd> ends{{listener_.get(), POLLIN, 0}};
    for (const auto& client : clients_) ends.push_back({client.socket.get(), POLLIN, 0});
    if (::poll(ends.data(), ends.size(), 20) <= 0) continue;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = clients_.size(); i > 0; --i) {
      if (ends[i].revents == 0 || receive(clients_[i - 1])) continue;
      clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i - 1));
    }
    if (ends[0].revents == 0) continue;
    clients_.push_back(
        {Descriptor(::accept(listener_.get(), nullptr, nullptr)), settings_.size(), {}});
    settings_.emplace_back();
  }
}

/// False: the connection is over.
bool DevicePort::receive(Client& client) {
  std::array<char, 512> piece;
  const auto got = ::recv(client.socket.get(), piece.data(), piece.size(), 0);
  if (got <= 0) return false;
  const std::string_view bytes(piece.data(), static_cast<std::size_t>(got));
  text_ += kind_ == Kind::Raw ? std::string(bytes) : take_telnet(client, bytes);
  return true;
}

/// The characters among them.
std::string DevicePort::take_telnet(Client& client, std::string_view bytes) {
  client.telnet += bytes;
  std::string characters;
  while (!client.telnet.empty()) {
    if (client.telnet.front() != kIac) {
      characters += client.telnet.front();
      client.telnet.erase(0, 1);
      continue;
    }
    const std::size_t size = take_command(client, client.telnet);
    if (size == 0) break;
    if (size == 2 && client.telnet[1] == kIac) characters += kIac;
    client.telnet.erase(0, size);
  }
  return characters;
}

/// Its size; 0: it is not complete.
std::size_t DevicePort::take_command(const Client& client, std::string_view command) {
  if (command.size() < 3) return command.size() == 2 && command[1] == kIac ? 2 : 0;
  const char verb = command[1], option = command[2];
  if (verb == kIac) return 2;
  const bool is_line = option == kBinary || option == kGoAhead;
  if (verb == kWill) {
    const bool is_taken = is_line || option == kComPort;
    say(client.socket, std::string{kIac, is_taken ? kDo : kDont, option});
  } else if (verb == kDo) {
    say(client.socket, std::string{kIac, is_line ? kWill : kWont, option});
  }
  if (verb != kSub) return 3;
  std::string sub;
  for (std::size_t at = 2; at + 1 < command.size(); ++at) {
    if (command[at] == kIac && command[at + 1] == kSubEnd) {
      std::uint32_t value = 0;
      for (const char byte : sub.substr(2)) value = value << 8 | static_cast<std::uint8_t>(byte);
      settings_[client.number][sub[1]] = value;
      sub[1] = static_cast<char>(sub[1] + kAnswer);
      say(client.socket, std::string{kIac, kSub} + doubled(sub) + kIac + kSubEnd);
      return at + 2;
    }
    sub += command[at];
    if (command[at] == kIac) ++at;
  }
  return 0;
}

std::string DevicePort::text() const {
  const std::lock_guard lock(mutex_);
  return text_;
}

bool DevicePort::stays_silent(std::chrono::milliseconds time) const {
  const std::size_t before = received();
  std::this_thread::sleep_for(time);
  return received() == before;
}

void DevicePort::write(std::string_view text) const {
  const std::lock_guard lock(mutex_);
  for (const auto& client : clients_)
    say(client.socket, kind_ == Kind::Raw ? std::string(text) : doubled(text));
}

std::size_t DevicePort::connections() const {
  const std::lock_guard lock(mutex_);
  return settings_.size();
}

std::map<int, std::uint32_t> DevicePort::settings(std::size_t connection) const {
  const std::lock_guard lock(mutex_);
  return settings_.at(connection);
}

}  // namespace dripline::integration
