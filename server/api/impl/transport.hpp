#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>

#include "server/identity/caller.hpp"

namespace dripline::api {

/// The bytes of one connection, unencrypted or through TLS. Every wait has a deadline, after which
/// the connection is closed. On the socket thread.
class Transport {
 public:
  using Time = std::chrono::steady_clock::time_point;
  using Limit = std::chrono::milliseconds;
  virtual ~Transport() = default;

  /// TLS's handshake; false: the connection cannot be used.
  virtual boost::asio::awaitable<bool> open(Limit limit) = 0;
  /// Reads some bytes; 0: the connection has ended, or `until` has passed.
  virtual boost::asio::awaitable<std::size_t> read(boost::asio::mutable_buffer to, Time until) = 0;
  /// Writes all bytes; false: the connection has ended. The limit applies to each kWritePiece, so
  /// that a client that reads slowly is served and one that does not read is cut off.
  virtual boost::asio::awaitable<bool> write(std::string_view text, Limit limit) = 0;
  /// Ends our direction of the connection.
  virtual boost::asio::awaitable<void> say_goodbye(Limit limit) = 0;
  virtual boost::asio::ip::tcp::socket& socket() = 0;
  /// The other end's, which the handshake has verified; after `open`.
  virtual std::optional<identity::ClientCertificate> certificate() = 0;
  void close();
  /// The other end's. An IPv4 client of a socket for both protocols has its IPv4 address.
  std::string peer_address();

  static constexpr std::size_t kWritePiece = 256 * 1024;
};

/// `tls` null: unencrypted.
std::unique_ptr<Transport> make_transport(boost::asio::ip::tcp::socket socket,
                                          boost::asio::ssl::context* tls);

/// Wakes a coroutine from other handlers of the same thread. It has one waiter.
class Signal {
 public:
  using Time = std::chrono::steady_clock::time_point;
  explicit Signal(boost::asio::io_context& io) : timer_(io) {}
  void set() {
    is_set_ = true;
    timer_.cancel();
  }
  /// True: the signal was set, and this wait resets it; false: `until` has passed.
  boost::asio::awaitable<bool> wait(Time until = Time::max()) {
    if (!is_set_) {
      timer_.expires_at(until);
      boost::system::error_code ignored;
      co_await timer_.async_wait(boost::asio::redirect_error(boost::asio::use_awaitable, ignored));
    }
    co_return std::exchange(is_set_, false);
  }

 private:
  boost::asio::steady_timer timer_;
  bool is_set_ = false;
};

}  // namespace dripline::api
