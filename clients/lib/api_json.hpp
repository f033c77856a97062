#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "clients/lib/api_types.hpp"
#include "clients/lib/value_types.hpp"
#include "protocol/base/result.hpp"

/// The server's JSON as values and back. Reading is strict about types and required members, and
/// ignores unknown members, so that an older client works with a newer server. Writing gives
/// members in the documented order, absent values as null.
namespace dripline::client {

/// Errors: Syntax, naming the member. Instances exist for every type of api_types.hpp.
template <class T>
Result<T> from_json(const nlohmann::json& json);

template <class T>
nlohmann::ordered_json to_json_value(const T& value);

/// Parses a whole text. Errors: Syntax.
Result<nlohmann::json> parse_json(std::string_view text);

}  // namespace dripline::client
