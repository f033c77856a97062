#include "server/api/response.hpp"

#include <nlohmann/json.hpp>

namespace dripline::api {

std::string to_text(const nlohmann::json& value) {
  // Stored text is UTF-8; if a byte is damaged, the rest can still be shown.
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Response json_response(int status, const nlohmann::json& value) {
  Response response = json_text_response(to_text(value));
  response.status = status;
  return response;
}

Response json_text_response(std::string text) {
  Response response;
  response.content_type = "application/json";
  response.body = std::move(text);
  return response;
}

Response no_content() {
  Response response;
  response.status = 204;
  return response;
}

int http_status(Errc code) {
  switch (code) {
    case Errc::Syntax:
      return 400;
    case Errc::Denied:
      return 401;
    case Errc::NotFound:
      return 404;
    case Errc::Busy:
    case Errc::Conflict:
      return 409;
    case Errc::LimitExceeded:
      return 413;
    case Errc::Unsupported:
      return 422;
    case Errc::Corrupt:
    case Errc::Io:
      return 500;
    case Errc::Timeout:
      return 504;
  }
  return 500;
}

Response error_response(const Error& error) {
  return error_response(http_status(error.code), error);
}

Response error_response(int status, const Error& error) {
  return json_response(
      status, {{"error", {{"code", std::string(to_string(error.code))}, {"message", error.what}}}});
}

}  // namespace dripline::api
