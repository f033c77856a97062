#pragma once

#include <optional>
#include <string>

#include "server/api/response.hpp"

/// What the routes that interpret programs have in common: path, check, comparison.
namespace dripline::api {

/// The query parameter `tolerance`, millimeters; `otherwise` where it is absent. Errors: Syntax,
/// LimitExceeded.
Result<double> read_tolerance(const std::optional<std::string>& text, double otherwise);

/// An interpretation that did not begin; too many at once: 503, and when to ask again.
Response refused_interpretation(const Error& error);

}  // namespace dripline::api
