#include "server/api/impl/http_head.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/field.hpp>
#include <ctime>
#include <iterator>

namespace dripline::api {
namespace {

namespace http = boost::beast::http;

constexpr std::size_t kMaxFields = 100;
constexpr std::size_t kMaxFieldName = 256;

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

/// A proxy and this server could read two of these differently.
bool comes_once(http::field name) {
  return name == http::field::authorization || name == http::field::host ||
         name == http::field::content_length || name == http::field::content_type ||
         name == http::field::transfer_encoding || name == http::field::range ||
         name == http::field::expect;
}

Result<void> read_fields(const RequestHead& head, Request& request) {
  std::size_t count = 0;
  for (const auto& field : head) {
    std::string name = lower(field.name_string());
    if (++count > kMaxFields) {
      return fail(Errc::LimitExceeded, "the request has more than {} header fields", kMaxFields);
    }
    if (name.size() > kMaxFieldName) {
      return fail(Errc::LimitExceeded, "the name of a header field has {} characters: at most {}",
                  name.size(), kMaxFieldName);
    }
    const std::string value(field.value());
    const auto [at, is_new] = request.headers.emplace(std::move(name), value);
    if (is_new) continue;
    if (comes_once(field.name()))
      return fail(Errc::Syntax, "header field {} is given twice", at->first);
    at->second += ", " + value;
  }
  return {};
}

const char* reason_of(int status) {
  static const std::map<int, const char*> kReasons{{200, "OK"},
                                                   {201, "Created"},
                                                   {204, "No Content"},
                                                   {206, "Partial Content"},
                                                   {304, "Not Modified"},
                                                   {400, "Bad Request"},
                                                   {401, "Unauthorized"},
                                                   {403, "Forbidden"},
                                                   {404, "Not Found"},
                                                   {405, "Method Not Allowed"},
                                                   {406, "Not Acceptable"},
                                                   {408, "Request Timeout"},
                                                   {409, "Conflict"},
                                                   {413, "Content Too Large"},
                                                   {416, "Range Not Satisfiable"},
                                                   {422, "Unprocessable Content"},
                                                   {429, "Too Many Requests"},
                                                   {431, "Request Header Fields Too Large"},
                                                   {500, "Internal Server Error"},
                                                   {501, "Not Implemented"},
                                                   {503, "Service Unavailable"},
                                                   {504, "Gateway Timeout"}};
  const auto found = kReasons.find(status);
  return found == kReasons.end() ? "Unknown" : found->second;
}

/// A control character in a name or value could begin another field or response.
bool is_safe(std::string_view text) {
  return std::ranges::none_of(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

std::string date_text() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  static constexpr std::array kDays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  static constexpr std::array kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                      "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  return fmt::format("{}, {:02} {} {} {:02}:{:02}:{:02} GMT",
                     kDays.at(static_cast<std::size_t>(parts.tm_wday)), parts.tm_mday,
                     kMonths.at(static_cast<std::size_t>(parts.tm_mon)), parts.tm_year + 1900,
                     parts.tm_hour, parts.tm_min, parts.tm_sec);
}

}  // namespace

Result<Request> to_request(const RequestHead& head) {
  constexpr unsigned kHttp11 = 11;
  Request request;
  auto target = parse_target({head.target().data(), head.target().size()});
  if (!target) return fail(target.error());
  request.target = *std::move(target);
  request.method = std::string(head.method_string());
  if (auto good = read_fields(head, request); !good) return fail(good.error());
  if (head.version() >= kHttp11 && !request.headers.contains("host")) {
    return fail(Errc::Syntax, "an HTTP/1.1 request names the server in a header field Host");
  }
  // A list of equal lengths is one length to some proxies, and none to others.
  if (const auto length = request.headers.find("content-length");
      length != request.headers.end() &&
      length->second.find_first_not_of("0123456789") != std::string::npos) {
    return fail(Errc::Syntax, "Content-Length is one number");
  }
  // A proxy could see the end of a body with another coding at another place.
  if (const auto coding = request.headers.find("transfer-encoding");
      coding != request.headers.end() &&
      (lower(coding->second) != "chunked" || request.headers.contains("content-length"))) {
    return fail(Errc::Syntax, "Transfer-Encoding: chunked alone is understood");
  }
  return request;
}

std::string head_text(const Response& response, const Framing& framing) {
  std::string text;
  text += fmt::format("HTTP/1.1 {} {}\r\nDate: {}\r\nX-Content-Type-Options: nosniff\r\n",
                      response.status, reason_of(response.status), date_text());
  const auto add = [&](std::string_view name, std::string_view value) {
    if (is_safe(name) && is_safe(value)) text += fmt::format("{}: {}\r\n", name, value);
  };
  if (!response.content_type.empty()) add("Content-Type", response.content_type);
  bool states_cache = false;
  for (const auto& [name, value] : response.headers) {
    add(name, value);
    states_cache = states_cache || name == "Cache-Control";
  }
  if (!states_cache) add("Cache-Control", "no-store");  // it may be for one user alone
  if (framing.is_chunked) {
    add("Transfer-Encoding", "chunked");
  } else if (framing.length && response.status != 204 && response.status != 304) {
    add("Content-Length", std::to_string(*framing.length));
  }
  add("Connection", framing.keeps_alive ? "keep-alive" : "close");
  text += "\r\n";
  return text;
}

std::string chunk_text(const std::string& piece) {
  if (piece.empty()) return {};
  return fmt::format("{:x}\r\n{}\r\n", piece.size(), piece);
}

Response refusal(int status, Errc code, std::string what) {
  Response response = error_response(status, {code, std::move(what)});
  if (status == 503) response.headers.emplace_back("Retry-After", "1");
  return response;
}

std::optional<Response> refusal_of(const boost::system::error_code& error) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    return refusal(431, Errc::LimitExceeded, "the head of the request is too large");
  }
  if (error == http::error::body_limit) {
    return refusal(413, Errc::LimitExceeded, "the body of the request is too large");
  }
  const bool is_gone = error == http::error::end_of_stream || error == http::error::partial_message;
  if (is_gone || error.category() != make_error_code(http::error::bad_method).category()) {
    return std::nullopt;
  }
  return refusal(400, Errc::Syntax, fmt::format("not an HTTP request: {}", error.message()));
}

}  // namespace dripline::api
