#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"

/// Pieces of XML text. What XML cannot carry (control characters, bytes that are not UTF-8) becomes
/// U+FFFD, so that no program name or message of a machine makes a document malformed. Pure.
namespace dripline::mtconnect {

/// As content or as the value of an attribute between double quotes.
void append_escaped(std::string& xml, std::string_view text);
std::string escaped(std::string_view text);

/// ` name="value"`
void append_attribute(std::string& xml, std::string_view name, std::string_view value);
void append_attribute(std::string& xml, std::string_view name, std::uint64_t value);

/// 2026-11-21T07:40:06.123456Z
void append_time(std::string& xml, UtcTime time);

/// With at most four decimals, without zeros at its end: 12.5, -0.0001, 3. Finite numbers alone.
std::string number_text(double value);

}  // namespace dripline::mtconnect
