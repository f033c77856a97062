#pragma once

#include <boost/asio/awaitable.hpp>
#include <optional>

#include "server/api/impl/body_memory.hpp"
#include "server/api/impl/http_session.hpp"
#include "server/api/impl/request_reader.hpp"
#include "server/api/impl/transport.hpp"

namespace dripline::api {

/// Receives the bodies of one connection within their bounds of size, memory and time. On the
/// socket thread.
class BodyReader {
 public:
  struct Parts {
    HttpShared& shared;
    Transport& transport;
    RequestReader& reader;
    Signal& woken;          ///< of the connection
    const bool& is_closed;  ///< it
  };
  explicit BodyReader(const Parts& parts) : parts_(parts) {}

  /// What is left of the parser's request, whose head is `head`. nullopt when it was read; else the
  /// answer, with a status of 0 when the client is gone.
  boost::asio::awaitable<std::optional<Response>> read(RequestReader::Parser& parser,
                                                       const Request& head,
                                                       BodyMemory::Share& share);

 private:
  std::uint64_t limit_of(const Request& head) const;
  bool may_continue() const { return !parts_.is_closed && !parts_.shared.is_stopping; }
  boost::asio::awaitable<bool> take_memory(std::uint64_t size, const std::string& caller,
                                           BodyMemory::Share& share);

  Parts parts_;
};

}  // namespace dripline::api
