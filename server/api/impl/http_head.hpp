#pragma once

#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/system/error_code.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "server/api/request.hpp"
#include "server/api/response.hpp"

/// Converts the heads of requests and responses between Beast's types and ours. Pure.
namespace dripline::api {

using RequestHead = boost::beast::http::request_header<boost::beast::http::fields>;

/// Errors: Syntax (no or two Hosts, a field that may come once comes twice, a bad target, a coding
/// other than chunked), LimitExceeded (target, count or size of fields). A field that comes twice
/// otherwise is joined by a comma.
Result<Request> to_request(const RequestHead& head);

/// How the end of a response is marked.
struct Framing {
  std::optional<std::uint64_t> length = {};  ///< absent: chunked, or until the connection ends
  bool is_chunked = false;
  bool keeps_alive = true;
};
/// Status line and fields up to the empty line. Fields that would break the head are left out.
std::string head_text(const Response& response, const Framing& framing);

/// A chunk of a chunked body; nothing for an empty one.
std::string chunk_text(const std::string& piece);

/// The answer to a request that the parser refuses; nullopt: none, the client is gone.
std::optional<Response> refusal_of(const boost::system::error_code& error);
Response refusal(int status, Errc code, std::string what);

}  // namespace dripline::api
