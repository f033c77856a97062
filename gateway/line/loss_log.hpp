#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"

namespace dripline::line {

/// What the log says of a line that is lost and opened again. A device server that has another
/// client takes each connection and ends it at once: said once, then with a count at growing
/// intervals, and again when the line is steady. It speaks only when something happens. Not
/// thread-safe: used on the line's thread.
class LossLog {
 public:
  /// Between two messages about a line that comes and goes; each is twice as long as the one
  /// before.
  static constexpr std::chrono::minutes kFirstInterval{1}, kLongestInterval{60};
  /// Reasons that are given at once while the line comes and goes.
  static constexpr std::size_t kMaxReasons = 4;

  struct Message {
    bool is_warning = false;
    std::string text;  ///< follows the names of the port and its machine
  };

  /// `address` as of serial::open_channel.
  explicit LossLog(std::string_view address);

  /// The line is lost or cannot be opened. nullopt: nothing is to be logged.
  std::optional<Message> on_lost(const std::string& why, SteadyTime now);
  std::optional<Message> on_open();
  /// It has stayed open for some time (serial::LineListener::on_steady).
  std::optional<Message> on_steady();

 private:
  /// Since the line was steady last.
  struct Period {
    std::uint64_t opened = 0, lost = 0;
    bool is_open = false;
    bool is_unsteady = false;  ///< and the log has it
    SteadyTime unsteady_since{}, next_message{};
    std::chrono::minutes interval{kFirstInterval};
    std::set<std::string> reasons;  ///< that the log has
  };
  Message unsteady(const std::string& why, SteadyTime now);
  std::optional<Message> lost_again(const std::string& why, SteadyTime now);

  const bool is_device_server_;
  Period period_;
};

/// Writes it, if there is one, after `names` ("port=lathe machine=m1").
void log_message(std::string_view names, const std::optional<LossLog::Message>& message);

}  // namespace dripline::line
