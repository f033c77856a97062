#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dripline::interpreter {

/// Appends `value` with at most 6 decimals, no trailing zeros, no exponent and no negative zero.
/// A value that is not finite becomes `null`, as JSON has no word for it.
void append_number(std::string& out, double value);
void append_integer(std::string& out, std::int64_t value);
void append_integer(std::string& out, std::uint64_t value);

/// Appends `text` as a JSON string with its quotes. Bytes that are not valid UTF-8 become U+FFFD,
/// so that the output is valid whatever a program holds.
void append_json_string(std::string& out, std::string_view text);

}  // namespace dripline::interpreter
