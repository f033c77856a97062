#pragma once

#include <string_view>

#include "clients/tools/conversational/events.hpp"
#include "protocol/base/result.hpp"

namespace dripline::conversational {

inline constexpr std::size_t kMaxFile = 1024 * 1024;

/// The events of a file: TOML with one `[[event]]` each, or the same as JSON (`{"event": [...]}`,
/// found out by the brace it begins with). The README lists what events and fields mean. Pure.
/// Errors: Syntax (the event's number and type, the field, its value and its limit);
/// LimitExceeded (a file over kMaxFile).
Result<Events> read_events(std::string_view text);

}  // namespace dripline::conversational
