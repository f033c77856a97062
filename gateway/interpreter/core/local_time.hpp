#pragma once

#include <cstdint>

namespace dripline::interpreter {

/// What the control's clock shows.
struct LocalTime {
  int year = 0, month = 1, day = 1, hour = 0, minute = 0, second = 0;
  int millisecond = 0;
};

/// Since the beginning of 1970 on the same clock.
std::int64_t milliseconds_of(const LocalTime& time);
LocalTime local_time_at(std::int64_t milliseconds);

}  // namespace dripline::interpreter
