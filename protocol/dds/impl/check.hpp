#pragma once

#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"

/// Checks the members of a message by their rules (members.hpp), and the rules between members, for
/// both directions. Free text is not checked (check.hpp).

namespace dripline::dds {

Result<void> check(const Announce& message);
Result<void> check(const Status& message);
Result<void> check(const Record& message);
Result<void> check(const RecordAck& message);
Result<void> check(const Command& message);
Result<void> check(const CommandResult& message);
Result<void> check(const BlockRequest& message);
Result<void> check(const BlockData& message);
Result<void> check(const LineRequest& message);
Result<void> check(const LineData& message);

/// Well-formed UTF-8 (no overlong forms, surrogates or values beyond U+10FFFF) without NUL, which a
/// DDS string cannot carry.
bool is_sendable_text(std::string_view text);

/// The text with every byte that cannot be sent written as \xNN, cut at a character and ended with
/// "…" when longer than `limit` bytes (at least 8). Valid text that fits is unchanged.
std::string make_sendable(std::string_view text, std::size_t limit);

}  // namespace dripline::dds
