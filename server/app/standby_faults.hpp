#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace dripline::app {

/// What keeps a server that waits from taking over, and what it would lack then. Each is a text for
/// the log, and empty while all is well.
struct StandbyFaults {
  std::string database = {};  ///< it cannot be looked at
  std::string place = {};     ///< its lease is over, and it could not be taken yet
  std::string ports = {};     ///< UDP ports for gateways are in use: it cannot take over
  std::string network =
      {};                  ///< the active server's gateways would not find it: it cannot take over
  std::string agent = {};  ///< without its MTConnect agent
  std::string settings = {};  ///< differ from the active server's
  std::string clock = {};     ///< differs from the database's
  std::string disk = {};      ///< full, or nearly
  bool is_disk_full = false;

  bool is_well() const;
  /// It never takes over so.
  bool is_blocked() const { return !ports.empty() || !network.empty(); }
  /// So is nothing handed over to it; the library of a dead server it takes all the same.
  bool is_unfit() const { return is_blocked() || is_disk_full; }
  /// For those who look at the active server: what this one would lack. Empty: nothing.
  std::string note() const;
  /// The end of the status line: ", its UDP ports are in use".
  std::string summary() const;
  /// The answer to /health: for any client, so no name, path or value.
  nlohmann::json health() const;
};

}  // namespace dripline::app
