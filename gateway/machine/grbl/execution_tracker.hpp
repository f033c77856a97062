#pragma once

#include <cstdint>
#include <deque>

#include "gateway/machine/grbl/reply.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::machine::grbl {

/// Which lines the board has executed, by its status reports. An `ok` shows that a line was parsed,
/// never that it was executed. Pure.
///
/// Lines have serial numbers from 1; their N words begin again after the last of `numbers`, which
/// are more than a board ever holds lines: every byte is time on the line.
///
/// Three reports show execution:
/// - `Ln:` names the planner's block: every line before it has left the planner;
/// - `Bf:` shows how many blocks the planner still has: so many lines at most are left;
/// - Idle with every line answered and an empty planner: everything is executed.
/// The planner runs ahead of the axes, Grbl's by up to 60 ms, grblHAL's by up to 100 ms. So what
/// the first two show is believed only kAhead later, if the board is still in Run then. The last
/// lines are shown by Idle alone.
class ExecutionTracker {
 public:
  static constexpr std::chrono::milliseconds kAhead{150};

  /// The serial number of the next line.
  std::uint64_t sent(bool moves);
  void answered();
  /// False: the report names a line that was never sent, or that the board has not come to yet.
  [[nodiscard]] bool reported(const StatusReport& report, SteadyTime now);

  void set_numbers(std::uint32_t count) { numbers_ = count; }
  /// Free blocks of an empty planner, as reported at rest; unknown: absent.
  void set_capacity(std::optional<int> blocks) { capacity_ = blocks; }
  std::uint64_t sent() const { return sent_; }
  std::uint64_t executed() const { return executed_; }
  bool is_empty() const { return executed_ == sent_; }
  /// The board has dropped what it had, executed or not: the count stays, the rest is forgotten.
  void drop();
  std::uint32_t number_of(std::uint64_t serial) const {
    return static_cast<std::uint32_t>((serial - 1) % numbers_ + 1);
  }

 private:
  void execute_to(std::uint64_t serial);
  std::uint64_t shown_by_line(std::uint32_t number, bool& is_known) const;
  std::uint64_t shown_by_buffers(int free_blocks) const;
  void on_rest(const StatusReport& report);

  std::uint32_t numbers_ = 99'999;
  std::uint64_t sent_ = 0, answered_ = 0, executed_ = 0;
  std::deque<bool> moves_;  ///< of the lines after `executed_`
  struct Shown {
    std::uint64_t serial = 0;
    SteadyTime at{};
  };
  std::deque<Shown> shown_;  ///< by reports in Run that are younger than kAhead
  std::optional<int> capacity_;
  bool has_seen_number_ = false;
  int rests_ = 0;  ///< reports at rest in a row
};

}  // namespace dripline::machine::grbl
