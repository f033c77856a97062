#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Values as people read them.

namespace dripline::cli {

/// 512 B, 1.5 kB, 12.0 MB, 1.07 GB: SI units.
std::string bytes_text(std::uint64_t bytes);
/// 0:07, 12:34, 1:02:03; rounded down to seconds, never negative.
std::string duration_text(double seconds);
/// 2026-11-21T07:40:06.123456Z as local time "2026-11-21 08:40:06"; other texts as they are.
std::string time_text(std::string_view iso8601);
/// Its time of day with milliseconds, "08:40:06.123".
std::string clock_text(std::string_view iso8601);
/// Seconds between two such times; 0 when one is not a time.
double seconds_between(std::string_view from, std::string_view to);
/// Of a control's variable, an offset or a table: to ten digits, so without what converting inches
/// leaves in the last ones; JSON has all of them. Nothing: "vacant".
std::string control_value_text(const std::optional<double>& value);
/// The first eight characters of a run's id or a digest: enough for people, and `dnc` takes it.
std::string short_id(std::string_view id);

}  // namespace dripline::cli
