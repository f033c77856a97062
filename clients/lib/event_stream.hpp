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

/// The stream is open: what happened before is not in it, so ask for the present state now.
struct StreamOpened {};
/// The connection is gone; the stream tries again by itself, unless the server denied it.
struct StreamLost {
  Failure failure;
};
using StreamItem = std::variant<StreamOpened, StreamLost, Machine, Run, Record>;

/// The server's events (GET /api/v1/events), read by a thread of its own that reconnects with
/// back-off. `next` is for one thread. At most 1024 items wait; when the reader falls behind, the
/// connection is not read on, and what the server then drops is made good by the next StreamOpened.
class EventStream {
 public:
  /// `machine` empty: of all machines.
  EventStream(const ServerAddress& address, const std::string& machine);
  ~EventStream();
  EventStream(const EventStream&) = delete;
  EventStream& operator=(const EventStream&) = delete;

  /// The next item, or nullopt when none came in time.
  std::optional<StreamItem> next(std::chrono::milliseconds timeout);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dripline::client
