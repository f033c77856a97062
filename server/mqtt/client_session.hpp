#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/mqtt/broker_link.hpp"
#include "server/mqtt/incoming_packets.hpp"
#include "server/mqtt/outgoing_packets.hpp"

namespace dripline::mqtt {

/// One connection to a broker as a state machine without a socket: bytes in, bytes out, time given.
/// What does not follow the protocol, or answers what was not sent, ends it. After an error it is
/// of no use any more.
class ClientSession {
 public:
  static constexpr std::size_t kMaxPayload = 1024 * 1024;  ///< of a message that is published
  static constexpr std::size_t kMaxInFlight = 20;          ///< without an answer, of QoS 1 and 2
  /// Bytes that the broker does not take: a broker that sends and reads nothing costs no more.
  static constexpr std::size_t kMaxOutput = 32 * 1024 * 1024;
  static constexpr std::size_t kMaxReceived = 16;  ///< payloads that are not taken yet
  static constexpr std::size_t kMaxReceivedSize = 64 * 1024;

  explicit ClientSession(Introduction introduction) : introduction_(std::move(introduction)) {}

  /// Errors: LimitExceeded (a text that the protocol has no room for).
  Result<void> begin(const Message& will, const std::string& subscribed, SteadyTime now);
  /// Numbers are never used again. Errors: Io (not connected), LimitExceeded, Unsupported (the
  /// broker takes no such QoS).
  Result<std::uint64_t> publish(const Message& message);
  /// Errors: Io (refused, or ended by the broker), Syntax, LimitExceeded.
  Result<void> receive(std::string_view bytes, SteadyTime now);
  /// Keeps the connection alive. Errors: Timeout.
  Result<void> look(SteadyTime now);
  /// Takes leave.
  void leave() { output_ += empty_packet(PacketType::Disconnect); }

  std::string_view output() const { return std::string_view(output_).substr(sent_bytes_); }
  /// The network has taken the first bytes of the output.
  void written(std::size_t size, SteadyTime now);

  bool is_connected() const { return is_connected_; }
  std::vector<BrokerLink::Acknowledgment> take_acknowledged() {
    return std::exchange(acknowledged_, {});
  }
  std::vector<std::string> take_received() { return std::exchange(received_, {}); }

 private:
  struct Flight {
    std::uint64_t message = 0;
    int qos = 1;
    bool is_released = false;  ///< PUBREC has come, PUBREL is sent
  };
  using Flights = std::map<std::uint16_t, Flight>;

  Result<void> take(const Packet& packet);
  Result<void> take_connack(const Packet& packet);
  Result<void> take_answer(const Packet& packet);
  Result<void> take_suback(const Packet& packet);
  Result<void> take_publication(const Packet& packet);
  Result<void> take_disconnect(const Packet& packet);
  void end_flight(Flights::iterator flight, std::uint8_t reason);
  void send_waiting();
  std::uint16_t free_number();

  const Introduction introduction_;
  std::string subscribed_;
  bool is_connected_ = false;
  Connack connack_;

  PacketReader reader_;
  std::string output_;
  std::size_t sent_bytes_ = 0;  ///< of the output
  std::uint64_t written_ = 0;   ///< bytes since the beginning
  std::uint64_t ping_end_ = 0;  ///< likewise: where the last PINGREQ ends
  /// QoS 0: where its end is, its number.
  std::deque<std::pair<std::uint64_t, std::uint64_t>> unwritten_;
  std::deque<std::pair<std::uint64_t, Message>> waiting_;  ///< for a place in flight
  Flights flights_;
  std::uint64_t last_message_ = 0;
  std::uint16_t last_number_ = kSubscribe;

  std::vector<BrokerLink::Acknowledgment> acknowledged_;
  std::vector<std::string> received_;

  SteadyTime sent_{}, heard_{};
  bool is_ping_open_ = false;
  SteadyTime pinged_{};

  static constexpr std::uint16_t kSubscribe = 1;  ///< the packet's number
};

}  // namespace dripline::mqtt
