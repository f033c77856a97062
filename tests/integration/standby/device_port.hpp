#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "protocol/base/descriptor.hpp"

namespace dripline::integration {

/// A port of a device server that lets several computers use it at once, as many do, with the test
/// as the control at its end: raw TCP, or RFC 2217. Any thread.
class DevicePort {
 public:
  enum class Kind : std::uint8_t { Raw, Rfc2217 };
  explicit DevicePort(Kind kind = Kind::Raw);
  ~DevicePort();
  DevicePort(const DevicePort&) = delete;
  DevicePort& operator=(const DevicePort&) = delete;

  const std::string& address() const { return address_; }
  /// What the control got, from whomever.
  std::string text() const;
  /// Of it, what came from byte `from` on.
  std::string text(std::size_t from) const { return text().substr(from); }
  std::size_t received() const { return text().size(); }
  /// Whether nothing comes for so long.
  bool stays_silent(std::chrono::milliseconds time) const;
  /// The control sends it, to every computer that is connected.
  void write(std::string_view text) const;
  /// That were made until now.
  std::size_t connections() const;
  /// What the computer of the connection asked for: the last value of each command of RFC 2217.
  std::map<int, std::uint32_t> settings(std::size_t connection) const;

 private:
  struct Client {
    Descriptor socket;
    std::size_t number = 0;
    std::string telnet;  ///< not complete
  };
  void serve(const std::stop_token& stop);
  bool receive(Client& client);
  std::string take_telnet(Client& client, std::string_view bytes);
  std::size_t take_command(const Client& client, std::string_view command);

  const Kind kind_;
  Descriptor listener_;
  std::string address_;
  mutable std::mutex mutex_;
  std::vector<Client> clients_;
  std::vector<std::map<int, std::uint32_t>> settings_;  ///< of each connection
  std::string text_;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace dripline::integration
