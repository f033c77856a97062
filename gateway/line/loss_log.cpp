#include "gateway/line/loss_log.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "protocol/process/log.hpp"

namespace dripline::line {

LossLog::LossLog(std::string_view address)
    : is_device_server_(address.starts_with("tcp://") || address.starts_with("rfc2217://")) {}

std::optional<LossLog::Message> LossLog::on_lost(const std::string& why, SteadyTime now) {
  const bool was_open = std::exchange(period_.is_open, false);
  if (was_open) ++period_.lost;
  if (period_.is_unsteady) return lost_again(why, now);
  period_.reasons.insert(why);
  // A first loss is an unplugged cable; a second one right after the line is back is not.
  if (was_open && period_.opened > 1) return unsteady(why, now);
  return Message{false, "has no line: " + why};
}

LossLog::Message LossLog::unsteady(const std::string& why, SteadyTime now) {
  period_.is_unsteady = true;
  period_.unsteady_since = now;
  period_.next_message = now + period_.interval;
  return {true, fmt::format("is opened and lost again and again: {}{}", why,
                            is_device_server_ ? ". Another client may have the port of the device "
                                                "server (an old server that is frozen, a terminal)"
                                              : "")};
}

std::optional<LossLog::Message> LossLog::lost_again(const std::string& why, SteadyTime now) {
  const bool is_new = period_.reasons.size() < kMaxReasons && period_.reasons.insert(why).second;
  if (is_new) return Message{true, "has no line: " + why};
  if (now < period_.next_message) return std::nullopt;
  period_.interval = std::min(period_.interval * 2, kLongestInterval);
  period_.next_message = now + period_.interval;
  const auto minutes = std::chrono::floor<std::chrono::minutes>(now - period_.unsteady_since);
  return Message{true, fmt::format("is still opened and lost again, {} times in {} min: {}",
                                   period_.lost, minutes.count(), why)};
}

std::optional<LossLog::Message> LossLog::on_open() {
  period_.is_open = true;
  ++period_.opened;
  if (period_.is_unsteady) return std::nullopt;
  return Message{false, "is open"};
}

std::optional<LossLog::Message> LossLog::on_steady() {
  const Period before = std::exchange(period_, {});
  period_.opened = 1;
  period_.is_open = true;
  if (!before.is_unsteady) return std::nullopt;
  return Message{false, fmt::format("is open and stays so; it was lost {} times", before.lost)};
}

void log_message(std::string_view names, const std::optional<LossLog::Message>& message) {
  if (!message) return;
  if (message->is_warning) {
    process::log_warning("{} {}", names, message->text);
  } else {
    process::log_info("{} {}", names, message->text);
  }
}

}  // namespace dripline::line
