#include "gateway/interpreter/core/local_time.hpp"

#include <chrono>

namespace dripline::interpreter {

using std::chrono::milliseconds;

std::int64_t milliseconds_of(const LocalTime& time) {
  const std::chrono::year_month_day date(std::chrono::year(time.year),
                                         std::chrono::month(static_cast<unsigned>(time.month)),
                                         std::chrono::day(static_cast<unsigned>(time.day)));
  const milliseconds day = std::chrono::sys_days(date).time_since_epoch();
  const milliseconds within = std::chrono::hours(time.hour) + std::chrono::minutes(time.minute) +
                              std::chrono::seconds(time.second) + milliseconds(time.millisecond);
  return (day + within).count();
}

LocalTime local_time_at(std::int64_t since_1970) {
  const std::chrono::sys_time<milliseconds> time{milliseconds(since_1970)};
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  return {static_cast<int>(date.year()),
          static_cast<int>(static_cast<unsigned>(date.month())),
          static_cast<int>(static_cast<unsigned>(date.day())),
          static_cast<int>(clock.hours().count()),
          static_cast<int>(clock.minutes().count()),
          static_cast<int>(clock.seconds().count()),
          static_cast<int>(clock.subseconds().count())};
}

}  // namespace dripline::interpreter
