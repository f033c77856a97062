#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "clients/lib/api_types.hpp"
#include "clients/lib/reply.hpp"
#include "clients/lib/server_address.hpp"

namespace dripline::client {

/// The stream is open. It does not hold earlier events: ask for the present state now.
struct StreamOpened {};
/// The connection is lost; the stream reconnects by itself unless the server denied it.
struct StreamLost {
  Failure failure;
};
/// The number of line events that the server dropped because this client was too slow.
struct TrafficLost {
  std::uint64_t count = 0;
};
using StreamItem =
    std::variant<StreamOpened, StreamLost, Machine, Run, Record, Port, Traffic, TrafficLost>;

/// The server's events (GET /api/v1/events, or a port's traffic), read by a thread of its own that
/// reconnects with back-off. `next` is for one thread. At most 1024 items wait; while the queue is
/// full, the connection is not read, and the state that follows the next StreamOpened makes up for
/// what the server then drops.
class EventStream {
 public:
  /// `machine` empty: of all machines.
  EventStream(const ServerAddress& address, const std::string& machine);
  /// The events of a port's line: Port once, then Traffic and TrafficLost.
  static EventStream of_port(const ServerAddress& address, const std::string& port);
  ~EventStream();
  EventStream(const EventStream&) = delete;
  EventStream& operator=(const EventStream&) = delete;

  /// The next item, or nullopt when none came in time.
  std::optional<StreamItem> next(std::chrono::milliseconds timeout);

 private:
  class Impl;
  explicit EventStream(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace dripline::client
