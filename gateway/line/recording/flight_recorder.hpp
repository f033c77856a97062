#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "gateway/line/port_view.hpp"
#include "gateway/line/recording/recording_file.hpp"
#include "protocol/base/clock.hpp"
#include "protocol/serial/line_driver.hpp"

namespace dripline::line {

/// Keeps the last minutes of what passed over one line. Characters of one direction that follow
/// each other closely are one entry. Memory is bounded by Options; a copy goes to disk with every
/// flush, so that a kill costs what came after the last one. Any thread.
class FlightRecorder {
 public:
  struct Options {
    std::string port;
    std::filesystem::path folder;  ///< empty: in memory only
    std::size_t max_bytes = 4 * 1024 * 1024;
    std::chrono::seconds max_age{600};
  };
  /// An entry is closed at this size, when the direction changes, and this long after it began.
  static constexpr std::size_t kMaxEntry = 256;
  static constexpr std::chrono::milliseconds kMaxSpan{50};

  /// Reads what an earlier life of the server has left. `on_entry` is called by flush().
  FlightRecorder(Options options, const Clock& clock,
                 std::function<void(const PortTraffic&)> on_entry);

  /// Uses memory only: for the line's thread.
  void add(const serial::LineTraffic& traffic);
  /// Publishes and writes complete entries, in their order; called some times a second.
  void flush();
  /// Resets the counts.
  void on_opened();
  /// Oldest first.
  std::vector<PortTraffic> entries() const;
  /// Entries are numbered from kFirst on; what an earlier life has left lies before that. Those
  /// from `number` on that are still here; the first of them has the number `first`. Only complete
  /// ones, so that their number is final.
  static constexpr std::uint64_t kFirst = std::uint64_t{1} << 32U;
  struct Part {
    std::uint64_t first = 0;
    std::vector<PortTraffic> entries;
  };
  Part entries_from(std::uint64_t number, std::size_t max_entries = 512) const;
  /// The number that the next complete entry gets.
  std::uint64_t next_number() const;
  std::uint64_t sent() const;      ///< characters, since the line was opened
  std::uint64_t received() const;  ///< the same
  std::uint64_t faults() const;    ///< the same

 private:
  bool joins(const serial::LineTraffic& traffic, UtcTime now) const;
  void append(PortTraffic entry);
  void close_open(UtcTime now);
  void drop_old(UtcTime now);

  const Options options_;
  const Clock& clock_;
  const std::function<void(const PortTraffic&)> on_entry_;
  std::mutex flushing_;                ///< one flush at a time; taken before `mutex_`
  std::optional<RecordingFile> file_;  ///< used by flush only
  mutable std::mutex mutex_;           ///< guards all below
  std::deque<PortTraffic> entries_;
  std::optional<PortTraffic> open_;  ///< still growing
  std::uint64_t first_ = kFirst;     ///< number of the oldest entry, or of the next one
  std::size_t bytes_ = 0;
  std::size_t untold_ = 0;  ///< of the newest entries
  std::uint64_t sent_ = 0, received_ = 0, faults_ = 0;
};

}  // namespace dripline::line
