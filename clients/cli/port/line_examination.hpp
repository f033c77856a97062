#pragma once

#include <chrono>
#include <functional>
#include <string_view>

#include "clients/tools/lines/line_diagnosis.hpp"
#include "protocol/serial/channel.hpp"

namespace dripline::cli {

/// Listens to an open line while its control punches out: at one rate after the other until what
/// comes reads as a program, then for longer; then sends XOFF and counts what still comes. One
/// thread.
struct LineExamination {
  serial::Channel& channel;
  std::chrono::milliseconds listen{30'000};  ///< at most, for something to come and be read
  bool tries_stop = true;                    ///< send XOFF, and XON again
  /// Returns when something may have come, or the time is over.
  std::function<void(std::chrono::milliseconds)> wait;
  std::function<wire::LineTime()> now;
  std::function<bool()> is_ended;             ///< Ctrl-C
  std::function<void(std::string_view)> say;  ///< what is being done, for people
};

/// The channel's settings and modem lines are changed. Errors: Io.
Result<wire::LineObservation> examine_line(const LineExamination& parts);

}  // namespace dripline::cli
