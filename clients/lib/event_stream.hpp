#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "clients/lib/api_types.hpp"
#include "clients/lib/reply.hpp"
#include "clients/lib/server_location.hpp"
#include "protocol/base/result.hpp"

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
/// what the server then drops. Of several servers that share a library, the one that has it.
class EventStream {
 public:
  /// `machine` empty: of all machines.
  EventStream(const ServerAddress& address, const std::string& machine);
  EventStream(const std::vector<ServerAddress>& servers, const std::string& machine);
  /// The events of a port's line: Port once, then Traffic and TrafficLost.
  static EventStream of_port(const std::vector<ServerAddress>& servers, const std::string& port);
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

struct ServerEvent {
  std::string name;  ///< `event:`; "message" when the server named none
  std::string data;  ///< `data:` lines joined by line ends
};

/// Reads a text/event-stream (WHATWG HTML, section 9.2) in pieces of any size. Comments,
/// ids and retry times are skipped. Pure; bounded: an event of more than 1 MiB is an error.
class EventParser {
 public:
  static constexpr std::size_t kMaxEvent = 1024 * 1024;

  /// The events that `bytes` completes. Errors: LimitExceeded; the parser must not be used after
  /// that.
  Result<std::vector<ServerEvent>> feed(std::string_view bytes);

 private:
  void take_line(std::string_view line, std::vector<ServerEvent>& events);
  std::string line_;
  bool skip_line_feed_ = false;  ///< the line ended with CR; an LF that follows belongs to it
  std::string name_;
  std::optional<std::string> data_;
};

}  // namespace dripline::client
