#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"

namespace dripline::cli {

/// Decides which states of a watched thing are worth a line in a pipe: each change of its `key`
/// (what it executes, what it reports) at once, and other changes (counters) every five seconds.
class ChangeLog {
 public:
  bool is_worth_a_line(const std::string& key, const std::string& line, SteadyTime now) {
    const bool is_new = key_ != key;
    const bool is_due = line_ != line && now - printed_ >= kEvery;
    if (!is_new && !is_due) return false;
    key_ = key;
    line_ = line;
    printed_ = now;
    return true;
  }

 private:
  static constexpr auto kEvery = std::chrono::seconds(5);
  std::optional<std::string> key_;
  std::string line_;
  SteadyTime printed_{};
};

}  // namespace dripline::cli
