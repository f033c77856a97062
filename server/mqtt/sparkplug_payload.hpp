#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::mqtt {

/// The payload of Sparkplug B: names with values, as protocol buffers. (Eclipse Sparkplug 3.0,
/// chapter 6.4)
struct Metric {
  /// In the order of `Value`.
  enum class Type : std::uint8_t { Unsigned, Double, Boolean, Text };
  using Value = std::variant<std::uint64_t, double, bool, std::string>;

  std::string name;
  Type type = Type::Text;
  std::optional<Value> value;  ///< of `type`; nullopt: null

  friend bool operator==(const Metric&, const Metric&) = default;
};

struct Payload {
  UtcTime time;                     ///< also of each metric
  std::optional<std::uint8_t> seq;  ///< of the message within its session; none in NDEATH
  std::vector<Metric> metrics = {};
};
std::string encode(const Payload& payload);

/// What a JSON document says, as metrics: `status/position/X`, `display/0/text`. Numbers are
/// Double. A null has no type: it is left out.
std::vector<Metric> metrics_of(const nlohmann::json& document);

/// Whether a command to the node (NCMD) asks for all births again; of anything else, and of bytes
/// that are no payload, nothing is taken.
bool asks_rebirth(std::string_view payload);
inline constexpr const char* kRebirth = "Node Control/Rebirth";

/// Errors: Syntax (empty, or with one of / + # or a control character).
Result<void> check_sparkplug_id(std::string_view id);

}  // namespace dripline::mqtt
