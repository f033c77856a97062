#pragma once

#include <cerrno>
#include <chrono>
#include <string>
#include <system_error>
#include <thread>

#include "protocol/process/log.hpp"

namespace dripline::gateway {

/// Memory or files are short: the panel is heard again as soon as there are some. One thread.
class Shortage {
 public:
  /// After `call` has failed; errno has the reason. Logged now and then.
  void wait_out(const char* call) {
    constexpr std::chrono::milliseconds kPause{50};
    constexpr std::chrono::seconds kSilence{10};
    const std::string reason = std::generic_category().message(errno);
    if (const auto now = std::chrono::steady_clock::now(); now >= next_log_) {
      process::log_error("panel: {}: {}; it is tried again", call, reason);
      next_log_ = now + kSilence;
    }
    std::this_thread::sleep_for(kPause);
  }

 private:
  std::chrono::steady_clock::time_point next_log_{};
};

}  // namespace dripline::gateway
