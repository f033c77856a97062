#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <chrono>
#include <memory>
#include <string_view>

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
  void close();

  static constexpr std::size_t kWritePiece = 256 * 1024;
};

/// `tls` null: unencrypted.
std::unique_ptr<Transport> make_transport(boost::asio::ip::tcp::socket socket,
                                          boost::asio::ssl::context* tls);

}  // namespace dripline::api
