#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "server/app/open_store.hpp"
#include "server/app/settings.hpp"

namespace dripline::app {

struct ServerParts;

/// The whole server, put together. The only place that knows all its parts.
class Server {
 public:
  /// Listens and takes part in DDS when it returns. Errors: Denied (unsafe settings), Io, Busy
  /// (another server uses the folder or the database), Corrupt, Unsupported. `place.on_lost`:
  /// the database is another server's now, and this one can only end.
  /// `on_handed_over`: a person has asked for a hand-over to a server that waits, which this one's
  /// end is; from any thread, and returns soon.
  static Result<std::unique_ptr<Server>> start(const Settings& settings, const Clock& clock,
                                               PlaceUse place = {},
                                               std::function<void()> on_handed_over = {});
  /// In order: accepts nothing, flushes storage, leaves DDS. A library that servers share is not
  /// renewed from then on. Errors: Timeout (a hot folder does not answer: the library was given
  /// back, nothing is stored any more, and the process is to end without another step, because the
  /// folder's thread uses the server as long as that lives).
  Result<void> end();
  /// `end`, where it was not called; after its Timeout what the thread uses stays.
  ~Server();

  const std::string& url() const;
  /// storage::OpenedStore::term
  std::uint64_t term() const;
  /// Of the MTConnect agent; empty: there is none.
  const std::string& mtconnect_url() const;
  /// From time to time: drops abandoned uploads.
  void tidy();
  /// One line for the service manager. Takes the locks that a request takes: a server whose threads
  /// block each other does not return.
  std::string status() const;

 private:
  explicit Server(std::unique_ptr<ServerParts> parts);
  std::unique_ptr<ServerParts> parts_;
  std::optional<Result<void>> ended_;
};

}  // namespace dripline::app
