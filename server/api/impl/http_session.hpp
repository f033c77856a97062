#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <map>
#include <memory>

#include "server/api/http_server.hpp"
#include "server/api/impl/body_memory.hpp"
#include "server/api/impl/command_threads.hpp"
#include "server/api/impl/connection_table.hpp"
#include "server/api/impl/transport.hpp"
#include "server/machines/worker_pool.hpp"

namespace dripline::api {

class HttpSession;

/// The state that all connections share. All members except the handlers, the pool and the threads
/// belong to the socket thread.
struct HttpShared {
  HttpShared(const HttpOptions& http_options, HttpHandlers http_handlers,
             ConnectionTable::Limits seats)
      : options(http_options),
        handlers(std::move(http_handlers)),
        table(seats),
        body_memory(http_options.limits.body_memory),
        pool(http_options.handler_threads),
        commands(http_options.limits.waiting_commands) {}

  const HttpOptions options;
  const HttpHandlers handlers;
  ConnectionTable table;
  BodyMemory body_memory;
  std::map<ConnectionTable::Id, std::weak_ptr<HttpSession>> sessions;
  bool is_stopping = false;       ///< nothing is read any more; what was taken is answered
  boost::asio::io_context io{1};  ///< after the members that its coroutines use
  boost::asio::steady_timer last_answers{
      io};  ///< while the server stops; ends with the last session
  machines::WorkerPool pool;
  CommandThreads commands;
};

/// One connection: its requests, one after the other. On the socket thread.
class HttpSession {
 public:
  virtual ~HttpSession() = default;
  /// The server stops: closes, unless an answer is owed. That is sent, and is the last one.
  virtual void drain() = 0;
  /// Ends its waits on the network.
  virtual void close() = 0;
  /// No worker will answer it any more: its waits for one end.
  virtual void abandon() = 0;
};

/// Serves `socket` until it is closed; keeps itself alive. `tls` null: unencrypted.
void start_session(HttpShared& shared, boost::asio::ip::tcp::socket socket,
                   boost::asio::ssl::context* tls, const ConnectionTable::Admission& admission);

}  // namespace dripline::api
