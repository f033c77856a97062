#include "server/api/impl/request_reader.hpp"

#include <algorithm>

namespace dripline::api {
namespace {

namespace http = boost::beast::http;
using boost::asio::awaitable;
using Clock = Transport::Time::clock;

constexpr std::uint32_t kMaxHead = 16 * 1024;
constexpr std::size_t kMaxBuffer = 128 * 1024;  ///< bound of pipelined requests in memory
constexpr std::size_t kReadHead = 4096;
constexpr std::size_t kReadBody = 64 * 1024;

/// No lambda of the coroutine: its type would be part of the coroutine's frame, which gcc refuses
/// in a joined source.
bool is_parsed(const RequestReader::Parser& parser, bool to_end) {
  return to_end ? parser.is_done() : parser.is_header_done();
}

}  // namespace

RequestReader::RequestReader(Transport& transport) : transport_(transport), buffer_(kMaxBuffer) {}

awaitable<std::size_t> RequestReader::fill(std::size_t most, Time until) {
  const std::size_t size = co_await transport_.read(buffer_.prepare(most), until);
  buffer_.commit(size);
  co_return size;
}

/// Parses and reads until the head, or all, of the message is there. gcc 12 breaks a co_await that
/// is part of a condition, so each is a statement.
awaitable<RequestReader::ErrorCode> RequestReader::advance(Parser& parser, bool to_end,
                                                           Limit silence, Time end) {
  for (;;) {
    ErrorCode error;
    while (buffer_.size() > 0 && !is_parsed(parser, to_end) && !error) {
      buffer_.consume(parser.put(buffer_.data(), error));
    }
    if (is_parsed(parser, to_end)) co_return ErrorCode();
    if (error && error != http::error::need_more) co_return error;
    const Time until = std::min<Time>(end, Clock::now() + silence);
    const std::size_t size = co_await fill(to_end ? kReadBody : kReadHead, until);
    if (size == 0) co_return http::error::end_of_stream;
  }
}

awaitable<RequestReader::ErrorCode> RequestReader::read_head(Parser& parser, Limit patience,
                                                             Limit limit) {
  parser.header_limit(kMaxHead);
  parser.body_limit(boost::none);
  if (buffer_.size() == 0) {
    const std::size_t size = co_await fill(kReadHead, Clock::now() + patience);
    if (size == 0) co_return http::error::end_of_stream;
  }
  co_return co_await advance(parser, false, limit, Clock::now() + limit);
}

awaitable<RequestReader::ErrorCode> RequestReader::read_body(Parser& parser, Limit silence,
                                                             Time end) {
  parser.eager(true);
  co_return co_await advance(parser, true, silence, end);
}

awaitable<std::size_t> RequestReader::discard(Time until) {
  buffer_.clear();
  co_return co_await fill(kReadBody, until);
}

}  // namespace dripline::api
