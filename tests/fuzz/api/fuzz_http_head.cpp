// The head of an HTTP request. Properties: cut anywhere it reads the same, and a request that is
// taken names one token, one host and one length at most.
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdlib>

#include "server/api/impl/http_head.hpp"

namespace {

namespace http = boost::beast::http;

/// Method, path and token, or why not.
std::string read(std::string_view text, std::size_t cut) {
  http::request_parser<http::string_body> parser;
  parser.header_limit(16 * 1024);
  boost::beast::flat_buffer buffer;
  boost::system::error_code error;
  for (const std::string_view piece : {text.substr(0, cut), text.substr(cut)}) {
    const auto to = buffer.prepare(piece.size());
    piece.copy(static_cast<char*>(to.data()), piece.size());
    buffer.commit(piece.size());
    while (buffer.size() > 0 && !parser.is_header_done() && !error) {
      buffer.consume(parser.put(buffer.data(), error));
    }
    if (error == http::error::need_more) error = {};
    if (error) return dripline::api::refusal_of(error) ? "refused" : "gone";
  }
  if (!parser.is_header_done()) return "more";
  const auto request = dripline::api::to_request(parser.get().base());
  if (!request) return "refused";
  const auto& fields = parser.get();
  if (fields.count(http::field::authorization) > 1 || fields.count(http::field::host) > 1 ||
      fields.count(http::field::content_length) > 1) {
    std::abort();
  }
  return request->method + " " + request->header("authorization");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
  // Half a head may be refused at once, or when the rest of it came.
  const std::string whole = read(text, text.size());
  const std::string parts = read(text, std::min<std::size_t>(data[0], text.size()));
  if (whole != parts && whole != "more" && parts != "more") std::abort();
  return 0;
}
