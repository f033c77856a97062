#pragma once

#include <boost/asio/awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>

#include "server/api/impl/transport.hpp"

namespace dripline::api {

/// The requests of one connection, read piece by piece with bounded memory. Errors are the
/// parser's; end_of_stream: the client is gone, or a deadline has passed. On the socket thread.
class RequestReader {
 public:
  using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
  using Time = Transport::Time;
  using Limit = Transport::Limit;
  using ErrorCode = boost::system::error_code;
  explicit RequestReader(Transport& transport);

  /// The head may begin within `patience` and takes `limit` from its first byte on. The body's
  /// size is left to be checked when the caller is known.
  boost::asio::awaitable<ErrorCode> read_head(Parser& parser, Limit patience, Limit limit);
  /// Ends after `silence` without a byte, or at `end`.
  boost::asio::awaitable<ErrorCode> read_body(Parser& parser, Limit silence, Time end);
  /// Reads some bytes and drops them: their number, 0 at the end of the connection.
  boost::asio::awaitable<std::size_t> discard(Time until);

 private:
  boost::asio::awaitable<ErrorCode> advance(Parser& parser, bool to_end, Limit silence, Time end);
  boost::asio::awaitable<std::size_t> fill(std::size_t most, Time until);

  Transport& transport_;
  boost::beast::flat_buffer buffer_;
};

}  // namespace dripline::api
