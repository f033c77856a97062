#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "protocol/base/name_lookup.hpp"
#include "protocol/base/result.hpp"
#include "server/mqtt/mqtt_settings.hpp"

namespace dripline::mqtt {

struct Message {
  std::string topic;
  std::string payload;
  /// 0: acknowledged when it is written to the connection. 1 or 2: by the broker.
  int qos = 1;
  bool is_retained = false;
};

/// One connection to a broker after the other, each without anything of the one before: what was
/// not acknowledged is published again by the caller. Nothing that a broker sends reaches the
/// caller but acknowledgments, and messages of the one topic it asks for. One thread, but for
/// `wake`.
class BrokerLink {
 public:
  virtual ~BrokerLink() = default;

  struct Acknowledgment {
    std::uint64_t message = 0;  ///< what `publish` returned
    std::string refusal;        ///< empty: the broker has it
  };
  struct Progress {
    bool is_connected = false;  ///< the broker has accepted us, and publish may be called
    bool is_lost = false;       ///< open it again
    std::string fault = {};     ///< why it is lost
    std::vector<Acknowledgment> acknowledged = {};
    std::vector<std::string> received = {};  ///< payloads; what is long, or too many, is left out
  };

  /// Begins to connect, without waiting; `will` is what the broker publishes for us when the
  /// connection is lost. `subscribed`: a topic whose messages are wanted; empty: none. Errors: Io,
  /// Denied (TLS files, password).
  virtual Result<void> open(const Message& will, const std::string& subscribed) = 0;
  /// Hands a message to the connection, without waiting for the broker. The number grows from
  /// message to message of a connection. Errors: Io, LimitExceeded (the broker takes no message of
  /// this size), Unsupported (nor of this QoS).
  virtual Result<std::uint64_t> publish(const Message& message) = 0;
  /// Sends and receives, until something has happened or the time is over.
  virtual Progress wait(std::chrono::milliseconds limit) = 0;
  /// Ends a `wait`, also the next one. Any thread.
  virtual void wake() = 0;
  /// Takes leave of the broker, which then does not publish the will. Does not wait.
  virtual void close() = 0;
  /// Ends the connection without a word: the broker publishes the will.
  virtual void drop() = 0;
};

/// MQTT over TCP, with TLS or without. `client_id` must not be used by another client of the
/// broker.
std::unique_ptr<BrokerLink> make_mqtt_link(MqttSettings settings, std::string client_id,
                                           NameLookup lookup = look_up);

}  // namespace dripline::mqtt
