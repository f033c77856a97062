#include "server/api/interpretation.hpp"

#include <charconv>
#include <cmath>

#include "server/paths/program_paths.hpp"

namespace dripline::api {

Result<double> read_tolerance(const std::optional<std::string>& text, double otherwise) {
  if (!text) return otherwise;
  double value = 0;
  const auto read = std::from_chars(text->data(), text->data() + text->size(), value);
  if (read.ec != std::errc{} || read.ptr != text->data() + text->size() || !std::isfinite(value))
    return fail(Errc::Syntax, "query parameter 'tolerance' is '{}': a number", *text);
  if (value < 0 || value > paths::kMaxTolerance) {
    return fail(Errc::LimitExceeded, "query parameter 'tolerance' is {}: 0 to {} mm", *text,
                paths::kMaxTolerance);
  }
  return value;
}

Response refused_interpretation(const Error& error) {
  constexpr int kUnavailable = 503;
  if (error.code != Errc::Busy) return error_response(error);
  Response response = error_response(kUnavailable, error);
  response.headers.emplace_back("Retry-After", "2");
  return response;
}

}  // namespace dripline::api
