#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::mqtt {

/// The broker that records and states are published to, and what of them.
struct MqttSettings {
  std::string broker;  ///< as it is written: mqtt://HOST[:PORT], mqtts://...; empty: none
  std::string host;
  std::uint16_t port = 0;
  bool has_tls = false;
  bool is_loopback = false;
  std::string ca;                ///< file of the broker's authorities; empty: the system's
  std::string certificate, key;  ///< files; empty: none is shown to the broker
  std::string user;              ///< empty: none
  std::string password_file;     ///< its first line
  std::string client_id;         ///< empty: made of the database's identity
  std::string prefix = "dripline";
  int qos = 2;                     ///< of records: 1 or 2
  std::vector<std::string> kinds;  ///< of records; empty: all
  bool has_records = true;
  bool has_status = true;
  bool is_status_retained = true;
  std::chrono::milliseconds status_interval{500};  ///< between two states of a machine
  bool is_version_5 = true;                        ///< of MQTT; else 3.1.1
  bool is_open_network_allowed = false;            ///< beyond this computer without TLS
  /// Of Sparkplug B: the machines are devices of this node; empty: it is not spoken.
  std::string sparkplug_group;
  std::string sparkplug_node = "dripline";

  bool is_on() const { return !broker.empty(); }
  bool has_sparkplug() const { return !sparkplug_group.empty(); }
};

/// Reads the table `[mqtt]` of a configuration; everything else in it is left out. The format:
/// deploy/examples/mqtt.toml. Errors: Syntax (also an unknown key), LimitExceeded, Conflict; they
/// name line and key.
Result<MqttSettings> read_mqtt(std::string_view toml);

/// Whether it may be used: files that are there, secrets that only their owner reads, and TLS
/// beyond this computer. Errors: Denied.
Result<void> check_exposure(const MqttSettings& settings);

/// The first line of the password file; empty without one. Errors: Denied (others can read it),
/// NotFound.
Result<std::string> read_password(const MqttSettings& settings);

}  // namespace dripline::mqtt
