#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/mqtt/broker_link.hpp"
#include "server/mqtt/sparkplug_payload.hpp"

namespace dripline::mqtt {

/// What a node of Sparkplug B says on one connection after the other: births, changes and deaths of
/// its devices, numbered without a gap. Pure. (Eclipse Sparkplug 3.0, chapters 5 and 6)
class SparkplugSession {
 public:
  /// `first`: bdSeq of the first connection. Another one than of the last connection of the server
  /// before, so that its death is not taken for this one's.
  SparkplugSession(std::string group, std::string node, std::string version, std::uint8_t first)
      : group_(std::move(group)),
        node_(std::move(node)),
        version_(std::move(version)),
        connection_(static_cast<std::uint8_t>(first - 1)) {}

  /// A new connection. Returns its last will: the node's death.
  Message begin(UtcTime now);
  /// Of the node; after it no device is born. First of a connection, and whenever it is asked for.
  Message birth(UtcTime now);
  /// What a device has to say: its birth, what has changed, its death; nullopt: nothing.
  std::optional<Message> report(const std::string& device, bool is_connected,
                                std::vector<Metric> metrics, UtcTime now);
  /// Before the node leaves: as its will.
  Message death(UtcTime now) const;
  /// Where the node is asked for its births.
  std::string command_topic() const { return topic("NCMD"); }

 private:
  using Values = std::map<std::string, Metric>;

  std::string topic(const char* type) const;
  std::string topic(const char* type, const std::string& device) const;
  Message number(std::string topic, std::vector<Metric> metrics, UtcTime now);
  Metric birth_death_number() const;

  const std::string group_, node_, version_;
  std::uint8_t connection_;  ///< bdSeq
  std::uint8_t next_ = 0;    ///< seq
  std::map<std::string, Values> born_;
};

}  // namespace dripline::mqtt
