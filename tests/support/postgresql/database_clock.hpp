#pragma once

#include <chrono>
#include <string>

namespace dripline::test {

/// The clock of a test's database, which can be set: `now()` and `clock_timestamp()` of all
/// connections that are opened from then on. Failures are reported through gtest assertions.
class DatabaseClock {
 public:
  explicit DatabaseClock(std::string url);
  /// By so much more than before; negative: back.
  void shift(std::chrono::seconds by) const;

 private:
  std::string url_;
};

}  // namespace dripline::test
