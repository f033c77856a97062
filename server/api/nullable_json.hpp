#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"

/// What is absent is null in the API's answers.
namespace dripline::api {

inline nlohmann::json text_or_null(std::string_view text) {
  return text.empty() ? nlohmann::json(nullptr) : nlohmann::json(text);
}
inline nlohmann::json time_or_null(const std::optional<UtcTime>& time) {
  return time ? nlohmann::json(to_iso8601(*time)) : nlohmann::json(nullptr);
}
inline nlohmann::json number_or_null(const std::optional<std::uint64_t>& number) {
  return number ? nlohmann::json(*number) : nlohmann::json(nullptr);
}
inline nlohmann::json number_or_null(const std::optional<double>& number) {
  return number ? nlohmann::json(*number) : nlohmann::json(nullptr);
}

}  // namespace dripline::api
