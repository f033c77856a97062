#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "storage/record_store.hpp"

/// What messages are called. Pure.
namespace dripline::mqtt {

inline constexpr std::size_t kMaxPrefix = 128;

/// Levels with `/` between them, none of them empty, no wildcard, not the broker's own ($).
/// Errors: Syntax, LimitExceeded.
Result<void> check_prefix(std::string_view prefix);
/// Of records. Errors: Syntax (names the kinds that there are).
Result<void> check_kind(std::string_view kind);

std::string online_topic(const std::string& prefix);
std::string status_topic(const std::string& prefix, const std::string& machine);
std::string record_topic(const std::string& prefix, const storage::Record& record);

/// The same for ever, and of no other record: MACHINE-EPOCH-NUMBER.
std::string record_id(const storage::Record& record);

}  // namespace dripline::mqtt
